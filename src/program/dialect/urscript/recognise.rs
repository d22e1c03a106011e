//! Telling URScript by its content.

use crate::base::text::Source;

use super::token::{Kind, Text, tokens};

/// Words that only this language has, with a bracket behind them.
const WORDS: [&[u8]; 20] = [
    b"movej",
    b"movel",
    b"movep",
    b"movec",
    b"servoj",
    b"servoc",
    b"optimovej",
    b"optimovel",
    b"speedl",
    b"speedj",
    b"set_tcp",
    b"set_payload",
    b"set_target_payload",
    b"textmsg",
    b"set_digital_out",
    b"set_standard_digital_out",
    b"get_actual_tcp_pose",
    b"get_inverse_kin",
    b"pose_trans",
    b"stopl",
];

/// A move to a pose or joint list that is written in it.
const MOVES: [&[u8]; 4] = [b"movej", b"movel", b"movep", b"movec"];

/// True for `def name(..):` that an `end` closes, with a word of this language; and for bare moves to `p[..]`.
pub(super) fn recognises(source: &Source) -> bool {
    let tokens = tokens(source);
    let text = Text { source, tokens: &tokens };
    let (mut opened, mut closed, mut named, mut bare) = (false, false, false, false);
    let mut begins = true;
    for (at, token) in tokens.iter().enumerate() {
        let word = text.word(at);
        if begins {
            opened |= matches!(word, b"def" | b"thread") && text.is(at + 2, b'(') && line_ends_with_colon(text, at);
            closed |= word == b"end" && tokens.get(at + 1).is_none_or(|next| next.kind == Kind::LineEnd);
            let written = text.word(at + 2) == b"p" && text.is(at + 3, b'[');
            let solved = text.word(at + 2) == b"get_inverse_kin";
            bare |= MOVES.contains(&word) && text.is(at + 1, b'(') && (written || solved);
        }
        named |= WORDS.contains(&word) && text.is(at + 1, b'(');
        begins = token.kind == Kind::LineEnd;
    }
    (opened && closed && named) || (bare && !opened)
}

fn line_ends_with_colon(text: Text<'_>, at: usize) -> bool {
    let rest = &text.tokens[at..];
    let end = rest.iter().take(200).position(|token| token.kind == Kind::LineEnd);
    end.and_then(|end| end.checked_sub(1)).is_some_and(|last| rest[last].kind == Kind::Symbol(b':'))
}
