//! Expressions that stand where a position belongs: literals, variables, `get_inverse_kin`, `pose_trans`.

use std::ops::Range;

use crate::geometry::pose::Pose;
use crate::program::target::Reference;

use super::motion::argument;
use super::statement;
use super::token::Text;
use super::value::{Literal, literal};
use super::variable::{Variables, is_single};

/// Variables of variables and calls in calls are followed this deep.
const MAX_DEPTH: usize = 8;

/// A file while it is read.
#[derive(Clone, Copy)]
pub(super) struct File<'a> {
    /// Its number in the job.
    pub file: usize,
    /// Its tokens.
    pub text: Text<'a>,
    /// Its statements.
    pub code: &'a statement::Program,
    /// Its variables.
    pub variables: &'a Variables,
}

/// What an argument of a move turned out to be.
#[derive(Clone, Debug)]
pub(super) enum Goal {
    /// A literal list, by its tokens, and the variable that holds it.
    Written(Range<usize>, Option<String>),
    /// `pose_trans` of two written poses.
    Composed(Box<Composed>),
    /// Known only at run time, with the reason.
    Runtime(String),
}

/// `pose_trans(from, to)`.
#[derive(Clone, Debug)]
pub(super) struct Composed {
    /// The first pose.
    pub from: Range<usize>,
    /// The literals that make the frame.
    pub parts: Vec<usize>,
    /// Its value.
    pub frame: Pose,
    /// The literal of the second pose.
    pub to: Range<usize>,
    /// The variable that holds it.
    pub name: Option<String>,
}

impl<'a> File<'a> {
    /// What an argument of a move is; with the joints that `get_inverse_kin` is to stay near, and a tool of its own.
    pub fn goal(self, range: &Range<usize>, at: usize) -> (Goal, Option<[f64; 6]>, Option<Reference>) {
        if self.call(range) != Some(b"get_inverse_kin") {
            return match self.single(range, at) {
                // `q = get_inverse_kin(..)` and `movej(q)`.
                Ok((value, place)) if self.call(&value) == Some(b"get_inverse_kin") => self.goal(&value, place),
                _ => (self.position(range, at), None, None),
            };
        }
        let arguments = self.text.parts(range.start + 1, range.end).map(|(parts, _)| parts).unwrap_or_default();
        let Some(pose) = argument(self.text, &arguments, 0, &[b"x", b"pose"]) else {
            return (Goal::Runtime("`get_inverse_kin` of nothing".into()), None, None);
        };
        let near = argument(self.text, &arguments, 1, &[b"qnear"]).and_then(|range| self.joints_deg(&range, at));
        let tool = argument(self.text, &arguments, 4, &[b"tcp"])
            .filter(|range| self.text.show(range) != "\"active_tcp\"")
            .map(|range| Reference::Runtime(format!("`get_inverse_kin` names the TCP `{}`", self.text.show(&range))));
        (self.position(&pose, at), near, tool)
    }

    /// The name of the function that an expression calls, if it is nothing but that call.
    fn call(self, range: &Range<usize>) -> Option<&'a [u8]> {
        let word = self.text.word(range.start);
        let (_, close) = self.text.is(range.start + 1, b'(').then(|| self.text.parts(range.start + 1, range.end))??;
        (!word.is_empty() && close + 1 == range.end).then_some(word)
    }

    /// The value of a variable, and where that stands.
    fn single(self, range: &Range<usize>, at: usize) -> Result<(Range<usize>, usize), String> {
        if !is_single(self.text, range) {
            return Err(format!("`{}` is computed", shortened(&self.text.show(range))));
        }
        let seen = self.variables.seen(self.text, self.code, self.text.word(range.start), at)?;
        let value = seen.value.clone().ok_or_else(|| "a part of it is set".to_owned())?;
        Ok((value, seen.statement))
    }

    fn position(self, range: &Range<usize>, at: usize) -> Goal {
        if self.call(range) == Some(b"pose_trans") {
            let arguments = self.text.parts(range.start + 1, range.end).map(|(parts, _)| parts).unwrap_or_default();
            let [from, to] = &arguments[..] else { return Goal::Runtime("`pose_trans` takes two poses".into()) };
            let both =
                self.constant(from, at, 0).and_then(|(frame, parts)| Ok((frame, parts, self.written(to, at, 0)?)));
            return match both {
                Ok((frame, parts, (to, name))) => {
                    Goal::Composed(Box::new(Composed { from: from.clone(), parts, frame, to, name }))
                }
                Err(reason) => Goal::Runtime(reason),
            };
        }
        match self.written(range, at, 0) {
            Ok((list, name)) => Goal::Written(list, name),
            Err(reason) => {
                // `approach = pose_trans(..)` and `movel(approach)`.
                let composed = self.single(range, at).ok().filter(|(value, _)| self.call(value) == Some(b"pose_trans"));
                composed.map_or(Goal::Runtime(reason), |(value, place)| self.position(&value, place))
            }
        }
    }

    /// The literal list that an expression stands for, and the variable that holds it.
    fn written(self, range: &Range<usize>, at: usize, depth: usize) -> Result<(Range<usize>, Option<String>), String> {
        if literal(self.text, range).is_some() {
            return Ok((range.clone(), None));
        }
        let (value, place) = self.single(range, at)?;
        if depth >= MAX_DEPTH {
            return Err("it goes through too many variables".into());
        }
        let (list, name) = self.written(&value, place, depth + 1)?;
        Ok((list, Some(name.unwrap_or_else(|| self.text.show(range)))))
    }

    /// A pose that is a constant, and the first tokens of the lists that make it.
    pub fn constant(self, range: &Range<usize>, at: usize, depth: usize) -> Result<(Pose, Vec<usize>), String> {
        if depth < MAX_DEPTH && self.call(range) == Some(b"pose_trans") {
            let arguments = self.text.parts(range.start + 1, range.end).map(|(parts, _)| parts).unwrap_or_default();
            let [from, to] = &arguments[..] else { return Err("`pose_trans` takes two poses".into()) };
            let (outer, mut parts) = self.constant(from, at, depth + 1)?;
            let (inner, more) = self.constant(to, at, depth + 1)?;
            parts.extend(more);
            return Ok((outer * inner, parts));
        }
        match self.written(range, at, depth) {
            Ok((list, _)) => match literal(self.text, &list) {
                Some(Literal::Pose(numbers)) => {
                    let pose = numbers.pose().ok_or_else(|| "its numbers make no pose".to_owned())?;
                    Ok((pose, vec![list.start]))
                }
                _ => Err(format!("`{}` is no constant pose", shortened(&self.text.show(range)))),
            },
            Err(reason) => match self.single(range, at) {
                Ok((value, place)) if depth < MAX_DEPTH && self.call(&value) == Some(b"pose_trans") => {
                    self.constant(&value, place, depth + 1)
                }
                _ => Err(reason),
            },
        }
    }

    fn joints_deg(self, range: &Range<usize>, at: usize) -> Option<[f64; 6]> {
        let (list, _) = self.written(range, at, 0).ok()?;
        match literal(self.text, &list)? {
            Literal::Joints(numbers) => Some(numbers.numbers_rad().map(f64::to_degrees)),
            _ => None,
        }
    }
}

/// The first words of an expression, for messages.
pub(super) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((cut, _)) => format!("{}..", &text[..cut]),
        None => text.to_owned(),
    }
}
