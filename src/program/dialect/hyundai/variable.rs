//! Pose variables: which hold one written pose for the whole program, and which change.

use std::collections::{HashMap, HashSet};

use crate::base::text::Span;
use crate::program::number::starts_with_word;
use crate::program::scan::Cursor;

use super::definition::Place;
use super::elements::string;
use super::expression::{Goal, Name, goal, name};
use super::written_pose::{WrittenPose, constructor};

/// Where a name holds: in one file, or (`None`) in all jobs.
type Scope = Option<usize>;

/// A pose variable or constant.
#[derive(Clone, Debug, Default)]
pub(super) struct Variable {
    /// Poses written into it: file and pose.
    pub poses: Vec<(usize, WrittenPose)>,
    /// The first thing that makes its value unknown.
    pub change: Option<String>,
}

/// An assignment `name = value` or `name.field = value`.
#[derive(Clone, Debug)]
pub(super) struct Assignment {
    /// What is assigned; the index of `po[i]` is constant.
    pub name: Name,
    /// Something of it only: `.j7`, or an index that is no constant.
    pub part: Option<String>,
    /// The right side.
    pub value: Span,
    /// Declared with `global`.
    pub global: bool,
}

/// All pose variables of a job.
#[derive(Clone, Debug, Default)]
pub(super) struct Variables {
    found: HashMap<(Scope, String), Variable>,
    globals: HashSet<(usize, String)>,
}

impl Variables {
    /// Notes a `global name` declaration of a file.
    pub fn declare_global(&mut self, file: usize, key: &str) {
        self.globals.insert((file, base_name(key).to_owned()));
    }

    /// Notes an assignment.
    pub fn assign(&mut self, bytes: &[u8], place: Place, assignment: &Assignment, total_axes: Option<usize>) {
        let Place { file, line, .. } = place;
        if assignment.global {
            self.declare_global(file, &assignment.name.key);
        }
        if let Some(part) = &assignment.part {
            self.change(file, &assignment.name.key, format!("`{part}` is set in line {line}"));
            return;
        }
        let key = &assignment.name.key;
        let value = Cursor::new(bytes, assignment.value).rest().trim_ascii();
        let array = array_of_poses(bytes, assignment.value);
        if !array.is_empty() || starts_with_word(value, "Array") {
            self.entry(file, key);
            for (index, pose) in array.into_iter().enumerate() {
                self.entry(file, &format!("{key}[{index}]")).poses.push((file, pose));
            }
            return;
        }
        match goal(bytes, assignment.value, total_axes) {
            Goal::Written(pose) => {
                self.entry(file, base_name(key));
                self.entry(file, key).poses.push((file, pose));
            }
            _ => self.change(file, key, format!("it is computed in line {line}")),
        }
    }

    /// Notes that another statement mentions names and may change them.
    pub fn touch(&mut self, bytes: &[u8], place: &Place) {
        let Place { file, line, span } = *place;
        let mut cursor = Cursor::new(bytes, span);
        let mut first_word = cursor;
        let Some(word) = first_word.name().map(|word| String::from_utf8_lossy(cursor.slice(word))) else { return };
        while !cursor.at_end() {
            if let Some(found) = name(&mut cursor) {
                let scope = self.scope(file, &found.key);
                if let Some(variable) = self.found.get_mut(&(scope, found.key)) {
                    variable.change.get_or_insert_with(|| format!("`{word}` in line {line} may change it"));
                }
            } else if string(&mut cursor).is_none() {
                // A name does not start behind a digit: `12mm`, `0x1F`. One with a variable index is passed over.
                let is_number = !cursor.skip_while(|byte| byte.is_ascii_digit()).is_empty();
                if cursor.name().is_none() && !is_number {
                    cursor.bump();
                }
            }
        }
    }

    /// The variable of this name as `file` sees it, and what makes its value unknown.
    pub fn get(&self, file: usize, key: &str) -> Option<(&Variable, Option<&str>)> {
        let scope = self.scope(file, key);
        let variable = self.found.get(&(scope, key.to_owned()))?;
        // An element is unknown, too, once its array is assigned as a whole or at an index that is no constant.
        let whole = self.found.get(&(scope, base_name(key).to_owned()));
        let change = variable.change.as_deref().or_else(|| whole.and_then(|whole| whole.change.as_deref()));
        Some((variable, change))
    }

