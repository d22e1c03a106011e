//! Positions: what an argument that stands where a position belongs refers to, and its numbers.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use crate::base::text::Span;
use crate::geometry::orientation::OrientationConvention;
use crate::program::number::NumberField;
use crate::program::shared::Shared;
use crate::program::target::{
    CartesianNumbers, Configuration, Declaration, DisplacementKind, ExternalAxis, JointNumbers, Mention, Target,
    TargetValue, Units,
};

use super::argument::{list, numbers, values};
use super::change::{Changes, element_at};
use super::configuration::{configuration, external_axes};
use super::statement::FileText;
use super::symbol::{Job, Lookup, Scope, Storage, Symbol};
use super::token::TokenKind;

/// The targets found so far.
pub struct Positions<'j, 'a> {
    /// The job.
    pub job: &'j Job<'a>,
    changes: &'j Changes,
    /// All targets, in the order in which moves mention them.
    pub targets: Vec<Target>,
    /// The targets of declared names, one an array element.
    by_symbol: HashMap<usize, Rc<[usize]>>,
    /// The target of an array element, by symbol and index as written (`{2}`).
    by_element: HashMap<(usize, String), usize>,
    /// Where moves name single positions: symbol, file and place.
    mentions: Vec<(usize, usize, Span)>,
    /// Elements of arrays that are named with their index: target and place of the name.
    element_mentions: Vec<(usize, Mention)>,
    /// Names that are declared in no file of the job.
    by_name: HashMap<(usize, String), usize>,
    /// How many more targets a variable index may stand for: keeps huge arrays from being listed for each move.
    budget: usize,
    /// First targets of the arrays for which the budget was too small.
    overrun: HashSet<usize>,
    configurations: Shared<Configuration>,
}

/// A million uses by variable index are more than any program has.
const MAX_INDEXED_USES: usize = 1_000_000;

const FUNCTIONS: &[&str] = &["crobt", "calcrobt", "cjointt", "calcjointt", "mirpos", "orobt", "offs", "reltool"];

/// True for the data types that hold a position.
pub fn is_position_type(data_type: &str) -> bool {
    matches!(data_type, "robtarget" | "jointtarget")
}

impl<'j, 'a> Positions<'j, 'a> {
    /// Nothing found yet.
    pub fn new(job: &'j Job<'a>, changes: &'j Changes) -> Self {
        Self {
            job,
            changes,
            targets: Vec::new(),
            by_symbol: HashMap::new(),
            by_element: HashMap::new(),
            mentions: Vec::new(),
            element_mentions: Vec::new(),
            by_name: HashMap::new(),
            budget: MAX_INDEXED_USES,
            overrun: HashSet::new(),
            configurations: Shared::default(),
        }
    }

    /// The targets of a declared name, if a move goes there.
    pub fn of_symbol(&self, symbol: usize) -> Option<&[usize]> {
        self.by_symbol.get(&symbol).map(AsRef::as_ref)
    }

    /// The declarations of single positions that moves name, by file and place of the value.
    pub fn declarations(&self) -> HashMap<(usize, Span), Declaration> {
        let mut found: HashMap<(usize, Span), Declaration> = HashMap::new();
        for &(symbol, file, place) in &self.mentions {
            let targets = self.of_symbol(symbol).unwrap_or_default();
            let Some(target) = targets.first().map(|&target| &self.targets[target]) else { continue };
            let Some(declared) = self.declaration(&self.job.symbols[symbol]) else { continue };
            let entry = found.entry((target.file, target.span)).or_insert(declared);
            entry.mentions.push((file, place));
        }
        found
    }

    /// Where moves name an element of an array, by file and place of its value: a value may stand there as well.
    pub fn element_mentions(&self) -> Vec<((usize, Span), Mention)> {
        let place = |target: usize| (self.targets[target].file, self.targets[target].span);
        self.element_mentions.iter().map(|(target, mention)| (place(*target), *mention)).collect()
    }

    fn declaration(&self, symbol: &Symbol) -> Option<Declaration> {
        let text = &self.job.files[symbol.scope.file];
        let key = symbol.display.to_lowercase();
        let name = symbol.tokens.clone().find(|&at| text.kind(at) == Some(TokenKind::Name) && text.key(at) == key)?;
        // The semicolon is the token behind the statement's own.
        let end = text.is_symbol(symbol.tokens.end, b';').then(|| text.tokens[symbol.tokens.end].span().end)?;
        let statement = Span::new(text.span(&symbol.tokens).start, end);
        Some(Declaration { statement, name: text.tokens[name].span(), mentions: Vec::new() })
    }

