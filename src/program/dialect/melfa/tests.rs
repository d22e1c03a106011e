//! The reader as a whole, on small programs.

use crate::base::text::Source;
use crate::geometry::orientation::OrientationConvention;
use crate::program::target::{PathKind, Program, Reference, Target, TargetValue};

use super::reader::read;
use super::statement::recognises;

fn program(text: &str) -> Program {
    read(&[Source::new("t.prg", text)])
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    program.targets.iter().find(|target| target.name.as_deref() == Some(name)).expect("the target")
}

#[test]
fn positions_stand_in_the_program_or_behind_it() {
    let read = program(
        "10 OVRD 50\r\n20 MOV J1 'home: P9\r\n30 MOV P1\r\n40 MVS P1,-50\r\n50 MVS PUP Wth M_Out(1)=1\r\n60 END\r\n\
         P1=(+455.25,-20.00,+520.00,+180.00,,-90.50,+0.00,,)(7,0)\r\nPUP=(400,0,500,180,0,180)(&H6,0)\r\n\
         J1=(0,0,90,0,90,0)\r\nP7=(1,2,3,4,5,6)(7,0)\r\n",
    );
    assert_eq!(
        read.targets.iter().map(|target| target.kind()).collect::<Vec<_>>(),
        ["cartesian", "cartesian", "joint"]
    );
    let first = named(&read, "P1");
    let TargetValue::Cartesian(numbers) = &first.value else { panic!("a pose") };
    assert_eq!(numbers.orientation.iter().map(|field| field.value).collect::<Vec<_>>(), [180.0, 0.0, -90.5]);
    assert!(numbers.orientation[1].insertion.is_some() && numbers.orientation[1].span().is_empty());
    assert_eq!((first.uses[0].path, first.uses[0].computed.is_some()), (PathKind::Joint, false));
    assert!(first.uses[1].computed.as_deref().is_some_and(|reason| reason.contains("-50")));
    let asked = &first.configuration;
    assert_eq!((asked.rear, asked.elbow_down, asked.wrist_negative), (Some(false), Some(false), Some(false)));
    assert_eq!(asked.joint_intervals_deg.len(), 3);
    assert_eq!(first.external_axes.len(), 1);
    assert_eq!(named(&read, "PUP").configuration.rear, None);
}

#[test]
fn angles_turn_about_fixed_axes() {
    // BFP-A8787, tool data (0,0,100,0,-90,0): the tool's Z lies along -X of the flange; (..,45,-90,0) tilts the hand by
    // 45 degrees about it.
    let rotation = |angles: [f64; 3]| {
        let radians = angles.map(f64::to_radians);
        OrientationConvention::FixedXyz.rotation(&radians).expect("a rotation")
    };
    assert!((rotation([0.0, -90.0, 0.0]).column(2) + nalgebra::Vector3::x()).norm() < 1e-12);
    let tilted = rotation([45.0, -90.0, 0.0]);
    let along = tilted.column(2);
    assert!((along[0] + 45f64.to_radians().cos()).abs() < 1e-12 && (along[1] + 45f64.to_radians().sin()).abs() < 1e-12);
    assert!((tilted.column(0) - nalgebra::Vector3::z()).norm() < 1e-12);
}

#[test]
fn arcs_have_their_points() {
    let read = program(
        "Mvr P1,P2,P3\nMvr2 P1,P3,P4\nMvr3 P1,P3,P5\nMva P2,1\nP1=(1,0,0,0,0,0)(7,0)\nP2=(2,0,0,0,0,0)(7,0)\n\
         P3=(3,0,0,0,0,0)(7,0)\nP4=(4,0,0,0,0,0)(7,0)\nP5=(5,0,0,0,0,0)(7,0)\n",
    );
    let paths = |name: &str| named(&read, name).uses.iter().map(|one| one.path).collect::<Vec<_>>();
    assert_eq!(paths("P2"), [PathKind::ArcVia, PathKind::Joint]);
    assert_eq!(paths("P3"), [PathKind::ArcEnd, PathKind::ArcEnd, PathKind::Other]);
    assert_eq!(paths("P4"), [PathKind::ArcVia]);
    assert!(named(&read, "P5").uses[0].computed.is_some());
    assert_eq!(named(&read, "P2").uses[1].computed, None);
}

#[test]
fn variables_that_change_are_computed() {
    let read = program(
        "PCU=P_Fbc\nPCU.Z=90\nMvs PCU\nMvs PM\nPM.X=PM.X+5\nMov PT*POFF\nIf M1=1 Then PI=(1,2,3,0,0,0)(7,0)\nMov PI\n\
         Mvs ,-20\nMov PNONE\nMov P2(M1)\nIf M_In(1)=1 Then Mov PX Else Mov PY\n\
         PM=(1,2,3,180,0,180)(7,0)\nPI=(4,5,6,0,0,0)(7,0)\nPX=(1,2,3,M2,0,0)(7,0)\nPY=(1,2,3,0,0,0)(7,0)\n",
    );
    for name in ["PCU", "PM", "PI", "PNONE", "PX"] {
        assert!(named(&read, name).computed.is_some(), "{name}");
    }
    assert!(named(&read, "PY").computed.is_none());
    assert_eq!(read.targets.iter().filter(|target| target.name.is_none() && target.computed.is_some()).count(), 3);
}

