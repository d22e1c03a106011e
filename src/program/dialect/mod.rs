//! The robot languages. Each is one file (or folder) with one `Dialect`, and one line in [`DIALECTS`].

use crate::base::text::{Encoding, Source};

use super::number::NumberRules;
use super::target::Program;

mod aptcl;
mod csv;
mod denso;
mod drl;
mod fanuc;
mod gcode;
mod hyundai;
mod inform;
mod melfa;
mod pdl2;
mod rapid;
mod script;
mod stated;
mod urscript;

/// Every language that the tool reads.
pub const DIALECTS: &[&dyn Dialect] = &[
    &rapid::Rapid,
    &hyundai::Hyundai,
    &fanuc::Fanuc,
    &inform::Inform,
    &urscript::UrScript,
    &csv::Csv,
    &gcode::GCode,
    &aptcl::AptCl,
    &drl::Drl,
    &melfa::Melfa,
    &denso::Denso,
    &pdl2::Pdl2,
];

/// What there is to know about a language without reading a program.
#[derive(Clone, Copy, Debug)]
pub struct Meta {
    /// The word for `--dialect`, and the name of the folder under `programs/`.
    pub id: &'static str,
    /// Maker and language, for people.
    pub title: &'static str,
    /// Usual file name endings, lower case, without the dot.
    pub extensions: &'static [&'static str],
    /// The multi-byte code page of files that are not UTF-8, if any.
    pub code_page: Option<Encoding>,
    /// How numbers may be written.
    pub numbers: NumberRules,
}

/// A robot language.
pub trait Dialect: Sync {
    /// Its name card.
    fn meta(&self) -> &'static Meta;

    /// True when the content can only be this language. No two dialects may both say so for one file.
    fn recognises(&self, source: &Source) -> bool;

    /// Reads the files of one job. Never fails: what is not understood stays untouched, what is wrong is said in
    /// [`Program::diagnostics`].
    fn read(&self, files: &[Source]) -> Program;
}

/// The dialect with this id.
pub fn by_id(id: &str) -> Option<&'static dyn Dialect> {
    DIALECTS.iter().copied().find(|dialect| dialect.meta().id.eq_ignore_ascii_case(id))
}

/// The dialect that recognises the content.
pub fn detect(source: &Source) -> Option<&'static dyn Dialect> {
    DIALECTS.iter().copied().find(|dialect| dialect.recognises(source))
}
