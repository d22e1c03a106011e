//! What a search remembers of its way.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// The chance of a search, and where it has been.
#[derive(Clone, Debug)]
pub struct Walk {
    /// For tests by shuffling.
    pub random: ChaCha8Rng,
    /// Causes, by name, beyond which the records have been asked for more: what came of it is known.
    visited: Vec<Vec<String>>,
}

impl Walk {
    /// A search that begins.
    pub fn new(seed: u64) -> Self {
        Self { random: ChaCha8Rng::seed_from_u64(seed), visited: Vec::new() }
    }

    /// True where these causes stood together before.
    pub fn has_been_at(&self, names: &[String]) -> bool {
        self.visited.iter().any(|known| known == names)
    }

    /// Remembers these causes.
    pub fn remember(&mut self, names: Vec<String>) {
        if !self.has_been_at(&names) {
            self.visited.push(names);
        }
    }
}
