//! The reader as a whole, on small programs.

use crate::base::text::Source;
use crate::program::dialect::Dialect;
use crate::program::target::{DisplacementKind, PathKind, Program, Reference, Target, TargetValue};

use super::Kawasaki;
use super::reader::read;
use super::section::recognises;

fn program(body: &str, data: &str) -> Program {
    let text = format!(".PROGRAM main()@24/05/14 10:02 #0; LMOVE no\n{body}\n.END\n{data}");
    read(&[Source::new("t.as", text)])
}

const DATA: &str = ".TRANS\np 100.5 -20 300 10 170 -30\nq[1] 1 2 3 0 180 0\nq[2] 4 5 6 0 180 0\nf 10 0 0 90 0 0\n\
                    grip 0 0 100 0 0 0\nglue 0 0 200 0 0 0\n.END\n.JOINTS\n#home 0 10 -90 0 -80 0 250.5\n.END\n";

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    let found = program.targets.iter().find(|target| target.name.as_deref() == Some(name));
    found.unwrap_or_else(|| panic!("no {name} in {:?}", program.targets))
}

fn tool(program: &Program, name: &str, one: usize) -> String {
    match &named(program, name).uses[one].tool {
        Reference::Named(name) => name.to_string(),
        Reference::Unnamed => "-".into(),
        Reference::Runtime(_) => "?".into(),
    }
}

#[test]
fn locations_of_the_sections_are_targets_where_motions_go_there() {
    let program = program("  JMOVE #home\n  LMOVE P ; lmove f\n10 C1MOVE q[1]\n  C2MOVE q[ 2 ],1\n  x = p.x", DATA);
    assert_eq!(program.targets.len(), 4);
    let TargetValue::Cartesian(numbers) = &named(&program, "p").value else { panic!("a pose") };
    assert_eq!(numbers.position.each_ref().map(|field| field.value), [100.5, -20.0, 300.0]);
    assert_eq!(numbers.orientation.iter().map(|field| field.value).collect::<Vec<_>>(), [10.0, 170.0, -30.0]);
    assert_eq!(named(&program, "q[1]").uses[0].path, PathKind::ArcVia);
    assert_eq!(named(&program, "q[2]").uses[0].path, PathKind::ArcEnd);
    let home = named(&program, "#home");
    assert_eq!((home.kind(), home.external_axes[0].name.as_str()), ("joint", "JT7"));
    assert!(program.diagnostics.is_empty());
}

/// The AS Language Reference Manual on transformation values: O turns about Z, A about the turned Y, T about the turned
/// Z. (0,90,0) points the tool along X, and (90,90,0) along Y.
#[test]
fn angles_are_those_of_the_manual() {
    for (angles, z_axis) in [("0,90,0", [1.0, 0.0, 0.0]), ("90,90,0", [0.0, 1.0, 0.0]), ("33,180,12", [0.0, 0.0, -1.0])]
    {
        let program = program(&format!("LMOVE TRANS(0,0,0,{angles})"), "");
        let TargetValue::Cartesian(numbers) = &program.targets[0].value else { panic!("a pose") };
        let pose = numbers.pose().expect("a rotation");
        let found: Vec<f64> = pose.rotation.column(2).iter().copied().collect();
        assert!(found.iter().zip(z_axis).all(|(a, b)| (a - b).abs() < 1e-12), "{angles}: {found:?}");
    }
}

#[test]
fn what_is_set_at_run_time_is_computed() {
    let body = "HERE p\nLMOVE p\nPOINT q[n] = p\nLMOVE q[1]\nPOINT a = TRANS(1,2,3,4,5,6)\nLMOVE a\nPOINT b = \
                TRANS(x,2,3,4,5,6)\nLMOVE b\nPOINT c = a+f\nLMOVE c\nPOINT/X d = a\nLMOVE d\nLMOVE nowhere\nTDRAW 1,2,3\n\
                XMOVE f TILL sig\nLAPPRO glue,50\nLMOVE p-q[2]\nPOINT twice = TRANS(1,2,3,4,5,6)\nPOINT twice = \
                TRANS(1,2,3,4,5,7)\nLMOVE twice";
    let program = program(body, DATA);
    for name in ["p", "q[1]", "b", "c", "d", "nowhere", "TDRAW 1,2,3", "p-q[2]", "twice"] {
        assert!(named(&program, name).computed.is_some(), "{name}");
    }
    assert!(named(&program, "a").computed.is_none());
    assert!(named(&program, "f").uses[0].computed.is_some());
    assert!(named(&program, "glue").uses[0].computed.is_some());
}

