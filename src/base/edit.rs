//! Changes to a file: sorted, disjoint replacements of byte ranges.
//!
//! Text is never mutated in place; an [`EditSet`] is collected, then applied once. An empty set gives the input back.

use std::borrow::Cow;

use super::text::Span;

/// Two edits that touch the same bytes, or one that lies outside the file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// The same bytes would be replaced twice.
    #[error("two edits overlap at bytes {}..{}", .0.start, .0.end)]
    Overlap(Span),
    /// The range does not lie in the file.
    #[error("an edit at bytes {}..{} is too large or lies outside a file of {length} bytes", .span.start, .span.end)]
    Outside {
        /// The range asked for.
        span: Span,
        /// Bytes in the file.
        length: usize,
    },
}

/// A set of edits to one file.
#[derive(Clone, Debug, Default)]
pub struct EditSet {
    edits: Vec<Edit>,
    /// All that comes, one after the other: programs have millions of edits of a few bytes.
    text: Vec<u8>,
    /// An edit that cannot be kept: in a file larger than any program, or of more bytes than any number has.
    too_far: Option<Span>,
}

/// One replacement; no `length` inserts. Numbers are short: their lengths are kept in two bytes.
#[derive(Clone, Copy, Debug)]
struct Edit {
    start: u32,
    /// Where the bytes that come begin in [`EditSet::text`].
    text: u32,
    length: u16,
    text_length: u16,
}

impl Edit {
    fn new(span: Span, text: usize, text_length: usize) -> Option<Self> {
        Some(Self {
            start: u32::try_from(span.start).ok()?,
            text: u32::try_from(text).ok()?,
            length: u16::try_from(span.len()).ok()?,
            text_length: u16::try_from(text_length).ok()?,
        })
    }

    /// The bytes that go.
    fn span(&self) -> Span {
        let start = self.start as usize;
        Span::new(start, start + self.length as usize)
    }

    /// The bytes that come.
    fn replacement<'t>(&self, text: &'t [u8]) -> &'t [u8] {
        &text[self.text as usize..][..self.text_length as usize]
    }
}

impl EditSet {
    /// Adds a replacement; order does not matter. An empty `span` inserts.
    pub fn push(&mut self, span: Span, replacement: impl AsRef<[u8]>) {
        let replacement = replacement.as_ref();
        match Edit::new(span, self.text.len(), replacement.len()) {
            Some(edit) => self.edits.push(edit),
            None => self.too_far = self.too_far.or(Some(span)),
        }
        self.text.extend_from_slice(replacement);
    }

    /// Adds all edits of another set.
    pub fn append(&mut self, other: &EditSet) {
        other.edits.iter().for_each(|edit| self.push(edit.span(), edit.replacement(&other.text)));
        self.too_far = self.too_far.or(other.too_far);
    }

    /// True when applying it gives the input back.
    pub fn is_empty(&self) -> bool {
        self.edits.is_empty() && self.too_far.is_none()
    }

    /// The file with every edit made.
    ///
    /// # Errors
    /// [`EditError`] when two edits overlap or one lies outside `bytes`.
    pub fn apply(&self, bytes: &[u8]) -> Result<Vec<u8>, EditError> {
        let outside = |span| EditError::Outside { span, length: bytes.len() };
        if let Some(span) = self.too_far {
            return Err(outside(span));
        }
        let mut out = Vec::with_capacity(bytes.len() + self.text.len());
        let mut copied = 0;
        for edit in self.in_order().iter() {
            let span = edit.span();
            if span.end > bytes.len() {
                return Err(outside(span));
            }
            if span.start < copied {
                return Err(EditError::Overlap(span));
            }
            out.extend_from_slice(&bytes[copied..span.start]);
            out.extend_from_slice(edit.replacement(&self.text));
            copied = span.end;
        }
        out.extend_from_slice(&bytes[copied..]);
        Ok(out)
    }

    /// The edits in the order of the file, which is mostly that in which they came.
    fn in_order(&self) -> Cow<'_, [Edit]> {
        let mut edits = Cow::Borrowed(self.edits.as_slice());
        if !edits.is_sorted_by_key(Edit::span) {
            edits.to_mut().sort_by_key(Edit::span);
        }
        edits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_replace_insert_and_leave_the_rest() {
        let mut edits = EditSet::default();
        edits.push(Span::new(4, 5), "XYZ");
        edits.push(Span::new(0, 1), "_");
        edits.push(Span::new(2, 2), "+");
        assert_eq!(edits.apply(b"abcdef").as_deref(), Ok(&b"_b+cdXYZf"[..]));
        assert_eq!(EditSet::default().apply(b"abc").as_deref(), Ok(&b"abc"[..]));
    }

    #[test]
    fn overlap_and_outside_are_errors() {
        let mut edits = EditSet::default();
        edits.push(Span::new(0, 3), "");
        edits.push(Span::new(2, 4), "");
        assert_eq!(edits.apply(b"abcdef"), Err(EditError::Overlap(Span::new(2, 4))));
        let mut edits = EditSet::default();
        edits.push(Span::new(5, 9), "");
        assert!(matches!(edits.apply(b"abcdef"), Err(EditError::Outside { length: 6, .. })));
    }
}
