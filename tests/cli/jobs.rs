//! Jobs of several files on the command line.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn programs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("programs/krl")
}

/// A folder with the shipped KUKA programs in it, laid out as a controller has them, and a model of a robot that bends.
fn shop() -> tempfile::TempDir {
    let shop = tempfile::tempdir().expect("a folder");
    let program = shop.path().join("R1/Program/line");
    let system = shop.path().join("R1/System");
    fs::create_dir_all(&program).expect("folders");
    fs::create_dir_all(&system).expect("folders");
    for name in ["side_panel.src", "side_panel.dat", "door_seal.src", "door_seal.dat"] {
        fs::copy(programs().join(name), program.join(name)).expect("a copy");
    }
    fs::copy(programs().join("$config.dat"), system.join("$config.dat")).expect("a copy");
    fs::write(program.join("notes.txt"), "welds\n").expect("a file");
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("calibration/kuka-kr210-r2700/robot.yaml");
    let mut model = fs::read_to_string(robot).expect("the robot");
    model.push_str("joint_compliance_rad_per_nm: [0, 1.0e-7, 2.0e-7, 3.0e-7, 3.0e-7, 0]\n");
    fs::write(shop.path().join("model.yaml"), model).expect("a file");
    shop
}

fn run(shop: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_falsetarget")).current_dir(shop).args(arguments).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

const SRC: &str = "R1/Program/line/side_panel.src";
const DAT: &str = "R1/Program/line/side_panel.dat";

#[test]
fn a_program_brings_its_data_and_what_all_share() {
    let shop = shop();
    let both = run(shop.path(), &["inspect", "--json", SRC, DAT]);
    assert_eq!(both.status.code(), Some(0), "{}", text(&both.stderr));
    let alone = run(shop.path(), &["inspect", "--json", SRC]);
    assert_eq!(text(&alone.stdout), text(&both.stdout), "a file that came with an earlier one is listed once");
    let report: serde_json::Value = serde_json::from_slice(&alone.stdout).expect("JSON");
    let paths: Vec<&str> =
        report["files"].as_array().expect("files").iter().filter_map(|f| f["path"].as_str()).collect();
    assert_eq!(paths[..2], [SRC, DAT]);
    assert!(paths[2].ends_with("System/$config.dat"));
    let weld = &report["files"][1]["targets"][1];
    assert_eq!(
        (weld["name"].as_str(), weld["tool"].as_str(), weld["frame"].as_str()),
        (Some("XP2"), Some("2"), Some("1"))
    );
    assert_eq!(weld["uses_path"].as_str(), Some(SRC));
    assert_eq!(report["files"][2]["targets"][0]["class"].as_str(), Some("joint"));
}

#[test]
fn a_job_is_written_whole() {
    let shop = shop();
    let done = run(shop.path(), &["correct", "--model", "model.yaml", "--out-dir", "out", SRC]);
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    let names: Vec<String> = fs::read_dir(shop.path().join("out"))
        .expect("the folder")
        .map(|entry| entry.expect("a file").file_name().to_string_lossy().into_owned())
        .collect();
    assert_eq!(names.len(), 2, "{names:?}");
    let differs = |name: &str| {
        fs::read(shop.path().join("out").join(name)).expect("written")
            != fs::read(programs().join(name)).expect("shipped")
    };
    assert!(differs("side_panel.dat") && differs("side_panel.src"));
}

#[test]
fn a_single_output_is_refused_where_targets_stand_beside() {
    let shop = shop();
    let no = run(shop.path(), &["correct", "--model", "model.yaml", SRC, "-o", "one.src"]);
    assert_eq!(no.status.code(), Some(2));
    assert!(text(&no.stderr).contains("--out-dir"), "{}", text(&no.stderr));
    assert!(!shop.path().join("one.src").exists());
    // A robot without error changes nothing, so that one output is enough.
    let same = run(shop.path(), &["correct", "--model", "kuka-kr210-r2700", SRC, "-o", "one.src"]);
    assert_eq!(same.status.code(), Some(0), "{}", text(&same.stderr));
    assert_eq!(fs::read(shop.path().join("one.src")).ok(), fs::read(shop.path().join(SRC)).ok());
}

#[test]
fn a_folder_is_mirrored_with_unchanged_files_and_nothing_of_a_refused_job() {
    let shop = shop();
    let line = shop.path().join("R1/Program/line");
    let far = "DEF far( )\nBAS(#TOOL,1)\nBAS(#BASE,0)\nPTP XP1\nEND\n";
    fs::write(line.join("far.src"), far).expect("a file");
    let data = "DEFDAT far\nDECL E6POS XP1={X 9000.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0,S 2,T 2}\nENDDAT\n";
    fs::write(line.join("FAR.DAT"), data).expect("a file");
    let done = run(shop.path(), &["correct", "--model", "model.yaml", "--out-dir", "out", "--report", "r.json", "R1"]);
    assert_eq!(done.status.code(), Some(1), "{}", text(&done.stderr));
    let out = shop.path().join("out");
    for name in ["Program/line/side_panel.src", "Program/line/door_seal.dat", "System/$config.dat"] {
        assert!(out.join(name).is_file(), "{name} is missing");
    }
    assert_eq!(fs::read(out.join("System/$config.dat")).ok(), fs::read(programs().join("$config.dat")).ok());
    for name in ["Program/line/far.src", "Program/line/FAR.DAT", "Program/line/notes.txt"] {
        assert!(!out.join(name).exists(), "{name} was written");
    }
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(shop.path().join("r.json")).expect("the report")).expect("JSON");
    assert_eq!(report["summary"]["refused"].as_u64(), Some(1));
    assert_eq!(report["summary"]["files"].as_u64(), Some(7), "a shared file counts once");
}

#[test]
fn joint_targets_in_a_shared_file_stay_as_they_are() {
    let shop = shop();
    let done = run(
        shop.path(),
        &["correct", "--model", "model.yaml", "--joint-targets", "--out-dir", "out", "--report", "-", SRC],
    );
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    let report: serde_json::Value = serde_json::from_slice(&done.stdout).expect("JSON");
    let home = &report["files"][2]["targets"][0];
    assert_eq!((home["name"].as_str(), home["class"].as_str()), (Some("XHOME"), Some("joint")));
    assert!(home["reason"].as_str().expect("a reason").contains("share"));
}
