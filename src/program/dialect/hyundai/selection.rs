//! Which user frame or tool is selected where: `SELUCRD 1`, `seltool 3,robot`.

use crate::base::text::Span;
use crate::program::number::starts_with_word;
use crate::program::target::Reference;

/// The selections of one kind in one file, in the order of the text.
#[derive(Clone, Debug, Default)]
pub(super) struct Selections {
    made: Vec<(usize, Reference)>,
    differ: bool,
}

impl Selections {
    /// Notes that the statement at `offset` selects what `text` says.
    pub fn push(&mut self, offset: usize, text: &str) {
        let text = text.trim();
        let selected = match text.parse::<u32>() {
            Ok(number) => Reference::Named(number.to_string().into()),
            Err(_) => Reference::Runtime(format!("`{text}` is selected at run time")),
        };
        self.differ |= self.made.first().is_some_and(|(_, first)| *first != selected);
        self.made.push((offset, selected));
    }

    /// What is selected at `offset`: the selection before it, if the order of the text is the order of the program or
    /// all selections agree. `None` when nothing is selected in the text.
    pub fn in_force(&self, offset: usize, branches: bool) -> Option<Reference> {
        let (_, first) = self.made.first()?;
        if !self.differ {
            return Some(first.clone());
        }
        if branches {
            return Some(Reference::Runtime("several selections and branches between them".to_owned()));
        }
        let before = self.made.partition_point(|&(at, _)| at < offset);
        self.made.get(before.checked_sub(1)?).map(|(_, selected)| selected.clone())
    }
}

/// True for a statement after which, or at which, the program may go on somewhere else.
pub(super) fn is_branch(bytes: &[u8], body: Span) -> bool {
    const WORDS: [&str; 12] =
        ["IF", "ELSE", "ELSEIF", "FOR", "WHILE", "GOTO", "GOSUB", "JUMP", "RETSUB", "RETURN", "SWITCH", "DEF"];
    let text = &bytes[body.start..body.end];
    text.first() == Some(&b'*') || WORDS.iter().any(|word| starts_with_word(text, word))
}
