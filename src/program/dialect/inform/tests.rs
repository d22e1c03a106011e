//! The reader as a whole, on small jobs.

use crate::base::text::Source;
use crate::program::target::{PathKind, Program, Reference, Target, TargetValue};

use super::job::recognises;
use super::reader::read;

const RCONF: &str = "///RCONF 1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0";

fn job(positions: &[&str], head: &str, instructions: &[&str]) -> Source {
    let mut text = String::from("'made by hand\r\n/JOB\r\n//NAME TEST\r\n//POS\r\n///NPOS 9,0,0,9,0,0\r\n");
    positions.iter().for_each(|line| text += &format!("{line}\r\n"));
    text += &format!("//INST\r\n///DATE 2026/01/01 00:00\r\n{head}\r\n///GROUP1 RB1\r\nNOP\r\n");
    instructions.iter().for_each(|line| text += &format!("{line}\r\n"));
    text += "END\r\n";
    Source::new("TEST.JBI", text)
}

fn program(positions: &[&str], instructions: &[&str]) -> Program {
    read(&[job(positions, "///ATTR SC,RW", instructions)])
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    program.targets.iter().find(|target| target.name.as_deref() == Some(name)).expect("the target")
}

#[test]
fn modal_lines_hold_until_they_are_given_again() {
    let program = program(
        &[
            "///TOOL 1",
            "///POSTYPE PULSE",
            "///PULSE",
            "C00000=17473,-27809,37525,12674,-77479,22303",
            "///USER 3",
            "///POSTYPE USER",
            "///RECTAN ",
            RCONF,
            "C00001=780.361,197.265,599.550,158.7046,-21.1320,16.3034",
            "///TOOL 2",
            "///POSTYPE ROBOT",
            "P00124=1,2,3,180.0,0.00,-90",
            "///POSTYPE PULSE",
            "C00002=1,2,3,4,5,6",
        ],
        &["MOVJ C00000 VJ=50.00", "MOVL C00001 V=166.7  //ORG", "MOVL P124 V=5.0", "MOVC C002 V=5.0", "MOVC C001 V=5"],
    );
    for name in ["C00000", "C00002"] {
        assert!(named(&program, name).computed.as_deref().is_some_and(|reason| reason.contains("pulse")), "{name}");
    }
    let first = named(&program, "C00001");
    let TargetValue::Cartesian(numbers) = &first.value else { panic!("a pose") };
    assert_eq!(numbers.position.each_ref().map(|field| field.value), [780.361, 197.265, 599.55]);
    assert_eq!(numbers.orientation[0].decimals(), 4);
    assert_eq!(first.configuration.wrist_negative, Some(true));
    assert_eq!((first.uses.len(), first.uses[0].path, first.uses[1].path), (2, PathKind::Linear, PathKind::ArcEnd));
    assert_eq!(
        (&first.uses[0].tool, &first.uses[0].frame),
        (&Reference::Named("1".into()), &Reference::Named("3".into()))
    );
    let variable = named(&program, "P00124");
    assert_eq!((&variable.uses[0].tool, &variable.uses[0].frame), (&Reference::Named("2".into()), &Reference::Unnamed));
    assert!(variable.computed.is_none());
}

#[test]
fn variables_that_are_set_or_make_a_frame_are_computed() {
    let pose = "=1.000,2.000,3.000,180.0000,0.0000,0.0000";
    let lines: Vec<String> = (1..=5).map(|number| format!("P{number:05}{pose}")).collect();
    let mut positions = vec!["///TOOL 0", "///POSTYPE BASE", "///RECTAN", RCONF];
    positions.extend(lines.iter().map(String::as_str));
    let program = program(
        &positions,
        &[
            "GETE D098 P001 (2)",
            "SETE P002 (2) D098",
            "CNVRT PX003 PX001 RF",
            "MFRAME UF#(15) P004 PX123 PX126",
            "MOVL P001 V=5.0",
            "MOVL P002 V=5.0",
            "MOVL P003 V=5.0",
            "MOVL P004 V=5.0",
            "SFTON P010 UF#(15)",
            "MOVL P001 V=5.0",
            "SFTOF",
            "IMOV P005 V=5.0",
            "MOVL P[B000] V=5.0",
            "MOVL P099 V=5.0",
            "'MOVL P004 V=9",
        ],
    );
    let first = named(&program, "P00001");
    assert!(first.computed.is_none());
    assert_eq!(first.uses.iter().map(|one| one.computed.is_some()).collect::<Vec<_>>(), [false, true]);
    for name in ["P00002", "P00003", "P00004", "P[B000]", "P099"] {
        assert!(named(&program, name).computed.is_some(), "{name}");
    }
    assert!(named(&program, "P00005").uses[0].computed.is_some());
    assert!(program.frames["15"].value.is_err());
}