    /// True for an argument that can only be a position.
    pub fn is_position(&self, text: &FileText, range: &Range<usize>, scope: Scope) -> bool {
        if text.kind(range.start) == Some(TokenKind::Position) {
            return range.len() == 1;
        }
        if text.is_symbol(range.start, b'[') {
            let parts = list(text, range).unwrap_or_default();
            let nested = parts.iter().all(|part| text.is_symbol(part.start, b'['));
            let counts: Vec<_> = parts.iter().map(|part| list(text, part).map_or(0, |inner| inner.len())).collect();
            return nested && (counts == [3, 4, 4, 6] || counts == [6, 6] || counts == [6]);
        }
        if text.kind(range.start) != Some(TokenKind::Name) {
            return false;
        }
        let key = text.key(range.start);
        if text.is_symbol(range.start + 1, b'(') {
            let returns =
                self.job.routine(&key, scope).and_then(|routine| self.job.routines[routine].returns.as_deref());
            return returns.is_some_and(is_position_type) || FUNCTIONS.contains(&key.as_str());
        }
        let symbol = self.job.known_symbol(&key, scope);
        let whole = !(range.clone().any(|at| text.is_symbol(at, b'.')));
        whole && symbol.is_some_and(|symbol| is_position_type(&symbol.data_type))
    }

    /// The targets that an argument stands for: one, or all elements of an array with a variable index.
    pub fn targets_of(&mut self, text: &FileText<'a>, range: &Range<usize>, scope: Scope) -> Vec<usize> {
        let key = text.key(range.start);
        match text.kind(range.start) {
            Some(TokenKind::Position | TokenKind::Symbol(b'[')) => {
                let (value, read) = self.literal(text, range);
                vec![self.push(text, range, scope, value, read)]
            }
            Some(TokenKind::Name) if text.is_symbol(range.start + 1, b'(') => match key.as_str() {
                "offs" => vec![self.displaced(text, range, scope, DisplacementKind::Frame)],
                "reltool" => vec![self.displaced(text, range, scope, DisplacementKind::Tool)],
                _ => {
                    let reason = format!("the function `{}` computes it", text.display(range.start));
                    vec![self.unwritten(text, range, scope, reason)]
                }
            },
            Some(TokenKind::Name) => match self.job.symbol(&key, scope) {
                Lookup::Found(symbol) => self.declared(text, range, scope, symbol),
                Lookup::Ambiguous => {
                    let reason = format!("several modules declare `{}`", text.display(range.start));
                    vec![self.unwritten(text, range, scope, reason)]
                }
                Lookup::Unknown => vec![self.undeclared(text, range, scope)],
            },
            _ => vec![self.unwritten(text, range, scope, "it is an expression".into())],
        }
    }

    fn declared(&mut self, text: &FileText<'a>, range: &Range<usize>, scope: Scope, index: usize) -> Vec<usize> {
        let symbol = &self.job.symbols[index];
        let indexed = text.is_symbol(range.start + 1, b'{');
        let end = if indexed { text.after_group(range.start + 1, range.end) } else { Some(range.start + 1) };
        if end != Some(range.end) {
            let reason = format!("`{}` is an expression", text.source.text(text.span(range)));
            return vec![self.unwritten(text, range, scope, reason)];
        }
        if !is_position_type(&symbol.data_type) && !is_parameter(symbol) {
            let reason = format!("`{}` is declared as `{}`", symbol.display, symbol.data_type);
            return vec![self.unwritten(text, range, scope, reason)];
        }
        let all = self.elements(index);
        if !indexed && symbol.dimensions == 0 {
            self.mentions.push((index, scope.file, text.span(range)));
        }
        if !indexed {
            return all.to_vec();
        }
        let Some(label) = element_at(text, range.start + 1, range.end) else {
            return self.any_of(&all);
        };
        match self.by_element.get(&(index, label)) {
            Some(&target) => {
                self.element_mentions.push((target, (scope.file, text.span(range))));
                vec![target]
            }
            // A parameter or an array without values has one target and no elements.
            None if all.len() == 1 => all.to_vec(),
            None => vec![self.no_element(text, range, scope)],
        }
    }

    /// All elements of an array, for a variable index.
    fn any_of(&mut self, all: &[usize]) -> Vec<usize> {
        if all.len() <= self.budget {
            self.budget -= all.len();
            return all.to_vec();
        }
        let first = all.first().copied();
        if first.is_some_and(|first| self.overrun.insert(first)) {
            for &target in all {
                let reason = "too many moves reach it through a variable index".to_owned();
                self.targets[target].computed.get_or_insert(reason);
            }
        }
        first.into_iter().collect()
    }

    fn no_element(&mut self, text: &FileText<'a>, range: &Range<usize>, scope: Scope) -> usize {
        let reason = format!("`{}` has no written value", text.source.text(text.span(range)));
        self.unwritten(text, range, scope, reason)
    }

