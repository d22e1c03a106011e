//! What stands in a program a million times over is kept once: the tool and frame of its moves, the configuration of its
//! targets.

use std::borrow::Borrow;
use std::sync::Arc;

/// Different values that take turns in a program, such as the two points of an arc: these many are looked through.
const TURNS: usize = 4;

/// The values met last.
#[derive(Debug)]
pub struct Shared<T> {
    recent: Vec<Arc<T>>,
}

impl<T> Default for Shared<T> {
    fn default() -> Self {
        Self { recent: Vec::new() }
    }
}

impl<T: PartialEq> Shared<T> {
    /// The value, in one place with its equals among those met last.
    pub fn share(&mut self, value: impl Borrow<T> + Into<Arc<T>>) -> Arc<T> {
        if let Some(known) = self.recent.iter().rev().find(|known| ***known == *value.borrow()) {
            return Arc::clone(known);
        }
        if self.recent.len() == TURNS {
            self.recent.remove(0);
        }
        let value = value.into();
        self.recent.push(Arc::clone(&value));
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_that_take_turns_are_one() {
        let mut shared = Shared::<String>::default();
        let first = shared.share("a".to_string());
        for other in ["b", "c", "d"] {
            shared.share(other.to_string());
        }
        assert!(Arc::ptr_eq(&first, &shared.share("a".to_string())));
        shared.share("e".to_string());
        assert!(!Arc::ptr_eq(&first, &shared.share("a".to_string())));
    }
}
