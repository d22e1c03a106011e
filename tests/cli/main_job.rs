//! `correct` over one program: standard input to standard output, files, reports, options.

use serde_json::Value;

use super::bench::{Bench, REACHED, program};

fn json(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).expect("JSON")
}

/// The text without the bytes that numbers are made of.
fn without_digits(text: &[u8]) -> Vec<u8> {
    text.iter().copied().filter(|byte| !byte.is_ascii_digit() && !matches!(byte, b'.' | b'-')).collect()
}

#[test]
fn standard_input_to_standard_output() {
    let bench = Bench::new();
    let job = bench.read("job.mod");
    for arguments in [&["correct", "--model", "model.yaml"][..], &["correct", "--model", "model.yaml", "-", "-o", "-"]]
    {
        let run = bench.run_with(arguments, &job);
        assert_eq!(run.status, Some(0), "{}", run.stderr);
        assert_ne!(run.stdout, job);
        assert_eq!(without_digits(&run.stdout), without_digits(&job));
        assert!(run.stderr.contains("<stdin>: 1 corrected"), "{}", run.stderr);
    }
}

#[test]
fn a_model_without_error_gives_every_byte_back() {
    let bench = Bench::new();
    let mut job = b"! Gr\xfc\xdfe\r\n".to_vec();
    job.extend(program(REACHED, "tGun").trim_end().replace('\n', "\r\n").bytes());
    let run = bench.run_with(&["correct", "--model", "robot.yaml"], &job);
    assert_eq!((run.status, run.stdout), (Some(0), job));
}

#[test]
fn a_file_gets_what_standard_output_would() {
    let bench = Bench::new();
    let to_file = bench.run(&["correct", "--model", "model.yaml", "job.mod", "-o", "out.mod"]);
    assert_eq!((to_file.status, to_file.stdout.len()), (Some(0), 0));
    let run = bench.run(&["correct", "--model", "model.yaml", "job.mod"]);
    assert_eq!(run.stdout, bench.read("out.mod"));
    assert_eq!(bench.files(), ["job.mod", "model.yaml", "out.mod", "robot.yaml"]);
}

#[test]
fn a_program_is_not_overwritten() {
    let bench = Bench::new();
    let job = bench.read("job.mod");
    for arguments in [
        &["correct", "--model", "model.yaml", "job.mod", "-o", "job.mod"][..],
        &["correct", "--model", "model.yaml", "job.mod", "-o", "./job.mod"],
        &["correct", "--model", "model.yaml", "job.mod", "-o", "out.mod", "--report", "job.mod"],
        &["correct", "--model", "model.yaml", "job.mod", "--out-dir", "."],
        &["correct", "--model", "model.yaml", "job.mod", "-o", "out.mod", "--report", "out.mod"],
        &["correct", "--model", "model.yaml", "job.mod", "--report", "-"],
        &["correct", "--model", "model.yaml", "job.mod", "-o", "no/folder/out.mod", "--report", "report.json"],
        &["correct", "--model", "model.yaml", "job.mod", "job.mod", "-o", "out.mod"],
        &["correct", "--model", "model.yaml", "job.mod", "-o", "out.mod", "--out-dir", "out"],
    ] {
        let run = bench.run(arguments);
        assert_eq!(run.status, Some(2), "{arguments:?}: {}", run.stderr);
        assert_eq!(bench.read("job.mod"), job);
        assert_eq!(bench.files(), ["job.mod", "model.yaml", "robot.yaml"], "{arguments:?}");
    }
}

