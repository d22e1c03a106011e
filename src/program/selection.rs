//! Which tool, frame or load is selected where, in languages that select by statements.
//!
//! The order of the text is the order of the program between two joins: labels, ends of branches, starts of functions,
//! calls. Nothing is followed across a join: what holds behind one is known only where all selections agree.

use std::ops::Range;

use super::target::Reference;

/// What is known about the selection at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InForce<'a> {
    /// No statement before this place selects anything.
    Nothing,
    /// It can only be this one; also a selection at run time that may reach here.
    Known(&'a Reference),
    /// Different ways here select differently.
    Open,
}

/// The selections of one kind, in the order of the text.
#[derive(Clone, Debug, Default)]
pub struct Selections {
    made: Vec<(usize, Reference)>,
    differ: bool,
    runtime: Option<usize>,
}

impl Selections {
    /// Notes a selection at a byte offset, which is not less than that of the one before.
    pub fn push(&mut self, offset: usize, selected: Reference) {
        self.differ |= self.made.first().is_some_and(|(_, first)| *first != selected);
        if matches!(selected, Reference::Runtime(_)) {
            self.runtime.get_or_insert(self.made.len());
        }
        self.made.push((offset, selected));
    }

    /// What is in force at `offset`. `joins` are the offsets, in order, at which other ways may come in.
    pub fn at(&self, offset: usize, joins: &[usize]) -> InForce<'_> {
        let Some((_, first)) = self.made.first() else { return InForce::Nothing };
        let before = self.made.partition_point(|&(at, _)| at < offset);
        let latest = before.checked_sub(1).map(|index| &self.made[index]);
        let last_join = joins.partition_point(|&at| at < offset).checked_sub(1).map(|index| joins[index]);
        let joined_since = last_join.is_some_and(|join| latest.is_none_or(|(at, _)| *at < join));
        match (latest, joined_since) {
            (Some((_, selected)), false) => InForce::Known(selected),
            (None, false) => InForce::Nothing,
            (_, true) if !self.differ => InForce::Known(first),
            // One of the ways may come from behind a selection at run time.
            (_, true) => self.runtime.map_or(InForce::Open, |index| InForce::Known(&self.made[index].1)),
        }
    }
}

/// Where other ways may come in, and from which stretch of the text they come: a block that selects nothing leaves what
/// was selected before it.
#[derive(Clone, Debug, Default)]
pub struct Joins {
    made: Vec<(usize, Range<usize>)>,
    open: Vec<(usize, Block)>,
}

/// What a block of statements is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// Passed over or not: `if`.
    Branch,
    /// Run again and again.
    Loop,
    /// Called from somewhere.
    Routine,
}

impl Joins {
    /// A way may come from anywhere: a label, the place behind a call.
    pub fn anywhere(&mut self, at: usize) {
        self.made.push((at, 0..usize::MAX));
    }

    /// A block begins.
    pub fn open(&mut self, at: usize, block: Block) {
        self.open.push((at, block));
    }

    /// Another branch of the same block begins: `else`.
    pub fn divide(&mut self, at: usize) {
        let start = self.open.last().map_or(0, |(start, _)| *start);
        self.made.push((at, start..at));
    }

    /// The innermost block ends.
    pub fn close(&mut self, at: usize) {
        match self.open.pop() {
            Some((start, Block::Branch)) => self.made.push((at, start..at)),
            Some((start, Block::Loop)) => self.made.extend([(start, start..at), (at, start..at)]),
            Some((_, Block::Routine)) | None => self.anywhere(at),
        }
    }

    /// The places at which a way may come in that selects otherwise, in order.
    pub fn that_matter(&self, selections: &Selections) -> Vec<usize> {
        let selects = |stretch: &Range<usize>| {
            let from = selections.made.partition_point(|(at, _)| *at < stretch.start);
            selections.made.get(from).is_some_and(|(at, _)| *at < stretch.end)
        };
        let mut all: Vec<usize> = self.made.iter().filter(|(_, from)| selects(from)).map(|(at, _)| *at).collect();
        all.sort_unstable();
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_join_forgets_unless_all_agree() {
        let named = |name: &str| Reference::Named(name.into());
        let runtime = Reference::Runtime("R[1]".into());
        let mut selections = Selections::default();
        assert_eq!(selections.at(5, &[]), InForce::Nothing);
        selections.push(10, named("1"));
        assert_eq!(selections.at(5, &[]), InForce::Nothing);
        assert_eq!(selections.at(5, &[2]), InForce::Known(&named("1")));
        assert_eq!(selections.at(30, &[20]), InForce::Known(&named("1")));
        selections.push(40, named("2"));
        assert_eq!(selections.at(15, &[]), InForce::Known(&named("1")));
        assert_eq!(selections.at(30, &[20]), InForce::Open);
        assert_eq!(selections.at(50, &[20]), InForce::Known(&named("2")));
        selections.push(60, runtime.clone());
        assert_eq!(selections.at(30, &[20]), InForce::Known(&runtime));
        assert_eq!(selections.at(15, &[]), InForce::Known(&named("1")));
    }

    #[test]
    fn blocks_that_select_nothing_join_nothing() {
        let mut selections = Selections::default();
        selections.push(10, Reference::Named("1".into()));
        selections.push(45, Reference::Named("2".into()));
        let mut joins = Joins::default();
        joins.open(20, Block::Branch);
        joins.divide(25);
        joins.close(30);
        joins.open(40, Block::Loop);
        joins.open(42, Block::Branch);
        joins.close(50);
        joins.close(60);
        assert_eq!(joins.that_matter(&selections), [40, 50, 60]);
        joins.anywhere(70);
        joins.close(80);
        assert_eq!(joins.that_matter(&selections), [40, 50, 60, 70, 80]);
        assert!(joins.that_matter(&Selections::default()).is_empty());
    }
}
