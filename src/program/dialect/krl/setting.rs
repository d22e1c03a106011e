//! What statements set: tool, base, load and the side that interpolation is about.
//!
//! What `BAS`, `STOOL2`, `SBASE`, `SLOAD` and `SIPO_MODE` do is what KUKA's `bas.src` does: `#INITMOV` takes tool 1 and
//! the world, `#TOOL` takes tool and load of its number, `#FRAMES`, `#PTP_PARAMS` and `#CP_PARAMS` take everything from
//! `FDAT_ACT`, which an inline form sets in the line before.

use crate::base::text::Span;
use crate::program::scan::Cursor;
use crate::program::target::Reference;

use super::aggregate::{Aggregate, Value, aggregate};
use super::frames::{Frames, Role, call};
use super::job::{Job, Kind, Statement};
use super::reference::reference;
use super::statement::{split_at_commas, trimmed};
use super::variable::{Known, Variables};

/// Number of settings.
pub(super) const SETTINGS: usize = 5;
/// `$TOOL`
pub(super) const TOOL: usize = 0;
/// `$BASE`
pub(super) const BASE: usize = 1;
/// `$LOAD`
pub(super) const LOAD: usize = 2;
/// `$IPO_MODE`: `Named("tcp")` for a stationary tool; nothing set is `#BASE`.
pub(super) const MODE: usize = 3;
/// The last routine called that is not in the job.
pub(super) const FOREIGN: usize = 4;

/// Settings and their new values.
pub(super) type Sets = Vec<(usize, Reference)>;

/// Frame data of an inline form: `{TOOL_NO 2,BASE_NO 1,IPO_FRAME #BASE}`, or why it is not known.
type FrameData = Result<Aggregate, String>;

/// Calls that set nothing of the above.
const HARMLESS: &[&str] = &[
    "user_grp",
    "userspot",
    "h50",
    "swrite",
    "sread",
    "cwrite",
    "cread",
    "copen",
    "cclose",
    "err_clear",
    "err_raise",
    "ir_stopm",
    "msgnotify",
    "msgquit",
    "msgdialog",
    "on_error_proceed",
    "krlmsg_ovld",
    "reset_cd_params",
];

/// Reads settings, statement by statement.
pub(super) struct Setter<'j, 'a> {
    job: &'j Job<'a>,
    variables: &'j Variables,
    /// The frames and loads that are named.
    pub frames: Frames<'j, 'a>,
    frame_data: Option<FrameData>,
}

impl<'j, 'a> Setter<'j, 'a> {
    /// With nothing named yet.
    pub fn new(job: &'j Job<'a>, variables: &'j Variables) -> Self {
        Self { job, variables, frames: Frames::new(job, variables), frame_data: None }
    }

    /// Forgets `FDAT_ACT`: the order of the program is no longer that of the text.
    pub fn forget(&mut self) {
        self.frame_data = None;
    }

    /// What a statement sets.
    pub fn sets(&mut self, routine: usize, statement: &Statement) -> Sets {
        let bytes = self.job.bytes(statement.file);
        match statement.kind {
            Kind::Assignment => {
                let mut cursor = Cursor::new(bytes, statement.span);
                let Some(found) = reference(bytes, &mut cursor) else { return Vec::new() };
                cursor.skip_blanks();
                cursor.eat(b'=');
                let value = trimmed(bytes, Span::new(cursor.offset(), statement.span.end));
                if found.base == "fdat_act" {
                    self.frame_data = Some(match found.member {
                        None => self.frame_data_of(routine, statement.file, value),
                        Some(_) => Err("FDAT_ACT is set member by member".into()),
                    });
                    return Vec::new();
                }
                self.assigned(routine, statement.file, &found.base, found.member.is_some(), value)
            }
            Kind::Call => match call(bytes, statement.span) {
                Some((callee, arguments)) if callee == "bas" => self.bas(routine, statement.file, arguments),
                Some((callee, _)) if !HARMLESS.contains(&callee.as_str()) => {
                    self.forget();
                    vec![(FOREIGN, Reference::Named(callee.into()))]
                }
                _ => Vec::new(),
            },
            _ => Vec::new(),
        }
    }

    /// What the list behind `WITH` sets.
    pub fn with(&mut self, routine: usize, file: usize, with: Span) -> Sets {
        let bytes = self.job.bytes(file);
        let mut sets = Vec::new();
        for part in split_at_commas(bytes, with) {
            let mut cursor = Cursor::new(bytes, part);
            let Some(found) = reference(bytes, &mut cursor) else { continue };
            cursor.skip_blanks();
            if cursor.eat(b'=') {
                let value = without_approximation(bytes, Span::new(cursor.offset(), part.end));
                sets.extend(self.assigned(routine, file, &found.base, found.member.is_some(), value));
            }
        }
        sets
    }

