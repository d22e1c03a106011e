//! RAPID modules of one task: a program that uses what other modules declare.

use super::bench::{Bench, REACHED};

/// A task laid out as a controller backs it up: points, moves and tools in three modules.
fn task() -> Bench {
    let bench = Bench::new();
    bench.write("T/PROGMOD/points.mod", format!("MODULE Points\r\n  CONST robtarget p1:={REACHED};\r\nENDMODULE\r\n"));
    bench.write("T/PROGMOD/MainMod.mod", main("pHome"));
    bench.write(
        "T/SYSMOD/tools.sys",
        "MODULE Tools(SYSMODULE)\n  PERS tooldata tGun:=[TRUE,[[0,0,200],[1,0,0,0]],[10,[0,0,100],[1,0,0,0],0,0,0]];\n\
         ENDMODULE\n",
    );
    bench
}

fn main(home: &str) -> String {
    format!(
        "MODULE MainMod\n  CONST robtarget {home}:={REACHED};\n  PROC main()\n    MoveJ {home},v100,fine,tGun;\n    \
         MoveL p1,v100,fine,tGun;\n  ENDPROC\nENDMODULE\n"
    )
}

#[test]
fn a_position_is_corrected_with_the_moves_of_another_module() {
    let bench = task();
    let run = bench.run(&["correct", "--model", "model.yaml", "T", "--out-dir", "out", "--report", "r.json"]);
    assert_eq!(run.status, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("3 file(s): 2 corrected, 0 joint, 0 computed, 0 refused"), "{}", run.stderr);
    assert_ne!(bench.read("out/PROGMOD/points.mod"), bench.read("T/PROGMOD/points.mod"));
    assert_eq!(bench.read("out/SYSMOD/tools.sys"), bench.read("T/SYSMOD/tools.sys"));
    // The same numbers as when all stands in one module.
    let (_, number) = text(&bench, "out/PROGMOD/points.mod")
        .split_once(":=")
        .map(|(a, b)| (a.len(), b.to_string()))
        .expect("a value");
    let number = number.split_once(';').expect("an end").0.to_string();
    assert!(text(&bench, "out/PROGMOD/MainMod.mod").contains(&number), "pHome and p1 are one pose");
    let report: serde_json::Value = serde_json::from_slice(&bench.read("r.json")).expect("JSON");
    assert_eq!(report["files"][0]["targets"].as_array().map(Vec::len), Some(1));
}

fn text(bench: &Bench, name: &str) -> String {
    String::from_utf8(bench.read(name)).expect("text")
}

#[test]
fn a_module_given_alone_brings_its_task() {
    let bench = task();
    let run = bench.run(&["inspect", "T/PROGMOD/points.mod"]);
    assert!(run.stderr.is_empty() && run.status == Some(0), "{}", run.stderr);
    let listed = String::from_utf8(run.stdout).expect("text");
    assert!(listed.contains("2 correctable") && listed.contains("tool tGun"), "{listed}");
    let run = bench.run(&["correct", "--model", "model.yaml", "T/PROGMOD/MainMod.mod", "-o", "one.mod"]);
    assert_eq!(run.status, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("--out-dir"), "{}", run.stderr);
}

#[test]
fn programs_that_exclude_each_other_leave_what_they_share_alone() {
    let bench = task();
    bench.write("T/PROGMOD/OtherMod.mod", main("pHome").replace("MODULE MainMod", "MODULE OtherMod"));
    let run = bench.run(&["correct", "--model", "model.yaml", "T", "--out-dir", "out", "--report", "r.jsonl"]);
    assert_eq!(run.status, Some(0), "{}", run.stderr);
    // Each corrects its own position; the common one is nobody's to change, and each is told so.
    assert!(run.stderr.contains("4 file(s): 2 corrected, 0 joint, 2 computed, 0 refused"), "{}", run.stderr);
    assert_eq!(bench.read("out/PROGMOD/points.mod"), bench.read("T/PROGMOD/points.mod"));
    assert!(run.stderr.contains("points.mod, which other programs share"), "{}", run.stderr);
    let lines: Vec<serde_json::Value> =
        text(&bench, "r.jsonl").lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let last = lines.last().expect("a summary");
    assert_eq!((last["summary"]["computed"].as_u64(), last["summary"]["files"].as_u64()), (Some(2), Some(4)));
}
