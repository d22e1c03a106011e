//! `set_tcp` and `set_payload`: which tool, with which load, is in force where.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use crate::base::text::Span;
use crate::geometry::pose::Pose;
use crate::program::selection::{Block, InForce, Joins, Selections};
use crate::program::target::{Definition, LoadData, Program, Reference, ToolData};

use super::motion::argument;
use super::statement;
use super::token::Text;
use super::value::{number, vector};

/// The selections of one file.
#[derive(Debug, Default)]
pub(super) struct Tools {
    tcps: Selections,
    payloads: Selections,
    poses: HashMap<String, Pose>,
    names: HashMap<String, String>,
    loads: HashMap<String, LoadData>,
    /// Where other ways may come in that set another TCP, another payload.
    tcp_joins: Vec<usize>,
    payload_joins: Vec<usize>,
    /// A payload without a centre of gravity.
    pub incomplete_payload: Option<Span>,
}

impl Tools {
    /// Follows the statements; `constant` gives the pose of an expression at a statement, or why there is none.
    pub fn of(
        text: Text<'_>,
        program: &statement::Program,
        constant: impl Fn(&Range<usize>, usize) -> Result<Pose, String>,
    ) -> Self {
        let mut tools = Self::default();
        let mut joins = Joins::default();
        let functions: HashSet<&[u8]> = program.functions.iter().skip(1).map(|one| one.name.as_slice()).collect();
        let called: Vec<bool> = (0..text.tokens.len())
            .map(|at| {
                let defines = at > 0 && matches!(text.word(at - 1), b"def" | b"thread" | b"sec");
                text.is(at + 1, b'(') && functions.contains(text.word(at)) && !defines
            })
            .collect();
        let called_names: HashSet<&[u8]> = (0..called.len()).filter(|&at| called[at]).map(|at| text.word(at)).collect();
        for (index, statement) in program.statements.iter().enumerate() {
            let tokens = &statement.tokens;
            let offset = text.span(tokens).start;
            let word = text.word(tokens.start);
            // The program itself, which nothing calls, starts with nothing selected.
            let starts_program = word == b"def" && !called_names.contains(text.word(tokens.start + 1));
            match word {
                b"if" => joins.open(offset, Block::Branch),
                b"while" | b"for" => joins.open(offset, Block::Loop),
                b"else" | b"elif" => joins.divide(offset),
                b"end" => joins.close(offset),
                b"def" | b"thread" | b"sec" => {
                    joins.open(offset, Block::Routine);
                    if !starts_program {
                        joins.anywhere(offset);
                    }
                }
                _ => {}
            }
            for at in text.calls(tokens) {
                match text.word(at) {
                    b"set_tcp" => tools.tcp(text, at, tokens.end, |range| constant(range, index)),
                    b"set_payload" | b"set_target_payload" => tools.payload(text, at, tokens.end),
                    b"set_payload_mass" | b"set_payload_cog" => {
                        let reason = format!("the payload is set by parts in line {}", text.source.line(offset));
                        tools.payloads.push(text.tokens[at].span.start, Reference::Runtime(reason));
                    }
                    _ => {}
                }
            }
            if tokens.clone().any(|at| called[at]) {
                joins.anywhere(text.span(tokens).end);
            }
        }
        tools.tcp_joins = joins.that_matter(&tools.tcps);
        tools.payload_joins = joins.that_matter(&tools.payloads);
        tools
    }

    fn tcp(&mut self, text: Text<'_>, at: usize, end: usize, constant: impl Fn(&Range<usize>) -> Result<Pose, String>) {
        let Some((arguments, _)) = text.parts(at + 1, end) else { return };
        let Some(range) = argument(text, &arguments, 0, &[b"pose"]) else { return };
        let offset = text.tokens[at].span.start;
        let line = text.source.line(offset);
        let selected = match constant(&range) {
            Ok(pose) => {
                // The same text again is the same tool.
                let first = self.names.entry(text.show(&range)).or_insert_with(|| format!("set_tcp in line {line}"));
                let name = if self.poses.get(first).is_none_or(|known| *known == pose) {
                    first.clone()
                } else {
                    format!("set_tcp in line {line}")
                };
                self.poses.insert(name.clone(), pose);
                Reference::Named(name.into())
            }
            Err(reason) => Reference::Runtime(format!("the TCP is set in line {line}: {reason}")),
        };
        self.tcps.push(offset, selected);
    }

    fn payload(&mut self, text: Text<'_>, at: usize, end: usize) {
        let Some((arguments, _)) = text.parts(at + 1, end) else { return };
        let offset = text.tokens[at].span.start;
        let line = text.source.line(offset);
        let mass = argument(text, &arguments, 0, &[b"m", b"mass"]);
        let Some(mass) = mass.as_ref().and_then(|range| number(text, range)) else {
            let reason = format!("the payload is computed in line {line}");
            self.payloads.push(offset, Reference::Runtime(reason));
            return;
        };
        let Some(cog) = argument(text, &arguments, 1, &[b"cog", b"cog_offset"]) else {
            self.incomplete_payload.get_or_insert(text.tokens[at].span);
            self.payloads.push(offset, Reference::Unnamed);
            return;
        };
        let selected = match vector(text, &cog) {
            Some(center_of_mass_m) => {
                let name = format!("payload in line {line}");
                self.loads.insert(name.clone(), LoadData { mass_kg: mass.value, center_of_mass_m });
                Reference::Named(name.into())
            }
            None => Reference::Runtime(format!("the payload is computed in line {line}")),
        };
        self.payloads.push(offset, selected);
    }

    /// The tool at a byte offset; defines it in `program`. With it the load that the program does not put on a tool of
    /// its own, if that is known at run time only.
    pub fn at(&self, offset: usize, file: usize, program: &mut Program) -> (Reference, Reference) {
        let open =
            |what: &str| Reference::Runtime(format!("several {what} are set, and which holds here depends on the way"));
        let tcp = match self.tcps.at(offset, &self.tcp_joins) {
            InForce::Nothing => Reference::Unnamed,
            InForce::Known(selected) => selected.clone(),
            InForce::Open => open("TCPs"),
        };
        let payload = match self.payloads.at(offset, &self.payload_joins) {
            InForce::Nothing => Reference::Unnamed,
            InForce::Known(selected) => selected.clone(),
            InForce::Open => open("payloads"),
        };
        let grip_load = if let Reference::Runtime(_) = payload { payload.clone() } else { Reference::Unnamed };
        let Reference::Named(tcp_name) = &tcp else { return (tcp, grip_load) };
        let load = match &payload {
            Reference::Named(name) => self.loads.get(&**name).copied(),
            _ => None,
        };
        let name = match (&payload, load) {
            (Reference::Named(payload), Some(_)) => format!("{tcp_name}, {payload}"),
            _ => tcp_name.to_string(),
        };
        if let Some(&pose) = self.poses.get(&**tcp_name) {
            let name = if file == 0 { name } else { format!("{name} of file {}", file + 1) };
            let key = Program::key(&name);
            program.tools.entry(key).or_insert_with(|| Definition {
                file,
                span: Default::default(),
                value: Ok(ToolData { pose, held_by_robot: true, load }),
            });
            return (Reference::Named(name.into()), grip_load);
        }
        (tcp, grip_load)
    }
}
