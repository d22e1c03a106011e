//! The four classes of targets, and what the text alone says about them.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::base::text::Source;
use crate::program::target::{Definition, Program, Reference, Target, TargetValue, Use};

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
pub fn class_by_text(program: &Program, sources: &[Source], target: &Target) -> (Class, Option<String>) {
    let (class, reason) = class_by_value(target);
    if class != Class::Corrected {
        return (class, reason);
    }
    let mut as_written = target.uses.iter().filter(|one| one.computed.is_none());
    match as_written.find_map(|one| open_setting(program, sources, one)) {
        Some(reason) => (Class::Computed, Some(reason)),
        None => (class, None),
    }
}

/// The same, whatever tools, frames and loads its moves have.
pub(super) fn class_by_value(target: &Target) -> (Class, Option<String>) {
    if let Some(reason) = &target.computed {
        return (Class::Computed, Some(reason.clone()));
    }
    // A target that some move reaches as written is worth correcting; one that no move does is not.
    let all_computed = !target.uses.is_empty() && target.uses.iter().all(|one| one.computed.is_some());
    if all_computed {
        return (Class::Computed, target.uses.iter().find_map(|one| one.computed.clone()));
    }
    match &target.value {
        TargetValue::Counts | TargetValue::Unwritten => (Class::Computed, Some("its value is not in the text".into())),
        TargetValue::Joint(_) => (Class::Joint, None),
        TargetValue::Displaced(_) => (Class::Corrected, None),
        TargetValue::Cartesian(numbers) => match numbers.has_orientation() {
            true => (Class::Corrected, None),
            false => (Class::Refused, Some("its numbers make no pose: the orientation has no length".into())),
        },
    }
}

/// Why the text does not tell the tool, frame or load of a move: one value cannot land for all that may be in force.
fn open_setting(program: &Program, sources: &[Source], one: &Use) -> Option<String> {
    let (what, reason) = at_run_time(&one.tool, &program.tools)
        .map(|reason| ("tool", reason))
        .or_else(|| at_run_time(&one.frame, &program.frames).map(|reason| ("frame", reason)))
        .or_else(|| at_run_time(&one.grip_load, &program.loads).map(|reason| ("load", reason)))
        .or_else(|| at_run_time(&one.grip_load, &program.flange_loads).map(|reason| ("load", reason)))?;
    let line = sources.get(one.file)?.line(one.span.start);
    Some(format!("its {what} in line {line} is known only at run time: {reason}"))
}

/// The reason why a reference, or what the program defines under its name, is known only at run time.
fn at_run_time<'a, T>(reference: &'a Reference, defined: &'a BTreeMap<String, Definition<T>>) -> Option<&'a str> {
    match reference {
        Reference::Unnamed => None,
        Reference::Runtime(reason) => Some(reason),
        Reference::Named(name) => defined.get(&Program::key(name))?.value.as_ref().err().map(String::as_str),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::dialect::by_id;

    #[test]
    fn a_tool_that_depends_on_the_way_makes_its_targets_computed() {
        let text = "DEF t( )\n$TOOL=TOOL_DATA[1]\n$BASE=BASE_DATA[1]\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nIF $IN[1] THEN\n\
                    $TOOL=TOOL_DATA[2]\nENDIF\nLIN {X 4,Y 5,Z 6,A 0,B 0,C 0}\nPTP {A1 0,A2 0,A3 0,A4 0,A5 0,A6 0}\nEND\n";
        let sources = [Source::new("t.src", text)];
        let program = by_id("krl").expect("in the registry").read(&sources);
        let classes: Vec<_> = program.targets.iter().map(|one| class_by_text(&program, &sources, one)).collect();
        let words: Vec<Class> = classes.iter().map(|(class, _)| *class).collect();
        assert_eq!(words, [Class::Corrected, Class::Computed, Class::Joint]);
        let reason = classes[1].1.as_deref().expect("a reason");
        assert!(reason.starts_with("its tool in line 8 is known only at run time"), "{reason}");
        assert!(reason.contains("tool_data[2]") && reason.contains("tool_data[1]"), "{reason}");
    }
}
