//! The reader as a whole, on small projects.

use crate::base::text::Source;
use crate::program::dialect::Dialect;
use crate::program::target::{PathKind, Program, Reference, Target, TargetValue};

use super::Spel;
use super::points::is_point_file;
use super::reader::read;
use super::statement::is_program;

fn point(number: u32, label: &str, coordinates: [f64; 6], more: &str) -> String {
    let [x, y, z, u, v, w] = coordinates;
    format!(
        "Point{} {{\r\n\tnNumber={number}\r\n\tsLabel=\"{label}\"\r\n\trX={x}\r\n\trY={y}\r\n\trZ={z}\r\n\trU={u}\r\n\
         \trV={v}\r\n\trW={w}\r\n{more}}}\r\n",
        number + 1
    )
}

fn points(all: &[String]) -> Source {
    let head = "ENVT0100,LM:2024/03/18 10:12:44:120,DS:0000000775,CS:19751,MA:0,EI:   \r\nnNumberOfJoints=6\r\n";
    Source::new("robot1.pts", format!("{head}{}", all.concat()))
}

fn project(body: &str, all: &[String]) -> Program {
    read(&[Source::new("Main.prg", format!("Function main\r\n{body}\r\nFend\r\n")), points(all)])
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    let found = program.targets.iter().find(|target| target.name.as_deref() == Some(name));
    found.unwrap_or_else(|| panic!("no {name} in {:?}", program.targets))
}

const P: [f64; 6] = [1.0, 2.0, 3.0, 90.0, 0.0, 180.0];

#[test]
fn labels_and_numbers_name_one_point() {
    let more = "\tnLocal=2\r\n\tnHand=2\r\n\tnElbow=1\r\n\tnJ4Flag=0\r\n\tnJ6Flag=1\r\n\trS=12.5\r\n";
    let program =
        project("Go PICK\r\nMove P3 CP; Arc pick, P(4) CP", &[point(3, "pick", P, more), point(4, "", P, "")]);
    assert_eq!(program.targets.len(), 2);
    let pick = named(&program, "pick");
    let TargetValue::Cartesian(numbers) = &pick.value else { panic!("a pose") };
    assert_eq!(numbers.position.each_ref().map(|field| field.value), [1.0, 2.0, 3.0]);
    let paths: Vec<_> = pick.uses.iter().map(|one| (one.path, one.frame.clone())).collect();
    let local = Reference::Named("2".into());
    assert_eq!(paths, [(PathKind::Joint, local.clone()), (PathKind::Linear, local.clone()), (PathKind::ArcVia, local)]);
    assert_eq!(named(&program, "P4").uses[0].path, PathKind::ArcEnd);
    assert_eq!((pick.configuration.rear, pick.configuration.elbow_down), (Some(true), Some(false)));
    assert_eq!(pick.configuration.joint_intervals_deg, [(3, -180.0, 180.0)]);
    assert_eq!((pick.external_axes[0].name.as_str(), pick.external_axes[0].value), ("S", 12.5));
}

/// The Visual Components post: U, V, W are the turns about fixed Z, Y, X, W first. A tool that points down and whose X
/// axis lies along the base's Y is (90, 0, 180).
#[test]
fn angles_turn_about_fixed_axes() {
    let program = project("Go P0", &[point(0, "", P, "")]);
    let TargetValue::Cartesian(numbers) = &program.targets[0].value else { panic!("a pose") };
    let rotation = numbers.pose().expect("a rotation").rotation;
    assert!((rotation.column(2) + nalgebra::Vector3::z()).norm() < 1e-12);
    assert!((rotation.column(0) - nalgebra::Vector3::y()).norm() < 1e-12);
}

#[test]
fn what_is_set_at_run_time_is_computed() {
    let all: Vec<String> = (0..8).map(|number| point(number, "", P, "")).collect();
    let untaught = point(9, "no", P, "\tnUndefined=262143\r\n");
    let body = "P1 = Here\r\nGo P1\r\nP2 = P3 +X(5)\r\nGo P2\r\nLocal 1, P4, P5, P6\r\nGo P4\r\nMove P3 +Z(10)\r\nGo no\r\n\
                Go P77\r\nGo LJM(P0)\r\nTMove XY(0,0,1,0)\r\nGo XY(x,1,2,3,4,5)\r\nGo XY(1,2,3,4)\r\nP7 = XY(1,2,3,4,5,6)\r\n\
                Go P7 ' Go P0\r\nPrint \"Go P0\"";
    let program = project(body, &[all, vec![untaught]].concat());
    for name in ["P1", "P2", "P4", "no", "P77", "LJM(P0)", "XY(0,0,1,0)", "XY(x,1,2,3,4,5)", "XY(1,2,3,4)"] {
        let target = named(&program, name);
        assert!(target.computed.is_some() || target.uses.iter().all(|one| one.computed.is_some()), "{name}");
    }
    assert!(named(&program, "P3").uses[0].computed.is_some());
    let constant = named(&program, "P7");
    assert_eq!((constant.file, constant.computed.is_some()), (0, false));
    assert!(!program.targets.iter().any(|target| target.name.as_deref() == Some("P0")));
}

