//! The reader as a whole, on small programs.

use crate::base::text::Source;
use crate::program::dialect::Dialect;
use crate::program::target::{PathKind, Program, Reference, Target, TargetValue};

use super::reader::read;

fn program(text: &str) -> Program {
    read(&[Source::new("MZ07-A.001", format!("{text}\nEND\n"))])
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    let found = program.targets.iter().find(|target| target.name.as_deref() == Some(name));
    found.unwrap_or_else(|| panic!("no {name} in {:?}", program.targets))
}

/// Lines of two programs that write this language.
const WRITTEN: &str = "MOVEX A=1,AC=0,SM=0,M1J,P,(0.0,90.00, -90,0,0,0),R= 5.0,H=1,MS\n\
    MOVEX A=2P,AC=0,SM=0,HM,M1X,L,(1822.33, -471.92, 1362.38, 21.93, 40.34, 31.88),S=200.0,H=2,MS,CONF=1020,\
    M2J,P,(2250.00, 851.62),S=200,H=2\n\
    MOVEX A=3P,M1X,C1,(1,2,3,0,0,180),CONF=1020,S=30,H=0,MS\nMOVEX A=3P,M1X,C2,(4,5,6,0,0,180),S=30,H=0,MS ' x";

#[test]
fn motions_hold_their_positions() {
    let program = program(WRITTEN);
    assert_eq!(
        program.targets.iter().map(Target::kind).collect::<Vec<_>>(),
        ["joint", "cartesian", "cartesian", "cartesian"]
    );
    let uses: Vec<_> =
        program.targets.iter().map(|target| (target.uses[0].path, target.uses[0].tool.clone())).collect();
    let tool = |number: &str| Reference::Named(number.into());
    assert_eq!(
        uses,
        [
            (PathKind::Joint, tool("1")),
            (PathKind::Linear, tool("2")),
            (PathKind::ArcVia, tool("0")),
            (PathKind::ArcEnd, tool("0"))
        ]
    );
    let axes: Vec<_> = program.targets[1].external_axes.iter().map(|axis| (axis.name.as_str(), axis.value)).collect();
    assert_eq!(axes, [("M2.1", 2250.0), ("M2.2", 851.62)]);
}

/// The writers: the fourth number turns about Z, last of the three.
#[test]
fn the_turn_about_z_stands_first() {
    let program = program("MOVEX M1X,L,(1,2,3,90,0,180),S=1,H=1,MS");
    let TargetValue::Cartesian(numbers) = &program.targets[0].value else { panic!("a pose") };
    let rotation = numbers.pose().expect("a rotation").rotation;
    assert!((rotation.column(2) + nalgebra::Vector3::z()).norm() < 1e-12);
    assert!((rotation.column(0) - nalgebra::Vector3::y()).norm() < 1e-12);
}

#[test]
fn pose_variables_are_targets_unless_they_change() {
    let text = "P1 = (1,2,3,4,5,6)\nP2=(1,2,3,4,5,6)\nP2=(1,2,3,4,5,7)\nP3=P1\nP4=(1,2,3,4,5,6)\nMODUSRCOORD 1,4,5,6\n\
                MOVEX M1X,P,P1,R=5,H=1,MS\nMOVEX M1X,L,P1,S=5,H=1,MS\nMOVEX M1X,P,P2,R=5\nMOVEX M1X,P,P3\nMOVEX \
                M1X,P,P4\nMOVEX M1J,P,P*,R=5\nMOVEX M1X,L,P9\nMOVEX M1X,L,(x,2,3,4,5,6)\nMOVEX M1X,L,(1,2,3)\nMOVEX \
                M1XW,L,(1,2,3,4,5,6)\nREM \"MOVEX M1X,L,(1,2,3,4,5,6)\"\n'MOVEX M1X,L,(1,2,3,4,5,6)";
    let program = program(text);
    assert_eq!(named(&program, "P1").uses.len(), 2);
    assert!(named(&program, "P1").computed.is_none());
    for name in ["P2", "P3", "P4", "P*", "P9", "(x,2,3,4,5,6)", "(1,2,3)", "(1,2,3,4,5,6)"] {
        assert!(named(&program, name).computed.is_some(), "{name}");
    }
    assert_eq!(program.targets.len(), 9);
}

#[test]
fn coordinates_and_shifts_hold_from_there_on() {
    let text = "MOVEX M1X,L,(1,2,3,4,5,6)\nCHGCOORD 1\nMOVEX M1X,L,(2,2,3,4,5,6)\n*LOOP\nMOVEX M1X,L,(3,2,3,4,5,6)\nCHGCOORD \
                0\nMOVEX M1X,L,(4,2,3,4,5,6)\nSETTOOL 1,1,V11!\nSHIFTR 1,P5\nMOVEX M1X,L,(5,2,3,4,5,6)";
    let program = program(text);
    let frames: Vec<_> = program.targets.iter().map(|target| target.uses[0].frame.clone()).collect();
    assert_eq!(
        (&frames[0], &frames[1], &frames[3]),
        (&Reference::Unnamed, &Reference::Named("1".into()), &Reference::Unnamed)
    );
    assert!(matches!(frames[2], Reference::Runtime(_)));
    assert!(program.targets[4].uses[0].computed.is_some());
    assert!(program.tools["1"].value.is_err());
}

#[test]
fn only_this_language_is_recognised() {
    let is = |text: &str| super::Nachi.recognises(&Source::new("t", text));
    assert!(is(WRITTEN));
    assert!(is("REM \"x\"\r\nMOVEX M1J,P,(1,2,3,4,5,6),S=500.00,H=1,MS\r\n"));
    for text in ["", "MOVEX", "MOVEX x,y", "S1 MOVE P,S=50%,A=3,T=0", "MOVE L,P1", "'MOVEX M1J,P,(1,2,3,4,5,6)"] {
        assert!(!is(text), "{text}");
    }
}

#[test]
fn a_condition_or_a_jump_over_a_selection_leaves_it_open() {
    const MOVE: &str = "MOVEX A=1,M1X,L,(401,0,500,0,0,180),S=60,H=2,MS";
    let frame = |lines: &str| program(&format!("CHGCOORD 1\n{lines}")).targets[0].uses[0].frame.clone();
    assert_eq!(frame(MOVE), Reference::Named("1".into()));
    for lines in [
        format!("IF I1=1 THEN CHGCOORD 2\n{MOVE}"),
        format!("IF I1=1 THEN 20\nCHGCOORD 3\n20 {MOVE}"),
        format!("GOTO 20\nCHGCOORD 3\n20\n{MOVE}"),
    ] {
        assert!(matches!(frame(&lines), Reference::Runtime(_)), "{lines}");
    }
    assert_eq!(frame(&format!("10 CHGCOORD 3\n20 {MOVE}")), Reference::Named("3".into()));
}
