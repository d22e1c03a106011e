//! The reader as a whole, on small programs.

use crate::base::edit::EditSet;
use crate::base::text::Source;
use crate::program::decimal::Decimal;
use crate::program::number::written;
use crate::program::target::{PathKind, Program, Reference, Target, TargetValue};

use super::reader::read;
use super::section::recognises;

/// A point as a controller prints it.
fn point(number: u32, head: &str, x: &str) -> String {
    format!(
        "P[{number}]{{\r\n   GP1:\r\n\t{head}\r\n\tX = {x:>9}  mm,\tY =    20.000  mm,\tZ =   -.005  mm,\r\n\
         \tW =   180.000 deg,\tP =      .000 deg,\tR =   -90.000 deg\r\n   GP2:\r\n\tUF : 9, UT : 9,\t\r\n\
         \tJ1=   300.000  mm\r\n}};\r\n"
    )
}

const HEAD: &str = "UF : 1, UT : 2,\t\tCONFIG : 'N U T, 0, 0, 0',";

fn program(statements: &[&str], points: &[String]) -> (Source, Program) {
    let mut text = String::from("/PROG  TEST\r\n/ATTR\r\nCOMMENT\t= \"P[9] ; x\";\r\n/MN\r\n");
    for (number, statement) in statements.iter().enumerate() {
        text += &format!("{:4}:{statement}\r\n", number + 1);
    }
    text += "/POS\r\n";
    points.iter().for_each(|point| text += point);
    text += "/END\r\n";
    let source = Source::new("TEST.LS", text);
    let program = read(std::slice::from_ref(&source));
    (source, program)
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    program.targets.iter().find(|target| target.name.as_deref() == Some(name)).expect("the target")
}

fn reasons(program: &Program, name: &str) -> Vec<String> {
    named(program, name).uses.iter().filter_map(|one| one.computed.clone()).collect()
}

#[test]
fn points_that_are_used_are_targets_with_their_own_frame_and_tool() {
    let (_, program) = program(
        &["J P[2] 100% FINE    ;", "  !L P[1] 5mm/sec FINE ;", "  //L P[1] 5mm/sec FINE ;", "L P[2] 5mm/sec FINE ;"],
        &[point(1, HEAD, "1.000"), point(2, HEAD, "-1234.500")],
    );
    assert_eq!(program.targets.len(), 1);
    let target = named(&program, "P[2]");
    let TargetValue::Cartesian(numbers) = &target.value else { panic!("a pose") };
    assert_eq!(numbers.position.each_ref().map(|field| field.value), [-1234.5, 20.0, -0.005]);
    assert_eq!(numbers.orientation.iter().map(|field| field.value).collect::<Vec<_>>(), [180.0, 0.0, -90.0]);
    assert!(target.external_axes.is_empty());
    let lines: Vec<_> =
        target.uses.iter().map(|one| (one.motion.as_ref(), one.frame.clone(), one.tool.clone())).collect();
    let named = |number: &str| Reference::Named(number.into());
    assert_eq!(lines, [("J", named("1"), named("2")), ("L", named("1"), named("2"))]);
}

#[test]
fn numbers_keep_their_columns() {
    let (source, program) = program(&["J P[1] 100% FINE ;"], &[point(1, HEAD, "99.999")]);
    let TargetValue::Cartesian(numbers) = &named(&program, "P[1]").value else { panic!("a pose") };
    let mut edits = EditSet::default();
    let mut put = |field: &crate::program::number::NumberField, value: f64, decimals: usize| {
        let (span, text) = written(field, source.slice(field.span()), &Decimal::nearest(value, decimals));
        edits.push(span, text);
    };
    put(&numbers.position[0], -100.0012, 3);
    put(&numbers.orientation[2], -90.00123, 5);
    let text = String::from_utf8(edits.apply(source.bytes()).expect("disjoint")).expect("ascii");
    assert!(text.contains("\tX =  -100.001  mm,\tY ="), "{text}");
    assert!(text.contains("\tR = -90.00123 deg\r\n"), "{text}");
}

