//! Correction: one pose, one file, and the stages of a file.

use divan::Bencher;
use divan::counter::ItemsCount;
use falsetarget::base::text::Source;
use falsetarget::files::cell::Cell;
use falsetarget::invert::{MeantPose, RealArm};
use falsetarget::kinematics::controller::Controller;
use falsetarget::model::arm::ArmModel;
use falsetarget::model::arm::EffectInstance;
use falsetarget::model::conditions::Conditions;
use falsetarget::model::effect::{Location, by_id};
use falsetarget::program::dialect::{Dialect, by_id as dialect_by_id};
use falsetarget::rewrite::{Class, Job, Options, Outcome, correct};

use crate::arms::{POSES, calibrated, numbers};
use crate::programs::raster;

/// Inline targets of the program that is corrected.
const TARGETS: usize = 20_000;

/// A program and all that corrects it.
struct Shop {
    model: ArmModel,
    controller: Controller,
    cell: Cell,
    dialect: &'static dyn Dialect,
    text: String,
}

impl Shop {
    fn new(model: ArmModel) -> Self {
        let controller = Controller::new(&model.robot);
        let text = raster(&controller, TARGETS);
        let dialect = dialect_by_id("rapid").expect("known");
        let shop = Self { model, controller, cell: Cell::default(), dialect, text };
        let sources = shop.sources();
        let outcome = shop.correct(&sources);
        assert_eq!(outcome.count(Class::Corrected), TARGETS, "every target has its false target");
        shop
    }

    fn sources(&self) -> [Source; 1] {
        [Source::new("raster.mod", self.text.as_bytes())]
    }

    fn correct(&self, sources: &[Source]) -> Outcome {
        let program = self.dialect.read(sources);
        let rules = self.dialect.meta().numbers;
        let job = Job { sources, program: &program, rules, cell: &self.cell };
        correct(&job, &self.model, &self.controller, &Options::default())
    }

    fn whole_file(&self) -> Vec<u8> {
        let sources = self.sources();
        self.correct(&sources).edits[0].apply(sources[0].bytes()).expect("disjoint edits")
    }
}

/// [`calibrated`] with play in two joints: then the senses of approach count.
fn with_backlash() -> ArmModel {
    let mut model = calibrated();
    let backlash = by_id("backlash").expect("known");
    for joint in [0, 3] {
        model.effects.push(EffectInstance { effect: backlash, location: Location::at_joint(joint) });
        model.parameters.effects.push(vec![2e-4]);
    }
    model
}

/// The pose of the real arm: deflected by its loads, with the network.
#[divan::bench]
fn forward_of_the_real_arm(bencher: Bencher<'_, '_>) {
    let model = calibrated();
    let arm = RealArm::new(&model);
    let (inputs, conditions) = (reachable(&model), Conditions::default());
    bencher.counter(ItemsCount::new(inputs.len())).bench_local(|| {
        for numbers in &inputs {
            let _ = divan::black_box(arm.flange(divan::black_box(numbers), &conditions));
        }
    });
}

/// The false target of one pose.
#[divan::bench]
fn command_of_one_pose(bencher: Bencher<'_, '_>) {
    let model = calibrated();
    let arm = RealArm::new(&model);
    let controller = Controller::new(&model.robot);
    let conditions = Conditions::default();
    let inputs: Vec<_> = reachable(&model)
        .into_iter()
        .map(|numbers| (controller.forward(&numbers).expect("a closed loop"), numbers))
        .collect();
    bencher.counter(ItemsCount::new(inputs.len())).bench_local(|| {
        for (pose, numbers) in &inputs {
            let meant = MeantPose { base_t_flange: divan::black_box(*pose), conditions: &conditions };
            let _ = divan::black_box(arm.command(&meant, numbers));
        }
    });
}

/// Numbers all over the range at which the loop closes.
fn reachable(model: &ArmModel) -> Vec<[f64; 6]> {
    let inside: Vec<_> = numbers(&model.robot)
        .into_iter()
        .filter(|numbers| model.robot.limit_violation(numbers, 0.0).is_none())
        .collect();
    assert!(inside.len() > POSES / 4, "most of the range is allowed");
    inside
}

/// From the bytes of a program to the bytes of the corrected one.
#[divan::bench]
fn whole_file(bencher: Bencher<'_, '_>) {
    let shop = Shop::new(calibrated());
    bencher.counter(ItemsCount::new(TARGETS)).bench_local(|| shop.whole_file());
}

/// The same with effects that ask how a joint arrives.
#[divan::bench]
fn whole_file_with_backlash(bencher: Bencher<'_, '_>) {
    let shop = Shop::new(with_backlash());
    bencher.counter(ItemsCount::new(TARGETS)).bench_local(|| shop.whole_file());
}

/// The part of a whole file that is reading.
#[divan::bench]
fn read_alone(bencher: Bencher<'_, '_>) {
    let shop = Shop::new(calibrated());
    bencher.counter(ItemsCount::new(TARGETS)).bench_local(|| shop.dialect.read(&shop.sources()));
}

/// The part that is following, inverting and choosing digits.
#[divan::bench]
fn correct_alone(bencher: Bencher<'_, '_>) {
    let shop = Shop::new(calibrated());
    let sources = shop.sources();
    let program = shop.dialect.read(&sources);
    let rules = shop.dialect.meta().numbers;
    let job = Job { sources: &sources, program: &program, rules, cell: &shop.cell };
    let run = || correct(&job, &shop.model, &shop.controller, &Options::default());
    bencher.counter(ItemsCount::new(TARGETS)).bench_local(run);
}
