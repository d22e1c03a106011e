//! Every bad input gives a message with file, line, column and reason, the exit status of the contract, nothing on
//! standard output and no file: neither the output nor a temporary one.

use super::bench::{Bench, REACHED, program};

/// Runs `correct` over one program, to a file and to standard output, and checks what every refusal owes.
fn refused(bench: &Bench, model: &str, job: &str, status: i32, says: &[&str]) {
    let before = bench.files();
    for output in ["out.mod", "-"] {
        let run = bench.run(&["correct", "--model", model, job, "-o", output]);
        for part in says {
            assert!(run.stderr.contains(part), "`{part}` is not in:\n{}", run.stderr);
        }
        assert_eq!(run.status, Some(status), "{}", run.stderr);
        assert!(run.stdout.is_empty(), "{}", String::from_utf8_lossy(&run.stdout));
        assert_eq!(bench.files(), before, "files changed");
    }
}

fn bad_program(text: impl AsRef<[u8]>, status: i32, says: &[&str]) {
    let bench = Bench::new();
    bench.write("bad.mod", text);
    refused(&bench, "model.yaml", "bad.mod", status, says);
}

fn bad_robot(text: impl AsRef<[u8]>, says: &[&str]) {
    let bench = Bench::new();
    bench.write("bad.yaml", text);
    refused(&bench, "bad.yaml", "job.mod", 2, says);
}

#[test]
fn unknown_tool() {
    let says = ["bad.mod:3:23", "tool `tNix` is defined neither in the program nor in the cell file", "line 5"];
    bad_program(program(REACHED, "tNix"), 1, &says);
}

#[test]
fn unknown_frame() {
    let says = ["bad.mod:3:23", "frame `wNix` is defined neither in the program nor in the cell file"];
    bad_program(program(REACHED, "tGun\\WObj:=wNix"), 1, &says);
}

#[test]
fn out_of_reach() {
    let far = REACHED.replace("1500", "4500");
    bad_program(program(&far, "tGun"), 1, &["bad.mod:3:23", "`p1`", "out of reach by 20", " mm"]);
}

#[test]
fn an_additional_axis_that_no_cell_file_describes() {
    let far = REACHED.replace("1500", "4500").replace("[9E9,9E9", "[3079.8,9E9");
    let says = ["bad.mod:3:23", "eax_a at 3079.8", "no cell file (--cell) says", "axes: [{name: eax_a"];
    bad_program(program(&far, "tGun"), 1, &says);
}

/// Axis 5 begins at 89.999 deg here; the target is taught at 90 deg, and its correction needs less.
#[test]
fn beyond_a_joint_limit_after_correction() {
    let bench = Bench::new();
    let narrow = Bench::robot().replace("min_deg: -120, max_deg: 120", "min_deg: 89.999, max_deg: 120");
    assert_ne!(narrow, Bench::robot());
    bench.write("narrow.yaml", &narrow);
    bench.write("narrow_model.yaml", Bench::model_of(&narrow, ""));
    // Joints 0, 0, 0, 0, 90, 0 of the nominal robot with the tool 200 mm out.
    let at_limit = "[[1462.5,0,1655],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    bench.write("limit.mod", program(at_limit, "tGun"));
    assert_eq!(bench.run(&["correct", "--model", "narrow.yaml", "limit.mod"]).status, Some(0));
    let says = ["limit.mod:3:23", "after correction joint 5 would stand at 89.9", "outside 89.999 to 120.000 deg"];
    refused(&bench, "narrow_model.yaml", "limit.mod", 1, &says);
}

#[test]
fn broken_yaml() {
    bad_robot("schema: falsetarget/robot/1\nname: a\njoints: [\n", &["bad.yaml:4:1", "error[yaml]"]);
    let tabbed = Bench::robot().replace("joints:\n", "joints:\n\t- {name: J0}\n");
    bad_robot(tabbed, &["bad.yaml:", "error[yaml]"]);
}

#[test]
fn unknown_key() {
    bad_robot(Bench::robot().replace("name: abb", "nmae: abb"), &["bad.yaml:4:1", "unknown field `nmae`", "`name`"]);
    let in_joint = Bench::robot().replacen("d_mm: 780", "d_cm: 78", 1);
    bad_robot(in_joint, &["bad.yaml:7:", "unknown field `d_cm`", "`d_mm`"]);
    let in_model = Bench::model_of(Bench::robot(), "efects: []\n");
    bad_robot(in_model, &["bad.yaml:", "unknown field `efects`", "`effects`"]);
}

#[test]
fn a_robot_a_thousand_times_too_large_or_too_small() {
    let scaled = |factor: f64| -> String {
        let scale = |word: &str| match word.trim_end_matches(',').parse::<f64>() {
            Ok(number) => format!("{}{}", number * factor, if word.ends_with(',') { "," } else { "" }),
            Err(_) => word.to_string(),
        };
        let mut length_next = false;
        let words = Bench::robot().split(' ').map(|word| {
            let scaled = if length_next { scale(word) } else { word.to_string() };
            length_next = word == "d_mm:" || word == "a_mm:";
            scaled
        });
        words.collect::<Vec<_>>().join(" ")
    };
    bad_robot(scaled(1000.0), &["bad.yaml:6:1", "error[unit-scale]", "3717.5000 m", "0.2 to 20 m"]);
    bad_robot(scaled(0.001), &["bad.yaml:6:1", "error[unit-scale]", "0.0037 m", "millimetres"]);
    let model = Bench::model_of(&scaled(0.001), "");
    bad_robot(model, &["bad.yaml:5:3", "error[unit-scale]", "0.0037 m"]);
}

