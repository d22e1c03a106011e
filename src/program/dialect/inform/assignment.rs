//! Instructions that set position variables and frames at run time: `SET P001 PX124`, `SETE P126 (2) D098`,
//! `CNVRT PX124 PX124 RF`, `MFRAME UF#(15) P001 P002 P003`.

use crate::base::text::Span;
use crate::program::scan::Cursor;

use super::positions::split;

/// What an instruction does to positions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Effect {
    /// A variable gets a value.
    Variable(u32),
    /// Some variable, by index, gets a value.
    SomeVariable,
    /// A user frame gets a value from these variables; `None` for a frame known only at run time.
    Frame(Option<u32>, Vec<u32>),
    /// All moves that follow are shifted.
    ShiftOn,
    /// No longer.
    ShiftOff,
    /// Another tool is selected.
    Tool,
}

/// Instructions whose first operand is read, not set.
const READING: [&str; 8] = ["REFP", "CALL", "JUMP", "IF", "WAIT", "TIMER", "CV", "PULSE"];

/// Reads an instruction; `None` when it leaves positions alone.
pub(super) fn effect(bytes: &[u8], line: Span) -> Option<Effect> {
    let mut cursor = Cursor::new(bytes, line);
    let word = cursor.name()?;
    let word = String::from_utf8_lossy(cursor.slice(word)).into_owned();
    match word.as_str() {
        "SFTON" => return Some(Effect::ShiftOn),
        "SFTOF" => return Some(Effect::ShiftOff),
        "TOOLSEL" => return Some(Effect::Tool),
        "MFRAME" | "SETUF" => return Some(frame(&mut cursor)),
        word if READING.contains(&word) => return None,
        _ => {}
    }
    cursor.skip_blanks();
    let name = cursor.name()?;
    if cursor.peek() == Some(b'[') {
        return matches!(cursor.slice(name), b"P" | b"PX").then_some(Effect::SomeVariable);
    }
    let (letters, number) = split(cursor.slice(name))?;
    matches!(letters.as_str(), "P" | "PX").then_some(Effect::Variable(number))
}

fn frame(cursor: &mut Cursor<'_>) -> Effect {
    cursor.skip_blanks();
    let mut number = None;
    if cursor.eat_word("UF") && cursor.eat(b'#') && cursor.eat(b'(') {
        let digits = cursor.skip_while(|byte| byte.is_ascii_digit());
        number = std::str::from_utf8(cursor.slice(digits)).ok().and_then(|text| text.parse().ok());
        cursor.skip_while(|byte| byte != b')');
        cursor.eat(b')');
    }
    let operands = String::from_utf8_lossy(cursor.rest()).into_owned();
    let variables = operands.split_whitespace().filter_map(|operand| split(operand.as_bytes()));
    let taken = variables.filter(|(letters, _)| letters == "P" || letters == "PX").map(|(_, number)| number).collect();
    Effect::Frame(number, taken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_sets_a_position_and_what_does_not() {
        let read = |text: &str| effect(text.as_bytes(), Span::new(0, text.len()));
        assert_eq!(read("SET P001 PX124"), Some(Effect::Variable(1)));
        assert_eq!(read("SETE P126 (2) D098"), Some(Effect::Variable(126)));
        assert_eq!(read("CNVRT PX124 PX124 RF"), Some(Effect::Variable(124)));
        assert_eq!(read("SET P[LB000] P001"), Some(Effect::SomeVariable));
        assert_eq!(read("MFRAME UF#(15) PX124 PX125 P126"), Some(Effect::Frame(Some(15), vec![124, 125, 126])));
        assert_eq!(read("MFRAME UF#(LB001) P1 P2 P3"), Some(Effect::Frame(None, vec![1, 2, 3])));
        assert_eq!(read("SFTON P[LB000] UF#(15)"), Some(Effect::ShiftOn));
        for text in
            ["GETE D098 P124 (2)", "REFP 1 C00005", "SET LP000 P100", "NOP", "*LABEL", "", "SET B000 1", "PAUSE"]
        {
            assert_eq!(read(text), None, "{text}");
        }
    }
}
