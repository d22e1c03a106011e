//! Location expressions: `p`, `#p[1,2]`, `TRANS(x,y,z,o,a,t)`, `a+b+TRANS(0,0,50)`, `SHIFT(p BY 0,0,50)`.

use crate::base::text::Span;
use crate::geometry::orientation::OrientationConvention;
use crate::geometry::pose::{Pose, rotation_x, rotation_y, rotation_z};
use crate::program::number::{NumberField, number_at};
use crate::program::scan::Cursor;
use crate::program::target::{CartesianNumbers, Units, values};

use super::section::{is_name_part, lower};

/// Brackets in brackets are followed this deep.
const MAX_DEPTH: usize = 8;

/// A location as written.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    /// All of it.
    pub span: Span,
    /// What is added up; `None` when some part is none of the forms that are read.
    pub terms: Option<Vec<Term>>,
}

/// A part of a compound location.
#[derive(Clone, Debug)]
pub(super) enum Term {
    /// A variable.
    Name(Name),
    /// `TRANS(..)`: what stands between the commas.
    Trans(Span, Vec<Number>),
    /// `#PPOINT(..)`, `#[..]`.
    Joints(Span, Vec<Number>),
    /// `RX(90)`, by axis.
    Turn(usize, Number),
    /// `SHIFT(p BY x,y,z)`: the location, the bracket's span and the numbers.
    Shift(Box<Expression>, Span, Vec<Number>),
    /// `FRAME(a,b,c,d)`: made of these locations.
    Frame(Vec<Name>),
    /// `NULL`.
    Null,
}

/// What stands where a number belongs.
#[derive(Clone, Debug)]
pub(super) enum Number {
    /// A number.
    Written(NumberField),
    /// Nothing: zero.
    Absent,
    /// Anything else.
    Computed,
}

impl Number {
    /// Its value, if the text has it.
    pub fn value(&self) -> Option<f64> {
        match self {
            Self::Written(field) => Some(field.value),
            Self::Absent => Some(0.0),
            Self::Computed => None,
        }
    }
}

/// A variable as a statement names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    /// From `#` or the first letter to the bracket that closes.
    pub span: Span,
    /// Lower case, with `#`, without index.
    pub base: String,
    /// What stands in the brackets.
    pub index: Index,
}

/// The index of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Index {
    /// No array.
    None,
    /// Numbers, separated by commas, without blanks.
    Constant(String),
    /// Known only at run time.
    Variable,
}

impl Name {
    /// The key of a variable or element; that of the array when the index is known only at run time.
    pub fn key(&self) -> String {
        match &self.index {
            Index::Constant(index) => format!("{}[{index}]", self.base),
            Index::None | Index::Variable => self.base.clone(),
        }
    }

    /// Local to its program.
    pub fn is_local(&self) -> bool {
        self.base.trim_start_matches('#').starts_with('.')
    }
}

impl Expression {
    /// Reads one up to a comma, the end of the statement or a word that does not belong to it.
    pub fn read(cursor: &mut Cursor<'_>) -> Self {
        Self::nested(cursor, 0)
    }

    fn nested(cursor: &mut Cursor<'_>, depth: usize) -> Self {
        cursor.skip_blanks();
        let start = cursor.offset();
        let mut terms = Some(Vec::new());
        let mut end = start;
        loop {
            cursor.skip_blanks();
            match (term(cursor, depth), &mut terms) {
                (Some(term), Some(terms)) => terms.push(term),
                _ => terms = None,
            }
            if terms.is_none() {
                break;
            }
            end = cursor.offset();
            cursor.skip_blanks();
            if !cursor.eat(b'+') {
                break;
            }
        }
        // `p-q` and the like are computed.
        if matches!(cursor.peek(), Some(b'-' | b'*' | b'/' | b'(' | b'[')) {
            terms = None;
        }
        if terms.is_none() {
            skip_argument(cursor);
            let text = &cursor.slice(Span::new(start, cursor.offset()));
            end = start + text.trim_ascii_end().len();
        }
        Self { span: Span::new(start, end), terms }
    }