    fn assigned(&mut self, routine: usize, file: usize, variable: &str, in_part: bool, value: Span) -> Sets {
        let setting = match variable {
            "$tool" => TOOL,
            "$base" => BASE,
            "$load" => LOAD,
            "$ipo_mode" => MODE,
            _ => return Vec::new(),
        };
        if in_part {
            let reason = format!("{} is changed in parts", variable.to_uppercase());
            return vec![(setting, Reference::Runtime(reason))];
        }
        let bytes = self.job.bytes(file);
        let function = call(bytes, value);
        let function = function.as_ref().map(|(name, argument)| (name.as_str(), *argument));
        let new = match (setting, function) {
            (TOOL, Some(("stool2", argument))) => match self.frame_data_of(routine, file, argument) {
                Ok(data) => self.by_data(routine, Role::Tool, &data),
                Err(reason) => Reference::Runtime(reason),
            },
            (TOOL, Some(("stool", argument))) => self.by_number(routine, file, argument, Role::Tool),
            (BASE, Some(("sbase", argument))) => self.by_number(routine, file, argument, Role::Base),
            (LOAD, Some(("sload", argument))) => match self.number(routine, file, argument) {
                Ok(number) => self.frames.load_by_number(routine, number),
                Err(reason) => Reference::Runtime(reason),
            },
            (MODE, Some(("sipo_mode", argument))) => self.mode(routine, file, argument),
            (MODE, _) => self.mode(routine, file, value),
            (TOOL, _) => self.frames.frame(routine, file, value, Role::Tool),
            (BASE, _) => self.frames.frame(routine, file, value, Role::Base),
            _ => self.frames.load(routine, file, value),
        };
        vec![(setting, new)]
    }

    fn bas(&mut self, routine: usize, file: usize, arguments: Span) -> Sets {
        let bytes = self.job.bytes(file);
        let parts = split_at_commas(bytes, arguments);
        let number = |this: &Self| parts.get(1).map(|part| this.number(routine, file, *part));
        match bytes[parts[0].start..parts[0].end].to_ascii_lowercase().as_slice() {
            b"#initmov" => vec![
                (TOOL, self.frames.by_number(routine, Role::Tool, 1)),
                (BASE, self.frames.by_number(routine, Role::Base, 0)),
                (MODE, Reference::Unnamed),
            ],
            b"#tool" => match number(self) {
                Some(Ok(number)) => vec![
                    (TOOL, self.frames.by_number(routine, Role::Tool, number)),
                    (LOAD, self.frames.load_by_number(routine, number)),
                ],
                other => runtime(&[TOOL, LOAD], &reason_of(other)),
            },
            b"#base" => match number(self) {
                Some(Ok(number)) => vec![(BASE, self.frames.by_number(routine, Role::Base, number))],
                other => runtime(&[BASE], &reason_of(other)),
            },
            b"#ex_base" => runtime(&[BASE], "the base stands on a kinematic of its own"),
            b"#frames" | b"#ptp_params" | b"#cp_params" => match &self.frame_data {
                Some(Ok(data)) => {
                    let data = data.clone();
                    let load = data.integer("tool_no").map(|number| self.frames.load_by_number(routine, number));
                    vec![
                        (TOOL, self.by_data(routine, Role::Tool, &data)),
                        (BASE, self.by_data(routine, Role::Base, &data)),
                        (LOAD, load.unwrap_or_default()),
                        (MODE, mode_of(&data)),
                    ]
                }
                Some(Err(reason)) => runtime(&[TOOL, BASE, LOAD, MODE], reason),
                None => runtime(&[TOOL, BASE, LOAD, MODE], "FDAT_ACT is set elsewhere"),
            },
            _ => Vec::new(),
        }
    }

    fn by_data(&mut self, routine: usize, role: Role, data: &Aggregate) -> Reference {
        let component = if role == Role::Tool { "tool_no" } else { "base_no" };
        match data.integer(component) {
            Some(number) => self.frames.by_number(routine, role, number),
            None => Reference::Runtime(format!("{} of the frame data is no number", component.to_uppercase())),
        }
    }

    fn by_number(&mut self, routine: usize, file: usize, expression: Span, role: Role) -> Reference {
        match self.number(routine, file, expression) {
            Ok(number) => self.frames.by_number(routine, role, number),
            Err(reason) => Reference::Runtime(reason),
        }
    }

