//! Additional axes: a track under the robot and a turntable under the frame, against the same cell written out by hand.

use falsetarget::base::text::Source;
use falsetarget::files::builtin::by_name;
use falsetarget::files::cell::{self, Cell};
use falsetarget::geometry::pose::pose_difference;
use falsetarget::kinematics::controller::Controller;
use falsetarget::model::arm::ArmModel;
use falsetarget::program::dialect::{self};
use falsetarget::program::target::Target;
use falsetarget::rewrite::class::Class;
use falsetarget::rewrite::correct::{Job, Options, correct};
use falsetarget::rewrite::outcome::Outcome;
use falsetarget::rewrite::play::play;
use falsetarget::rewrite::written_pose;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::spoil::spoil;
use super::{LANDS_WITHIN_M, LANDS_WITHIN_RAD};

const TOOL: &str = "PERS tooldata t:=[TRUE,[[0,0,200],[1,0,0,0]],[10,[0,0,100],[1,0,0,0],0,0,0]];";

fn module(declarations: &str, moves: &str) -> Source {
    Source::new("a.mod", format!("MODULE A\n{TOOL}\n{declarations}\nPROC main()\n{moves}\nENDPROC\nENDMODULE\n"))
}

fn robtarget(xyz: &str, axes: &str) -> String {
    format!("[[{xyz}],[0,0,1,0],[0,0,0,0],[{axes}]]")
}

fn cell(axes: &str) -> Cell {
    let text = format!(
        "schema: falsetarget/cell/1\nframes: {{STN1: {{xyz_mm: [1500, 0, 300], rpy_deg: [0, 0, 0]}}}}\naxes:\n{axes}"
    );
    cell::read(&Source::new("cell.yaml", text)).expect("a sound cell file")
}

fn arm() -> ArmModel {
    let robot = by_name("abb-irb6640").expect("built in").expect("sound");
    spoil(robot, &mut ChaCha8Rng::seed_from_u64(5))
}

fn corrected(source: &Source, cell: &Cell) -> (Outcome, Source) {
    let arm = arm();
    let dialect = dialect::detect(source).expect("RAPID");
    let program = dialect.read(std::slice::from_ref(source));
    let controller = Controller::new(&arm.robot);
    let sources = std::slice::from_ref(source);
    let job = Job { sources, program: &program, rules: dialect.meta().numbers, cell };
    let outcome = correct(&job, &arm, &controller, &Options::default());
    let bytes = outcome.edits[0].apply(source.bytes()).expect("disjoint edits");
    (outcome, Source::new("a.mod", bytes))
}

/// Every target of the corrected program lands where the original means it.
fn check_landing(original: &Source, corrected: &Source, cell: &Cell) {
    let arm = arm();
    let controller = Controller::new(&arm.robot);
    let read = |source: &Source| dialect::detect(source).expect("RAPID").read(std::slice::from_ref(source));
    let (before, after) =
        (play(&read(original), cell, &arm, &controller), play(&read(corrected), cell, &arm, &controller));
    assert!(!before.is_empty() && before.len() == after.len());
    for (meant, got) in before.iter().zip(&after) {
        let (shift, turn) = pose_difference(&got.landed, &meant.written);
        assert!(shift.norm() < LANDS_WITHIN_M && turn.norm() < LANDS_WITHIN_RAD, "{} m", shift.norm());
        assert!(pose_difference(&meant.landed, &meant.written).0.norm() > 1e-4, "there was something to correct");
    }
}

/// What a correction changed of each target, in its frame.
fn shifts(before: &Source, after: &Source) -> Vec<nalgebra::Vector3<f64>> {
    let written = |source: &Source| {
        let program = dialect::detect(source).expect("RAPID").read(std::slice::from_ref(source));
        let pose = |target: &Target| written_pose(&program, &target.value).expect("a pose").translation;
        program.targets.iter().map(pose).collect::<Vec<_>>()
    };
    written(after).iter().zip(written(before)).map(|(after, before)| after - before).collect()
}

