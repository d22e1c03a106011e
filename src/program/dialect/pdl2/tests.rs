//! The reader as a whole, on small programs.

use crate::base::text::Source;
use crate::program::target::{PathKind, Program, Reference, Target, TargetValue};

use super::clause::recognises;
use super::reader::read;

fn program(body: &str) -> Program {
    read(&[Source::new("t.pdl", format!("PROGRAM t\nVAR p1, p2 : POSITION\nBEGIN\n{body}END t\n"))])
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    program.targets.iter().find(|target| target.name.as_deref() == Some(name)).expect("the target")
}

#[test]
fn positions_joints_and_arcs() {
    let read = program(
        "  p1 := POS(1250.5, -20.0, 800.0, 180.0, 90.0, 180.0, 'S W T1:0 T2:-1')\n  MOVE JOINT TO p1 -- MOVE TO p9\n  \
         MOVEFLY LINEAR TO POS(1,2,3,0,90,0,'') ADVANCE\n  MOVE TO {0,-20,-90,0,90,0,1500}\n  \
         MOVE CIRCULAR TO POS(4,5,6,0,90,0,'') VIA p1, WITH $LIN_SPD = 0.2\n  MOVE ARM[1] LINEAR TO p1\n  \
         MOVE LINEAR TO XTNDPOS(POS(1,2,3,0,90,0,''), , , (250.5))\n",
    );
    assert_eq!(read.targets.iter().filter(|target| target.computed.is_some()).count(), 0);
    let first = named(&read, "p1");
    assert_eq!(
        first.uses.iter().map(|one| one.path).collect::<Vec<_>>(),
        [PathKind::Joint, PathKind::ArcVia, PathKind::Linear]
    );
    let asked = &first.configuration;
    assert_eq!((asked.rear, asked.elbow_down, asked.wrist_negative), (Some(true), Some(false), Some(true)));
    assert_eq!(asked.joint_intervals_deg, [(3, -180.0, 180.0), (5, -540.0, -180.0)]);
    let joint = read.targets.iter().find(|target| target.kind() == "joint").expect("a joint target");
    assert_eq!(joint.external_axes[0].value, 1500.0);
    let last = read.targets.last().expect("a target");
    assert_eq!(last.external_axes[0].value, 250.5);
    let TargetValue::Cartesian(numbers) = &last.value else { panic!("a pose") };
    // E2 = 90 lays the tool along X.
    assert!((numbers.pose().expect("a pose").rotation.column(2) - nalgebra::Vector3::x()).norm() < 1e-12);
    assert_eq!(read.targets[1].configuration, Default::default());
}

#[test]
fn system_variables_hold_in_the_order_of_the_text() {
    let read = program(
        "  $TOOL := POS(0,0,200,0,0,0,'')\n  $BASE := POS(0,0,500,0,0,0,'')\n  $UFRAME := fix\n  fix := POS(1000,0,600,90,0,0,'')\n  \
         MOVE LINEAR TO POS(1,0,0,0,90,0,'')\n  $UFRAME := POS(0)\n  MOVE LINEAR TO POS(2,0,0,0,90,0,'')\n  \
         MOVE LINEAR TO POS(3,0,0,0,90,0,'') WITH $TOOL = POS(0,0,90,0,0,0,'')\n  IF $DIN[1] THEN\n    $TOOL := grip\n  ENDIF\n  \
         MOVE LINEAR TO POS(4,0,0,0,90,0,'')\n",
    );
    let uses: Vec<_> = read.targets.iter().map(|target| &target.uses[0]).collect();
    let frame = |index: usize| match &uses[index].frame {
        Reference::Named(name) => read.frames[&Program::key(name)].value.as_ref().expect("a value").pose,
        other => panic!("{other:?}"),
    };
    assert!((frame(0).translation - nalgebra::Vector3::new(1.0, 0.0, 0.1)).norm() < 1e-12);
    assert!((frame(0).rotation[(1, 0)] - 1.0).abs() < 1e-12);
    assert!((frame(1).translation - nalgebra::Vector3::new(0.0, 0.0, -0.5)).norm() < 1e-12);
    let tool = |index: usize| match &uses[index].tool {
        Reference::Named(name) => read.tools[&Program::key(name)].value.as_ref().expect("a value").pose.translation.z,
        other => panic!("{other:?}"),
    };
    assert_eq!((tool(0), tool(2)), (0.2, 0.09));
    assert!(matches!(uses[3].tool, Reference::Runtime(_)));
}

