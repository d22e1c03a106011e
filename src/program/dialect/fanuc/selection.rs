//! Which frame and tool number is selected where: `UFRAME_NUM=1`, `UTOOL_NUM=R[2]`.
//!
//! The order of the text is the order of the program between two joins: labels, ends of branches, calls.

/// A selection.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Selected {
    /// This number.
    Number(u32),
    /// By a register or an expression; the text says which and in which line.
    Runtime(String),
}

/// What is known about the selection at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum InForce<'a> {
    /// It can only be this one.
    Known(&'a Selected),
    /// Nothing is selected in this program, or different ways here select differently.
    Open,
}

/// The selections of one kind in one program, in the order of the text.
#[derive(Clone, Debug, Default)]
pub(super) struct Selections {
    made: Vec<(usize, Selected)>,
    differ: bool,
    runtime: Option<usize>,
}

impl Selections {
    /// Notes a selection at a byte offset.
    pub fn push(&mut self, offset: usize, selected: Selected) {
        self.differ |= self.made.first().is_some_and(|(_, first)| *first != selected);
        if matches!(selected, Selected::Runtime(_)) {
            self.runtime.get_or_insert(self.made.len());
        }
        self.made.push((offset, selected));
    }

    /// What is in force at `offset`. `joins` are the offsets, in order, at which other ways may come in.
    pub fn at(&self, offset: usize, joins: &[usize]) -> InForce<'_> {
        let before = self.made.partition_point(|&(at, _)| at < offset);
        let latest = before.checked_sub(1).map(|index| &self.made[index]);
        let last_join = joins.partition_point(|&at| at < offset).checked_sub(1).map(|index| joins[index]);
        let joined_since = last_join.is_some_and(|join| latest.is_none_or(|(at, _)| *at < join));
        match latest {
            Some((_, selected)) if !joined_since || !self.differ => InForce::Known(selected),
            _ => match self.runtime {
                // One of the ways may come from behind a selection by register.
                Some(index) if joined_since => InForce::Known(&self.made[index].1),
                _ => InForce::Open,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_join_forgets_unless_all_agree() {
        let mut selections = Selections::default();
        selections.push(10, Selected::Number(1));
        assert_eq!(selections.at(5, &[]), InForce::Open);
        assert_eq!(selections.at(30, &[20]), InForce::Known(&Selected::Number(1)));
        selections.push(40, Selected::Number(2));
        assert_eq!(selections.at(15, &[]), InForce::Known(&Selected::Number(1)));
        assert_eq!(selections.at(30, &[20]), InForce::Open);
        assert_eq!(selections.at(50, &[20]), InForce::Known(&Selected::Number(2)));
        selections.push(60, Selected::Runtime("R[1]".into()));
        assert_eq!(selections.at(30, &[20]), InForce::Known(&Selected::Runtime("R[1]".into())));
        assert_eq!(selections.at(15, &[]), InForce::Known(&Selected::Number(1)));
    }
}
