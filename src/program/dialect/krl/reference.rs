//! Variables as statements name them: `XP1`, `lfWorkPos[2]`, `FP3.BASE_NO`.

use crate::base::text::Span;
use crate::program::scan::Cursor;

use super::statement::{key, name};

/// What stands in brackets behind a name.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Index {
    /// No brackets.
    None,
    /// Numbers only, as `[2]` or `[1,2]`; `[]` for a whole array.
    Constant(String),
    /// Something else.
    Variable(Span),
}

/// A variable.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reference {
    /// All of it, members included.
    pub span: Span,
    /// The name, in lower case.
    pub base: String,
    /// Its index.
    pub index: Index,
    /// The first member behind a dot, in lower case.
    pub member: Option<String>,
}

impl Reference {
    /// Name and constant index: what an element is filed under. `None` when the index is a variable.
    pub fn element(&self) -> Option<String> {
        match &self.index {
            Index::None => Some(self.base.clone()),
            Index::Constant(index) => Some(format!("{}{index}", self.base)),
            Index::Variable(_) => None,
        }
    }
}

/// Reads a variable at the cursor, which then stands behind it.
pub(super) fn reference(bytes: &[u8], cursor: &mut Cursor<'_>) -> Option<Reference> {
    let first = name(cursor)?;
    let mut found = Reference { span: first, base: key(bytes, first), index: Index::None, member: None };
    loop {
        let behind = *cursor;
        cursor.skip_blanks();
        if found.member.is_none() && found.index == Index::None && cursor.peek() == Some(b'[') {
            let Some(inside) = bracketed(cursor) else {
                *cursor = behind;
                return Some(found);
            };
            found.index = index(bytes, inside);
        } else if cursor.eat(b'.') {
            let member = name(cursor)?;
            found.member.get_or_insert_with(|| key(bytes, member));
        } else if found.member.is_some() && cursor.peek() == Some(b'[') && bracketed(cursor).is_some() {
            // An index of a member: it is not looked at.
        } else {
            *cursor = behind;
            found.span = Span::new(first.start, behind.offset());
            return Some(found);
        }
    }
}

/// The inside of the brackets at the cursor, which then stands behind them.
fn bracketed(cursor: &mut Cursor<'_>) -> Option<Span> {
    let start = cursor.offset() + 1;
    let mut depth = 0usize;
    for (at, &byte) in cursor.rest().iter().enumerate() {
        match byte {
            b'[' => depth += 1,
            b']' => {
                depth -= 1;
                if depth == 0 {
                    let end = start - 1 + at;
                    cursor.seek(end + 1);
                    return Some(Span::new(start, end));
                }
            }
            _ => {}
        }
    }
    None
}

fn index(bytes: &[u8], inside: Span) -> Index {
    let text = &bytes[inside.start..inside.end];
    if !text.iter().all(|byte| byte.is_ascii_digit() || matches!(byte, b',' | b' ' | b'\t')) {
        return Index::Variable(inside);
    }
    let digits: String = text.iter().filter(|byte| !byte.is_ascii_whitespace()).map(|&byte| char::from(byte)).collect();
    Index::Constant(format!("[{digits}]"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_indices_and_members() {
        let read = |text: &str| reference(text.as_bytes(), &mut Cursor::new(text.as_bytes(), Span::new(0, text.len())));
        let one = read("lfWorkPos[ 2 ] :x").expect("a name");
        assert_eq!((one.element(), one.span), (Some("lfworkpos[2]".into()), Span::new(0, 14)));
        let member = read("FDAT_ACT.BASE_NO = 1").expect("a name");
        assert_eq!((member.base.as_str(), member.member.as_deref()), ("fdat_act", Some("base_no")));
        assert_eq!(read("$POS_ACT").expect("a name").base, "$pos_act");
        assert_eq!(read("p[i+q[1]].z").and_then(|found| found.element()), None);
        assert_eq!(read("p[1").expect("a name").element(), Some("p".into()));
        assert_eq!(read("p."), None);
    }
}
