//! Hyundai JOB.

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// Hyundai JOB.
pub struct Hyundai;

static META: Meta = Meta {
    id: "hyundai",
    title: "Hyundai JOB",
    extensions: &["job"],
    code_page: None,
    numbers: NumberRules { max_decimals: 9, integers_may_gain_point: true },
};

impl Dialect for Hyundai {
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
