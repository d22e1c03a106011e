//! Targets in a wrist singularity: refused in words, unless the arm needs no correction there.

use super::bench::{Bench, program};

/// Joint 5 at zero: axes 4 and 6 in one line.
const STRAIGHT: &str = "[[1862.5,0,2055],[0.70710678,0,0.70710678,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";

#[test]
fn a_straight_wrist_is_refused_with_the_reason_in_words() {
    let bench = Bench::new();
    bench.write("straight.mod", program(STRAIGHT, "tGun"));
    let before = bench.files();
    let run = bench.run(&["correct", "--model", "model.yaml", "straight.mod", "-o", "out.mod"]);
    assert_eq!(run.status, Some(1));
    for part in ["straight.mod:3:23", "wrist singularity", "joint 5 at", "axes 4 and 6 in line", "bend the wrist"] {
        assert!(run.stderr.contains(part), "`{part}` is not in:\n{}", run.stderr);
    }
    assert!(run.stdout.is_empty());
    assert_eq!(bench.files(), before);
}

#[test]
fn a_straight_wrist_of_a_perfect_arm_stays_as_it_is() {
    let bench = Bench::new();
    bench.write("straight.mod", program(STRAIGHT, "tGun"));
    let run = bench.run(&["correct", "--model", "robot.yaml", "straight.mod", "-o", "out.mod"]);
    assert_eq!(run.status, Some(0), "{}", run.stderr);
    assert_eq!(bench.read("out.mod"), bench.read("straight.mod"));
}
