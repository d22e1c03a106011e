//! Additional axes: where a track has carried the robot, and a turntable the frame, when a target is reached.
//!
//! Frames of programs and cell files are those of a cell whose axes stand at their zero, seen from the robot base there.
//! With the robot's displacement `B` and the frame's `F`, both products of the displacements of their axes in the order
//! of the cell file (the first carries the second), the frame stands at `B^-1 F base_T_frame` in the base. The axes
//! themselves count as exact, and a rotary axis under the robot as vertical: gravity keeps its direction in the base.

use std::collections::BTreeSet;

use crate::files::axes::{CellAxis, Moves};
use crate::geometry::pose::Pose;
use crate::program::target::{Program, Target};

use super::setting::Obstacle;

/// The axes of a cell as one program uses them.
pub struct Carriers<'a> {
    axes: &'a [CellAxis],
    /// Axes that some target of the program gives a value, lower case.
    used: BTreeSet<String>,
}

impl<'a> Carriers<'a> {
    /// The axes of a cell for one program.
    pub fn new(axes: &'a [CellAxis], program: &Program) -> Self {
        let all = program.targets.iter().flat_map(|target| &target.external_axes);
        let mut used = BTreeSet::new();
        for axis in all {
            if !used.contains(axis.name.as_str()) {
                used.insert(axis.name.to_lowercase());
            }
        }
        Self { axes, used }
    }

    /// True when neither the cell nor the program knows of any additional axis.
    pub fn is_empty(&self) -> bool {
        self.axes.is_empty() && self.used.is_empty()
    }

    /// `B^-1 F` at a target; `None` where nothing moves. `frames` are the names of the frame in force, lower case.
    ///
    /// # Errors
    /// [`Obstacle`] when an axis stands elsewhere than at zero and the cell file does not say what that moves, or when
    /// the target does not say where such an axis stands.
    pub fn displacement(&self, target: &Target, frames: &[String]) -> Result<Option<Pose>, Obstacle> {
        let unknown = target.external_axes.iter().find(|axis| axis.value != 0.0 && self.axis(&axis.name).is_none());
        if let Some(axis) = unknown {
            let (name, value) = (&axis.name, axis.value);
            return Err(Obstacle::refused(format!(
                "the target has {name} at {value}, and no cell file (--cell) says what that axis moves; write there \
                 `axes: [{{name: {name}, kind: linear, moves: base, direction: [1, 0, 0]}}]` for a track, `kind: rotary, \
                 moves: FRAME, point_mm: [..], direction: [..]` for a turntable, `moves: nothing` for a gun"
            )));
        }
        let product = |matters: &dyn Fn(&Moves) -> bool| -> Result<Option<Pose>, Obstacle> {
            let mut all: Option<Pose> = None;
            for axis in self.axes.iter().filter(|axis| matters(&axis.moves)) {
                let Some(value) = self.value(target, axis)? else { continue };
                all = Some(all.unwrap_or_else(Pose::identity) * axis.displacement(value));
            }
            Ok(all)
        };
        let base = match target.rides_along {
            true => None,
            false => product(&|moves| *moves == Moves::Base)?,
        };
        let frame =
            product(&|moves| matches!(moves, Moves::Frames(all) if all.iter().any(|name| frames.contains(name))))?;
        Ok(match (base, frame) {
            (None, frame) => frame,
            (Some(base), None) => Some(base.inverse()),
            (Some(base), Some(frame)) => Some(base.inverse() * frame),
        })
    }

    fn axis(&self, name: &str) -> Option<&CellAxis> {
        self.axes.iter().find(|axis| axis.name.eq_ignore_ascii_case(name))
    }

    /// Where an axis stands at a target; `None` for one that no target of the program names, which stays at its zero.
    fn value(&self, target: &Target, axis: &CellAxis) -> Result<Option<f64>, Obstacle> {
        let own = target.external_axes.iter().find(|own| own.name.eq_ignore_ascii_case(&axis.name));
        match own {
            Some(own) => Ok(Some(own.value)),
            None if !self.used.contains(&axis.name) => Ok(None),
            None => {
                let message = format!("the target does not say where axis {} stands, and others do", axis.name);
                Err(Obstacle::refused(message))
            }
        }
    }
}
