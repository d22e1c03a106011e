//! Languages in which a number that is left out is that of the target before: what stays must not move along.

use falsetarget::base::text::Source;
use falsetarget::files::builtin::by_name;
use falsetarget::files::cell::Cell;
use falsetarget::kinematics::controller::Controller;
use falsetarget::program::dialect;
use falsetarget::program::target::{Program, TargetValue};
use falsetarget::rewrite::class::Class;
use falsetarget::rewrite::correct::{Job, Options, correct};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::spoil::spoil;

/// The third block is out of reach and says only where it goes in X; the fourth goes on from it.
const PROGRAM: &str = "(falsetarget: orientation=fixed-xyz frame=base tool=own)\n\
                       G21 G90\n\
                       G1 X520.0 Y0.0 Z620.0 A180.0 B10.0 C180.0\n\
                       Y60.0\n\
                       X9000.0\n\
                       X500.0\n";

fn values(program: &Program, index: usize) -> Vec<f64> {
    match &program.targets[index].value {
        TargetValue::Cartesian(numbers) => {
            numbers.position.iter().chain(&numbers.orientation).map(|field| field.value).collect()
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_refused_block_keeps_its_numbers_when_others_are_corrected() {
    let sources = [Source::new("part.nc", PROGRAM)];
    let dialect = dialect::detect(&sources[0]).expect("G-code");
    let program = dialect.read(&sources);
    let robot = by_name("kuka-kr6-r900").expect("built in").expect("sound");
    let controller = Controller::new(&robot);
    let model = spoil(robot, &mut ChaCha8Rng::seed_from_u64(5));
    let cell = Cell::default();
    let job = Job { sources: &sources, program: &program, rules: dialect.meta().numbers, cell: &cell };
    let outcome = correct(&job, &model, &controller, &Options::default());
    let classes: Vec<Class> = outcome.targets.iter().map(|target| target.class).collect();
    assert_eq!(classes, [Class::Corrected, Class::Corrected, Class::Refused, Class::Corrected]);
    let bytes = outcome.edits[0].apply(sources[0].bytes()).expect("disjoint edits");
    let again = dialect.read(&[Source::new("part.nc", bytes)]);
    assert_eq!(values(&again, 2), values(&program, 2));
    for index in [0, 1, 3] {
        assert_ne!(values(&again, index), values(&program, index));
        assert!((values(&again, index)[0] - values(&program, index)[0]).abs() < 20.0);
    }
}
