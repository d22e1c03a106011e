//! What effects do to the arm.

use nalgebra::Vector3;

use crate::geometry::real::Real;
use crate::model::parameters::Displacement;
use crate::model::robot::DOF;

use super::location::MovingFrame;

/// What effects do to the arm: the sum over all of them.
#[derive(Clone, Copy, Debug)]
pub struct Response<T: Real> {
    /// Extra turn of each actuator, rad, in the controller's sense.
    pub actuators_rad: [T; DOF],
    /// Extra tilt of each joint axis, rad: a rotation vector in the frame in which the joint turns about z.
    pub tilt: [Vector3<T>; DOF],
    /// Displacement of each link's far end, in the frame after its row.
    pub links: [Displacement<T>; DOF],
    /// Displacement of the base, in the robot base.
    pub base: Displacement<T>,
    /// Displacement of the measured point, in the tool frame.
    pub tool: Displacement<T>,
    /// True when any `tilt` was added.
    pub axes_tilt: bool,
    /// True when any `links` was added.
    pub links_move: bool,
    /// True when `base` was added.
    pub base_moves: bool,
}

impl Response<f64> {
    /// The same over another scalar, without derivatives.
    pub fn constant<T: Real>(&self) -> Response<T> {
        Response {
            actuators_rad: self.actuators_rad.map(T::constant),
            tilt: self.tilt.map(|vector| vector.map(T::constant)),
            links: self.links.map(|link| link.map(T::constant)),
            base: self.base.map(T::constant),
            tool: self.tool.map(T::constant),
            axes_tilt: self.axes_tilt,
            links_move: self.links_move,
            base_moves: self.base_moves,
        }
    }
}

impl<T: Real> Response<T> {
    /// Nothing moves.
    pub fn none() -> Self {
        let zero = T::zero();
        Self {
            actuators_rad: [zero; DOF],
            tilt: [Vector3::zeros(); DOF],
            links: [[zero; 6]; DOF],
            base: [zero; 6],
            tool: [zero; 6],
            axes_tilt: false,
            links_move: false,
            base_moves: false,
        }
    }

    /// Every number of it.
    pub fn numbers(&self) -> impl Iterator<Item = &T> {
        let tilt = self.tilt.iter().flat_map(|vector| vector.iter());
        self.actuators_rad.iter().chain(tilt).chain(self.links.iter().flatten()).chain(&self.base).chain(&self.tool)
    }

    /// The largest difference between two responses, rad or m; infinite where one is no number.
    pub fn largest_change(&self, last: &Self) -> f64 {
        let turns = differences(&self.actuators_rad, &last.actuators_rad);
        turns.fold(self.largest_change_of_shape(last), larger)
    }

    /// [`Response::largest_change`] of all but the actuators: of what bends and shifts the chain itself.
    pub fn largest_change_of_shape(&self, last: &Self) -> f64 {
        let mut largest = 0.0;
        if self.links_move || last.links_move {
            for (link, before) in self.links.iter().zip(&last.links) {
                largest = differences(link, before).fold(largest, larger);
            }
        }
        if self.axes_tilt || last.axes_tilt {
            for (axis, before) in self.tilt.iter().zip(&last.tilt) {
                largest = differences(axis.as_slice(), before.as_slice()).fold(largest, larger);
            }
        }
        if self.base_moves || last.base_moves {
            largest = differences(&self.base, &last.base).fold(largest, larger);
        }
        largest
    }

    /// Turns an actuator further.
    pub fn turn(&mut self, joint: usize, angle_rad: T) {
        self.actuators_rad[joint] += angle_rad;
    }

    /// Tilts a joint axis.
    pub fn tilt_axis(&mut self, joint: usize, vector_rad: Vector3<T>) {
        self.tilt[joint] += vector_rad;
        self.axes_tilt = true;
    }

    /// Displaces the far end of a link.
    pub fn move_link(&mut self, link: usize, shift_m: Vector3<T>, turn_rad: Vector3<T>) {
        add(&mut self.links[link], shift_m, turn_rad);
        self.links_move = true;
    }

    /// Displaces the base.
    pub fn move_base(&mut self, shift_m: Vector3<T>, turn_rad: Vector3<T>) {
        add(&mut self.base, shift_m, turn_rad);
        self.base_moves = true;
    }

    /// Displaces a frame that can move during a recording.
    pub fn move_frame(&mut self, frame: MovingFrame, displacement: &Displacement<T>) {
        let [x, y, z, rx, ry, rz] = *displacement;
        let (shift_m, turn_rad) = (Vector3::new(x, y, z), Vector3::new(rx, ry, rz));
        match frame {
            MovingFrame::Base => self.move_base(shift_m, turn_rad),
            MovingFrame::Tool => self.move_tool(shift_m, turn_rad),
        }
    }

    /// Displaces the measured point against the flange.
    pub fn move_tool(&mut self, shift_m: Vector3<T>, turn_rad: Vector3<T>) {
        add(&mut self.tool, shift_m, turn_rad);
    }
}

fn differences<'a, T: Real>(next: &'a [T], last: &'a [T]) -> impl Iterator<Item = f64> + 'a {
    next.iter().zip(last).map(|(a, b)| (a.value() - b.value()).abs())
}

/// The larger of the two, where `max` would take no number for no change.
fn larger(largest: f64, difference: f64) -> f64 {
    if difference.is_nan() { f64::INFINITY } else { largest.max(difference) }
}

fn add<T: Real>(to: &mut Displacement<T>, shift_m: Vector3<T>, turn_rad: Vector3<T>) {
    for (component, addend) in to.iter_mut().zip(shift_m.iter().chain(turn_rad.iter())) {
        *component += *addend;
    }
}
