//! The reader as a whole, on small programs.

use crate::base::text::Source;
use crate::program::target::{PathKind, Program, Reference, Target, TargetValue};

use super::reader::read;
use super::statement::recognises;

fn program(text: &str) -> Program {
    read(&[Source::new("t.pac", text)])
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    program.targets.iter().find(|target| target.name.as_deref() == Some(name)).expect("the target")
}

#[test]
fn one_variable_has_several_spellings() {
    let read = program(
        "PROGRAM PRO1\r\n#DEFINE PICK P12\r\nTAKEARM\r\nj00 = (0.00, -6.53, 155.37, 0.00, -60.54, 90)\r\n\
         P12 = (450, -10.5, 300, 180, 0, 180, 5)\r\nP[13] = P(1,2,3,4,5,6)\r\nmove p, @p J0, s=20 'home: P99\r\n\
         MOVE L, @E P[12], S=30\r\nMOVE L, @10 PICK, NEXT\r\nmove c, p013, @p P12, s=50\r\nMOVE P, @0 J(0,0,90,0,90,0)\r\n\
         MOVE L, @P (100,200,300,180,0,0,5)\r\nEND\r\n",
    );
    assert_eq!(read.targets.len(), 5);
    let pick = named(&read, "P12");
    assert_eq!(
        pick.uses.iter().map(|one| one.path).collect::<Vec<_>>(),
        [PathKind::Linear, PathKind::Linear, PathKind::ArcEnd]
    );
    assert_eq!(named(&read, "P[13]").uses[0].path, PathKind::ArcVia);
    assert_eq!(read.targets.iter().filter(|target| target.kind() == "joint").count(), 2);
    assert!(read.targets.iter().all(|target| target.computed.is_none()));
}

#[test]
fn declarations_may_give_values() {
    let read = program(
        "DEFJNT Start = J(-46.1,-6.7,-20.5,71.3,49.5,-30.2), other\nDEFPOS a, b = (200.0,250.0,348.7,-90.0,150.0,-90.0)\n\
         MOVE P, @P Start\nMOVE L, @P b\nMOVE L, @P a\n",
    );
    assert_eq!(named(&read, "Start").kind(), "joint");
    assert!(named(&read, "b").computed.is_none() && named(&read, "a").computed.is_some());
}

#[test]
fn yaw_pitch_and_roll_are_those_of_paul() {
    // Robot Manipulators (1981): RPY = Rot(z, roll) Rot(y, pitch) Rot(x, yaw), with RX the yaw.
    let read = program("MOVE L, @P (0,0,0,90,0,90)\n");
    let TargetValue::Cartesian(numbers) = &read.targets[0].value else { panic!("a pose") };
    let rotation = numbers.pose().expect("a pose").rotation;
    // Z of the tool: turned about X onto -Y, then about Z onto +X.
    assert!((rotation.column(2) - nalgebra::Vector3::x()).norm() < 1e-12);
    assert!((rotation.column(0) - nalgebra::Vector3::y()).norm() < 1e-12);
}

#[test]
fn what_changes_at_run_time_is_computed() {
    let read = program(
        "P1 = (1,2,3,0,0,0)\nLETX P1 = D10\nMOVE L, @P P1\nP2 = P1 + (0,0,100,0,0,0)\nMOVE L, @P P2\nMOVE L, @P P[I1]\n\
         MOVE P, @P P3+(0,100,0,0,0,0)H\nP4 = (1,2,3,0,0,0)\nAPPROACH L, P4, @P 100, S=50\nMOVE L, @0 P4\nDEPART L, @P 100\n\
         MOVE L, @0 P9\nMOVE P, @P P4 EX((7,300))\nP5=(1,2,3,0,0,F1)\nMOVE L, @P P5\nDRIVEA (1,30)\nsetsplinepoint 1, P4\n\
         P6=(1,2,3,0,0,0)\nIF IO[1] = ON THEN MOVE L, @E P6 ELSE MOVE P, @E P4\n",
    );
    assert_eq!(named(&read, "P6").uses.len(), 1);
    for name in ["P1", "P2", "P9", "P5"] {
        assert!(named(&read, name).computed.is_some(), "{name}");
    }
    let approached = named(&read, "P4");
    assert!(approached.computed.is_none());
    let computed: Vec<bool> = approached.uses.iter().map(|one| one.computed.is_some()).collect();
    assert_eq!(computed, [true, false, true, false, false]);
    assert_eq!(read.targets.iter().filter(|target| target.name.is_none() && target.computed.is_some()).count(), 4);
}

