//! What a motion statement names as its goal.

use crate::base::text::Span;
use crate::program::number::starts_with_word;
use crate::program::scan::Cursor;

use super::written_pose::{PoseFault, WrittenPose, constructor, list, tuple};

/// The goal of a motion.
#[derive(Clone, Debug)]
pub(super) enum Goal {
    /// Its values stand here.
    Written(WrittenPose),
    /// A pose variable or constant.
    Named(Name),
    /// A displacement of the recorded pose: `R2`, `+Shift(..)`.
    Shift,
    /// Anything else.
    Expression(Span),
    /// A pose that cannot be read.
    Broken(PoseFault),
}

/// The name of a variable with its constant index, if it has one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    /// Where it stands.
    pub span: Span,
    /// In lower case, without blanks: `p1`, `po[0]`.
    pub key: String,
}

/// Reads the expression that fills `span`.
pub(super) fn goal(bytes: &[u8], span: Span, total_axes: Option<usize>) -> Goal {
    let mut cursor = Cursor::new(bytes, span);
    cursor.skip_blanks();
    let is_constructor = starts_with_word(cursor.rest(), "Pose");
    let written = match cursor.peek() {
        Some(b'(') => tuple(&mut cursor, total_axes),
        Some(b'[') => list(&mut cursor),
        Some(b'+' | b'-') => return Goal::Shift,
        _ if is_constructor => constructor(&mut cursor),
        _ => return named(&mut cursor, span),
    };
    let rest_is_blank = cursor.rest().trim_ascii().is_empty();
    match written {
        Ok(pose) if rest_is_blank => Goal::Written(pose),
        Err(fault @ PoseFault::Unclosed(_)) => Goal::Broken(fault),
        Err(fault) if !is_constructor => Goal::Broken(fault),
        _ => Goal::Expression(span),
    }
}

fn named(cursor: &mut Cursor<'_>, span: Span) -> Goal {
    match name(cursor) {
        Some(name) if cursor.rest().trim_ascii().is_empty() => {
            let is_register = name
                .key
                .strip_prefix('r')
                .is_some_and(|rest| !rest.is_empty() && rest.bytes().all(|byte| byte.is_ascii_digit()));
            if is_register { Goal::Shift } else { Goal::Named(name) }
        }
        _ => Goal::Expression(span),
    }
}

/// Reads a name and, if one follows, a constant index; the cursor stays where it is when the index is no constant.
pub(super) fn name(cursor: &mut Cursor<'_>) -> Option<Name> {
    let before = *cursor;
    let word = cursor.name()?;
    let mut key = String::from_utf8_lossy(cursor.slice(word)).to_lowercase();
    if cursor.peek() == Some(b'[') {
        cursor.bump();
        cursor.skip_blanks();
        let digits = cursor.skip_while(|byte| byte.is_ascii_digit());
        cursor.skip_blanks();
        if digits.is_empty() || !cursor.eat(b']') {
            *cursor = before;
            return None;
        }
        key.push('[');
        key.push_str(&String::from_utf8_lossy(cursor.slice(digits)));
        key.push(']');
    }
    Some(Name { span: Span::new(word.start, cursor.offset()), key })
}
