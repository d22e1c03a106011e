//! What is printed where: help, colour, closed pipes.

use std::process::Stdio;

use super::bench::{Bench, REACHED, program};

#[test]
fn every_command_explains_itself() {
    let bench = Bench::new();
    let general = bench.run(&["--help"]);
    assert_eq!(general.status, Some(0));
    let text = String::from_utf8(general.stdout).expect("text");
    assert!(text.contains("Exit status: 0 done; 1") && text.contains("2 bad usage"), "{text}");
    for (command, words) in [
        (
            "correct",
            &[
                "--model",
                "--cell",
                "--dialect",
                "--report",
                "--out-dir",
                "--allow-partial",
                "--joint-targets",
                "Examples:",
            ][..],
        ),
        ("inspect", &["--dialect", "--json"]),
        ("simulate", &["--robot", "--effects", "--recording"]),
        ("robots", &["-o, --output"]),
        ("calibrate", &["--robot", "--recording", "--json", "--paper"]),
        ("predict", &["--model", "--recording"]),
        ("diagnose", &["--model", "--recording", "--json"]),
        ("validate", &["--model", "--recording", "--json"]),
        ("plan", &["--robot", "--points", "--among"]),
    ] {
        assert!(text.contains(command), "{command} is not in the list");
        let run = bench.run(&[command, "--help"]);
        let help = String::from_utf8(run.stdout).expect("text");
        assert_eq!(run.status, Some(0));
        assert!(words.iter().all(|word| help.contains(word)), "{help}");
        assert!(help.lines().all(|line| line.chars().count() <= 100), "{help}");
    }
}

#[test]
fn usage_errors_have_status_2_and_name_the_option() {
    let bench = Bench::new();
    for (arguments, says) in [
        (&["correct", "job.mod"][..], "--model"),
        (&["correct", "--modell", "model.yaml"], "--model"),
        (&["nonsense"], "nonsense"),
        (&["correct", "--model", "model.yaml", "--jobs", "many", "job.mod"], "--jobs"),
    ] {
        let run = bench.run(arguments);
        assert_eq!(run.status, Some(2), "{arguments:?}");
        assert!(run.stderr.contains(says) && run.stdout.is_empty(), "{}", run.stderr);
    }
}

#[test]
fn nothing_is_coloured_when_nobody_looks() {
    let bench = Bench::new();
    bench.write("bad.mod", program(REACHED, "tNix"));
    for variable in ["NO_COLOR", "UNRELATED"] {
        let output =
            bench.command(&["correct", "--model", "model.yaml", "bad.mod"]).env(variable, "1").output().expect("ran");
        assert!(!output.stderr.contains(&0x1b) && !output.stderr.is_empty());
    }
}

/// The reader is gone before anything is written: no complaint, and status 0.
#[test]
fn a_closed_pipe_is_no_failure() {
    let bench = Bench::new();
    // More than a pipe holds, so that writing must fail.
    let moves: String = (0..4000).map(|_| "    MoveL p1,v100,fine,tGun;\n").collect();
    let text = program(REACHED, "tGun").replace("  ENDPROC", &format!("{moves}  ENDPROC"));
    bench.write("long.mod", text);
    for arguments in [
        &["correct", "--model", "model.yaml", "long.mod"][..],
        &["correct", "--model", "model.yaml", "long.mod", "-o", "out.mod", "--report", "-"],
        &["inspect", "--json", "long.mod"],
        &["robots"],
    ] {
        let mut child =
            bench.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("started");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("ended");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {stderr}");
        assert!(!stderr.contains("panicked") && !stderr.contains("pipe"), "{stderr}");
    }
}

#[test]
fn built_in_robots_are_listed_and_printed() {
    let bench = Bench::new();
    let list = String::from_utf8(bench.run(&["robots"]).stdout).expect("text");
    assert!(list.contains("hh800-class") && list.contains("abb-irb6640"), "{list}");
    assert_eq!(bench.run(&["robots", "abb-irb6640"]).stdout, Bench::robot().as_bytes());
    assert_eq!(bench.run(&["robots", "nobody"]).status, Some(2));
}

#[test]
fn inspect_needs_no_model() {
    let bench = Bench::new();
    let run = bench.run(&["inspect", "job.mod"]);
    assert_eq!(run.status, Some(0));
    let table = String::from_utf8(run.stdout).expect("text");
    assert!(
        table.contains("p1") && table.contains("1 correctable, 0 joint, 0 computed, 0 refused in 1 file(s)"),
        "{table}"
    );
    let run = bench.run_with(&["inspect", "--json"], &bench.read("job.mod"));
    let report: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    assert_eq!((&report["files"][0]["path"], &report["summary"]["corrected"]), (&"<stdin>".into(), &1.into()));
}