#[test]
fn saved_positions_yield_to_those_that_the_program_sets() {
    let read = program(
        "1 P2 = (200.000,250.000,348.735,-150.000,0.000,180.000)\nCallP \"ON\"\n2 Mvs P2\n3 Mvs P3\n4 P3 = (1,2,3,0,0,0)\n5 Mvs P3\n\
         6 If M1=1 Then *L1\n7 P4 = (1,2,3,0,0,0)\n8 Mvs P4\n9 Mvs P5\n10 End\n\nP2=(0.000,0.000,0.000,0.000,0.000,0.000)(7,0)\n\
         P3=(0,0,0,0,0,0)(7,0)\nP4=(0,0,0,0,0,0)(7,0)\nP5=(5,0,0,0,0,0)(7,0)\n",
    );
    let TargetValue::Cartesian(numbers) = &named(&read, "P2").value else { panic!("a pose") };
    assert_eq!((numbers.position[0].value, &named(&read, "P2").computed), (200.0, &None));
    assert!(named(&read, "P3").computed.is_some() && named(&read, "P4").computed.is_some());
    assert!(named(&read, "P5").computed.is_none());
}

#[test]
fn tools_and_bases() {
    let read = program(
        "Tool (0,0,150,0,0,0)\nMov P1\nBase (100,0,0,0,0,90)\nMov P2\nTool PTL\nM_Tool=2\nBase 1\nMov P3\n*L1\nMov P4\n\
         Tool PCHANGED\nGoTo *L1\nP1=(1,0,0,0,0,0)(7,0)\nP2=(1,0,0,0,0,0)(7,0)\nP3=(1,0,0,0,0,0)(7,0)\n\
         P4=(1,0,0,0,0,0)(7,0)\nPTL=(0,0,80,0,0,0)(0,0)\nCmp Pos,&B11\nMov P5\nP5=(1,2,3,0,0,0)(7,0)\n",
    );
    let one = |name: &str| &named(&read, name).uses[0];
    let Reference::Named(tool) = &one("P1").tool else { panic!("a tool") };
    let pose = read.tools[&Program::key(tool)].value.as_ref().expect("a value").pose;
    assert_eq!(pose.translation.z, 0.15);
    let Reference::Named(frame) = &one("P2").frame else { panic!("a frame") };
    let frame = read.frames[&Program::key(frame)].value.as_ref().expect("a value").pose;
    // The world's origin, 100 mm behind the base, which is turned by a quarter.
    assert!((frame.translation - nalgebra::Vector3::new(0.0, 0.1, 0.0)).norm() < 1e-12);
    assert_eq!((&one("P3").tool, &one("P3").frame), (&Reference::Named("2".into()), &Reference::Named("1".into())));
    assert!(matches!(one("P4").tool, Reference::Runtime(_)));
    assert!(one("P5").computed.is_some());
}

#[test]
fn only_melfa_basic_is_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is("10 MOV P1\n20 MVS P2\n"));
    assert!(is("Mov PSAFE\r\nP1=(1,2,3,4,5,6)(7,0)\r\nSpd 100\r\n"));
    for text in [
        "",
        "mov p1\n",
        "mov ax, bx\nint 21h\n",
        "MOVE P, @P P1\nP1 = (1,2,3,4,5,6)\n",
        "MOVJ P001 VJ=50.00\nMOVL P002 V=10\n",
        "S1 MOVE P,S=10%,A=1,T=1\n",
        "PTP {X 1,Y 2,Z 3,A 0,B 0,C 0}\n",
    ] {
        assert!(!is(text), "{text}");
    }
}

#[test]
fn a_condition_or_a_jump_over_a_tool_leaves_it_open() {
    let tool = |lines: &str| {
        let text =
            format!("10 OVRD 50\r\n20 TOOL (0,0,100,0,0,0)\r\n{lines}\r\n90 END\r\nP1=(400,0,500,180,0,180)(7,0)\r\n");
        named(&program(&text), "P1").uses[0].tool.clone()
    };
    let open = |reference: Reference| matches!(reference, Reference::Runtime(_));
    assert!(!open(tool("30 MOV P1")));
    assert!(open(tool("30 IF M_IN(1)=1 THEN TOOL (0,0,200,0,0,0)\r\n40 MOV P1")));
    let over = "40 TOOL (0,0,200,0,0,0)\r\n50 MOV P1";
    assert!(open(tool(&format!("30 IF M_IN(1)=1 THEN 50\r\n{over}"))));
    assert!(open(tool(&format!("30 ON M1 GOTO 20,50\r\n{over}"))));
    assert!(!open(tool(&format!("30 IF M_IN(1)=1 THEN 90\r\n{over}"))));
}

#[test]
fn a_tool_that_is_set_further_down_in_a_loop_comes_round() {
    let read = program(
        "Tool (0,0,100,0,0,0)\nFor M1=1 To 3\nMvs P1\nTool (0,0,200,0,0,0)\nMvs P2\nNext M1\nEnd\n\
         P1=(400,0,500,180,0,180)(7,0)\nP2=(400,0,500,180,0,180)(7,0)\n",
    );
    assert!(matches!(named(&read, "P1").uses[0].tool, Reference::Runtime(_)));
    assert!(matches!(named(&read, "P2").uses[0].tool, Reference::Named(_)));
}
