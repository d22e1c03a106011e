//! Targets in the making: a reader adds moves one by one, in any order, and gets the targets in the order of the text.

use std::collections::HashMap;

use crate::base::text::Span;

use super::shared::Shared;
use super::target::{Configuration, Program, Target, TargetValue, Use, Way};

/// Longest name that is shown of an expression.
const LONGEST_NAME: usize = 60;

/// The targets of a job so far.
#[derive(Debug, Default)]
pub struct Gathered {
    made: Vec<Target>,
    by_key: HashMap<usize, usize>,
    by_text: HashMap<(usize, String), usize>,
    ways: Shared<Way>,
}

impl Gathered {
    /// Adds a move to a position that the job holds once, under a number of the reader's own. The target is made when the
    /// first move goes there.
    pub fn add_use(&mut self, key: usize, one: Use, make: impl FnOnce() -> Target) -> &mut Target {
        let made = &mut self.made;
        let slot = *self.by_key.entry(key).or_insert_with(|| {
            made.push(make());
            made.len() - 1
        });
        self.made[slot].add_use(one.sharing(&mut self.ways));
        &mut self.made[slot]
    }

    /// True when a move goes to the position with this number.
    pub fn has(&self, key: usize) -> bool {
        self.by_key.contains_key(&key)
    }

    /// Adds a target that stands in its move.
    pub fn inline(&mut self, target: Target) -> &mut Target {
        self.made.push(target);
        let last = self.made.len() - 1;
        &mut self.made[last]
    }

    /// Adds a move to something that the text does not hold, with the reason. The same text in one file is one target.
    pub fn unwritten(&mut self, text: &str, span: Span, reason: String, one: Use) {
        let name: String = text.chars().take(LONGEST_NAME).collect();
        let slot = *self.by_text.entry((one.file, name.clone())).or_insert_with(|| {
            let value = TargetValue::Unwritten;
            self.made.push(Target { name: Some(name), computed: Some(reason), ..plain(one.file, span, value) });
            self.made.len() - 1
        });
        self.made[slot].add_use(one.sharing(&mut self.ways));
    }

    /// Gives the targets to the program, in the order of the text. A displaced target names its base by the base's key
    /// until here; one whose base no move goes to becomes unwritten.
    pub fn finish(mut self, program: &mut Program) {
        let mut order: Vec<usize> = (0..self.made.len()).collect();
        order.sort_by_key(|&slot| (self.made[slot].file, self.made[slot].span));
        let mut place = vec![0; order.len()];
        for (index, &slot) in order.iter().enumerate() {
            place[slot] = index;
        }
        for target in &mut self.made {
            let TargetValue::Displaced(displacement) = &mut target.value else { continue };
            match self.by_key.get(&displacement.base) {
                Some(&slot) => displacement.base = place[slot],
                None => {
                    target.value = TargetValue::Unwritten;
                    target.computed = Some("displaced from a position that no move goes to".into());
                }
            }
        }
        program.targets = in_order(self.made, &order);
    }
}

/// The targets with these indices, in this order.
pub fn in_order(targets: Vec<Target>, order: &[usize]) -> Vec<Target> {
    // Most large programs are in order already, and have no room for another copy.
    if order.len() == targets.len() && order.is_sorted() {
        return targets;
    }
    let mut targets: Vec<Option<Target>> = targets.into_iter().map(Some).collect();
    order.iter().filter_map(|&index| targets.get_mut(index)?.take()).collect()
}

/// A target of a file with nothing but its numbers.
pub fn plain(file: usize, span: Span, value: TargetValue) -> Target {
    Target {
        file,
        name: None,
        span,
        value,
        computed: None,
        configuration: Configuration::unsaid(),
        external_axes: Vec::new(),
        rides_along: false,
        uses: Vec::new(),
    }
}