    /// The only term, if it is a name.
    pub fn single_name(&self) -> Option<&Name> {
        match self.terms.as_deref() {
            Some([Term::Name(name)]) => Some(name),
            _ => None,
        }
    }

    /// All names in it.
    pub fn names(&self) -> Vec<&Name> {
        let terms = self.terms.iter().flatten();
        terms
            .flat_map(|term| match term {
                Term::Name(name) => vec![name],
                Term::Frame(names) => names.iter().collect(),
                Term::Shift(inner, ..) => inner.names(),
                _ => Vec::new(),
            })
            .collect()
    }
}

fn term(cursor: &mut Cursor<'_>, depth: usize) -> Option<Term> {
    let start = cursor.offset();
    let joints = cursor.eat(b'#');
    if joints && cursor.peek() == Some(b'[') {
        let (numbers, end) = numbers(cursor, b']')?;
        return Some(Term::Joints(Span::new(start, end), numbers));
    }
    let name = cursor.skip_while(is_name_part);
    let word = cursor.slice(name);
    if !word.first().is_some_and(|&first| first.is_ascii_alphabetic() || matches!(first, b'.' | b'_') || first >= 0x80)
        || word == b"."
    {
        return None;
    }
    cursor.skip_blanks();
    let upper = word.to_ascii_uppercase();
    match (upper.as_slice(), cursor.peek()) {
        (b"TRANS", Some(b'(')) if !joints => {
            let (numbers, end) = numbers(cursor, b')')?;
            Some(Term::Trans(Span::new(start, end), numbers))
        }
        (b"PPOINT", Some(b'(')) if joints => {
            let (numbers, end) = numbers(cursor, b')')?;
            Some(Term::Joints(Span::new(start, end), numbers))
        }
        (b"RX" | b"RY" | b"RZ", Some(b'(')) => {
            let (mut numbers, _) = numbers(cursor, b')')?;
            (numbers.len() == 1).then(|| Term::Turn(usize::from(upper[1] - b'X'), numbers.remove(0)))
        }
        (b"SHIFT", Some(b'(')) if depth < MAX_DEPTH => shift(cursor, start, depth),
        (b"FRAME", Some(b'(')) if depth < MAX_DEPTH => {
            let mut names = Vec::new();
            cursor.bump();
            loop {
                let part = Expression::nested(cursor, depth + 1);
                names.extend(part.names().into_iter().cloned());
                match cursor.bump() {
                    Some(b',') => {}
                    Some(b')') => return Some(Term::Frame(names)),
                    _ => return None,
                }
            }
        }
        (b"NULL", next) if !joints && next != Some(b'[') => Some(Term::Null),
        // A function of the controller.
        (_, Some(b'(')) => None,
        _ => {
            cursor.seek(name.end);
            named(cursor, start).map(Term::Name)
        }
    }
}

/// The index behind a name; the cursor stands at the end of the name.
fn named(cursor: &mut Cursor<'_>, start: usize) -> Option<Name> {
    let base = lower(cursor.slice(Span::new(start, cursor.offset())));
    let mut index = Index::None;
    if cursor.eat(b'[') {
        let inside = bracketed(cursor, b'[', b']')?;
        let constant = |part: &[u8]| !part.is_empty() && part.iter().all(u8::is_ascii_digit);
        let parts: Vec<&[u8]> = cursor.slice(inside).split(|&byte| byte == b',').map(<[u8]>::trim_ascii).collect();
        index = match parts.iter().all(|part| constant(part)) {
            true => Index::Constant(parts.iter().map(|part| lower(part)).collect::<Vec<_>>().join(",")),
            false => Index::Variable,
        };
    }
    Some(Name { span: Span::new(start, cursor.offset()), base, index })
}

/// A name with its index, if one stands here.
pub(super) fn name(cursor: &mut Cursor<'_>) -> Option<Name> {
    let before = *cursor;
    if let Some(Term::Name(name)) = term(cursor, MAX_DEPTH) {
        return Some(name);
    }
    *cursor = before;
    None
}

