//! Settings files: `falsetarget.yaml` beside a library saves typing the model, the cell and the options.

use serde::Deserialize;

use crate::base::text::Source;

use super::error::FileError;
use super::yaml::{complain, parse};

/// The word in the first line.
pub const SCHEMA: &str = "falsetarget/settings/1";
/// The name under which the file is looked for, in the folder of the programs and those above.
pub const FILE_NAME: &str = "falsetarget.yaml";

/// What a settings file says; every key may be absent. Options of the command line win.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    schema: String,
    /// Model or robot file, from the folder of the settings file; or a built-in robot's name.
    pub model: Option<String>,
    /// Cell file, from the folder of the settings file.
    pub cell: Option<String>,
    /// As `--joint-targets`.
    pub joint_targets: Option<bool>,
    /// As `--allow-partial`.
    pub allow_partial: Option<bool>,
    /// As `--split-shared`.
    pub split_shared: Option<bool>,
    /// As `--inside-only`.
    pub inside_only: Option<bool>,
    /// As `--trust-units`.
    pub trust_units: Option<bool>,
}

/// Reads a settings file.
///
/// # Errors
/// [`FileError`] with the place.
pub fn read(source: &Source) -> Result<Settings, FileError> {
    let settings: Settings = parse(source, "a settings file (schema: falsetarget/settings/1)")?;
    match settings.schema == SCHEMA {
        true => Ok(settings),
        false => {
            let message = format!("the schema is `{}`; expected `{SCHEMA}`", settings.schema);
            Err(complain(source, "schema", None, "schema", message))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_keys_and_other_schemas_are_errors() {
        let read = |text: &str| read(&Source::new("falsetarget.yaml", text));
        let settings = read("schema: falsetarget/settings/1\nmodel: m.yaml\njoint_targets: true\n").expect("sound");
        assert_eq!((settings.model.as_deref(), settings.joint_targets), (Some("m.yaml"), Some(true)));
        assert!(read("schema: falsetarget/settings/1\nmodle: m.yaml\n").is_err());
        assert!(read("schema: falsetarget/cell/1\n").is_err());
    }
}