#[test]
fn the_report_has_the_keys_of_the_contract() {
    let bench = Bench::new();
    let text = program(REACHED, "tGun").replace(
        "  ENDPROC",
        "    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tGun;\n    MoveJ p1,v5,z1,tGun;\n  ENDPROC",
    );
    bench.write("job.mod", &text);
    let run = bench.run(&["correct", "--model", "model.yaml", "job.mod", "-o", "out.mod", "--report", "report.json"]);
    assert_eq!(run.status, Some(0), "{}", run.stderr);
    let report = json(&bench.read("report.json"));
    assert_eq!(report["schema"], "falsetarget/targets/1");
    assert_eq!(
        report["summary"],
        serde_json::json!({"corrected": 1, "joint": 1, "computed": 0, "refused": 0, "files": 1})
    );
    let file = &report["files"][0];
    assert_eq!((&file["path"], &file["dialect"], &file["newline"]), (&"job.mod".into(), &"rapid".into(), &"lf".into()));
    assert!(file["encoding"].is_string());
    let target = &file["targets"][0];
    let span: Vec<usize> =
        target["span"].as_array().expect("two").iter().map(|at| at.as_u64().expect("offset") as usize).collect();
    assert_eq!(&text[span[0]..span[1]], REACHED);
    for (key, value) in [
        ("name", serde_json::json!("p1")),
        ("line", serde_json::json!(3)),
        ("kind", serde_json::json!("cartesian")),
        ("class", serde_json::json!("corrected")),
        ("reason", Value::Null),
        ("motion", serde_json::json!("MoveL")),
        ("tool", serde_json::json!("tGun")),
        ("frame", serde_json::json!("wobj0")),
        ("uses", serde_json::json!([5, 7])),
        ("xyz_mm", serde_json::json!([1500.0, 100.0, 1200.0])),
        ("quat_wxyz", serde_json::json!([0.0, 0.0, 1.0, 0.0])),
    ] {
        assert_eq!(target[key], value, "{key}");
    }
    let correction_mm = target["correction_mm"].as_f64().expect("a number");
    assert!((0.1..5.0).contains(&correction_mm), "{correction_mm}");
    assert!(target["correction_deg"].is_f64() && target["iterations"].is_u64());
    assert!(target.as_object().expect("keys").contains_key("u95_mm"));
    let joint = &file["targets"][1];
    assert_eq!((&joint["class"], &joint["kind"]), (&"joint".into(), &"joint".into()));
    assert_eq!(joint["joints_deg"], serde_json::json!([0.0, 0.0, 0.0, 0.0, 30.0, 0.0]));
}

#[test]
fn report_on_standard_output_leaves_it_alone_otherwise() {
    let bench = Bench::new();
    let run = bench.run(&["correct", "--model", "model.yaml", "job.mod", "-o", "out.mod", "--report", "-"]);
    assert_eq!(json(&run.stdout)["summary"]["corrected"], 1);
}

#[test]
fn a_refused_run_still_reports() {
    let bench = Bench::new();
    bench.write("bad.mod", program(REACHED, "tNix"));
    let run = bench.run(&["correct", "--model", "model.yaml", "bad.mod", "-o", "out.mod", "--report", "report.json"]);
    assert_eq!(run.status, Some(1));
    assert!(!bench.path("out.mod").exists());
    let target = &json(&bench.read("report.json"))["files"][0]["targets"][0];
    assert_eq!(target["class"], "refused");
    assert!(target["reason"].as_str().expect("a reason").contains("tNix"));
}

#[test]
fn allow_partial_writes_the_rest() {
    let bench = Bench::new();
    let far = REACHED.replace("1500", "4500");
    let text = program(REACHED, "tGun")
        .replace("  PROC", &format!("  CONST robtarget p2:={far};\n  PROC"))
        .replace("  ENDPROC", "    MoveL p2,v100,fine,tGun;\n  ENDPROC");
    bench.write("job.mod", &text);
    let refused = bench.run(&["correct", "--model", "model.yaml", "job.mod", "-o", "out.mod"]);
    assert_eq!(refused.status, Some(1));
    assert!(!bench.path("out.mod").exists());
    let partial = bench.run(&["correct", "--model", "model.yaml", "--allow-partial", "job.mod", "-o", "out.mod"]);
    assert_eq!(partial.status, Some(1), "the answer is still no");
    let out = String::from_utf8(bench.read("out.mod")).expect("text");
    assert!(out.contains(&far) && !out.contains(REACHED), "{out}");
}