#[test]
fn tools_and_work_coordinates() {
    let read = program(
        "TOOL 1, (0,0,120,0,0,0)\nWORK 2, P50\nP50 = (500,0,0,0,0,90)\nCHANGETOOL 1\nCHANGEWORK 2\nMOVE L, @P (1,2,3,0,0,0)\n\
         CHANGETOOL I5\nMOVE L, @P (1,2,4,0,0,0)\nIF I1 = 1 THEN\n  CHANGETOOL 3\nENDIF\nMOVE L, @P (1,2,5,0,0,0)\n",
    );
    let uses: Vec<_> = read.targets.iter().map(|target| &target.uses[0]).collect();
    assert_eq!((&uses[0].tool, &uses[0].frame), (&Reference::Named("1".into()), &Reference::Named("2".into())));
    assert_eq!(read.tools["1"].value.as_ref().map(|tool| tool.pose.translation.z), Ok(0.12));
    assert_eq!(read.frames["2"].value.as_ref().map(|frame| frame.pose.translation.x), Ok(0.5));
    assert!(matches!(uses[1].tool, Reference::Runtime(_)) && matches!(uses[2].tool, Reference::Runtime(_)));
}

#[test]
fn only_pac_is_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is("'!TITLE \"<Title>\"\nPROGRAM PRO1\ntakearm\nmove p, p1, s=20\nEND\n"));
    assert!(is("Sub Main\r\n  Move L, @P P[10], S=50\r\nEnd Sub\r\n"));
    for text in [
        "",
        "S1 MOVE P,S=10%,A=1,T=1\n",
        "MOVE L,S=5mm/s,A=1,T=2\n",
        "10 MOV P1\n20 MVS P2\n",
        "MOVEX A=1,AC=0,L,(1,2,3,4,5,6)\n",
        "MOVE LINEAR TO p1\n",
    ] {
        assert!(!is(text), "{text}");
    }
}

#[test]
fn a_tool_under_a_condition_is_known_only_at_run_time() {
    let read = program(
        "PROGRAM PRO1\r\nCHANGETOOL 1\r\nMOVE L, @P (400,0,300,180,0,180)\r\nIF IO[10] = ON THEN CHANGETOOL 2\r\n\
         MOVE L, @P (401,0,300,180,0,180)\r\nCHANGETOOL 1\r\nMOVE L, @P (402,0,300,180,0,180)\r\nEND\r\n",
    );
    let tools: Vec<_> = read.targets.iter().map(|target| target.uses[0].tool.clone()).collect();
    let one = Reference::Named("1".into());
    assert_eq!(tools, [one.clone(), Reference::Runtime("set under a condition in line 4".into()), one]);
}

#[test]
fn a_tool_that_is_selected_further_down_in_a_loop_comes_round() {
    let read = program(
        "PROGRAM PRO1\r\nCHANGETOOL 1\r\nDO\r\nMOVE L, @P (400,0,300,180,0,180)\r\nCHANGETOOL 2\r\n\
         MOVE L, @P (401,0,300,180,0,180)\r\nLOOP\r\nEND\r\n",
    );
    assert!(matches!(read.targets[0].uses[0].tool, Reference::Runtime(_)));
    assert_eq!(read.targets[1].uses[0].tool, Reference::Named("2".into()));
}