#[test]
fn what_changes_at_run_time_is_computed() {
    let read = program(
        "  p1 := POS(1,2,3,0,90,0,'')\n  p1.X := p1.X + 5\n  MOVE LINEAR TO p1\n  p2 := POS(1,2,3,0,90,0,'')\n  p2 := POS(1,2,4,0,90,0,'')\n  \
         MOVE LINEAR TO p2\n  p3 := POS(1,2,3,0,90,0,'')\n  set_height(p3, 50)\n  MOVE LINEAR TO p3\n  MOVE LINEAR TO taught\n  \
         MOVE NEAR p4 BY 50\n  p4 := POS(1,2,3,0,90,0,'')\n  MOVE TO p4\n  MOVE AWAY 100\n  MOVE RELATIVE VEC(0,0,10) IN TOOL\n  \
         MOVE LINEAR TO p1 : POS(0,0,10,0,0,0,'')\n  MOVE TO {, , 5}\n  MOVE LINEAR TO POS(x,2,3,0,90,0,'')\n",
    );
    for name in ["p1", "p2", "p3", "taught"] {
        assert!(named(&read, name).computed.is_some(), "{name}");
    }
    let near = named(&read, "p4");
    assert!(near.computed.is_none());
    assert_eq!(near.uses.iter().map(|one| one.computed.is_some()).collect::<Vec<_>>(), [true, false]);
    assert_eq!(read.targets.iter().filter(|target| target.name.is_none() && target.computed.is_some()).count(), 5);
}

#[test]
fn only_pdl2_is_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is("PROGRAM weld\nBEGIN\n  MOVE LINEAR TO p1\nEND weld\n"));
    assert!(is("ROUTINE r\r\nBEGIN\r\n  a := 1\r\n  MOVE TO p1\r\nEND r\r\n"));
    for text in [
        "",
        "PROGRAM karel\n%NOLOCKGROUP\nVAR p : XYZWPR\nBEGIN\n  $MOTYPE = LINEAR\n  MOVE TO p\nEND karel\n",
        "PROGRAM PRO1\nTAKEARM\nMOVE P, @P P1\nEND\n",
        "program x;\nbegin\n  a := 1;\nend.\n",
        "MOVE LINEAR TO p1\n",
        "Move linear to in review: BEGIN\n",
    ] {
        assert!(!is(text), "{text}");
    }
}

#[test]
fn a_tool_that_is_set_further_down_in_a_loop_comes_round() {
    let read = program(
        "  $TOOL := POS(0,0,100,0,0,0,'')\n  REPEAT\n  MOVE LINEAR TO POS(1,2,3,0,180,0,'')\n  $TOOL := POS(0,0,200,0,0,0,'')\n  \
         MOVE LINEAR TO POS(4,5,6,0,180,0,'')\n  UNTIL done\n",
    );
    assert!(matches!(read.targets[0].uses[0].tool, Reference::Runtime(_)));
    assert!(matches!(read.targets[1].uses[0].tool, Reference::Named(_)));
    // What is set behind the first move of a program does not hold there.
    let later = program("  MOVE LINEAR TO POS(1,2,3,0,180,0,'')\n  $TOOL := POS(0,0,100,0,0,0,'')\n");
    assert_eq!(later.targets[0].uses[0].tool, Reference::Unnamed);
}