    /// The scope in which a name lives, as a key to tell equal names apart.
    pub fn scope(&self, file: usize, key: &str) -> Scope {
        let is_global = is_numbered_constant(key) || self.globals.contains(&(file, base_name(key).to_owned()));
        (!is_global).then_some(file)
    }

    fn change(&mut self, file: usize, key: &str, reason: String) {
        self.entry(file, key).change.get_or_insert(reason);
    }

    fn entry(&mut self, file: usize, key: &str) -> &mut Variable {
        let scope = self.scope(file, key);
        self.found.entry((scope, key.to_owned())).or_default()
    }
}

/// `P1`, `P[1]`: pose constants of the controller, common to all jobs.
fn is_numbered_constant(key: &str) -> bool {
    key.strip_prefix('p').is_some_and(|rest| {
        let digits = rest.trim_start_matches('[').trim_end_matches(']');
        !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
    })
}

fn base_name(key: &str) -> &str {
    key.split('[').next().unwrap_or(key)
}

/// Reads `var po=..`, `P1.X=..`, `_tool[1]=..`; `None` for everything else.
pub(super) fn assignment(bytes: &[u8], body: Span) -> Option<Assignment> {
    let mut cursor = Cursor::new(bytes, body);
    let global = cursor.eat_word("global");
    let _ = global || cursor.eat_word("var");
    cursor.skip_blanks();
    let start = cursor.offset();
    let (name, mut part) = match name(&mut cursor) {
        Some(name) => (name, None),
        None => {
            let word = cursor.name()?;
            let key = String::from_utf8_lossy(cursor.slice(word)).to_lowercase();
            (Name { span: word, key }, Some(()))
        }
    };
    let after_name = cursor;
    let mut depth = 0_usize;
    while let Some(byte) = cursor.peek() {
        match byte {
            b'=' if depth == 0 => break,
            b'[' => depth += 1,
            b']' => depth = depth.saturating_sub(1),
            b'.' | b'_' | b' ' | b'\t' | b'%' | b'!' | b'$' => {}
            byte if byte.is_ascii_alphanumeric() || depth > 0 => {}
            _ => return None,
        }
        cursor.bump();
    }
    let left = Span::new(after_name.offset(), cursor.offset());
    if !cursor.eat(b'=') || cursor.peek() == Some(b'=') {
        return None;
    }
    let rest_of_left = cursor.slice(left).trim_ascii();
    // `WAIT DI1=1` and the like: two words before the sign.
    if rest_of_left.first().is_some_and(u8::is_ascii_alphanumeric) {
        return None;
    }
    if !rest_of_left.is_empty() {
        part = Some(());
    }
    let part = part.map(|()| String::from_utf8_lossy(cursor.slice(Span::new(start, left.end))).trim().to_owned());
    Some(Assignment { name, part, value: Span::new(cursor.offset(), body.end), global })
}

/// Statements that only read what they mention.
pub(super) fn only_reads(bytes: &[u8], body: Span) -> bool {
    const WORDS: [&str; 14] = [
        "PRINT", "IF", "ELSEIF", "WHILE", "FOR", "WAIT", "RETURN", "GOTO", "GOSUB", "MKUCRD", "SELUCRD", "SELTOOL",
        "VAR", "GLOBAL",
    ];
    let text = &bytes[body.start..body.end];
    text.first() == Some(&b'*') || WORDS.iter().any(|word| starts_with_word(text, word))
}

/// The poses of `[Pose(..),Pose(..)]`; empty for every other value.
fn array_of_poses(bytes: &[u8], value: Span) -> Vec<WrittenPose> {
    let mut cursor = Cursor::new(bytes, value);
    cursor.skip_blanks();
    if !cursor.eat(b'[') {
        return Vec::new();
    }
    let mut poses = Vec::new();
    loop {
        cursor.skip_blanks();
        if !starts_with_word(cursor.rest(), "Pose") {
            return Vec::new();
        }
        let Ok(pose) = constructor(&mut cursor) else { return Vec::new() };
        poses.push(pose);
        cursor.skip_blanks();
        match cursor.bump() {
            Some(b',') => {}
            Some(b']') if cursor.rest().trim_ascii().is_empty() => return poses,
            _ => return Vec::new(),
        }
    }
}
