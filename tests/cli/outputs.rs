//! Places that are no plain files: a link stays a link, and a pipe or a device is written and not replaced.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::process::Command;

use super::bench::Bench;

const CORRECT: [&str; 5] = ["correct", "--model", "model.yaml", "job.mod", "-o"];

fn corrected(bench: &Bench) -> Vec<u8> {
    bench.run(&CORRECT[..4]).stdout
}

#[test]
fn the_file_behind_a_link_is_written() {
    let bench = Bench::new();
    bench.write("store/old.mod", "old");
    symlink(bench.path("store/old.mod"), bench.path("link.mod")).expect("a link");
    let run = bench.run(&[&CORRECT[..], &["link.mod"]].concat());
    assert_eq!(run.status, Some(0), "{}", run.stderr);
    assert!(fs::symlink_metadata(bench.path("link.mod")).expect("it is there").is_symlink());
    assert_eq!(bench.read("store/old.mod"), corrected(&bench));
}

#[test]
fn a_link_to_the_program_itself_is_refused() {
    let bench = Bench::new();
    let before = bench.read("job.mod");
    symlink(bench.path("job.mod"), bench.path("link.mod")).expect("a link");
    let run = bench.run(&[&CORRECT[..], &["link.mod"]].concat());
    assert_eq!(run.status, Some(2), "{}", run.stderr);
    assert_eq!(bench.read("job.mod"), before);
}

#[test]
fn a_pipe_is_written_and_stays_a_pipe() {
    let bench = Bench::new();
    for (arguments, name) in
        [(&CORRECT[..], "program"), (&["correct", "--model", "model.yaml", "job.mod", "--report"], "report")]
    {
        let pipe = bench.path(name);
        assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || fs::read(pipe).expect("read")
        });
        let run = bench.run(&[arguments, &[name]].concat());
        assert_eq!(run.status, Some(0), "{}", run.stderr);
        assert!(fs::metadata(&pipe).expect("it is there").file_type().is_fifo());
        let read = reader.join().expect("read");
        match name {
            "program" => assert_eq!(read, corrected(&bench)),
            _ => assert!(read.starts_with(b"{") && read.ends_with(b"}\n")),
        }
    }
}
