//! Data files of version 6: a section for each type, and an element for each part of a value.
//!
//! `<point name="p"><pFather name="world" fatherIndex="0"/><valuePoint index="0"><tpValue x=".." ../><cpValue ../>`. All
//! numbers are written; one that is not counts as zero, as in later versions.

use crate::base::text::Source;

use super::data::{Data, Element, Kind, Value, configuration, value};
use super::xml::Tag;

/// Follows the elements of a file.
#[derive(Debug, Default)]
pub(super) struct Reader {
    variable: Option<(String, Kind)>,
    father: Option<String>,
    key: String,
    /// The last point, for its posture comes behind its numbers.
    last: Option<Element>,
}

impl Reader {
    /// Takes the next tag; gives the value whose numbers stand in it.
    pub fn open(&mut self, source: &Source, file: usize, tag: &Tag) -> Option<(Element, Value)> {
        let bytes = source.bytes();
        let name = &bytes[tag.name.start..tag.name.end];
        let kind = match name {
            b"point" => Some(Kind::Point),
            b"joint" => Some(Kind::Joint),
            b"frame" => Some(Kind::Frame),
            b"tool" => Some(Kind::Tool),
            _ => None,
        };
        match (name, kind) {
            (_, Some(kind)) => {
                self.variable = tag.text(bytes, "name").map(|name| (name, kind));
                (self.father, self.last) = (None, None);
                None
            }
            (b"pFather" | b"fFather" | b"tFather", _) => {
                self.father = father(bytes, tag);
                None
            }
            (b"valuePoint" | b"valueJoint" | b"valueFrame" | b"valueTool", _) => {
                self.key = tag.text(bytes, "index").unwrap_or_else(|| "0".into());
                None
            }
            (b"tpValue" | b"jointValue" | b"tfValue" | b"ttValue", _) => {
                let (variable, kind) = self.variable.clone()?;
                let value = value(source, file, &variable, kind, &self.key, tag);
                let element = Element { name: variable, kind, key: self.key.clone() };
                self.last = Some(element.clone());
                Some((element, Value { father: self.father.clone(), ..value }))
            }
            _ => None,
        }
    }

    /// `cpValue` gives the posture of the point before it.
    pub fn configure(&self, bytes: &[u8], tag: &Tag, data: &mut Data) {
        if &bytes[tag.name.start..tag.name.end] != b"cpValue" {
            return;
        }
        let Some(last) = &self.last else { return };
        if let Some(value) = data.0.get_mut(&last.name).and_then(|variable| variable.values.get_mut(&last.key)) {
            value.configuration = configuration(|attribute| tag.text(bytes, attribute));
        }
    }
}

/// `lib:name[2]` of a father; none where no name is given.
fn father(bytes: &[u8], tag: &Tag) -> Option<String> {
    let name = tag.text(bytes, "name").filter(|name| !name.is_empty())?;
    let alias = tag.text(bytes, "alias").filter(|alias| !alias.is_empty());
    let index = tag.text(bytes, "fatherIndex").unwrap_or_else(|| "0".into());
    Some(match alias {
        Some(alias) => format!("{alias}:{name}[{index}]"),
        None => format!("{name}[{index}]"),
    })
}
