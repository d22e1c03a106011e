//! The arrivals of a program by target.

use crate::model::robot::DOF;

use super::visits::{Senses, Visit};

/// All arrivals, in the order of the program, and those at each target.
pub struct Arrivals {
    /// In the order of the program.
    pub visits: Vec<Visit>,
    /// How the joints come to each visit, where the model asks for it.
    pub senses: Option<Vec<Senses>>,
    /// Visits by target; those of a target in the order of the program.
    order: Vec<u32>,
    /// Where the visits of each target begin in `order`.
    starts: Vec<u32>,
}

impl Arrivals {
    /// The visits of a program with so many targets.
    pub fn new(visits: Vec<Visit>, targets: usize) -> Self {
        let mut order: Vec<u32> = (0..visits.len() as u32).collect();
        order.sort_by_key(|&visit| visits[visit as usize].target());
        let mut starts = vec![0; targets + 1];
        visits.iter().for_each(|visit| starts[visit.target() + 1] += 1);
        for target in 0..targets {
            starts[target + 1] += starts[target];
        }
        Self { visits, senses: None, order, starts }
    }

    /// The arrivals at a target.
    pub fn at(&self, target: usize) -> impl Iterator<Item = &Visit> {
        self.indices(target).map(|visit| &self.visits[visit])
    }

    /// The sense of each joint at the arrivals at a target; none where they do not matter.
    pub fn senses_at(&self, target: usize) -> impl Iterator<Item = &Senses> {
        let senses = self.senses.as_deref();
        self.indices(target).filter_map(move |visit| senses?.get(visit))
    }

    /// The sense that all arrivals at a target share; zero for a joint that arrives from both sides.
    pub fn common_approach(&self, target: usize) -> [f64; DOF] {
        std::array::from_fn(|joint| {
            let mut senses = self.senses_at(target).map(|senses| senses[joint]);
            let first = senses.next().unwrap_or_default();
            if senses.all(|sense| sense == first) { f64::from(first) } else { 0.0 }
        })
    }

    /// What to know of a target that is reached from both sides: play cannot be corrected in one value.
    pub fn both_sides(&self, target: usize) -> Option<String> {
        let first = self.senses_at(target).next()?;
        let both = |joint: &usize| self.senses_at(target).any(|senses| senses[*joint] != first[*joint]);
        let joints: Vec<String> = (0..DOF).filter(both).map(|joint| (joint + 1).to_string()).collect();
        let message = "is reached from both sides of the play; the middle is taken";
        (!joints.is_empty()).then(|| format!("joint {} {message}", joints.join(", ")))
    }

    fn indices(&self, target: usize) -> impl Iterator<Item = usize> {
        let (from, to) = (self.starts[target] as usize, self.starts[target + 1] as usize);
        self.order[from..to].iter().map(|&visit| visit as usize)
    }
}
