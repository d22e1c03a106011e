//! The four classes of targets, and what the text alone says about them.

use serde::Serialize;

use crate::program::target::{Target, TargetValue};

/// What becomes of a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Class {
    /// Rewritten (or, by the text alone, can be).
    Corrected,
    /// A joint target: left alone unless asked for.
    Joint,
    /// Its value is not in the text: left alone.
    Computed,
    /// There is no solution, or a tool or frame is unknown.
    Refused,
}

impl Class {
    /// The word in reports.
    pub fn word(self) -> &'static str {
        match self {
            Class::Corrected => "corrected",
            Class::Joint => "joint",
            Class::Computed => "computed",
            Class::Refused => "refused",
        }
    }
}

/// The class by the text alone, with the reason where it is not [`Class::Corrected`] or [`Class::Joint`].
pub fn class_by_text(target: &Target) -> (Class, Option<String>) {
    if let Some(reason) = &target.computed {
        return (Class::Computed, Some(reason.clone()));
    }
    // A target that some move reaches as written is worth correcting; one that no move does is not.
    let all_computed = !target.uses.is_empty() && target.uses.iter().all(|one| one.computed.is_some());
    if all_computed {
        return (Class::Computed, target.uses.iter().find_map(|one| one.computed.clone()));
    }
    match &target.value {
        TargetValue::Unwritten => (Class::Computed, Some("its value is not in the text".into())),
        TargetValue::Joint(_) => (Class::Joint, None),
        TargetValue::Displaced(_) => (Class::Corrected, None),
        TargetValue::Cartesian(numbers) => match numbers.has_orientation() {
            true => (Class::Corrected, None),
            false => (Class::Refused, Some("its numbers make no pose: the orientation has no length".into())),
        },
    }
}
