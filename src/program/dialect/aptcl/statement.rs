//! Lines into statements: `MAJOR/minor,minor,.. $` with continuations, `$$` comments, text statements.

use crate::base::text::{Source, Span};
use crate::program::number::{NumberField, number_at};
use crate::program::scan::Cursor;

/// A statement.
#[derive(Clone, Debug, Default)]
pub(super) struct Statement {
    /// The major word in upper case.
    pub major: String,
    /// What stands between the commas behind `/`.
    pub minors: Vec<Span>,
    /// From the major word to the last minor.
    pub span: Span,
}

/// A statement or a comment.
#[derive(Clone, Debug)]
pub(super) enum Part {
    /// A statement.
    Statement(Statement),
    /// Text behind `$$`, `PPRINT`, `REMARK`.
    Comment(Span),
    /// A line that is neither.
    Opaque,
}

/// Words whose line is text.
const TEXTS: [&str; 5] = ["PARTNO", "PPRINT", "REMARK", "INSERT", "TPRINT"];

/// All parts of a file.
pub(super) fn parts(source: &Source) -> Vec<Part> {
    let bytes = source.bytes();
    let mut parts = Vec::new();
    let mut open: Option<Statement> = None;
    for line in source.lines() {
        let mut cursor = Cursor::new(bytes, line);
        cursor.skip_while(|byte| byte.is_ascii_whitespace() || matches!(byte, 0xef | 0xbb | 0xbf));
        let start = cursor.offset();
        let text = if open.is_none() { text_statement(&mut cursor) } else { None };
        if let Some(text) = text {
            parts.push(Part::Comment(text));
            continue;
        }
        cursor.seek(start);
        let code = cursor.skip_while(|byte| byte != b'$');
        let continued = cursor.eat(b'$') && cursor.peek() != Some(b'$');
        if !continued && cursor.eat(b'$') {
            parts.push(Part::Comment(Span::new(cursor.offset(), line.end)));
        }
        let code = Span::new(code.start, code.start + source.slice(code).trim_ascii_end().len());
        let mut statement = match open.take() {
            Some(mut statement) => {
                minors(bytes, code, &mut statement);
                statement
            }
            None if code.is_empty() => continue,
            None => match begun(bytes, code) {
                Some(statement) => statement,
                None => {
                    parts.push(Part::Opaque);
                    continue;
                }
            },
        };
        statement.span.end = statement.span.end.max(code.end);
        if continued {
            open = Some(statement);
        } else {
            parts.push(Part::Statement(statement));
        }
    }
    parts.extend(open.map(Part::Statement));
    parts
}

/// The text of `PPRINT text` and its like, whose words are not followed by an `=`.
fn text_statement(cursor: &mut Cursor<'_>) -> Option<Span> {
    TEXTS.iter().any(|word| cursor.eat_word(word)).then(|| {
        cursor.skip_while(|byte| matches!(byte, b' ' | b'\t' | b'/' | b'\'' | b'"'));
        let end = cursor.offset() + cursor.rest().len();
        Span::new(cursor.offset(), end)
    })
}

/// `MAJOR` or `MAJOR/..`.
fn begun(bytes: &[u8], code: Span) -> Option<Statement> {
    let mut cursor = Cursor::new(bytes, code);
    let major = cursor.name()?;
    let word = String::from_utf8_lossy(cursor.slice(major)).to_ascii_uppercase();
    cursor.skip_blanks();
    let mut statement = Statement { major: word, minors: Vec::new(), span: code };
    match cursor.peek() {
        None => {}
        Some(b'/') => {
            cursor.bump();
            minors(bytes, Span::new(cursor.offset(), code.end), &mut statement);
        }
        // `TLON,GOFWD/..`
        Some(b',') => minors(bytes, Span::new(cursor.offset() + 1, code.end), &mut statement),
        Some(_) => return None,
    }
    Some(statement)
}

/// Adds what stands between commas. A comma at either end of a line does not make an empty one.
fn minors(bytes: &[u8], code: Span, statement: &mut Statement) {
    let mut start = code.start;
    for at in code.start..=code.end {
        if at == code.end || bytes[at] == b',' {
            let text = &bytes[start..at];
            let from = start + (text.len() - text.trim_ascii_start().len());
            let minor = Span::new(from, from + text.trim_ascii().len());
            if !minor.is_empty() {
                statement.minors.push(minor);
            }
            start = at + 1;
        }
    }
}

impl Statement {
    /// The minor words and numbers as text, in upper case.
    pub fn word<'a>(&self, source: &'a Source, index: usize) -> std::borrow::Cow<'a, str> {
        let text = self.minors.get(index).map(|&minor| source.text(minor)).unwrap_or_default();
        text.to_ascii_uppercase().into()
    }

    /// The first `count` minors as numbers.
    pub fn numbers(&self, source: &Source, count: usize) -> Option<Vec<NumberField>> {
        let whole = |minor: &Span| number_at(source.bytes(), minor.start).filter(|field| field.span() == *minor);
        (self.minors.len() >= count).then(|| self.minors[..count].iter().map(whole).collect())?
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Vec<String> {
        let source = Source::new("t", text);
        let shown = |part: Part| match part {
            Part::Statement(one) => {
                let minors: Vec<String> = one.minors.iter().map(|&minor| source.text(minor).into_owned()).collect();
                format!("{}:{}", one.major, minors.join("|"))
            }
            Part::Comment(text) => format!("'{}", source.text(text)),
            Part::Opaque => "?".into(),
        };
        parts(&source).into_iter().map(shown).collect()
    }

    #[test]
    fn statements_go_on_behind_a_dollar() {
        assert_eq!(
            read("PARTNO A $ B\r\ngoto / 1.0, -2., $ seq 12\r\n  3.0, 0.0, $\r\n0.0,1.0$$ end\r\nFINI\r\n"),
            ["'A $ B", "' end", "GOTO:1.0|-2.|3.0|0.0|0.0|1.0", "FINI:"]
        );
        assert_eq!(read("$$ x\n12345\nTLON,GOFWD/(CIRCLE/0,0)"), ["' x", "?", "TLON:GOFWD/(CIRCLE/0|0)"]);
    }
}