    /// A number: literal, constant variable, or a member of constant frame data.
    fn number(&self, routine: usize, file: usize, expression: Span) -> Result<i64, String> {
        if let Some(number) = self.variables.integer(self.job, routine, file, expression) {
            return Ok(number);
        }
        let text = || self.job.sources[file].text(expression).into_owned();
        let (data, member) = self.member_of_data(routine, file, expression)?;
        data.integer(&member).ok_or_else(|| format!("`{}` is known only at run time", text()))
    }

    fn mode(&self, routine: usize, file: usize, expression: Span) -> Reference {
        let bytes = self.job.bytes(file);
        let expression = trimmed(bytes, expression);
        let text = &bytes[expression.start..expression.end];
        if let Some(constant) = text.strip_prefix(b"#") {
            return mode_named(&String::from_utf8_lossy(constant).to_lowercase());
        }
        match self.member_of_data(routine, file, expression) {
            Ok((data, member)) => match data.get(&member) {
                Some(Value::Constant(mode)) => mode_named(mode),
                _ => Reference::Runtime("$IPO_MODE is known only at run time".into()),
            },
            Err(reason) => Reference::Runtime(reason),
        }
    }

    /// `FP3.BASE_NO`: the data of FP3, and the member.
    fn member_of_data(&self, routine: usize, file: usize, expression: Span) -> Result<(Aggregate, String), String> {
        let bytes = self.job.bytes(file);
        let expression = trimmed(bytes, expression);
        let mut cursor = Cursor::new(bytes, expression);
        let text = || self.job.sources[file].text(expression).into_owned();
        let found = reference(bytes, &mut cursor).filter(|_| cursor.at_end());
        match found.as_ref().map(|found| (found.element(), &found.member)) {
            Some((Some(element), Some(member))) => Ok((self.data(routine, element)?, member.clone())),
            _ => Err(format!("`{}` is known only at run time", text())),
        }
    }

    /// Frame data: a variable, or written there.
    fn frame_data_of(&self, routine: usize, file: usize, expression: Span) -> FrameData {
        let bytes = self.job.bytes(file);
        let mut cursor = Cursor::new(bytes, expression);
        if cursor.peek() == Some(b'{') {
            return aggregate(bytes, &mut cursor).map_err(|_| "the frame data is not complete".into());
        }
        let text = || self.job.sources[file].text(expression).into_owned();
        let found = reference(bytes, &mut cursor).filter(|found| cursor.at_end() && found.member.is_none());
        match found.and_then(|found| found.element()) {
            Some(element) => self.data(routine, element),
            None => Err(format!("the frame data is `{}`", text())),
        }
    }

    fn data(&self, routine: usize, element: String) -> FrameData {
        let base = element.split('[').next().unwrap_or(&element).to_string();
        let scope = self.variables.scope(self.job, routine, &base);
        let spelled = element.to_uppercase();
        match self.variables.get(&(scope, element), &spelled) {
            Known::Once(write) => {
                self.frames.constant(&write).ok_or_else(|| format!("`{spelled}` is not written in numbers"))
            }
            Known::Changes(reason, _) | Known::Nowhere(reason) => Err(reason),
        }
    }
}

/// The interpolation mode of frame data; one without it means the base.
fn mode_of(data: &Aggregate) -> Reference {
    match data.get("ipo_frame") {
        Some(Value::Constant(mode)) => mode_named(mode),
        None => Reference::Unnamed,
        Some(_) => Reference::Runtime("IPO_FRAME of the frame data is known only at run time".into()),
    }
}

fn runtime(settings: &[usize], reason: &str) -> Sets {
    settings.iter().map(|&setting| (setting, Reference::Runtime(reason.to_string()))).collect()
}

fn reason_of(number: Option<Result<i64, String>>) -> String {
    match number {
        Some(Err(reason)) => reason,
        _ => "the number of tool or base is missing".into(),
    }
}

/// A value behind which `C_SPL` or the like may stand.
fn without_approximation(bytes: &[u8], value: Span) -> Span {
    let value = trimmed(bytes, value);
    let text = &bytes[value.start..value.end];
    let last_word = text.iter().rposition(|byte| byte.is_ascii_whitespace()).map_or(0, |at| at + 1);
    match text[last_word..].to_ascii_lowercase().starts_with(b"c_") && last_word > 0 {
        true => trimmed(bytes, Span::new(value.start, value.start + last_word)),
        false => value,
    }
}

/// A mode by its word: `base` is what holds where nothing is set, so that ways on which it is set agree with others.
fn mode_named(word: &str) -> Reference {
    if word == "base" { Reference::Unnamed } else { Reference::Named(word.into()) }
}