#[test]
fn an_index_may_mean_any_taught_point_that_is_not_named() {
    let all = [point(1, "", P, ""), point(2, "", P, ""), point(3, "", P, "\tnUndefined=1\r\n")];
    let program = project("Go P(i + 1)\r\nMove P2", &all);
    assert_eq!((named(&program, "P1").uses.len(), named(&program, "P2").uses.len()), (1, 1));
    assert!(named(&program, "P(i + 1)").computed.is_some());
    assert_eq!(program.targets.len(), 3);
}

#[test]
fn positions_may_stand_in_the_motion() {
    let program =
        project("Go XY( 1, -2.5, 3,4,5,6 ) /L /B /2 CP\r\nGo JA(1,2,3,4,5,6)\r\nGo AglToPls(1,2,3,4,5,6)", &[]);
    assert_eq!(program.targets.iter().map(Target::kind).collect::<Vec<_>>(), ["cartesian", "joint", "joint"]);
    let first = &program.targets[0];
    assert_eq!((first.configuration.rear, first.configuration.elbow_down), (Some(true), Some(true)));
    assert_eq!(first.uses[0].frame, Reference::Named("2".into()));
}

#[test]
fn tools_are_followed_through_the_order_of_the_program() {
    let body = "TLSet 1, XY(0,0,100,90,0,0)\r\nTLSet 2, XY(0,0,50)\r\nTLSet 2, XY(0,0,60)\r\nSetUp\r\nGo P1\r\nIf a Then Tool \
                2 Else Go P2\r\nGo P3\r\nTool n\r\nGo P4\r\nFend\r\nFunction SetUp\r\nTool 1";
    let all: Vec<String> = (0..5).map(|number| point(number, "", P, "")).collect();
    let program = project(body, &all);
    let tool = |name: &str| match &named(&program, name).uses[0].tool {
        Reference::Named(name) => name.to_string(),
        _ => "?".into(),
    };
    assert_eq!(["P1", "P2", "P3", "P4"].map(tool), ["1", "1", "?", "?"]);
    assert!((program.tools["1"].value.as_ref().expect("known").pose.translation.z - 0.1).abs() < 1e-12);
    assert!(program.tools["2"].value.is_err() && program.tools["0"].value.is_ok());
}

#[test]
fn what_is_cut_off_or_broken_is_said() {
    let codes =
        |sources: &[Source]| -> Vec<_> { read(sources).diagnostics.iter().map(|finding| finding.code).collect() };
    assert_eq!(codes(&[Source::new("a.prg", "Function main\nGo P1")]), ["truncated"]);
    let cut = point(1, "", P, "").replace('}', "");
    assert_eq!(codes(&[points(&[point(0, "", P, ""), cut])]), ["truncated", "checksum"]);
    let broken = point(1, "", P, "").replace("rX=1", "rX=1,0");
    assert_eq!(codes(&[points(&[broken])]), ["broken-point", "checksum"]);
}

#[test]
fn only_spel_is_recognised() {
    assert!(is_point_file(&points(&[])));
    let is = |text: &str| is_program(&Source::new("t", text));
    assert!(is("' x\r\nFunction main\r\nGo P1\r\nFend\r\n"));
    for text in ["", "Function main\n", "Fend\nFunction main\n", "def main():\nend\n", "FUNCTIONAL x\nFend"] {
        assert!(!is(text), "{text}");
    }
}

#[test]
fn defined_names_stand_for_points_and_numbers() {
    let include = "' cell\r\n#define PICK P3\r\n#define GRIP 2 ' gripper\r\n#define FIRST PICK\r\n#define TWICE 1\r\n";
    let include = Source::new("cell.inc", include);
    let body = "#include \"cell.inc\"\r\n#define TWICE 2\r\nFunction main\r\nTLSet GRIP, XY(0,0,100,0,0,0)\r\nTool GRIP\r\n\
                Go FIRST\r\nMove P(SLOT)\r\nTool TWICE\r\nGo P5\r\nFend\r\n#define SLOT 4\r\n";
    let all: Vec<String> = (3..6).map(|number| point(number, "", P, "")).collect();
    assert!(Spel.recognises(&include) && !Spel.recognises(&Source::new("cell.h", "#define PICK P3\n")));
    let program = read(&[Source::new("Main.prg", body), include, points(&all)]);
    let tool = |name: &str| named(&program, name).uses[0].tool.clone();
    let two = Reference::Named("2".into());
    assert_eq!((program.targets.len(), tool("P3"), tool("P4")), (3, two.clone(), two));
    assert!(program.tools["2"].value.is_ok() && matches!(tool("P5"), Reference::Runtime(_)));
}
