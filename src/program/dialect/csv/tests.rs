//! The reader as a whole, on small lists.

use crate::base::text::Source;
use crate::geometry::orientation::OrientationConvention;
use crate::program::target::{LengthUnit, PathKind, Program, Reference, TargetValue};

use super::reader::{read, recognises};

fn program(text: &str) -> Program {
    read(&[Source::new("t.csv", text)])
}

fn codes(text: &str) -> Vec<&'static str> {
    program(text).diagnostics.iter().map(|finding| finding.code).collect()
}

#[test]
fn rows_are_targets_with_tool_frame_and_motion() {
    let list = "\u{feff}# drill holes\r\n# falsetarget: tool=drill\r\nname;x_mm;y_mm;z_mm;qw;qx;qy;qz;frame;motion;E1\r\n\
                a;100.0;-20;3.25;0;1;0;0;jig;MoveL;12.5\r\n\"b;1\";1;2;3;0;1;0;0;;ptp;\r\n\r\n";
    let read = program(list);
    assert!(read.diagnostics.is_empty(), "{:?}", read.diagnostics);
    assert_eq!(read.targets.len(), 2);
    let first = &read.targets[0];
    assert_eq!((first.name.as_deref(), first.uses[0].path), (Some("a"), PathKind::Linear));
    assert_eq!(
        (&first.uses[0].tool, &first.uses[0].frame),
        (&Reference::Named("drill".into()), &Reference::Named("jig".into()))
    );
    assert_eq!(first.external_axes[0].value, 12.5);
    let pose = match &first.value {
        TargetValue::Cartesian(numbers) => numbers.pose().expect("a pose"),
        _ => panic!("a pose"),
    };
    assert_eq!((pose.translation.x, pose.rotation[(2, 2)]), (0.1, -1.0));
    let second = &read.targets[1];
    assert_eq!((second.name.as_deref(), second.uses[0].path), (Some("b;1"), PathKind::Joint));
    assert_eq!(second.uses[0].frame, Reference::Named("work".into()));
}

#[test]
fn ambiguous_angles_and_units_have_to_be_stated() {
    let rows = "x,y,z,rx,ry,rz\n1,2,3,0.1,0.2,0.3\n";
    assert_eq!(codes(rows), ["orientation-missing", "unit-missing", "unit-missing"]);
    let stated = program(&format!("# falsetarget: units=inch,rad orientation=rotation-vector\n{rows}"));
    assert!(stated.diagnostics.is_empty());
    let TargetValue::Cartesian(numbers) = &stated.targets[0].value else { panic!("a pose") };
    assert_eq!(numbers.convention, OrientationConvention::RotationVector);
    assert_eq!((numbers.units.length, numbers.units.radians), (LengthUnit::Inch, true));
    assert!((numbers.pose().expect("a pose").translation.z - 0.0762).abs() < 1e-15);
    assert_eq!(
        codes("# falsetarget: orientation=quaternion-wxyz units=mm,deg\nx,y,z,a,b,c\n"),
        ["orientation-missing"]
    );
    assert_eq!(codes("x_mm,y_mm,z_mm\n1,2,3\n"), ["orientation-missing"]);
    assert_eq!(codes("1,2,3,4,5,6\n"), ["header-missing"]);
}

#[test]
fn joint_rows_stand_beside_poses() {
    let read = program(
        "x_mm,y_mm,z_mm,w_deg,p_deg,r_deg,j1_deg,j2_deg,j3_deg,j4_deg,j5_deg,j6_deg\n\
         ,,,,,,1,2,3,4,5,6\n1,2,3,4,5,6,10,20,30,40,50,60\n1,2,3,4,5,6,,,,,,\n",
    );
    assert!(read.diagnostics.is_empty());
    assert_eq!(
        read.targets.iter().map(|target| target.kind()).collect::<Vec<_>>(),
        ["joint", "cartesian", "cartesian"]
    );
    let near = read.targets[1].configuration.near_joints_deg.expect("near joints");
    assert!((near[3] - 40.0).abs() < 1e-12);
    assert_eq!(read.targets[2].configuration.near_joints_deg, None);
}

#[test]
fn broken_rows_are_said() {
    let head = "x_mm,y_mm,z_mm,qw,qx,qy,qz\n";
    assert_eq!(codes(&format!("{head}1,2,3,1,0,0\n")), ["broken-row"]);
    assert_eq!(codes(&format!("{head}1,2,x,1,0,0,0\n")), ["broken-row"]);
    assert_eq!(codes("x_mm;y_mm;z_mm;qw;qx;qy;qz\n1,5;2;3;1;0;0;0\n"), ["broken-row"]);
    assert!(codes(&format!("{head}1,2,3,1,0,0,0\n# end")).is_empty());
}

#[test]
fn only_lists_of_targets_are_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is("# x\nname,x_mm,y_mm,z_mm,qw,qx,qy,qz\np1,1,2,3,1,0,0,0"));
    assert!(is("x\ty\tz\trx\try\trz\r1\t2\t3\t4\t5\t6\r"));
    assert!(is("j1,j2,j3,j4,j5,j6\n0,0,90,0,90,0\n"));
    for text in [
        "",
        "x_mm,y_mm,z_mm,qw,qx,qy,qz\n",
        "x,y,z,a,b,c\nfoo,bar,baz,1,2,3\n",
        "id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n1,2,3,4,5,6,7,8,9,10\n",
        "id,x_mm,y_mm,z_mm,u95_mm\n1,2,3,4,5\n",
        "1,2,3,4,5,6\n1,2,3,4,5,6\n",
    ] {
        assert!(!is(text), "{text}");
    }
}
