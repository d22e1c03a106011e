//! `correct --out-dir`: many programs, folders mirrored, each file whole or not at all.

use super::bench::{Bench, REACHED, program};

/// A library of two good programs, one that is refused, and two files that are none.
fn library() -> Bench {
    let bench = Bench::new();
    bench.write("lib/a.mod", program(REACHED, "tGun"));
    bench.write("lib/deep/er/b.mod", program(REACHED, "tGun"));
    bench.write("lib/deep/far.mod", program(&REACHED.replace("1500", "4500"), "tGun"));
    bench.write("lib/README.md", "# Programs\n");
    bench.write("lib/empty.mod", "");
    bench
}

fn outputs(bench: &Bench) -> Vec<String> {
    bench.files().into_iter().filter(|name| name.starts_with("out/")).collect()
}

#[test]
fn a_folder_is_mirrored_and_refused_programs_are_left_out() {
    let bench = library();
    let run = bench.run(&["correct", "--model", "model.yaml", "lib", "--out-dir", "out", "--report", "r.json"]);
    assert_eq!(run.status, Some(1), "{}", run.stderr);
    assert_eq!(outputs(&bench), ["out/a.mod", "out/deep/er/b.mod"]);
    let alone = bench.run(&["correct", "--model", "model.yaml", "lib/a.mod"]);
    assert_eq!(bench.read("out/a.mod"), alone.stdout);
    assert!(run.stderr.contains("README.md: no robot program"), "{}", run.stderr);
    assert!(
        run.stderr.contains("3 file(s): 2 corrected, 0 joint, 0 computed, 1 refused; 2 other file(s)"),
        "{}",
        run.stderr
    );
    let report: serde_json::Value = serde_json::from_slice(&bench.read("r.json")).expect("JSON");
    let paths: Vec<&str> =
        report["files"].as_array().expect("files").iter().filter_map(|file| file["path"].as_str()).collect();
    assert_eq!(paths, ["lib/a.mod", "lib/deep/er/b.mod", "lib/deep/far.mod"]);
}

#[test]
fn messages_do_not_depend_on_the_number_of_processors() {
    let bench = library();
    let with =
        |jobs| bench.run(&["correct", "--model", "model.yaml", "lib", "--out-dir", "out", "--jobs", jobs]).stderr;
    assert_eq!(with("1"), with("4"));
}

#[test]
fn a_second_run_does_not_correct_the_first_ones_results() {
    let bench = library();
    for _ in 0..2 {
        bench.run(&["correct", "--model", "model.yaml", "lib", "--out-dir", "lib/out"]);
    }
    let below: Vec<String> = bench.files().into_iter().filter(|name| name.starts_with("lib/out/")).collect();
    assert_eq!(below, ["lib/out/a.mod", "lib/out/deep/er/b.mod"]);
}

#[test]
fn bad_programs_of_a_batch_are_bad_input_and_the_others_are_written() {
    let bench = library();
    bench.write("cut.mod", "MODULE A\n  PROC main()\n    MoveL p1,v1");
    for (bad, says) in
        [("cut.mod", "cut.mod:3:5"), ("lib/empty.mod", "the program is empty"), ("no.mod", "No such file")]
    {
        let run = bench.run(&["correct", "--model", "model.yaml", bad, "lib/a.mod", "--out-dir", "out"]);
        assert_eq!(run.status, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains(says), "{}", run.stderr);
        assert_eq!(outputs(&bench), ["out/a.mod"]);
    }
}

#[test]
fn two_programs_for_one_place_are_refused_before_anything_is_written() {
    let bench = library();
    bench.write("other/a.mod", program(REACHED, "tGun"));
    let run = bench.run(&["correct", "--model", "model.yaml", "lib/a.mod", "other/a.mod", "--out-dir", "out"]);
    assert_eq!(run.status, Some(2));
    assert!(run.stderr.contains("would both become out/a.mod"), "{}", run.stderr);
    let run = bench.run(&["correct", "--model", "model.yaml", "lib", "--out-dir", "job.mod"]);
    assert_eq!(run.status, Some(2));
    assert!(outputs(&bench).is_empty());
}