#[test]
fn a_calibration_error_of_a_robots_size() {
    let model = Bench::model_of(Bench::robot(), "").replace("value: -0.0008", "value: 0.8");
    bad_robot(model, &["bad.yaml:23:3", "error[unit-scale]", "no calibration error"]);
}

#[test]
fn a_program_in_metres() {
    let metres = REACHED.replace("1500,100,1200", "1.5,0.1,1.2");
    bad_program(program(&metres, "tGun"), 2, &["bad.mod:3:23", "error[unit-scale]", "in metres?", "--trust-units"]);
    let bench = Bench::new();
    let pose = "(0.640,0.380,0.3005,180.000,0.000,-150.000)R";
    let job = format!(
        "Program File Format Version : 1.6  MechType: 370  TotalAxis: 6  AuxAxis: 0\r\n\
         S1   MOVE L,S=50%,A=3,T=0  {pose}\r\n     END\r\n"
    );
    bench.write("metres.job", job);
    refused(&bench, "model.yaml", "metres.job", 2, &["metres.job:2:28", "error[unit-scale]", "in metres?"]);
}

#[test]
fn a_truncated_program() {
    let whole = program(REACHED, "tGun");
    let cut = |behind: &str| whole[..whole.find(behind).expect("in it") + behind.len()].to_string();
    bad_program(cut("[[1500,100"), 2, &["bad.mod:3:", "error[truncated]"]);
    bad_program(cut("MoveL p1,v100"), 2, &["bad.mod:5:5", "error[truncated]", "`;` is missing"]);
    bad_program(cut("fine,tGun;\n"), 2, &["bad.mod:4:3", "error[truncated]", "`ENDPROC` is missing"]);
}

#[test]
fn a_program_of_another_dialect() {
    bad_program("#!/bin/sh\nmake all\n", 2, &["bad.mod:1:1", "no robot language that this tool knows"]);
    let bench = Bench::new();
    let run = bench.run(&["correct", "--model", "model.yaml", "--dialect", "hyundai", "job.mod", "-o", "out.mod"]);
    assert_eq!(run.status, Some(2));
    assert!(
        run.stderr.contains("job.mod:1:1") && run.stderr.contains("this is ABB RAPID, not Hyundai"),
        "{}",
        run.stderr
    );
    assert!(!bench.path("out.mod").exists());
    let run = bench.run(&["correct", "--model", "model.yaml", "--dialect", "karel", "job.mod"]);
    assert_eq!(run.status, Some(2));
    assert!(run.stderr.contains("known dialects are rapid"), "{}", run.stderr);
}

#[test]
fn an_empty_file() {
    bad_program("", 2, &["bad.mod:1:1", "the program is empty"]);
    bad_program("\r\n \t\r\n", 2, &["bad.mod:1:1", "the program is empty"]);
    bad_robot("", &["bad.yaml:1:1", "the file is empty; expected a model file"]);
}

#[test]
fn a_directory_and_a_missing_file() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("folder")).expect("made");
    refused(&bench, "model.yaml", "folder", 2, &["folder is a directory; expected a file"]);
    refused(&bench, "folder", "job.mod", 2, &["folder is a directory; expected a file"]);
    refused(&bench, "model.yaml", "nowhere.mod", 2, &["nowhere.mod", "No such file"]);
    refused(&bench, "nowhere.yaml", "job.mod", 2, &["nowhere.yaml", "No such file"]);
    refused(&bench, "nobody", "job.mod", 2, &["`nobody` is neither a file nor a built-in robot"]);
}

/// Bytes of a linear congruence, so that the test is the same every day.
fn random_bytes(count: usize) -> Vec<u8> {
    let mut state = 12345u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 56) as u8
    };
    (0..count).map(|_| next()).collect()
}

#[test]
fn random_bytes_as_anything() {
    let bytes = random_bytes(4000);
    bad_program(&bytes, 2, &["bad.mod:1:1", "binary data, not the text of a program"]);
    bad_robot(&bytes, &["bad.yaml:1:", "not UTF-8"]);
    let bench = Bench::new();
    bench.write("bytes.mod", &bytes);
    let run = bench.run(&["correct", "--model", "model.yaml", "--cell", "bytes.mod", "job.mod", "-o", "out.mod"]);
    assert_eq!(run.status, Some(2));
    assert!(!bench.path("out.mod").exists());
    for dialect in ["rapid", "hyundai"] {
        let run = bench.run(&["correct", "--model", "model.yaml", "--dialect", dialect, "bytes.mod", "-o", "out.mod"]);
        assert_eq!(run.status, Some(2), "{}", run.stderr);
        assert!(!bench.path("out.mod").exists());
        let obeyed = |c: char| c.is_control() && c != '\n';
        assert!(!run.stderr.contains(obeyed), "a terminal would obey {:?}", run.stderr);
    }
}

#[test]
fn a_program_where_a_robot_file_belongs() {
    let says = ["bad.yaml:1:1", "invalid type", "expected a model file (schema: falsetarget/model/1)"];
    bad_robot(program(REACHED, "tGun"), &says);
}

#[test]
fn columns_are_right_far_behind_the_start_of_a_line() {
    let bench = Bench::new();
    let far = REACHED.replace("1500", "4500");
    let one_line = program(&far, "tGun").replace('\n', " ");
    bench.write("line.mod", &one_line);
    let column = one_line.find("[[4500").expect("in it") + 1;
    assert!(column > 100);
    bench.write("long.mod", format!("{}{one_line}", " ".repeat(300)));
    refused(&bench, "model.yaml", "line.mod", 1, &[&format!("line.mod:1:{column}")]);
    refused(&bench, "model.yaml", "long.mod", 1, &[&format!("long.mod:1:{}", column + 300)]);
}