    /// The targets of a declared name, made when it is first asked for.
    fn elements(&mut self, index: usize) -> Rc<[usize]> {
        if let Some(known) = self.by_symbol.get(&index) {
            return Rc::clone(known);
        }
        let job = self.job;
        let symbol = &job.symbols[index];
        let text = &job.files[symbol.scope.file];
        let elements = if is_parameter(symbol) { Vec::new() } else { job.elements(index) };
        let mut made = Vec::with_capacity(elements.len().max(1));
        for (label, range) in &elements {
            let (value, read) = self.literal(text, range);
            let target = self.push(text, range, symbol.scope, value, read);
            let changed = self.changes.reason(index, label).map(str::to_owned);
            let target_entry = &mut self.targets[target];
            target_entry.name = Some(format!("{}{label}", symbol.display));
            target_entry.computed = changed.or(target_entry.computed.take());
            self.by_element.insert((index, label.clone()), target);
            made.push(target);
        }
        if made.is_empty() {
            let reason = match self.changes.reason(index, "") {
                _ if is_parameter(symbol) => format!("`{}` is a parameter of the routine", symbol.display),
                Some(reason) => reason.to_owned(),
                None => format!("`{}` is declared without a value", symbol.display),
            };
            let target = self.unwritten(text, &symbol.tokens, symbol.scope, reason);
            self.targets[target].name = Some(symbol.display.clone());
            made.push(target);
        }
        let made: Rc<[usize]> = made.into();
        self.by_symbol.insert(index, Rc::clone(&made));
        made
    }

    fn undeclared(&mut self, text: &FileText<'a>, range: &Range<usize>, scope: Scope) -> usize {
        let written = text.source.text(text.span(range)).into_owned();
        let key = (scope.file, written.to_lowercase());
        if let Some(&known) = self.by_name.get(&key) {
            return known;
        }
        let reason = format!("`{written}` is not declared in this text");
        let target = self.unwritten(text, range, scope, reason);
        self.targets[target].name = Some(written);
        self.by_name.insert(key, target);
        target
    }

    /// A target whose numbers are not in the text.
    pub fn unwritten(&mut self, text: &FileText<'a>, range: &Range<usize>, scope: Scope, reason: String) -> usize {
        let place = text.line(range.start);
        let reason = if reason.contains("line ") { reason } else { format!("{reason} (line {place})") };
        self.push(text, range, scope, TargetValue::Unwritten, Err(reason))
    }

    /// Adds a target.
    pub fn push(
        &mut self,
        text: &FileText<'a>,
        range: &Range<usize>,
        scope: Scope,
        value: TargetValue,
        read: Result<Extras, String>,
    ) -> usize {
        let (extras, computed) = match read {
            Ok(extras) => (extras, None),
            Err(reason) => (Extras::none(), Some(reason)),
        };
        self.targets.push(Target {
            file: scope.file,
            name: None,
            span: text.span(range),
            value,
            computed,
            configuration: extras.configuration,
            external_axes: extras.external_axes,
            rides_along: false,
            uses: Vec::new(),
        });
        self.targets.len() - 1
    }

    /// A `robtarget` or `jointtarget` written in numbers.
    fn literal(&mut self, text: &FileText<'a>, range: &Range<usize>) -> (TargetValue, Result<Extras, String>) {
        if let Some(inside) = text.position(range.start).filter(|_| range.len() == 1) {
            return self.literal(&inside, &(0..inside.tokens.len()));
        }
        let parts = list(text, range).unwrap_or_default();
        let value = match parts.as_slice() {
            [place, turn, ..] if parts.len() == 4 => cartesian(text, place, turn),
            // Some writers of MoveAbsJ leave the list of additional axes out.
            [joints] | [joints, _] => numbers::<6>(text, joints)
                .map(|joints| TargetValue::Joint(Box::new(JointNumbers { joints, units: Units::MM_DEG }))),
            _ => None,
        };
        let Some(value) = value else {
            let reason = format!("its value is not written in numbers (line {})", text.line(range.start));
            return (TargetValue::Unwritten, Err(reason));
        };
        let extras = Extras {
            configuration: match parts.as_slice() {
                [_, _, data, _] => {
                    self.configurations.share(values::<4>(text, data).map(configuration).unwrap_or_default())
                }
                _ => Configuration::unsaid(),
            },
            external_axes: parts
                .get(1..)
                .and_then(<[_]>::last)
                .and_then(|axes| values::<6>(text, axes))
                .map(external_axes)
                .unwrap_or_default(),
        };
        (value, Ok(extras))
    }
}

/// What a target says besides its place.
pub struct Extras {
    /// Configuration data.
    pub configuration: Arc<Configuration>,
    /// Additional axes.
    pub external_axes: Vec<ExternalAxis>,
}

impl Extras {
    fn none() -> Self {
        Self { configuration: Configuration::unsaid(), external_axes: Vec::new() }
    }
}

fn is_parameter(symbol: &Symbol) -> bool {
    matches!(symbol.storage, Storage::Parameter | Storage::Reference)
}

fn cartesian(text: &FileText, place: &Range<usize>, turn: &Range<usize>) -> Option<TargetValue> {
    let orientation: [NumberField; 4] = numbers(text, turn)?;
    Some(TargetValue::Cartesian(Box::new(CartesianNumbers {
        position: numbers(text, place)?,
        orientation: orientation.into(),
        convention: OrientationConvention::QuaternionWxyz,
        units: Units::MM_DEG,
    })))
}
