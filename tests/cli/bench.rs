//! A folder with a robot, a model with errors and a program, and a way to run the tool in it.

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

const ROBOT: &str = include_str!("../../calibration/abb-irb6640/robot.yaml");

const ERRORS: &str = "\
parameters:
  - {at: joint 2, quantity: offset, value: 0.001, unit: rad}
  - {at: joint 3, quantity: offset, value: -0.0008, unit: rad}
  - {at: joint 4, quantity: alpha, value: 0.0006, unit: rad}
  - {at: joint 5, quantity: offset, value: 0.0012, unit: rad}
  - {at: joint 6, quantity: alpha, value: 0.0006, unit: rad}
";

/// A robtarget that the robot reaches comfortably.
pub const REACHED: &str = "[[1500,100,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";

/// A program with one target in line 3 and one move to it in line 5.
pub fn program(target: &str, tool: &str) -> String {
    format!(
        "MODULE A\n  PERS tooldata tGun:=[TRUE,[[0,0,200],[1,0,0,0]],[10,[0,0,100],[1,0,0,0],0,0,0]];\n  \
         CONST robtarget p1:={target};\n  PROC main()\n    MoveL p1,v100,fine,{tool};\n  ENDPROC\nENDMODULE\n"
    )
}

/// A folder of its own for one test.
pub struct Bench {
    folder: tempfile::TempDir,
}

/// How a run ended.
pub struct Run {
    pub status: Option<i32>,
    pub stdout: Vec<u8>,
    pub stderr: String,
}

impl Bench {
    /// With `robot.yaml`, `model.yaml` (the same robot with errors) and `job.mod`.
    pub fn new() -> Self {
        let bench = Self { folder: tempfile::tempdir().expect("a folder") };
        bench.write("robot.yaml", ROBOT);
        bench.write("model.yaml", Self::model_of(ROBOT, ""));
        bench.write("job.mod", program(REACHED, "tGun"));
        bench
    }

    /// A model file with the errors of this bench around a robot file's text.
    pub fn model_of(robot: &str, more: &str) -> String {
        let lines = robot.lines().filter(|line| !line.starts_with("schema:") && !line.starts_with('#'));
        let inner: String = lines.map(|line| format!("  {line}\n")).collect();
        format!("schema: falsetarget/model/1\nrobot:\n{inner}{ERRORS}{more}")
    }

    /// The robot file's text.
    pub fn robot() -> &'static str {
        ROBOT
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, content).expect("written");
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).expect("the file is there")
    }

    /// Every file below the folder, sorted.
    pub fn files(&self) -> Vec<String> {
        fn walk(folder: &std::path::Path, found: &mut Vec<PathBuf>) {
            for entry in fs::read_dir(folder).expect("readable").flatten() {
                match entry.path().is_dir() {
                    true => walk(&entry.path(), found),
                    false => found.push(entry.path()),
                }
            }
        }
        let mut found = Vec::new();
        walk(self.folder.path(), &mut found);
        let below = |path: &PathBuf| path.strip_prefix(self.folder.path()).expect("below").display().to_string();
        let mut names: Vec<String> = found.iter().map(below).collect();
        names.sort();
        names
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_falsetarget"));
        command.args(arguments).current_dir(self.folder.path()).env_remove("NO_COLOR");
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Run {
        self.run_with(arguments, b"")
    }

    /// Runs with this on standard input.
    pub fn run_with(&self, arguments: &[&str], input: &[u8]) -> Run {
        let mut command = self.command(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("started");
        let mut stdin = child.stdin.take().expect("a pipe");
        let input = input.to_vec();
        let writer = std::thread::spawn(move || stdin.write_all(&input));
        let output = child.wait_with_output().expect("ended");
        // A run that refuses its arguments does not read.
        let _ = writer.join().expect("no panic");
        let stderr = String::from_utf8(output.stderr).expect("messages are UTF-8");
        assert!(!stderr.contains("panicked"), "{stderr}");
        Run { status: output.status.code(), stdout: output.stdout, stderr }
    }
}
