//! Text that goes into a page: what comes from files is escaped, what this module's callers write is not.

use std::fmt::{self, Write};

/// Text with what HTML would take for its own made harmless. Serves element content and quoted attributes.
///
/// Characters that no HTML text may hold (control characters) become the replacement character.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            '\t' | '\n' => safe.push(letter),
            control if control.is_control() => safe.push('\u{fffd}'),
            other => safe.push(other),
        }
    }
    safe
}

/// A page or a part of one, growing.
#[derive(Clone, Debug, Default)]
pub struct Markup(String);

impl Markup {
    /// Adds markup as it is. Values from outside go through [`escaped`] first, or through [`Markup::element`].
    pub fn raw(&mut self, markup: impl fmt::Display) -> &mut Self {
        // Writing to a string cannot fail.
        let _ = write!(self.0, "{markup}");
        self
    }

    /// Adds an element with text in it, escaped.
    pub fn element(&mut self, tag: &str, attributes: &str, text: &str) -> &mut Self {
        let space = if attributes.is_empty() { "" } else { " " };
        self.raw(format_args!("<{tag}{space}{attributes}>{}</{tag}>\n", escaped(text)))
    }

    /// Adds a table. Cells are escaped; columns beyond the first `words` ones are numbers, set to the right.
    pub fn table(&mut self, heads: &[&str], words: usize, rows: &[Vec<String>]) -> &mut Self {
        let class = |column: usize| if column < words { "" } else { "class=\"n\"" };
        self.raw("<div class=\"scroll\"><table>\n<thead><tr>");
        for (column, head) in heads.iter().enumerate() {
            self.element("th", class(column), head);
        }
        self.raw("</tr></thead>\n<tbody>\n");
        for row in rows {
            self.raw("<tr>");
            for (column, cell) in row.iter().enumerate() {
                self.element("td", class(column), cell);
            }
            self.raw("</tr>\n");
        }
        self.raw("</tbody></table></div>\n")
    }

    /// The markup.
    pub fn into_string(self) -> String {
        self.0
    }
}

/// A number with as many digits as tell something: three to four.
pub fn short(number: f64) -> String {
    let size = number.abs();
    match size {
        _ if !number.is_finite() => "-".into(),
        _ if size == 0.0 => "0".into(),
        _ if (1e-3..1e4).contains(&size) => {
            let digits = (3 - size.log10().floor() as i32).clamp(0, 5) as usize;
            format!("{number:.digits$}")
        }
        _ => format!("{number:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_says_is_no_markup() {
        let name = "<script>alert('1')</script>&\"\u{7}";
        assert_eq!(escaped(name), "&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt;&amp;&quot;\u{fffd}");
        let mut markup = Markup::default();
        markup.table(&["a", "b"], 1, &[vec![name.into(), "1".into()]]);
        let text = markup.into_string();
        assert!(!text.contains("<script") && text.contains("<td class=\"n\">1</td>"));
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(short(0.012345), "0.01235");
        assert_eq!(short(123.456), "123.5");
        assert_eq!(short(1.2e-7), "1.20e-7");
        assert_eq!(short(f64::NAN), "-");
        assert_eq!(short(-5.0), "-5.000");
    }
}
