//! The hot folder.

use std::io::Write;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use super::bench::{Bench, REACHED, program};

const QUICK: &str = "0.2";

fn shop() -> Bench {
    let bench = Bench::new();
    bench.write("in/notes.txt", "");
    bench
}

fn arguments<'a>(settle: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let start = ["watch", "--model", "model.yaml", "in", "out", "--every", "0.05", "--settle", settle];
    start.iter().chain(more).copied().collect()
}

struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn start(bench: &Bench, settle: &str) -> Running {
    Running(bench.command(&arguments(settle, &[])).stderr(Stdio::null()).spawn().expect("started"))
}

fn wait_for(bench: &Bench, name: &str) {
    let started = Instant::now();
    while !bench.path(name).exists() {
        assert!(started.elapsed() < Duration::from_secs(30), "{name} never came");
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn programs_are_corrected_and_failures_moved_aside_with_a_reason() {
    let bench = shop();
    bench.write("in/good.mod", program(REACHED, "tGun"));
    bench.write("in/deep/far.mod", program(&REACHED.replace("1500", "4500"), "tGun"));
    bench.write("in/cut.mod", "MODULE A\n  PROC main()\n    MoveL p1,v1");
    bench.write("in/garbage.mod", "nothing of the kind");
    let run = bench.run(&arguments(QUICK, &["--once"]));
    assert_eq!(run.status, Some(2), "{}", run.stderr);
    let alone = bench.run(&["correct", "--model", "model.yaml", "in/good.mod"]);
    assert_eq!(bench.read("out/good.mod"), alone.stdout);
    for (name, says) in
        [("deep/far.mod", "out of reach by 20"), ("cut.mod", "cut.mod:3:5"), ("garbage.mod", "no robot language")]
    {
        assert!(!bench.path(&format!("in/{name}")).exists() && !bench.path(&format!("out/{name}")).exists(), "{name}");
        assert!(bench.path(&format!("in/failed/{name}")).is_file());
        let why = String::from_utf8(bench.read(&format!("in/failed/{name}.txt"))).expect("text");
        assert!(why.contains(says), "{name}: {why}");
    }
    assert!(bench.path("in/good.mod").is_file() && bench.path("in/notes.txt").is_file());
    // Nothing is done twice, also when the robot has taken the program away.
    std::fs::remove_file(bench.path("out/good.mod")).expect("taken");
    assert_eq!(bench.run(&arguments(QUICK, &["--once"])).status, Some(0));
    assert!(!bench.path("out/good.mod").exists());
}

#[test]
fn a_program_that_is_still_written_is_waited_for() {
    let bench = shop();
    let running = start(&bench, QUICK);
    let text = program(REACHED, "tGun");
    let (first, second) = text.split_at(text.len() / 2);
    let mut file = std::fs::File::create(bench.path("in/slow.mod")).expect("a file");
    file.write_all(first.as_bytes()).expect("written");
    file.flush().expect("written");
    std::thread::sleep(Duration::from_millis(700));
    assert!(!bench.path("out/slow.mod").exists() && !bench.path("in/failed").exists(), "half a program was taken");
    file.write_all(second.as_bytes()).expect("written");
    drop(file);
    wait_for(&bench, "out/slow.mod");
    let first_result = bench.read("out/slow.mod");
    // A program that is exported again is corrected again.
    let other = text.replace("1500", "1510");
    bench.write("in/slow.mod", &other);
    let started = Instant::now();
    while bench.read("out/slow.mod") == first_result && started.elapsed() < Duration::from_secs(30) {
        std::thread::sleep(Duration::from_millis(10));
    }
    assert_eq!(bench.read("out/slow.mod"), bench.run(&["correct", "--model", "model.yaml", "in/slow.mod"]).stdout);
    drop(running);
}

#[test]
fn files_of_one_job_that_arrive_one_after_the_other_are_corrected_together() {
    let bench = shop();
    let running = start(&bench, "2");
    let tool = "PERS tooldata tGun:=[TRUE,[[0,0,200],[1,0,0,0]],[10,[0,0,100],[1,0,0,0],0,0,0]];";
    bench.write("in/moves.mod", "MODULE M\n  PROC main()\n    MoveL p1,v1,fine,tGun;\n  ENDPROC\nENDMODULE\n");
    std::thread::sleep(Duration::from_millis(100));
    bench.write("in/points.mod", format!("MODULE P\n  {tool}\n  CONST robtarget p1:={REACHED};\nENDMODULE\n"));
    wait_for(&bench, "out/points.mod");
    wait_for(&bench, "out/moves.mod");
    assert_ne!(bench.read("out/points.mod"), bench.read("in/points.mod"));
    drop(running);
}
