//! What a learner may look at, and what it may turn: everything, or what was located before.

use crate::model::curves::Variable;
use crate::model::network::Feature;
use crate::model::robot::{DOF, LOOP_AROUND, LOOP_DRIVEN};

use super::term::Term;

/// See the module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Every actuator by all that a model file knows of a pose.
    Everything,
    /// These actuators by these features.
    Located {
        /// The actuators, from zero.
        turns: Vec<usize>,
        /// What turns them.
        features: Vec<Feature>,
    },
}

impl Subject {
    /// The inputs of a network. Of everything: sines and cosines of every actuator and of the forearm's inclination (of the
    /// fold, where there is a parallelogram: its forearm's inclination is the actuator's own), load torques, senses of approach.
    pub fn features(&self, has_loop: bool) -> Vec<Feature> {
        if let Subject::Located { features, .. } = self {
            return features.clone();
        }
        let joints = 1..=DOF;
        let mut all: Vec<Feature> = joints.clone().flat_map(|at| [Feature::Sine(at), Feature::Cosine(at)]).collect();
        let (driven, around) = (LOOP_DRIVEN + 1, LOOP_AROUND + 1);
        all.extend(match has_loop {
            true => [Feature::SineOfDifference(driven, around), Feature::CosineOfDifference(driven, around)],
            false => [Feature::SineOfSum(around, driven), Feature::CosineOfSum(around, driven)],
        });
        all.extend(joints.clone().map(Feature::Torque));
        all.extend(joints.map(Feature::Approach));
        all
    }

    /// True where it may turn this actuator (from zero).
    pub fn turns(&self, actuator: usize) -> bool {
        match self {
            Subject::Everything => true,
            Subject::Located { turns, .. } => turns.contains(&actuator),
        }
    }

    /// True where a term turns what it may by what it may.
    pub fn admits(&self, term: &Term) -> bool {
        let Subject::Located { features, .. } = self else { return true };
        let sees = |feature: Feature| features.contains(&feature);
        let along = match term.along {
            Variable::Angle(joint) => sees(Feature::Sine(joint)),
            Variable::Sum(one, other) => sees(Feature::Sine(one)) && sees(Feature::Sine(other)),
            Variable::Torque(joint) => sees(Feature::Torque(joint)),
        };
        self.turns(term.turns) && along && term.sense_of.is_none_or(|joint| sees(Feature::Approach(joint + 1)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::term::Waves;

    fn term(turns: usize, along: Variable, sense_of: Option<usize>) -> Term {
        let waves = Waves::Interval;
        Term { turns, along, sense_of, waves, start: 0.0, length: 1.0, columns: 2, bands: vec![0] }
    }

    #[test]
    fn a_located_subject_admits_what_turns_its_joints_by_its_variables() {
        let located = Subject::Located { turns: vec![4], features: vec![Feature::Sine(2), Feature::Approach(5)] };
        let cases = [
            (term(4, Variable::Angle(2), None), true),
            (term(4, Variable::Angle(2), Some(4)), true),
            (term(4, Variable::Angle(2), Some(3)), false),
            (term(4, Variable::Angle(5), None), false),
            (term(4, Variable::Sum(2, 3), None), false),
            (term(4, Variable::Torque(5), None), false),
            (term(3, Variable::Angle(2), None), false),
        ];
        for (term, admitted) in cases {
            assert_eq!(located.admits(&term), admitted, "{term:?}");
            assert!(Subject::Everything.admits(&term));
        }
    }
}
