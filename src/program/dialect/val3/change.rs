//! What programs do to data at run time.

use std::collections::HashMap;

use super::code::{Kind, Name, Text};
use super::program_file::Code;

/// Reasons why data is not what the file says, or must stay as it is.
#[derive(Debug, Default)]
pub(super) struct Changes {
    /// By name; all elements where there is no key.
    reasons: HashMap<(String, Option<String>), String>,
    /// Parameters and local variables that are changed, by program.
    own: HashMap<(usize, String), ()>,
}

impl Changes {
    /// Why an element is not what the file says.
    pub fn reason(&self, base: &str, key: &str) -> Option<&String> {
        let of = |key: Option<String>| self.reasons.get(&(base.to_owned(), key));
        of(Some(key.to_owned())).or_else(|| of(None))
    }

    fn note(&mut self, program: usize, code: &Code, name: Name, reason: String) {
        if code.own_names.contains(&name.base) {
            self.own.insert((program, name.base), ());
        } else {
            self.reasons.entry((name.base, name.key)).or_insert(reason);
        }
    }

    /// Collects them from all programs of a job.
    pub fn of(programs: &[Code], texts: &[Text<'_>]) -> Self {
        let mut changes = Self::default();
        let mut handed: Vec<(usize, String, usize, Name, String)> = Vec::new();
        let by_name: HashMap<&str, usize> =
            programs.iter().enumerate().map(|(index, code)| (code.name.as_str(), index)).collect();
        for (program, (code, text)) in programs.iter().zip(texts).enumerate() {
            let line = |at: usize| text.source.line(text.tokens[at].1.start);
            for at in 0..text.tokens.len() {
                let begins = at == 0 || text.tokens[at - 1].0 == Kind::LineEnd;
                if begins && let Some(name) = assigned(text, at) {
                    let reason = format!("`{}` is set at run time in line {}", name.base, line(at));
                    changes.note(program, code, name, reason);
                }
                if !text.is(at + 1, b'(') || text.word(at).is_empty() {
                    continue;
                }
                let word = String::from_utf8_lossy(text.word(at)).into_owned();
                let called = at > 0 && text.word(at - 1) == b"call";
                let Some((arguments, _)) = text.parts(at + 1) else { continue };
                let name = |place: usize| arguments.get(place).and_then(|range| text.only_name(range));
                match word.as_str() {
                    "link" => {
                        let reason = format!("linked to another frame in line {}", line(at));
                        name(0).into_iter().for_each(|name| changes.note(program, code, name, reason.clone()));
                    }
                    "setFrame" => {
                        let reason =
                            format!("line {} makes a frame of it: a correction would move that frame", line(at));
                        for point in (0..3).filter_map(name) {
                            changes.note(program, code, point, reason.clone());
                        }
                        let reason = format!("the frame is set in line {}", line(at));
                        name(3).into_iter().for_each(|name| changes.note(program, code, name, reason.clone()));
                    }
                    "pointToJoint" => {
                        let reason = format!("computed in line {}", line(at));
                        name(3).into_iter().for_each(|name| changes.note(program, code, name, reason.clone()));
                    }
                    _ if called || by_name.contains_key(word.as_str()) => {
                        for place in 0..arguments.len() {
                            if let Some(name) = name(place) {
                                let reason = format!("handed to `{word}` in line {}, which may change it", line(at));
                                handed.push((program, word.clone(), place, name, reason));
                            }
                        }
                    }
                    _ => {}
                }
            }
        }
        // What is handed on may be changed there.
        for (program, _, _, name, _) in &handed {
            if programs[*program].own_names.contains(&name.base) {
                changes.own.insert((*program, name.base.clone()), ());
            }
        }
        for (program, callee, place, name, reason) in handed {
            let parameter =
                by_name.get(callee.as_str()).map(|&callee| (callee, programs[callee].parameters.get(place)));
            let unchanged = parameter.is_some_and(|(callee, parameter)| {
                parameter.is_some_and(|(parameter, by_reference)| {
                    !by_reference || !changes.own.contains_key(&(callee, parameter.clone()))
                })
            });
            if !unchanged {
                changes.note(program, &programs[program], name, reason);
            }
        }
        changes
    }
}

/// `name = ..`, `name[2].trsf.x = ..`: what a statement sets.
fn assigned(text: &Text<'_>, at: usize) -> Option<Name> {
    let name = text.name(at)?;
    let mut end = name.end;
    while text.is(end, b'.') && !text.word(end + 1).is_empty() {
        end += 2;
        if text.is(end, b'[') {
            end = text.parts(end)?.1 + 1;
        }
    }
    (text.is(end, b'=') && !text.is(end + 1, b'=')).then_some(name)
}