#[test]
fn a_variable_index_may_mean_any_element() {
    let program = program("FOR i = 1 TO 2\n  LMOVE q[i]\nEND", DATA);
    assert_eq!((named(&program, "q[1]").uses.len(), named(&program, "q[2]").uses.len()), (1, 1));
}

#[test]
fn compound_locations_are_frames_or_displacements() {
    let body = "LMOVE p\nLMOVE p+TRANS(0,0,-50)\nLMOVE SHIFT(p BY 1,2,3)\nLMOVE f+q[1]\nLMOVE f+f+TRANS(1,2,3,0,180,0)\n\
                LMOVE p+f\nLMOVE SHIFT(q[2] BY 1,2,3)";
    let program = program(body, DATA);
    let displaced = |name: &str| match &named(&program, name).value {
        TargetValue::Displaced(displacement) => {
            let base = program.targets[displacement.base].name.clone();
            (displacement.kind, displacement.position.each_ref().map(|field| field.value), base)
        }
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!(displaced("p+TRANS(0,0,-50)"), (DisplacementKind::Tool, [0.0, 0.0, -50.0], Some("p".into())));
    assert_eq!(displaced("SHIFT(p BY 1,2,3)"), (DisplacementKind::Frame, [1.0, 2.0, 3.0], Some("p".into())));
    assert_eq!(named(&program, "q[1]").uses[0].frame, Reference::Named("f".into()));
    let inline = program.targets.iter().find(|target| target.name.is_none()).expect("the inline target");
    let Reference::Named(frame) = &inline.uses[0].frame else { panic!("a frame") };
    let pose = program.frames[&Program::key(frame)].value.as_ref().expect("known").pose;
    // Twice: 10 mm along x and a quarter turn.
    assert!((pose.translation - nalgebra::Vector3::new(0.01, 0.01, 0.0)).norm() < 1e-12);
    assert!(named(&program, "p+f").computed.is_some());
    assert!(named(&program, "SHIFT(q[2] BY 1,2,3)").computed.is_some());
}

#[test]
fn tools_are_followed_through_branches_and_calls() {
    let body = "TOOL grip\nLMOVE p\nFOR i = 1 TO 3\n  CALL sub\nEND\nIF SIG(1) THEN\n  TOOL glue\nEND\nLMOVE p\nTOOL NULL\n\
                LMOVE p\nTOOL ext\nLMOVE p\nTOOL q[n]\nLMOVE p\n.END\n.PROGRAM sub()\nLMOVE f";
    let program = program(body, DATA);
    let tools: Vec<String> = (0..5).map(|one| tool(&program, "p", one)).collect();
    assert_eq!(tools, ["grip", "?", "NULL", "ext", "?"]);
    assert_eq!(tool(&program, "f", 0), "grip");
    assert!(program.tools.contains_key("null") && !program.tools.contains_key("ext"));
}

#[test]
fn the_load_belongs_to_a_tool_that_the_job_holds() {
    let program = program("TOOL grip\nWEIGHT 12.5,1,2,30,0,0,0\nLMOVE p", DATA);
    let name = tool(&program, "p", 0);
    let load = program.tools[&Program::key(&name)].value.as_ref().expect("known").load.expect("a load");
    assert_eq!((load.mass_kg, load.center_of_mass_m), (12.5, [0.001, 0.002, 0.03]));
}

#[test]
fn block_steps_name_their_tool_and_system_data_defines_it() {
    let data = ".SYSDATA\nTOOL1 10 0 20 0 90 0\nTOOL 1 2 3 0 0 0\nTOOLSHAPE 0 0 0 0 0 0 0\n.END\n";
    let block =
        "JOINT SPEED9 ACCU1 TIMER0 TOOL1 WORK0 CLAMP1 (OFF,0,0,O) OX= WX= #[-30.05,54.1,-92.9,-8.3,18.9,-169.2] ;x";
    let program = program(&format!("{block}\nLMOVE TRANS(1,2,3,4,5,6)"), data);
    let uses: Vec<_> = program.targets.iter().map(|target| (target.kind(), target.uses[0].tool.clone())).collect();
    assert_eq!(uses[0], ("joint", Reference::Named("1".into())));
    assert_eq!(uses[1], ("cartesian", Reference::Named("TOOL of the system data".into())));
    assert!(program.tools.contains_key("1"));
}

#[test]
fn a_location_of_which_a_frame_is_made_keeps_its_numbers() {
    let program =
        program("POINT w = FRAME(p,q[1],q[2],p)\nLMOVE p\nTOOL glue\nLMOVE glue\nCALL teach(f)\nLMOVE f", DATA);
    assert!(named(&program, "p").computed.as_ref().is_some_and(|reason| reason.contains("frame")));
    assert!(named(&program, "glue").computed.as_ref().is_some_and(|reason| reason.contains("tool")));
    // The program that is called is not in the job: it may change what it gets.
    assert!(named(&program, "f").computed.as_ref().is_some_and(|reason| reason.contains("teach")));
}

#[test]
fn parameters_that_are_only_read_leave_the_location_as_it_is() {
    let body = "CALL go(p,f)\nLMOVE p\nLMOVE f\n.END\n.PROGRAM go(.a,.b)\nLMOVE .a\nHERE .b";
    let program = program(body, DATA);
    assert!(named(&program, "p").computed.is_none());
    assert!(named(&program, "f").computed.is_some());
    assert!(named(&program, ".a").computed.is_some());
}

#[test]
fn above_and_below_hold_for_the_next_motion() {
    let program = program("BELOW\nJMOVE p\nLMOVE f", DATA);
    assert_eq!(named(&program, "p").configuration.elbow_down, Some(true));
    assert_eq!(named(&program, "f").configuration.elbow_down, None);
}

#[test]
fn what_is_cut_off_is_said() {
    let codes = |text: &str| -> Vec<_> {
        read(&[Source::new("t", text)]).diagnostics.iter().map(|finding| finding.code).collect()
    };
    assert_eq!(codes(".PROGRAM a()\nLMOVE TRANS(1,2,3"), ["truncated"]);
    assert_eq!(codes(".TRANS\np 1 2 3 4 5 6\np 1 2 3\n.END\n"), ["broken-location", "duplicate-location"]);
}

#[test]
fn only_as_is_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is(".PROGRAM a()\n.END\n"));
    assert!(is("; a comment\r\n.TRANS\r\np 1 2 3 4 5 6\r\n.END"));
    for text in ["", ".PROGRAM a()", "/PROG A\n/MN\n.END", ".end", "PROC a()\n.PROGRAM x\n.END", ".TRANS 5\n.END\n"] {
        assert!(!is(text), "{text}");
    }
}

#[test]
fn locations_that_are_saved_apart_belong_to_the_programs_beside_them() {
    let programs = ".PROGRAM main()\nTOOL t1\nLMOVE p1\nJMOVE #home\nLMOVE .here\nLMOVE pal[i]\nCALL sub(p2)\n.END\n";
    let locations = ".TRANS\np1 1 2 3 0 180 0\npal[1] 1 2 3 0 180 0\np2 1 2 3 0 180 0\nt1 0 0 100 0 0 0\n.END\n.JOINTS\n\
                     #home 0 0 0 0 0 0\nother 1 2 3 4 5 6\n.END\n";
    let ties = |text: &str| Kawasaki.ties(&Source::new("t.as", text));
    let (taker, giver) = (ties(programs), ties(locations));
    assert!(giver.takes.is_empty() && giver.gives.len() == 6 && giver.gives.iter().all(|given| given.is_position));
    let taken = giver.gives.iter().filter(|given| taker.takes.contains(&given.name)).count();
    assert_eq!((taken, taker.takes.len()), (5, 5));
    // A whole save gives none of its locations: it may be that of another robot.
    let whole = ties(&format!("{programs}{locations}"));
    assert!(whole.takes.is_empty() && whole.gives == taker.gives);
}