#[test]
fn untaught_and_foreign_points_are_computed() {
    let gp2 = "P[3]{\r\n   GP2:\r\n\tUF : 1, UT : 1,\r\n\tJ1=   1.000  deg\r\n};\r\n".to_owned();
    let remote = point(4, HEAD, "1.000").replace("X =", "RX =").replace("Y =", "RY =");
    let (_, program) = program(
        &["J P[1] 1% FINE ;", "J P[3] 1% FINE ;", "J P[4] 1% FINE ;", "J P[7] 1% FINE ;", "J PR[2:home] 1% FINE ;"],
        &[point(1, HEAD, "********"), gp2, remote],
    );
    for name in ["P[1]", "P[3]", "P[4]", "P[7]", "PR[2]"] {
        assert!(named(&program, name).computed.is_some(), "{name}");
    }
    assert_eq!(program.targets.len(), 5);
}

#[test]
fn joints_external_axes_and_names_are_read() {
    let joints = "P[1:\"ho}me]\"]{\r\n   GP1:\r\n\tUF : 0, UT : 1,\t\r\n\tJ1=     0.000 deg,\tJ2=   -30.000 deg,\
                  \tJ3=     5.000 deg,\r\n\tJ4=     0.000 deg,\tJ5=   -90.000 deg,\tJ6=     0.000 deg,\r\n\
                  \tE1=   250.500  mm\r\n};\r\n"
        .to_owned();
    let (_, program) = program(&["J P[1:\"ho}me]\"] 1% FINE ;"], &[joints]);
    let target = named(&program, "P[1]");
    let TargetValue::Joint(numbers) = &target.value else { panic!("joints") };
    assert_eq!(numbers.joints.each_ref().map(|field| field.value), [0.0, -30.0, 5.0, 0.0, -90.0, 0.0]);
    assert_eq!(
        target.external_axes.iter().map(|axis| (axis.name.as_str(), axis.value)).collect::<Vec<_>>(),
        [("E1", 250.5)]
    );
}

#[test]
fn selections_by_register_and_changed_frames_are_runtime() {
    let any = "UF : F, UT : F,\t\tCONFIG : '',";
    let (_, program) = program(
        &[
            "  UFRAME_NUM=1 ;",
            "  UTOOL_NUM=2 ;",
            "J P[1] 1% FINE ;",
            "J P[2] 1% FINE ;",
            "  UFRAME_NUM=R[3:frame] ;",
            "J P[3] 1% FINE ;",
            "  UTOOL[2]=PR[4] ;",
            "  P[4]=LPOS    ;",
            "J P[4] 1% FINE ;",
        ],
        &[point(1, HEAD, "1.0"), point(2, any, "1.0"), point(3, HEAD, "1.0"), point(4, HEAD, "1.0")],
    );
    let frame = |name: &str| named(&program, name).uses[0].frame.clone();
    assert_eq!(frame("P[1]"), Reference::Named("1".into()));
    assert_eq!(frame("P[2]"), Reference::Named("1".into()));
    assert!(
        matches!(frame("P[3]"), Reference::Runtime(reason) if reason.contains("R[3]") && reason.contains("line 9"))
    );
    assert!(program.tools.get("2").is_some_and(|tool| tool.value.is_err()));
    assert!(named(&program, "P[4]").computed.is_some());
    assert!(program.diagnostics.is_empty(), "{:?}", program.diagnostics);
}