#[test]
fn on_a_track_a_target_of_the_cell_is_corrected_as_it_lies_before_the_robot() {
    let cell = cell("- {name: eax_a, kind: linear, moves: base, direction: [0, 1, 0], zero: 500}\n");
    let far = robtarget("1500,2600,1200", "3000,9E9,9E9,9E9,9E9,9E9");
    let source = module("", &format!("MoveL {far},v1,fine,t;"));
    let (_, after) = corrected(&source, &cell);
    check_landing(&source, &after, &cell);
    // By hand: 2500 mm along y are gone.
    let near = module("", &format!("MoveL {},v1,fine,t;", robtarget("1500,100,1200", "9E9,9E9,9E9,9E9,9E9,9E9")));
    let (_, by_hand) = corrected(&near, &Cell::default());
    assert!((shifts(&source, &after)[0] - shifts(&near, &by_hand)[0]).norm() < 1e-8);
    assert!(String::from_utf8_lossy(after.bytes()).contains("[3000,9E9"), "the axis keeps its value");
}

#[test]
fn on_a_turntable_a_target_is_corrected_where_the_table_has_turned_it() {
    let cell = cell("- {name: EAX_B, kind: rotary, moves: stn1, point_mm: [1500, 0, 300], direction: [0, 0, 1]}\n");
    let wobj = |frame: &str| format!("PERS wobjdata w:={frame};");
    let on_table = wobj("[FALSE,FALSE,\"STN1\",[[9,9,9],[1,0,0,0]],[[0,0,100],[1,0,0,0]]]");
    let moves = |axes: &str| format!("MoveL {},v1,fine,t\\WObj:=w;", robtarget("150,40,500", axes));
    let source = module(&on_table, &moves("9E9,30,9E9,9E9,9E9,9E9"));
    let (_, after) = corrected(&source, &cell);
    check_landing(&source, &after, &cell);
    // By hand: the user frame written out as the table stands at 30 degrees.
    let (cos, sin) = (15f64.to_radians().cos(), 15f64.to_radians().sin());
    let turned = wobj(&format!("[FALSE,TRUE,\"\",[[1500,0,300],[{cos},0,0,{sin}]],[[0,0,100],[1,0,0,0]]]"));
    let near = module(&turned, &moves("9E9,9E9,9E9,9E9,9E9,9E9"));
    let (_, by_hand) = corrected(&near, &Cell::default());
    assert!((shifts(&source, &after)[0] - shifts(&near, &by_hand)[0]).norm() < 1e-8);
}

#[test]
fn what_no_cell_file_describes_is_refused_with_what_to_write() {
    let moved = |axes: &str| module("", &format!("MoveL {},v1,fine,t;", robtarget("1500,100,1200", axes)));
    let only = |source: &Source, cell: &Cell| {
        let (mut outcome, _) = corrected(source, cell);
        let target = outcome.targets.remove(0);
        (target.class, target.reason.unwrap_or_default())
    };
    let (class, reason) = only(&moved("12.5,9E9,9E9,9E9,9E9,9E9"), &Cell::default());
    assert_eq!(class, Class::Refused);
    assert!(reason.contains("eax_a at 12.5") && reason.contains("axes: [{name: eax_a"), "{reason}");
    // At zero, not used, or said to move nothing: as without.
    for axes in ["0,9E9,9E9,9E9,9E9,9E9", "9E9,9E9,9E9,9E9,9E9,9E9"] {
        assert_eq!(only(&moved(axes), &Cell::default()).0, Class::Corrected);
    }
    let gun = cell("- {name: eax_a, moves: nothing}\n");
    assert_eq!(only(&moved("12.5,9E9,9E9,9E9,9E9,9E9"), &gun).0, Class::Corrected);
    // A target that leaves out where the track stands, in a program that moves it.
    let track = cell("- {name: eax_a, kind: linear, moves: base, direction: [1, 0, 0]}\n");
    let silent = robtarget("1500,100,1200", "9E9,9E9,9E9,9E9,9E9,9E9");
    let both = module("", &format!("MoveL {silent},v1,fine,t;\nMoveL {},v1,fine,t;", silent.replacen("9E9", "10", 1)));
    let (class, reason) = only(&both, &track);
    assert_eq!(class, Class::Refused);
    assert!(reason.contains("does not say where axis eax_a stands"), "{reason}");
}