fn shift(cursor: &mut Cursor<'_>, start: usize, depth: usize) -> Option<Term> {
    cursor.bump();
    let inner = Expression::nested(cursor, depth + 1);
    cursor.skip_blanks();
    if !cursor.eat_word("BY") {
        return None;
    }
    let mut found = Vec::new();
    loop {
        found.push(number(cursor));
        match cursor.bump() {
            Some(b',') => {}
            Some(b')') => return Some(Term::Shift(Box::new(inner), Span::new(start, cursor.offset()), found)),
            _ => return None,
        }
    }
}

/// Numbers in brackets with commas; the cursor stands at the bracket that opens. Gives the end behind the other.
pub(super) fn numbers(cursor: &mut Cursor<'_>, close: u8) -> Option<(Vec<Number>, usize)> {
    cursor.bump();
    let mut found = Vec::new();
    loop {
        found.push(number(cursor));
        match cursor.bump() {
            Some(b',') => {}
            Some(byte) if byte == close => return Some((found, cursor.offset())),
            _ => return None,
        }
    }
}

/// One number up to a comma or a bracket that closes.
pub(super) fn number(cursor: &mut Cursor<'_>) -> Number {
    cursor.skip_blanks();
    let start = cursor.offset();
    skip_argument(cursor);
    let text = cursor.slice(Span::new(start, cursor.offset())).trim_ascii_end();
    if text.is_empty() {
        return Number::Absent;
    }
    match number_at(text, 0) {
        Some(field) if field.span().len() == text.len() => Number::Written(field.at(start)),
        _ => Number::Computed,
    }
}

/// Goes to the next comma or closing bracket that does not belong to a bracket opened on the way.
fn skip_argument(cursor: &mut Cursor<'_>) {
    let mut depth = 0_usize;
    while let Some(byte) = cursor.peek() {
        match byte {
            b'(' | b'[' => depth += 1,
            b')' | b']' if depth == 0 => return,
            b')' | b']' => depth -= 1,
            b',' if depth == 0 => return,
            _ => {}
        }
        cursor.bump();
    }
}

/// What stands up to the bracket that closes; the cursor stands behind the one that opens.
fn bracketed(cursor: &mut Cursor<'_>, open: u8, close: u8) -> Option<Span> {
    let start = cursor.offset();
    let mut depth = 1_usize;
    while let Some(byte) = cursor.bump() {
        depth = match byte {
            _ if byte == open => depth + 1,
            _ if byte == close => depth - 1,
            _ => depth,
        };
        if depth == 0 {
            return Some(Span::new(start, cursor.offset() - 1));
        }
    }
    None
}

/// The six numbers of a pose: x, y, z, O, A, T.
pub(super) fn pose_numbers(fields: [NumberField; 6]) -> CartesianNumbers {
    let [x, y, z, o, a, t] = fields;
    CartesianNumbers {
        position: [x, y, z],
        orientation: [o, a, t].into(),
        convention: OrientationConvention::EulerZyz,
        units: Units::MM_DEG,
    }
}

/// Six written numbers, if there are six and no more.
pub(super) fn six(numbers: &[Number]) -> Option<[NumberField; 6]> {
    let written = numbers.iter().filter_map(|number| match number {
        Number::Written(field) => Some(field.clone()),
        _ => None,
    });
    let fields: Vec<NumberField> = written.collect();
    if fields.len() != numbers.len() {
        return None;
    }
    fields.try_into().ok()
}

/// The pose that `TRANS` makes of numbers, of which those behind the last are zero.
pub(super) fn trans(numbers: &[Number]) -> Option<Pose> {
    let mut six = [0.0; 6];
    for (place, number) in six.iter_mut().zip(numbers) {
        *place = number.value()?;
    }
    let fields = six.map(NumberField::unplaced);
    debug_assert_eq!(values(&fields), six);
    pose_numbers(fields).pose()
}

/// The turn about an axis, from 0.
pub(super) fn turn(axis: usize, degrees: f64) -> Pose {
    let angle = degrees.to_radians();
    Pose::from_rotation(match axis {
        0 => rotation_x(angle),
        1 => rotation_y(angle),
        _ => rotation_z(angle),
    })
}
