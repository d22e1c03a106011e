//! Nominal forward and inverse kinematics of one arm, the same poses here and in rs-opw-kinematics.

use divan::Bencher;
use divan::counter::ItemsCount;
use falsetarget::geometry::pose::Pose;
use falsetarget::kinematics::controller::Controller;
use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use rs_opw_kinematics::kinematic_traits::{Joints, Kinematics};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;

use crate::arms::{POSES, numbers, opw, same_as_opw};

/// One arm twice, with numbers to go to.
struct Pair {
    ours: Controller,
    theirs: OPWKinematics,
    numbers: Vec<Joints>,
}

impl Pair {
    fn new() -> Self {
        let parameters = opw();
        let ours = Controller::new(&same_as_opw(&parameters));
        let numbers = numbers(ours.robot());
        Self { ours, theirs: OPWKinematics::new(parameters), numbers }
    }

    fn poses(&self) -> Vec<Pose> {
        self.numbers.iter().map(|numbers| self.ours.forward(numbers).expect("no loop")).collect()
    }

    fn isometries(&self) -> Vec<Isometry3<f64>> {
        let isometry = |pose: Pose| {
            let (place, turn) = (Translation3::from(pose.translation), UnitQuaternion::from_matrix(&pose.rotation));
            Isometry3::from_parts(place, turn)
        };
        let all: Vec<_> = self.poses().into_iter().map(isometry).collect();
        let agree = |(one, numbers): (&Isometry3<f64>, &Joints)| {
            (one.translation.vector - self.theirs.forward(numbers).translation.vector).norm() < 1e-9
        };
        assert!(all.iter().zip(&self.numbers).all(agree), "both are the same arm");
        all
    }
}

fn batch<I: Sync, O>(bencher: Bencher<'_, '_>, inputs: &[I], work: impl Fn(&I) -> O) {
    bencher.counter(ItemsCount::new(POSES)).bench_local(|| {
        for input in inputs {
            divan::black_box(work(divan::black_box(input)));
        }
    });
}

#[divan::bench]
fn forward(bencher: Bencher<'_, '_>) {
    let pair = Pair::new();
    batch(bencher, &pair.numbers, |numbers| pair.ours.forward(numbers));
}

#[divan::bench]
fn forward_rs_opw_kinematics(bencher: Bencher<'_, '_>) {
    let pair = Pair::new();
    batch(bencher, &pair.numbers, |numbers| pair.theirs.forward(numbers));
}

/// All branches, with posture, distance from singularities, limits and full turns.
#[divan::bench]
fn inverse(bencher: Bencher<'_, '_>) {
    let pair = Pair::new();
    batch(bencher, &pair.poses(), |pose| pair.ours.inverse(pose));
}

/// All branches; each is checked by a forward pass there.
#[divan::bench]
fn inverse_rs_opw_kinematics(bencher: Bencher<'_, '_>) {
    let pair = Pair::new();
    batch(bencher, &pair.isometries(), |pose| pair.theirs.inverse(pose));
}