#[test]
fn axes_beside_the_arm_are_kept() {
    let program = program(
        &[
            "///TOOL 0",
            "///POSTYPE ROBOT",
            "///RECTAN",
            "C0001=1.0,2.0,3.0,4.0,5.0,6.0",
            "///POSTYPE BASE",
            "C0002=1.0,2.0,3.0,4.0,5.0,6.0",
            "C0003=1.0,2.0,3.0,4.0,5.0,6.0,7.0",
            "///POSTYPE PULSE",
            "///PULSE",
            "BC0001=100",
            "BC0002=100",
            "EC0001=7,8",
        ],
        &["MOVL C0001 BC0001 EC0001 V=5.0", "MOVL C0002 BC0002 V=5.0", "MOVL C0003 V=5.0", "MOVJ EC0001 VJ=1.00"],
    );
    let axes: Vec<_> =
        named(&program, "C0001").external_axes.iter().map(|axis| (axis.name.as_str(), axis.value)).collect();
    assert_eq!(axes, [("B1", 100.0), ("E1", 7.0), ("E2", 8.0)]);
    let rides = |name| (named(&program, name).rides_along, named(&program, name).computed.is_none());
    assert_eq!((rides("C0001"), rides("C0002")), ((true, true), (false, true)));
    assert!(named(&program, "C0003").computed.as_deref().is_some_and(|reason| reason.contains("7 values")));
    assert_eq!(program.targets.len(), 3);
}

#[test]
fn relative_jobs_and_cut_off_jobs_are_said() {
    let positions = ["///POSTYPE ROBOT", "///RECTAN", "C0001=1.0,2.0,3.0,4.0,5.0,6.0"];
    let relative = read(&[job(&positions, "///ATTR SC,RW,RJ", &["MOVL C0001 V=5.0"])]);
    assert!(relative.targets[0].uses[0].computed.is_some());
    let cut =
        Source::new("t", "/JOB\n//POS\n///POSTYPE ROBOT\n///RECTAN\nC0001=1.0,2.0,3.\n//INST\nNOP\nMOVL C0001 V=5.0\n");
    let read_cut = read(&[cut]);
    assert_eq!(read_cut.diagnostics.iter().map(|finding| finding.code).collect::<Vec<_>>(), ["missing-end"]);
    assert!(read_cut.targets[0].computed.is_some());
    let broken = program(&["///POSTYPE ROBOT", "C0001=1.0,2.0,x"], &["MOVL C0001 V=5.0"]);
    assert_eq!(broken.diagnostics[0].code, "broken-position");
}

#[test]
fn variables_of_another_job_are_found() {
    let data = job(&["///POSTYPE ROBOT", "///RECTAN", "P0001=1.0,2.0,3.0,4.0,5.0,6.0"], "///ATTR SC,RW", &[]);
    let moves = job(&[], "///ATTR SC,RW", &["MOVL P001 V=5.0", "MOVL C0001 V=5.0"]);
    let program = read(&[data, moves]);
    assert_eq!((named(&program, "P0001").file, named(&program, "P0001").uses[0].file), (0, 1));
    assert!(named(&program, "C0001").computed.is_some());
}

#[test]
fn only_jobs_are_recognised() {
    let is = |text: &[u8]| recognises(&Source::new("t", text));
    assert!(is(b"'PP version 1\r\n/JOB\r\n//NAME A\r\n//POS\r\n"));
    assert!(is(b"/JOB\n//NAME \x83\x5c\x81\x5b\n"));
    for text in [&b""[..], b"/JOB", b"/JOBS\n//NAME A\n", b"/PROG A\n/MN\n//NAME", b"// comment\n/JOB\n//POS", b"{}\n"]
    {
        assert!(!is(text), "{text:?}");
    }
}
