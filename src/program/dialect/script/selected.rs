//! Which tool and frame statements select where.

use crate::program::selection::{InForce, Selections};
use crate::program::target::Reference;

/// The selections of a file, in the order of its text.
#[derive(Debug, Default)]
pub(in super::super) struct Selected {
    /// Tools.
    pub tools: Selections,
    /// Frames.
    pub frames: Selections,
    /// Where other ways may come in.
    pub joins: Vec<usize>,
}

/// What is selected in a line that does so only where a condition holds.
pub(in super::super) fn under_condition(line: usize) -> Reference {
    Reference::Runtime(format!("set under a condition in line {line}"))
}

impl Selected {
    /// The tool at a byte offset.
    pub fn tool(&self, offset: usize) -> Reference {
        self.at(&self.tools, offset, "tools")
    }

    /// The frame at a byte offset.
    pub fn frame(&self, offset: usize) -> Reference {
        self.at(&self.frames, offset, "frames")
    }

    fn at(&self, selections: &Selections, offset: usize, what: &str) -> Reference {
        // A way that comes in at this very statement counts.
        match selections.at(offset + 1, &self.joins) {
            InForce::Nothing => Reference::Unnamed,
            InForce::Known(selected) => selected.clone(),
            InForce::Open => Reference::Runtime(format!("several {what} are set; which holds here depends on the way")),
        }
    }
}
