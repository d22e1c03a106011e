//! The robot languages. Each is one file (or folder) with one `Dialect`, and one line in [`DIALECTS`].

use crate::base::text::{Encoding, Source};

use super::number::NumberRules;
use super::target::Program;
use super::ties::Ties;

mod aptcl;
mod brackets;
mod csv;
mod denso;
mod drl;
mod fanuc;
mod gcode;
mod hyundai;
mod inform;
mod kawasaki;
mod krl;
mod melfa;
mod nachi;
mod pdl2;
mod rapid;
mod script;
mod spel;
mod stated;
mod urscript;
mod val3;

/// Every language that the tool reads.
pub const DIALECTS: &[&dyn Dialect] = &[
    &rapid::Rapid,
    &hyundai::Hyundai,
    &fanuc::Fanuc,
    &inform::Inform,
    &krl::Krl,
    &urscript::UrScript,
    &kawasaki::Kawasaki,
    &val3::Val3,
    &spel::Spel,
    &nachi::Nachi,
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

    /// The job that a file belongs to, told by its name without folder: files of this language in one folder whose
    /// jobs have the same name are read, corrected and written together. Each file is a job of its own unless the
    /// language says otherwise.
    fn job_of(&self, file_name: &str) -> String {
        file_name.to_string()
    }

    /// What a file gives to the other files of its folder and takes from them, by name: [`super::ties::together`] makes
    /// jobs of it.
    fn ties(&self, _source: &Source) -> Ties {
        Ties::default()
    }

    /// Names of folders whose files, where they lie beside each other, count as lying in one: a controller's program
    /// and system modules.
    fn joined_folders(&self) -> &'static [&'static str] {
        &[]
    }

    /// Names of files that many jobs share: looked for beside a job and above it, in whatever case. They are read with
    /// every job and never written with one.
    fn shared_files(&self) -> &'static [&'static str] {
        &[]
    }
}

/// The dialect with this id.
pub fn by_id(id: &str) -> Option<&'static dyn Dialect> {
    DIALECTS.iter().copied().find(|dialect| dialect.meta().id.eq_ignore_ascii_case(id))
}

/// The dialect that recognises the content; none for data that is no text at all.
pub fn detect(source: &Source) -> Option<&'static dyn Dialect> {
    if source.is_binary() {
        return None;
    }
    DIALECTS.iter().copied().find(|dialect| dialect.recognises(source))
}
