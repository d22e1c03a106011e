//! Which column of a recording holds what.

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::files::error::FileError;
use crate::model::robot::DOF;

/// Indices of the columns that mean something.
#[derive(Clone, Debug)]
pub struct Columns {
    /// `q1_deg` ...
    pub joints: [usize; DOF],
    /// `x_mm`, `y_mm`, `z_mm`.
    pub position: Option<[usize; 3]>,
    /// `rx_deg`, `ry_deg`, `rz_deg`.
    pub rotation: Option<[usize; 3]>,
    /// `qd1_deg_s` ...
    pub speed: Option<[usize; DOF]>,
    /// `qdd1_deg_s2` ...
    pub acceleration: Option<[usize; DOF]>,
    /// `dir1` ...
    pub approach: Option<[usize; DOF]>,
    /// `t_s`.
    pub time: Option<usize>,
    /// `temp_c`.
    pub temperature: Option<usize>,
    /// `payload_kg`.
    pub payload: Option<usize>,
    /// `sigma_mm`.
    pub sigma: Option<usize>,
    /// `sigma_deg`.
    pub sigma_rotation: Option<usize>,
    /// `set`.
    pub set: Option<usize>,
    /// `id`.
    pub id: Option<usize>,
    /// `station`.
    pub station: Option<usize>,
}

/// The header row with its place, for complaints.
pub struct Header<'a> {
    /// The file.
    pub source: &'a Source,
    /// The names, trimmed.
    pub names: Vec<String>,
    /// Where the row stands.
    pub span: Span,
}

impl Header<'_> {
    /// Finds the columns.
    ///
    /// # Errors
    /// [`FileError`] naming what is missing: a joint, or a part of a group of columns that belong together; or a name
    /// that occurs twice, or a robot with more axes than the tool knows.
    pub fn columns(&self) -> Result<Columns, FileError> {
        let numbered = |before: &str, after: &str| std::array::from_fn(|joint| format!("{before}{}{after}", joint + 1));
        let lettered = |names: [&str; 3]| names.map(str::to_string);
        if let Some(twice) = self.names.iter().enumerate().find(|(index, name)| {
            let known = !name.is_empty();
            known && self.names[..*index].contains(name)
        }) {
            return Err(self.complain(format!("the column `{}` occurs twice", twice.1)));
        }
        if self.position_of(&format!("q{}_deg", DOF + 1)).is_some() {
            return Err(self.complain(format!("the recording is of an arm with more than {DOF} axes")));
        }
        let joints: Option<[usize; DOF]> = self.group(numbered("q", "_deg"))?;
        let Some(joints) = joints else {
            return Err(self.complain(format!("no columns `q1_deg` to `q{DOF}_deg`: joint positions are needed")));
        };
        Ok(Columns {
            joints,
            position: self.group(lettered(["x_mm", "y_mm", "z_mm"]))?,
            rotation: self.group(lettered(["rx_deg", "ry_deg", "rz_deg"]))?,
            speed: self.group(numbered("qd", "_deg_s"))?,
            acceleration: self.group(numbered("qdd", "_deg_s2"))?,
            approach: self.group(numbered("dir", ""))?,
            time: self.position_of("t_s"),
            temperature: self.position_of("temp_c"),
            payload: self.position_of("payload_kg"),
            sigma: self.position_of("sigma_mm"),
            sigma_rotation: self.position_of("sigma_deg"),
            set: self.position_of("set"),
            id: self.position_of("id"),
            station: self.position_of("station"),
        })
    }

    fn position_of(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Columns that belong together: all of them, none of them, or an error.
    fn group<const N: usize>(&self, names: [String; N]) -> Result<Option<[usize; N]>, FileError> {
        let found: Vec<Option<usize>> = names.iter().map(|name| self.position_of(name)).collect();
        if found.iter().all(Option::is_none) {
            return Ok(None);
        }
        let mut places = [0; N];
        for ((place, found), name) in places.iter_mut().zip(found).zip(&names) {
            let missing = || self.complain(format!("the column `{name}` is missing, though its neighbours are there"));
            *place = found.ok_or_else(missing)?;
        }
        Ok(Some(places))
    }

    /// A complaint about the header.
    pub fn complain(&self, message: String) -> FileError {
        let diagnostic = Diagnostic::error("columns", message)
            .at(0, self.span, "")
            .help(format!("the columns are: {}", self.names.join(", ")));
        FileError::new(self.source, diagnostic)
    }
}
