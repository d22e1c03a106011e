//! Libraries: what a batch does with many files, when it is stopped, and when it is shared.

use std::process::Stdio;
use std::time::{Duration, Instant};

use super::bench::{Bench, REACHED, program};

/// A library of `count` programs with `targets` targets each, in folders of ten.
fn library(count: usize, targets: usize) -> Bench {
    let bench = Bench::new();
    let moves: String = (0..targets)
        .map(|n| format!("    MoveL {},v100,z1,tGun;\n", REACHED.replace("1500", &format!("{}.25", 1400 + n % 200))))
        .collect();
    let body = program(REACHED, "tGun").replace("  ENDPROC", &format!("{moves}  ENDPROC"));
    for number in 0..count {
        bench.write(&format!("lib/{}/p{number}.mod", number / 10), &body);
    }
    bench.write("lib/notes.txt", "welds\r\n");
    bench
}

fn below(bench: &Bench, folder: &str) -> Vec<String> {
    bench.files().into_iter().filter(|name| name.starts_with(folder)).collect()
}

#[test]
fn a_killed_run_is_taken_up_and_leaves_no_half_file() {
    let bench = library(60, 400);
    let arguments = ["correct", "--model", "model.yaml", "lib", "--out-dir", "out", "--others", "copy", "--jobs", "2"];
    let whole = bench.run(&["correct", "--model", "model.yaml", "lib", "--out-dir", "whole", "--others", "copy"]);
    assert_eq!(whole.status, Some(0), "{}", whole.stderr);
    let mut child = bench.command(&arguments).stderr(Stdio::null()).spawn().expect("started");
    let started = Instant::now();
    let programs = || below(&bench, "out/").into_iter().filter(|name| name.ends_with(".mod")).count();
    while programs() < 15 && started.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(2));
    }
    // SIGKILL.
    child.kill().expect("killed");
    child.wait().expect("ended");
    let before: Vec<String> = below(&bench, "out/").into_iter().filter(|name| name.ends_with(".mod")).collect();
    assert!(before.len() >= 15);
    for name in &before {
        assert!(bench.read(name) == bench.read(&name.replace("out/", "whole/")), "{name} is not whole");
    }
    let again = bench.run(&arguments);
    assert_eq!(again.status, Some(0), "{}", again.stderr);
    if before.len() < 60 {
        assert!(again.stderr.contains("finished before"), "{}", again.stderr);
    }
    assert!(again.stderr.contains("60 file(s): 24060 corrected"), "{}", again.stderr);
    let names = |folder: &str| below(&bench, folder).iter().map(|name| name[folder.len()..].to_string()).collect();
    let (out, expected): (Vec<String>, Vec<String>) = (names("out/"), names("whole/"));
    assert_eq!(out, expected, "nothing but the library stays");
    for name in out {
        assert!(bench.read(&format!("out/{name}")) == bench.read(&format!("whole/{name}")), "{name}");
    }
}

#[test]
fn shards_share_a_library_without_overlap() {
    let bench = library(40, 1);
    let mut seen = 0;
    for part in ["1/3", "2/3", "3/3"] {
        let before = below(&bench, "out/").len();
        let run = bench.run(&["correct", "--model", "model.yaml", "lib", "--out-dir", "out", "--shard", part]);
        assert_eq!(run.status, Some(0), "{}", run.stderr);
        let done = below(&bench, "out/").len() - before;
        assert!((5..=25).contains(&done), "{part} did {done}");
        seen += done;
    }
    assert_eq!(seen, 40);
    for bad in ["0/3", "4/3", "1", "a/b"] {
        let run = bench.run(&["correct", "--model", "model.yaml", "lib", "--out-dir", "out", "--shard", bad]);
        assert_eq!(run.status, Some(2), "{bad}");
    }
}

#[test]
fn the_first_failure_can_stop_a_run() {
    let bench = library(30, 1);
    bench.write("lib/0/a_far.mod", program(&REACHED.replace("1500", "4500"), "tGun"));
    let run = bench.run(&["correct", "--model", "model.yaml", "lib", "--out-dir", "out", "--fail-fast", "--jobs", "1"]);
    assert_eq!(run.status, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("a_far.mod: line 3:"), "{}", run.stderr);
    assert!(run.stderr.contains("because of the first failure"), "{}", run.stderr);
    let written: Vec<_> = below(&bench, "out/").into_iter().filter(|name| name.ends_with(".mod")).collect();
    assert!(written.is_empty(), "begun after the failure: {written:?}");
}

#[test]
fn settings_beside_the_programs_save_typing_and_options_win() {
    let bench = library(1, 1);
    let moved = bench.read("model.yaml");
    bench.write("lib/models/real.yaml", moved);
    bench.write(
        "lib/falsetarget.yaml",
        "schema: falsetarget/settings/1\nmodel: models/real.yaml\njoint_targets: true\n",
    );
    let joint = "MODULE J\n  PROC main()\n    MoveAbsJ [[10,20,10,5,30,5],[9E9,9E9,9E9,9E9,9E9,9E9]],v1,fine,tool0;\n  ENDPROC\nENDMODULE\n";
    bench.write("lib/0/joint.mod", joint);
    let by_settings = bench.run(&["correct", "lib/0/joint.mod"]);
    assert_eq!(by_settings.status, Some(0), "{}", by_settings.stderr);
    assert_ne!(by_settings.stdout, joint.as_bytes());
    let option_wins = bench.run(&["correct", "--joint-targets=false", "lib/0/joint.mod"]);
    assert_eq!(option_wins.stdout, joint.as_bytes());
    let model_wins = bench.run(&["correct", "--model", "robot.yaml", "lib/0/p0.mod"]);
    assert_eq!(model_wins.stdout, bench.read("lib/0/p0.mod"));
    bench.write("lib/falsetarget.yaml", "schema: falsetarget/settings/1\nmodell: x\n");
    let run = bench.run(&["correct", "lib/0/p0.mod"]);
    assert_eq!(run.status, Some(2));
    assert!(run.stderr.contains("falsetarget.yaml:2"), "{}", run.stderr);
}

#[test]
fn other_files_are_copied_as_asked_and_never_changed() {
    let bench = library(1, 1);
    bench.write("lib/photo.jpg", [0u8, 159, 1, 2, 3, 0, 0, 0].repeat(4096));
    let run = bench.run(&["correct", "--model", "model.yaml", "lib", "--out-dir", "out", "--others", "copy"]);
    assert_eq!(run.status, Some(0), "{}", run.stderr);
    assert!(bench.read("out/photo.jpg") == bench.read("lib/photo.jpg"));
    assert_eq!(bench.read("out/notes.txt"), b"welds\r\n");
    assert_eq!(below(&bench, "out/"), ["out/0/p0.mod", "out/notes.txt", "out/photo.jpg"]);
}