#[test]
fn arcs_take_two_points_and_displacements_are_known_in_any_language() {
    let (_, program) = program(
        &[
            "C P[1]    \r\n    :  P[2] 5mm/sek FINE    ;",
            "L P[3] 5mm/sek CNT0 ACC100 ZEIT VOR .10sek,P-SPS WKZ_Offset ,PR[5]    ;\r\n      1:  DO[1]=ON ;\r\n       ------ ;",
            "L P[3] 5mm/sek FINE Skip,LBL[1] ;",
            "  Touch Offset PR[7] ;",
            "L P[4] 5mm/sek FINE ;",
            "  Touch Offset End ;",
            "L P[4] 5mm/sek FINE COORD ;",
        ],
        &[point(1, HEAD, "1.0"), point(2, HEAD, "2.0"), point(3, HEAD, "3.0"), point(4, HEAD, "4.0")],
    );
    assert_eq!(named(&program, "P[1]").uses[0].path, PathKind::ArcVia);
    assert_eq!(named(&program, "P[2]").uses[0].path, PathKind::ArcEnd);
    assert_eq!(reasons(&program, "P[3]"), ["displaced by PR[5]"]);
    assert_eq!(named(&program, "P[3]").uses.len(), 2);
    assert_eq!(reasons(&program, "P[4]").len(), 2);
}

#[test]
fn an_index_register_may_mean_any_point_that_is_not_named() {
    let points = [point(1, HEAD, "1.0"), point(2, HEAD, "2.0"), point(1, HEAD, "3.0")];
    let (_, program) = program(&["J P[R[1]] 1% FINE ;", "J P[2] 1% FINE ;"], &points);
    assert!(named(&program, "P[R[1]]").computed.is_some());
    assert_eq!((named(&program, "P[1]").uses.len(), named(&program, "P[2]").uses.len()), (1, 1));
    assert_eq!(program.targets.len(), 3);
    assert!(program.diagnostics.iter().any(|finding| finding.code == "duplicate-point"));
}

#[test]
fn what_is_cut_off_or_broken_is_said() {
    let codes = |program: &Program| program.diagnostics.iter().map(|finding| finding.code).collect::<Vec<_>>();
    let cut = point(2, HEAD, "2.0").replace("};", "");
    let (_, broken) = program(&["J P[1] 1% FINE ;"], &[point(1, HEAD, "1.2.3"), cut]);
    assert_eq!(codes(&broken), ["broken-point", "truncated"]);
    assert!(named(&broken, "P[1]").computed.is_some());
    let text = "/PROG A\n/MN\n   1:J P[1] 100% FINE    ;\n   2:J P[2";
    assert_eq!(codes(&read(&[Source::new("a", text)])), ["truncated"]);
}

#[test]
fn a_mismatch_of_frames_is_reported_once() {
    let statements = ["  UFRAME_NUM=3 ;", "J P[1] 1% FINE ;", "L P[1] 1% FINE ;", "  LBL[1] ;", "  PAYLOAD[2] ;"];
    let (_, program) = program(&statements, &[point(1, HEAD, "1.0")]);
    let codes: Vec<_> = program.diagnostics.iter().map(|finding| finding.code).collect();
    assert_eq!(codes, ["frame-mismatch", "payload-schedule"]);
}

#[test]
fn only_fanuc_programs_are_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is("/PROG  A\t  Macro\r\n/ATTR\r\n"));
    assert!(is("\u{feff}/PROG A\n/MN\n/POS\n/END"));
    for text in [
        "",
        "/PROG A",
        "ERRALL.LS\n/PROG A\n/MN\n",
        "/JOB\n//NAME A\n//POS\n",
        ".PROGRAM a()\n/END\n",
        "/PROGRAM A\n/MN",
    ] {
        assert!(!is(text), "{text}");
    }
}

#[test]
fn a_frame_selected_under_a_condition_is_known_only_at_run_time() {
    let frame = |statements: &[&str]| {
        let (_, program) = program(statements, &[point(1, HEAD, "900.000")]);
        named(&program, "P[1]").uses[0].frame.clone()
    };
    assert_eq!(frame(&["  UFRAME_NUM=1 ;", "L P[1] 100mm/sec FINE ;"]), Reference::Named("1".into()));
    let conditional = frame(&["  UFRAME_NUM=1 ;", "  IF (DI[1]),UFRAME_NUM=2 ;", "L P[1] 100mm/sec FINE ;"]);
    assert!(matches!(conditional, Reference::Runtime(_)));
}