#[test]
fn inside_only_needs_a_region_and_keeps_to_it() {
    let bench = Bench::new();
    let region = |max_deg: f64| {
        format!("region: {{min_deg: [-90, -60, -90, -90, -90, -90], max_deg: [90, 60, 60, {max_deg}, 120, 90]}}\n")
    };
    bench.write("inside.yaml", Bench::model_of(Bench::robot(), &region(90.0)));
    bench
        .write("outside.yaml", Bench::model_of(Bench::robot(), &region(90.0).replace("max_deg: [90", "max_deg: [-80")));
    let with = |model| bench.run(&["correct", "--model", model, "--inside-only", "job.mod", "-o", "out.mod"]);
    let none = with("model.yaml");
    assert_eq!(none.status, Some(2));
    assert!(none.stderr.contains("model.yaml names no calibrated region"), "{}", none.stderr);
    let outside = with("outside.yaml");
    assert_eq!(outside.status, Some(1));
    assert!(outside.stderr.contains("outside the calibrated region: joint 1 at"), "{}", outside.stderr);
    assert!(!bench.path("out.mod").exists());
    assert_eq!(with("inside.yaml").status, Some(0));
}

#[test]
fn joint_targets_only_when_asked_for() {
    let bench = Bench::new();
    let text = "MODULE A\n  PROC main()\n    MoveAbsJ [[10,5.5,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n  ENDPROC\nENDMODULE\n";
    let left = bench.run_with(&["correct", "--model", "model.yaml"], text.as_bytes());
    assert_eq!((left.status, &left.stdout[..]), (Some(0), text.as_bytes()));
    let same = bench.run_with(&["correct", "--model", "robot.yaml", "--joint-targets"], text.as_bytes());
    assert_eq!((same.status, &same.stdout[..]), (Some(0), text.as_bytes()));
    let corrected = bench.run_with(&["correct", "--model", "model.yaml", "--joint-targets"], text.as_bytes());
    assert_eq!(corrected.status, Some(0), "{}", corrected.stderr);
    assert_ne!(corrected.stdout, text.as_bytes());
    assert_eq!(without_digits(&corrected.stdout), without_digits(text.as_bytes()));
}

#[test]
fn a_cell_file_gives_what_the_program_only_names() {
    let bench = Bench::new();
    bench.write("bad.mod", program(REACHED, "tNix"));
    bench.write("cell.yaml", "schema: falsetarget/cell/1\ntools: {tnix: {xyz_mm: [0, 0, 200], rpy_deg: [0, 0, 0]}}\n");
    let run = bench.run(&["correct", "--model", "model.yaml", "--cell", "cell.yaml", "bad.mod"]);
    assert_eq!(run.status, Some(0), "{}", run.stderr);
}

#[test]
fn shared_targets_are_split_when_asked_for() {
    let bench = Bench::new();
    let frame = |x: f64| format!("[FALSE,TRUE,\"\",[[{x},0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]");
    let text = program(&REACHED.replace("1500", "100"), "tGun\\WObj:=wA")
        .replace(
            "  CONST",
            &format!("  PERS wobjdata wA:={};\n  PERS wobjdata wB:={};\n  CONST", frame(1400.0), frame(1450.0)),
        )
        .replace("]];\n  PROC", "]]; ! seam\n  PROC")
        .replace(
            "  ENDPROC",
            "    MoveL Offs(P1,0,0,50),v100,fine,tGun\\WObj:=wB;\n    MoveL P1,v100,fine,tGun\\WObj:=wB;\n  ENDPROC",
        );
    bench.write("job.mod", &text);
    let refused = bench.run(&["correct", "--model", "model.yaml", "job.mod", "-o", "out.mod"]);
    assert_eq!(refused.status, Some(1), "{}", refused.stderr);
    assert!(
        refused.stderr.contains("used with different tools, frames or loads in lines 7 and 9"),
        "{}",
        refused.stderr
    );
    assert!(!bench.path("out.mod").exists());

    let split =
        ["correct", "--split-shared", "--model", "model.yaml", "job.mod", "-o", "out.mod", "--report", "r.json"];
    let run = bench.run(&split);
    assert_eq!(run.status, Some(0), "{}", run.stderr);
    let out = String::from_utf8(bench.read("out.mod")).expect("text");
    let copied = text
        .replace(" ! seam\n", &format!(" ! seam\n  CONST robtarget p1_2:={};\n", REACHED.replace("1500", "100")))
        .replace("Offs(P1,", "Offs(p1_2,")
        .replace("MoveL P1,", "MoveL p1_2,");
    assert_eq!(without_digits(out.as_bytes()), without_digits(copied.as_bytes()));
    assert!(out.contains("Offs(p1_2,") && out.contains("MoveL p1_2,") && out.contains("MoveL p1,"), "{out}");
    assert_eq!(json(&bench.read("r.json"))["summary"]["corrected"], 3);

    let perfect = bench.run(&["correct", "--split-shared", "--model", "robot.yaml", "job.mod"]);
    assert_eq!(perfect.stdout, text.as_bytes());
}

