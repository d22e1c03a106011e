//! Telling KRL by its content.

use crate::base::text::{Source, Span};
use crate::program::scan::Cursor;

use super::aggregate::aggregate;
use super::reference::reference;
use super::statement::{first_word, name, statements};

/// True when the text can only be KRL.
///
/// Proof is any of: a header line `&ACCESS`, a data list `DEFDAT name`, a motion to or a value of an aggregate that
/// begins with `X` or `A1`, or a routine `DEF name( )` (without the colon of other languages) in a text with an inline
/// form, a system variable, a motion or `END` in capitals.
pub(super) fn is_krl(source: &Source) -> bool {
    let bytes = source.bytes();
    let start = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let head = bytes[start..].trim_ascii_start();
    if head.len() > 6 && head[..7].eq_ignore_ascii_case(b"&ACCESS") {
        return true;
    }
    let (mut routine, mut hint) = (false, has_fold(bytes));
    for span in statements(source) {
        let (word, rest) = first_word(bytes, span);
        let (word, rest) = if word == "global" { first_word(bytes, rest) } else { (word, rest) };
        match word.as_str() {
            "defdat" if is_data_list(bytes, rest) => return true,
            "ptp" | "lin" | "sptp" | "slin" | "circ" | "scirc" | "spl" => {
                if begins_position(bytes, rest) {
                    return true;
                }
                hint |= is_name_alone(bytes, rest);
            }
            "decl" | "e6pos" | "e6axis" | "pos" | "axis" | "frame" if assigns_position(bytes, rest) => return true,
            "def" => routine |= is_routine(bytes, rest),
            // Languages that share `def` and `end` are particular about their case.
            "end" => hint |= routine && bytes[span.start..span.end] == *b"END",
            "deffct" => routine |= rest.len() > 2,
            "bas" => hint |= bytes[rest.start..rest.end].starts_with(b"(#"),
            word => hint |= word.starts_with('$') && word.len() > 1,
        }
        if routine && hint {
            return true;
        }
    }
    false
}

fn has_fold(bytes: &[u8]) -> bool {
    bytes.windows(6).any(|six| six[0] == b';' && six.eq_ignore_ascii_case(b";FOLD "))
}

/// `name`, perhaps `PUBLIC`, and nothing else.
fn is_data_list(bytes: &[u8], rest: Span) -> bool {
    let mut cursor = Cursor::new(bytes, rest);
    let named = name(&mut cursor).is_some();
    cursor.skip_blanks();
    cursor.eat_word("PUBLIC");
    cursor.skip_blanks();
    named && cursor.at_end()
}

/// `name (..)` and nothing else.
fn is_routine(bytes: &[u8], rest: Span) -> bool {
    let mut cursor = Cursor::new(bytes, rest);
    let named = name(&mut cursor).is_some();
    cursor.skip_blanks();
    named && cursor.eat(b'(') && cursor.rest().trim_ascii_end().last() == Some(&b')')
}

/// An aggregate with a coordinate or an axis in it.
fn begins_position(bytes: &[u8], span: Span) -> bool {
    let mut cursor = Cursor::new(bytes, span);
    if cursor.peek() != Some(b'{') {
        return false;
    }
    let first = aggregate(bytes, &mut cursor).ok().and_then(|found| found.components.into_iter().next());
    first.is_some_and(|(name, _)| matches!(name.as_str(), "x" | "y" | "z" | "a" | "b" | "c" | "a1" | "e1"))
}

/// `XP1`, perhaps with `C_DIS` or `WITH` behind it: no comma list, no `:=`.
fn is_name_alone(bytes: &[u8], rest: Span) -> bool {
    let mut cursor = Cursor::new(bytes, rest);
    if reference(bytes, &mut cursor).is_none() {
        return false;
    }
    cursor.skip_blanks();
    let behind = cursor.rest().to_ascii_lowercase();
    behind.is_empty() || behind.starts_with(b"c_") || behind.starts_with(b"with ")
}

/// `[GLOBAL] [type] name={X ..`
fn assigns_position(bytes: &[u8], rest: Span) -> bool {
    let equals = bytes[rest.start..rest.end].iter().position(|&byte| byte == b'=');
    equals.is_some_and(|at| {
        let mut cursor = Cursor::new(bytes, Span::new(rest.start + at + 1, rest.end));
        cursor.skip_blanks();
        begins_position(bytes, Span::new(cursor.offset(), rest.end))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is(text: &str) -> bool {
        is_krl(&Source::new("t", text))
    }

    #[test]
    fn programs_data_and_snippets_are_recognised() {
        assert!(is("&ACCESS RVP\r\n&REL 1\r\nDEF a()\r\nEND\r\n"));
        assert!(is("\n  defdat Points public\nENDDAT"));
        assert!(is("DEF  main ( )\n;FOLD INI\nBAS (#INITMOV,0 )\n;ENDFOLD (INI)\nEND"));
        assert!(is("DEF  OpenGripper ( )\n   DO_Open = TRUE\n   WAIT FOR DI_Open\nEND\n"));
        assert!(is("def main(a:in)\nptp xhome\nend"));
        assert!(is("GLOBAL DEFFCT FRAME f (a :IN)\n$OUT[3]=TRUE\nENDFCT"));
        assert!(is("LIN {X 10,Y 0,Z 5,A 0,B 0,C 0} C_DIS"));
        assert!(is("DECL E6POS XP1={X 10,Y 0,Z 5,A 0,B 0,C 0,S 2,T 3}"));
        assert!(is("E6AXIS h={A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}"));
    }

    #[test]
    fn other_languages_are_not() {
        for text in [
            "",
            "def f():\n  movel(p[0.1,0.2,0.3,0,0,0], a=1.2, v=0.25, t=0, r=0)\nend\n",
            "def pick(a)\n  $stdout.puts a\nend\n# ruby, x\nfoo = 1\n".replace("$stdout", "stdout").as_str(),
            "MODULE a\nPROC main()\nMoveJ p1,v100,z10,tool0;\nENDPROC\nENDMODULE\n",
            "/PROG A\n/MN\n 1:L P[1] 100mm/sec FINE ;\n/POS\n/END\n",
            "Program File Format Version : 1.6  MechType: 370\n     S1   MOVE P,S=60%,A=3,T=1\n     END\n",
            ".PROGRAM a()\n  JMOVE p1\n  LMOVE p2\n.END\n",
            "PROGRAM a\nBEGIN\n  MOVE LINEAR TO p1\nEND a\n",
        ] {
            assert!(!is(text), "{text}");
        }
    }
}
