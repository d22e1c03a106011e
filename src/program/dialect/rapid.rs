//! ABB RAPID.

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// ABB RAPID.
pub struct Rapid;

static META: Meta = Meta {
    id: "rapid",
    title: "ABB RAPID",
    extensions: &["mod"],
    code_page: None,
    numbers: NumberRules { max_decimals: 9, integers_may_gain_point: true },
};

impl Dialect for Rapid {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, _source: &Source) -> bool {
        false
    }

    fn read(&self, _files: &[Source]) -> Program {
        Program::default()
    }
}