#[test]
fn what_has_no_name_to_spare_is_split_by_its_value() {
    let bench = Bench::new();
    bench.write(
        "cell.yaml",
        "schema: falsetarget/cell/1\ntools:\n  \"1\": {xyz_mm: [0, 0, 200]}\n  \"2\": {xyz_mm: [80, 0, 260]}\n",
    );
    let array = "MODULE A\n  PERS tooldata t1:=[TRUE,[[0,0,200],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n  \
                 PERS tooldata t2:=[TRUE,[[80,0,260],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n  \
                 CONST robtarget p{2}:=[VALUE,VALUE];\n  PROC main()\n    MoveL p{1},v1,z1,t1;\n    \
                 MoveL p{2},v1,z1,t1;\n    MoveL p{2},v1,z1,t2;\n    MoveL p{2},v1,z1,t1;\n  ENDPROC\nENDMODULE\n"
        .replace("VALUE", REACHED);
    bench.write("array.mod", &array);
    let pose = "(1500.000,100.000,1200.000,180.000,0.000,0.000,&H0000)";
    let job = format!(
        "Program File Format Version : 1.6  MechType: 0(X)  TotalAxis: 6  AuxAxis: 0\n     P1={pose}\n\
         S1   MOVE L,P1,S=60%,A=0,T=1\nS2   MOVE L,P1,S=60%,A=0,T=2\n     END\n"
    );
    bench.write("0001.JOB", &job);
    let aggregate = "{X 1500.0,Y 100.0,Z 1200.0,A 0.0,B 0.0,C 180.0}";
    let routine = format!(
        "DEF job( )\nDECL E6POS XP1\n$BASE=$WORLD\nXP1={aggregate}\n$TOOL=TOOL_DATA[1]\nLIN XP1 C_DIS\n\
         $TOOL=TOOL_DATA[2]\nLIN XP1\nEND\n"
    );
    bench.write("job.src", &routine);
    let script = "def job():\n  p1=p[1.5,0.1,1.2,3.1415926,0,0]\n  set_tcp(p[0,0,0.2,0,0,0])\n  movel(p1,a=1)\n  \
                  set_tcp(p[0.08,0,0.26,0,0,0])\n  movel(p1,a=2)\nend\n";
    bench.write("job.script", script);
    for (name, by_value) in [
        ("job.src", routine.replace("LIN XP1\n", &format!("LIN {aggregate}\n"))),
        ("job.script", script.replace("movel(p1,a=2)", "movel(p[1.5,0.1,1.2,3.1415926,0,0],a=2)")),
        ("array.mod", array.replace("p{2},v1,z1,t2", &format!("{REACHED},v1,z1,t2"))),
        ("0001.JOB", job.replace("P1,S=60%,A=0,T=2", &format!("{pose},S=60%,A=0,T=2"))),
    ] {
        let run = |model, more: &[&str]| {
            bench.run(&[&["correct", "--model", model, "--cell", "cell.yaml", name][..], more].concat())
        };
        let refused = run("model.yaml", &[]);
        assert_eq!(refused.status, Some(1), "{}", refused.stderr);
        let split = run("model.yaml", &["--split-shared", "-o", &format!("out-{name}")]);
        assert_eq!(split.status, Some(0), "{}", split.stderr);
        // The same program, written out by hand, needs no splitting.
        bench.write(name, &by_value);
        let by_hand = run("model.yaml", &[]);
        assert_eq!(by_hand.status, Some(0), "{}", by_hand.stderr);
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
        assert_eq!(text(bench.read(&format!("out-{name}"))), text(by_hand.stdout));
    }
}

#[test]
fn a_target_with_an_absurd_number_is_refused_like_any_out_of_reach() {
    let bench = Bench::new();
    bench.write("job.mod", program(&REACHED.replace("1500", "251E222"), "tGun"));
    let run = bench.run(&["correct", "--model", "model.yaml", "job.mod", "-o", "out.mod"]);
    assert_eq!(run.status, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("out of reach") && !bench.path("out.mod").exists(), "{}", run.stderr);
}
