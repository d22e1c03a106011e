//! Which user frame or tool is selected where: `SELUCRD 1`, `seltool 3,robot`, and where ways of the program meet.

use std::collections::HashMap;

use crate::program::number::starts_with_word;
use crate::program::selection::{InForce, Selections};
use crate::program::target::Reference;

use super::statement::Statement;

/// Words behind which the order of the text is not the order of the program. Others that begin with `END` are such too.
const JOINING: [&str; 15] = [
    "ELSE", "ELSEIF", "FOR", "NEXT", "WHILE", "DO", "LOOP", "REPEAT", "UNTIL", "SWITCH", "CASE", "DEFAULT", "DEF",
    "CALL", "JMPP",
];

/// Words with an address behind them.
const JUMPING: [&str; 3] = ["GOTO", "GOSUB", "JUMP"];

/// The number that a selecting statement names.
pub(super) fn selected(text: &str) -> Reference {
    let text = text.trim();
    match text.parse::<u32>() {
        Ok(number) => Reference::Named(number.to_string().into()),
        Err(_) => Reference::Runtime(format!("`{text}` is selected at run time")),
    }
}

/// What is selected at `offset`; `None` when no statement before it selects anything.
pub(super) fn in_force(selections: &Selections, offset: usize, joins: &[usize]) -> Option<Reference> {
    // A way that comes in at this very statement counts.
    match selections.at(offset + 1, joins) {
        InForce::Nothing => None,
        InForce::Known(selected) => Some(selected.clone()),
        InForce::Open => Some(Reference::Runtime("several are selected; which holds here depends on the way".into())),
    }
}

/// Collects where ways meet, statement by statement.
#[derive(Default)]
pub(super) struct Ways {
    joins: Vec<usize>,
    labelled: HashMap<String, usize>,
    /// Addresses that jumps name; `None` for one that is known only at run time.
    named: Vec<Option<String>>,
    last: usize,
}

impl Ways {
    /// Looks at a statement; the part behind a `THEN` comes as a statement of its own, behind the whole.
    pub fn note(&mut self, bytes: &[u8], statement: &Statement) {
        let Statement { span, body, .. } = *statement;
        let text = &bytes[body.start..body.end];
        let behind_then = span.start < self.last;
        self.last = span.end;
        if behind_then {
            // What is done under a condition is not always done.
            self.joins.push(span.end);
            if let Some(address) = address(text) {
                self.named.push(Some(address));
            }
        } else {
            let label = bytes[span.start..body.start].trim_ascii();
            let label = if text.first() == Some(&b'*') { text } else { label };
            if let Some(label) = address(label) {
                self.labelled.insert(label, span.start);
            }
        }
        if let Some(jump) = JUMPING.iter().find(|word| starts_with_word(text, word)) {
            self.named.extend(text[jump.len()..].split(|&byte| byte == b',').map(address));
        }
        // A routine that is called at an address comes back here.
        let ends_a_block = text.len() > 3 && text[..3].eq_ignore_ascii_case(b"END") && text[3] != b' ';
        if ends_a_block || JOINING.iter().chain(&["GOSUB"]).any(|word| starts_with_word(text, word)) {
            self.joins.push(span.end);
        }
    }

    /// The offsets at which other ways may come in, in order.
    pub fn finish(mut self) -> Vec<usize> {
        let known = |address: &Option<String>| address.as_ref().and_then(|address| self.labelled.get(address).copied());
        let reached: Option<Vec<usize>> = self.named.iter().map(known).collect();
        match reached {
            Some(reached) => self.joins.extend(reached),
            // A jump to somewhere may go to any label.
            None => self.joins.extend(self.labelled.values()),
        }
        self.joins.sort_unstable();
        self.joins
    }
}

/// `S5`, `120`, `*name`, in upper case.
fn address(text: &[u8]) -> Option<String> {
    let text = text.trim_ascii();
    let digits = text.strip_prefix(b"S").or_else(|| text.strip_prefix(b"s")).unwrap_or(text);
    let numbered = !digits.is_empty() && digits.iter().all(u8::is_ascii_digit);
    let named = text.len() > 1 && text[0] == b'*';
    (numbered || named).then(|| String::from_utf8_lossy(text).to_uppercase())
}
