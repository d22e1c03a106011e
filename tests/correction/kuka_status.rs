//! The shipped KUKA jobs say status and turn of their points, computed with another implementation of the arm: the
//! solutions that the program is followed with must be the same ones.

use std::path::Path;

use falsetarget::base::text::{Source, Span};
use falsetarget::files::builtin::by_name;
use falsetarget::files::cell::Cell;
use falsetarget::kinematics::controller::Controller;
use falsetarget::model::arm::ArmModel;
use falsetarget::program::dialect;
use falsetarget::program::target::{Configuration, TargetValue};
use falsetarget::rewrite::play::play;

/// The number behind ` T ` or ` 'B..'` of a position, as the text has it.
fn turn(text: &str) -> Option<u32> {
    let after = text.split(&[',', ' '][..]).collect::<Vec<_>>();
    let place = after.iter().position(|word| *word == "T")?;
    let word = after.get(place + 1)?.trim_end_matches('}');
    match word.strip_prefix("'B").and_then(|bits| bits.strip_suffix('\'')) {
        Some(bits) => u32::from_str_radix(bits, 2).ok(),
        None => word.parse().ok(),
    }
}

#[test]
fn axes_stand_at_the_sides_that_the_turn_says() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("programs/krl");
    let mut checked = 0;
    for job in ["side_panel", "door_seal"] {
        let sources = [format!("{job}.src"), format!("{job}.dat"), "$config.dat".to_string()]
            .map(|name| Source::new(name.clone(), std::fs::read(folder.join(name)).expect("a shipped file")));
        let krl = dialect::by_id("krl").expect("the language");
        let mut program = krl.read(&sources);
        // What the text says is taken away, so that the order of the program alone decides.
        let said: Vec<Option<u32>> = program
            .targets
            .iter()
            .map(|target| turn(&sources[target.file].text(Span::new(target.span.start, target.span.end))))
            .collect();
        program.targets.iter_mut().for_each(|target| target.configuration = Configuration::unsaid());
        let robot = by_name("kuka-kr210-r2700").expect("built in").expect("sound");
        let controller = Controller::new(&robot);
        for arrival in play(&program, &Cell::default(), &ArmModel::controller(robot), &controller) {
            let target = &program.targets[arrival.target];
            let (TargetValue::Cartesian(_), Some(said)) = (&target.value, said[arrival.target]) else { continue };
            let numbers = arrival.numbers_rad;
            let signs = (0..6).filter(|&joint| numbers[joint] < 0.0).fold(0, |bits, joint| bits | 1 << joint);
            assert_eq!(signs, said, "{:?}: {:?}", target.name, numbers.map(f64::to_degrees));
            checked += 1;
        }
    }
    assert!(checked > 25, "only {checked} positions say their turn");
}
