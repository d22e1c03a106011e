//! Changes to a file: sorted, disjoint replacements of byte ranges.
//!
//! Text is never mutated in place; an [`EditSet`] is collected, then applied once. An empty set gives the input back.

use super::text::Span;

/// Two edits that touch the same bytes, or one that lies outside the file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// The same bytes would be replaced twice.
    #[error("two edits overlap at bytes {}..{}", .0.start, .0.end)]
    Overlap(Span),
    /// The range does not lie in the file.
    #[error("an edit at bytes {}..{} lies outside a file of {length} bytes", .span.start, .span.end)]
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
}

/// One replacement. An empty `span` inserts.
#[derive(Clone, Copy, Debug)]
struct Edit {
    /// The bytes that go.
    span: Span,
    /// Where the bytes that come stand in [`EditSet::text`].
    text: Span,
}

impl EditSet {
    /// Adds a replacement; order does not matter. An empty `span` inserts.
    pub fn push(&mut self, span: Span, replacement: impl AsRef<[u8]>) {
        let start = self.text.len();
        self.text.extend_from_slice(replacement.as_ref());
        self.edits.push(Edit { span, text: Span::new(start, self.text.len()) });
    }

    /// True when applying it gives the input back.
    pub fn is_empty(&self) -> bool {
        self.edits.is_empty()
    }

    /// The file with every edit made.
    ///
    /// # Errors
    /// [`EditError`] when two edits overlap or one lies outside `bytes`.
    pub fn apply(&self, bytes: &[u8]) -> Result<Vec<u8>, EditError> {
        let mut out = Vec::with_capacity(bytes.len() + self.text.len());
        let mut copied = 0;
        let mut in_order = self.edits.clone();
        in_order.sort_by_key(|edit| edit.span);
        for edit in in_order {
            if edit.span.end > bytes.len() {
                return Err(EditError::Outside { span: edit.span, length: bytes.len() });
            }
            if edit.span.start < copied {
                return Err(EditError::Overlap(edit.span));
            }
            out.extend_from_slice(&bytes[copied..edit.span.start]);
            out.extend_from_slice(&self.text[edit.text.start..edit.text.end]);
            copied = edit.span.end;
        }
        out.extend_from_slice(&bytes[copied..]);
        Ok(out)
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
