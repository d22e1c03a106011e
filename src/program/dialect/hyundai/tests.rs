//! What is read from text in the shapes that real jobs have.

use proptest::prelude::*;

use super::Hyundai;
use crate::base::diagnostic::Severity;
use crate::base::text::{Encoding, Newline, Source};
use crate::program::dialect::Dialect;
use crate::program::target::{PathKind, Program, Reference, Target, TargetValue};

const HI5: &str = "Program File Format Version : 1.6  MechType: 458(HA006B-01)  TotalAxis: 7  AuxAxis: 1\r\n";
const HI5_SIX: &str = "Program File Format Version : 1.6  MechType: 370(HS220-01)  TotalAxis: 6  AuxAxis: 0\r\n";
const HI6: &str = "Hyundai Robot Job File; { version: 1.6, mech_type: \"\", total_axis: -1, aux_axis: 0 }\n";
const POSE: &str = "(896.778,102.196,955.691,-180.000,0.003,-177.597,&H0008)";

fn job(header: &str, body: &str) -> (Source, Program) {
    let source = Source::new("0001.JOB", format!("{header}{body}"));
    let program = Hyundai.read(std::slice::from_ref(&source));
    (source, program)
}

fn hi5(body: &str) -> (Source, Program) {
    job(HI5_SIX, &format!("{body}\r\n     END\r\n"))
}

fn hi6(body: &str) -> (Source, Program) {
    job(HI6, &format!("{body}\n     end\n"))
}

fn only(program: &Program) -> &Target {
    assert_eq!(program.targets.len(), 1, "{:?}", program.targets);
    &program.targets[0]
}

fn position(target: &Target) -> [f64; 3] {
    match &target.value {
        TargetValue::Cartesian(numbers) => numbers.position.each_ref().map(|field| field.value),
        other => panic!("{other:?}"),
    }
}

fn joints(target: &Target) -> [f64; 6] {
    match &target.value {
        TargetValue::Joint(numbers) => numbers.joints.each_ref().map(|field| field.value),
        other => panic!("{other:?}"),
    }
}

fn codes(program: &Program) -> Vec<(&'static str, Severity)> {
    program.diagnostics.iter().map(|finding| (finding.code, finding.severity)).collect()
}

#[test]
fn axis_angles_stay_joint_values_under_a_linear_move() {
    let line = "S4   MOVE L,S=100%,A=3,T=0  (55.230,109.100,-21.889,-43.935,-71.457,25.590,0.000)A";
    let (source, program) = job(HI5, &format!("{line}\r\n     END\r\n"));
    let target = only(&program);
    assert_eq!(joints(target), [55.23, 109.1, -21.889, -43.935, -71.457, 25.59]);
    assert_eq!((target.external_axes[0].name.as_str(), target.external_axes[0].value), ("J7", 0.0));
    assert_eq!(target.name.as_deref(), Some("S4"));
    assert_eq!(source.text(target.span), "(55.230,109.100,-21.889,-43.935,-71.457,25.590,0.000)A");
    let used = &target.uses[0];
    assert_eq!(source.text(used.span), line);
    assert_eq!((&*used.motion, used.path), ("MOVE L", PathKind::Linear));
    assert_eq!(used.tool, Reference::Named("0".into()));
    assert!(program.diagnostics.is_empty());
}

#[test]
fn a_pose_is_found_before_and_after_the_parameters() {
    for line in [format!("S1   MOVE L,{POSE}U2,S=60%,A=3,T=3"), format!("S1   MOVE L,S=60%,A=3,T=3  {POSE}U2 'x (1,2)")]
    {
        let (source, program) = hi5(&line);
        let target = only(&program);
        assert_eq!(position(target), [896.778, 102.196, 955.691], "{line}");
        assert_eq!(source.text(target.span), format!("{POSE}U2"));
        assert_eq!(target.configuration.wrist_negative, Some(true));
        assert_eq!(target.uses[0].frame, Reference::Named("2".into()));
        assert_eq!(target.uses[0].tool, Reference::Named("3".into()));
    }
}

#[test]
fn additional_axes_stand_before_the_configuration() {
    let body = "S1   MOVE P,S=20%,A=7,T=1  (0.5,10.0,300.001,5.158,-0.029,91.146,1200.000,&H0601)U1\r\n     END\r\n";
    let (_, program) = job(HI5, body);
    let target = only(&program);
    assert_eq!(position(target), [0.5, 10.0, 300.001]);
    assert_eq!(target.external_axes.iter().map(|axis| axis.value).collect::<Vec<_>>(), [1200.0]);
    assert!(codes(&program).is_empty(), "{:?}", program.diagnostics);
}

#[test]
fn a_decimal_configuration_is_no_additional_axis() {
    let (_, program) = hi5("S1   MOVE P,S=20%,A=7,T=1  (204.5, 3719.35, 277.94, 0, 50, 0, 24)R");
    let target = only(&program);
    assert!(target.external_axes.is_empty());
    assert_eq!(target.configuration.wrist_negative, Some(true));
    assert_eq!(target.uses[0].frame, Reference::Unnamed);
}

#[test]
fn encoder_counts_missing_poses_and_shifts_are_computed() {
    let (_, program) = hi5(&format!(
        "S1   MOVE P,S=60%,A=3,T=0  (&H00404078,&H003ECE88,&H003FACD8,&H00401198,&H003F4CBC,&H003FECC0)E\r\n\
         S2   MOVE P,S=60%,A=3,T=0\r\n\
         S3   MOVE L,R2,S=LV1!cm/min,A=3,T=0  {POSE}\r\n\
         S4   SMOV S1,C,S=23mm/s,A=1,T=0  (1.0,2.0,3.0,4.0,5.0,6.0)A\r\n\
         S5   MOVE SL,S=23mm/s,A=1,T=VT%  {POSE}\r\n\
         S6   MOVE L,P[V1%],S=23mm/s,A=1,T=0"
    ));
    let of_target: Vec<bool> = program.targets.iter().map(|target| target.computed.is_some()).collect();
    let of_use: Vec<bool> = program.targets.iter().map(|target| target.uses[0].computed.is_some()).collect();
    assert_eq!(of_target, [true, true, false, false, false, true]);
    assert_eq!(of_use, [false, false, true, true, true, false]);
    assert!(matches!(program.targets[0].value, TargetValue::Counts));
    assert_eq!(program.targets[3].name.as_deref(), Some("S4"));
    assert_eq!(&*program.targets[3].uses[0].motion, "SMOV C");
    assert!(matches!(program.targets[4].uses[0].tool, Reference::Runtime(_)));
    assert!(codes(&program).is_empty());
}

#[test]
fn a_pose_constant_is_one_target_with_its_uses() {
    let (source, program) = hi5(&format!(
        "     P1={POSE}\r\n     P2={POSE}\r\nS1   MOVE L,P1,S=50%,A=3,T=1\r\n     DO1=1 'P1=(1,2)\r\nS2   MOVE P,P1,S=9%,A=0,T=1"
    ));
    let target = only(&program);
    assert_eq!((target.name.as_deref(), target.computed.as_deref()), (Some("P1"), None));
    assert_eq!(source.line(target.span.start), 2);
    assert_eq!(target.uses.iter().map(|used| source.line(used.span.start)).collect::<Vec<_>>(), [4, 6]);
}

#[test]
fn a_pose_constant_that_changes_is_computed() {
    for (change, word) in [
        (format!("P1={POSE}R"), "line 2 and line 3"),
        ("P1.X=P1.X+R8.X".to_owned(), "line 3"),
        ("TOUCHSEN TSC#=4,TF,TD,0,P1,V1!".to_owned(), "TOUCHSEN"),
        ("IF DI1=1 THEN P1=P2".to_owned(), "line 3"),
    ] {
        let (_, program) = hi5(&format!("     P1={POSE}\r\n     {change}\r\nS1   MOVE L,P1,S=50%,A=3,T=1"));
        let reason = only(&program).computed.clone().unwrap_or_default();
        assert!(reason.contains(word), "{change}: {reason}");
    }
    let (_, program) = hi5(&format!("     P1={POSE}\r\n     PRINT #0,P1.X\r\nS1   MOVE L,P1,S=50%,A=3,T=1"));
    assert_eq!(only(&program).computed, None);
}

#[test]
fn hi6_lists_are_joints_unless_they_say_otherwise() {
    let (_, program) = hi6("S1   move P,spd=100mm/sec,accu=0,tool=0  [10, 90, 20, 0, 0, 0] # [1,2]\n\
         S2   move L,spd=100mm/sec,accu=0,tool=2  [1000.5,-20.25,900,180,0,90,-5.5,\"u1\",\"re;r2\"]\n\
         S3   move P,tg=+Shift(0,0,0,0,-10,0),spd=80%,accu=1,tool=3 until di2  [10, 90, 20, 0, 0, 0]\n\
         S4   move L,spd=9%,accu=0,tool=0 until (di1 and di2)\n\
         S5   move L,spd=9%,accu=0,tool=0  [1000,0,900,180,0,90,\"sync(20.5,-12.0),robot\"]");
    assert_eq!(joints(&program.targets[0]), [10.0, 90.0, 20.0, 0.0, 0.0, 0.0]);
    let cartesian = &program.targets[1];
    assert_eq!(position(cartesian), [1000.5, -20.25, 900.0]);
    assert_eq!(cartesian.external_axes[0].value, -5.5);
    assert_eq!((cartesian.configuration.rear, cartesian.configuration.wrist_negative), (Some(true), Some(false)));
    assert_eq!(cartesian.uses[0].frame, Reference::Named("1".into()));
    assert!(program.targets[2].uses[0].computed.is_some());
    assert!(matches!(program.targets[3].value, TargetValue::Unwritten));
    assert!(program.targets[4].computed.as_deref().is_some_and(|reason| reason.contains("sync")));
}

#[test]
fn hi6_pose_variables_hold_when_their_arguments_are_constants() {
    let (source, program) = hi6("     var po=Pose(1850, 0, 2010.5, 0, -90, 0, \"base\", \"nf\")\n\
              var ps=Pose(\"[1850, 5, 2010.5, 0, -90, 0, \\\"u2\\\", \\\"fl\\\"]\")\n\
              var list=[Pose(10,90,0,0,-30,0),Pose(1850,7,2010,0,0,0,\"base\")]\n\
              var sum=po+Shift(1,2,3,0,0,0,\"base\")\n\
              var cur=cpo(\"joint\",\"cur\")\n\
              cur.j7=90\n\
         S1   move P,po,spd=80%,accu=1,tool=1\n\
         S2   move L,tg=ps,spd=80%,accu=1,tool=1\n\
         S3   move L,tg=list[1],spd=80%,accu=1,tool=1\n\
         S4   move L,tg=sum,spd=80%,accu=1,tool=1\n\
         S5   move L,tg=cur,spd=80%,accu=1,tool=1\n\
         S6   move L,tg=list[i],spd=80%,accu=1,tool=1\n\
         S7   move L,tg=po+sft[1],spd=80%,accu=1,tool=1");
    let summary: Vec<(String, bool)> = program
        .targets
        .iter()
        .map(|target| (target.name.clone().unwrap_or_default(), target.computed.is_some()))
        .collect();
    let names: Vec<(&str, bool)> = summary.iter().map(|(name, computed)| (name.as_str(), *computed)).collect();
    assert_eq!(
        names,
        [("po", false), ("ps", false), ("list[1]", false), ("sum", true), ("cur", true), ("S6", true), ("S7", true)]
    );
    assert_eq!(position(&program.targets[1]), [1850.0, 5.0, 2010.5]);
    assert_eq!(program.targets[1].uses[0].frame, Reference::Named("2".into()));
    assert!(source.text(program.targets[1].span).ends_with("\\\"]\")"));
    assert_eq!(position(&program.targets[2]), [1850.0, 7.0, 2010.0]);
}

#[test]
fn tools_and_frames_of_the_job() {
    let (_, program) = hi5(
        "     Tool1=(10.000,0.000,150.000,0.000,90.000,0.000)T\r\n     MKUCRD 1,(1000.000,0.000,500.000,0.000,0.000,90.000,&H0000)\r\n     MKUCRD 2,(1.0,0.0,5.0,0.0,0.0,90.0,&H0000)U1",
    );
    let tool = program.tools["1"].value.as_ref().expect("a constant");
    assert_eq!(tool.pose.translation.as_slice(), [0.01, 0.0, 0.15]);
    // A turn of 90 degrees about y takes z to x.
    assert!((tool.pose.rotation * nalgebra::Vector3::z() - nalgebra::Vector3::x()).norm() < 1e-12);
    let frame = program.frames["1"].value.as_ref().expect("a constant");
    assert_eq!(frame.pose.translation.as_slice(), [1.0, 0.0, 0.5]);
    assert!(program.frames["2"].value.is_err());

    let (_, program) = hi6(
        "     _tool[1]=Shift(100,20,300,0,0,0,\"tool\")\n     _tool[1].mass=5\n     _tool[1].cx=10\n     _tool[1].cy=0\n     _tool[1].cz=100\n\
              _tool3=Shift(_mw1/10,0,0,0,0,0,\"tool\")\n\
              var o=Pose(1000,0,0,0,0,0,\"base\")\n     var x=Pose(1000,100,0,0,0,0,\"base\")\n     var xy=Pose(900,100,0,0,0,0,\"base\")\n     var r=mkucs(4,o,x,xy)",
    );
    let load = program.tools["1"].value.as_ref().expect("a constant").load.expect("a load");
    assert_eq!((load.mass_kg, load.center_of_mass_m), (5.0, [0.01, 0.0, 0.1]));
    assert!(program.tools["3"].value.is_err());
    let frame = program.frames["4"].value.as_ref().expect("three constants");
    // x of the frame is y of the base, and the plane's second direction is -x.
    assert!((frame.pose.rotation * nalgebra::Vector3::x() - nalgebra::Vector3::y()).norm() < 1e-12);
    assert!((frame.pose.rotation * nalgebra::Vector3::y() + nalgebra::Vector3::x()).norm() < 1e-12);
}

#[test]
fn the_selected_user_frame_holds_for_poses_without_a_number() {
    let step = format!("S1   MOVE L,S=9%,A=0,T=1  {POSE}U");
    let frame = |body: &str| hi5(body).1.targets.last().expect("a target").uses[0].frame.clone();
    assert_eq!(frame(&format!("     SELUCRD 3\r\n{step}")), Reference::Named("3".into()));
    assert_eq!(frame(&format!("     SELUCRD 1\r\n     SELUCRD 3\r\n{step}")), Reference::Named("3".into()));
    assert_eq!(frame(&format!("     SELUCRD 0\r\n{step}")), Reference::Unnamed);
    let open = |body: &str| matches!(frame(&format!("     SELUCRD 1\r\n{body}\r\n{step}")), Reference::Runtime(_));
    assert!(open("     IF DI1 THEN 10\r\n     SELUCRD 3"));
    assert!(open("     IF DI1 THEN S1\r\n     SELUCRD 3"));
    assert!(open("     IF DI1 THEN SELUCRD 3"));
    assert!(open("     IF DI1 THEN\r\n     SELUCRD 3\r\n     ENDIF"));
    assert!(open("     SELUCRD 3\r\n     CALL 12"));
    // A jump past the step, and branches before the last selection, change nothing.
    let known = |body: &str| frame(&format!("     SELUCRD 1\r\n{body}\r\n{step}\r\n90   STOP"));
    assert_eq!(known("     IF DI1 THEN 90\r\n     SELUCRD 3"), Reference::Named("3".into()));
    assert_eq!(
        known("     IF DI1 THEN\r\n     SELUCRD 2\r\n     ENDIF\r\n     SELUCRD 3"),
        Reference::Named("3".into())
    );
    assert!(matches!(frame(&format!("     SELUCRD V1%\r\n{step}")), Reference::Runtime(_)));
    assert!(matches!(frame(&step), Reference::Runtime(_)));
}

#[test]
fn text_that_only_looks_like_a_move_is_none() {
    let (_, program) = hi5(
        "     PRINT #0,\"S9   MOVE P,S=1%,A=0,T=1  (1,2,3,4,5,6)A\"\r\n     'MOVE P,S=1%,A=0,T=1  (1,2,3,4,5,6)A\r\n     REM MOVE P,S=1%,A=0,T=1  (1,2,3,4,5,6)A",
    );
    assert!(program.targets.is_empty());
}

#[test]
fn a_pose_that_is_cut_off_is_an_error() {
    let whole = format!("{HI5}S1   MOVE L,S=100%,A=3,T=0  (55.2,109.1,-21.8,-43.9,-71.4,25.5,0.0)A\r\n     END\r\n");
    assert!(codes(&job(&whole, "").1).is_empty());
    let open = whole.rfind('(').expect("a tuple");
    let close = whole.rfind(')').expect("its end");
    let end = whole.find("END").expect("an end") + "END".len();
    for cut in HI5.len()..end {
        let expected = if cut > open && cut <= close + 1 {
            ("truncated", Severity::Error)
        } else {
            ("missing-end", Severity::Warning)
        };
        let mut found = codes(&job(&whole[..cut], "").1);
        found.retain(|(_, severity)| *severity > Severity::Note);
        assert_eq!(found, [expected], "{:?}", &whole[..cut]);
    }
    for (text, wrong) in [("P1=(1.0,2.0", true), ("P1=(1.0,2.0,3.0,4.0,5.0,6.0,7.0,&H8)U", true), ("DO1=1", false)] {
        let expected = if wrong { ("truncated", Severity::Error) } else { ("missing-end", Severity::Warning) };
        assert_eq!(codes(&job(HI5, text).1), [expected], "{text}");
    }
}

#[test]
fn axes_and_units_are_checked() {
    let (_, program) = job(HI5, "S1   MOVE P,S=1%,A=0,T=1  (1.0,2.0,3.0,4.0,5.0,6.0)A\r\n     END\r\n");
    assert_eq!(codes(&program), [("axis-count", Severity::Error)]);
    let (_, program) = hi5("S1   MOVE P,S=1%,A=0,T=1  (1.0,2.0,3.0,4.0)A");
    assert_eq!(codes(&program), [("axis-count", Severity::Error)]);
    assert!(only(&program).computed.is_some());
    let (_, program) = hi5("S1   MOVE P,S=1%,A=0,T=1  (1.85,0.2,1.1,180.0,0.0,0.0,&H0008)");
    assert_eq!(codes(&program), [("unit-scale", Severity::Warning)]);
    let (_, program) = hi5("S1   MOVE P,S=1%,A=0,T=1  (1.85,x,1.1,180.0,0.0,0.0,&H0008)");
    assert_eq!(codes(&program), [("malformed-pose", Severity::Error)]);
}

#[test]
fn jobs_are_told_from_other_languages() {
    let is = |text: &str| Hyundai.recognises(&Source::new("t", text));
    assert!(is(HI5) && is(HI6) && is(&format!("\u{feff}{HI6}")) && is(&format!("\r\n  {HI5}")));
    assert!(is("     'x\r\nS1   MOVE P,S=60%,A=3,T=0  (1,2,3,4,5,6)A\r\n"));
    assert!(is("     move L,tg=po,spd=9%,accu=1,tool=1\n"));
    for other in [
        "",
        "/JOB\r\n//NAME X\r\nNOP\r\nMOVJ C00000 VJ=50.00\r\n",
        "/PROG X\n   1:J P[1] 100% FINE ;\n",
        "MODULE M\n  MoveL p1,v100,fine,tool0;\nENDMODULE\n",
        "DEF X()\nPTP {A1 0,A2 -90}\nEND\n",
        "PROGRAM PRO1\nMOVE P, P1, S=50\nEND\n",
        "removed P,S=1%\n",
    ] {
        assert!(!is(other), "{other}");
    }
}

#[test]
fn the_files_of_one_job_share_numbered_constants_but_not_locals() {
    let first = Source::new("0001.JOB", format!("{HI5_SIX}     P1={POSE}\r\n     END\r\n"));
    let second = Source::new("0002.JOB", format!("{HI5_SIX}S1   MOVE L,P1,S=1%,A=0,T=1\r\n     END\r\n"));
    let program = Hyundai.read(&[first, second]);
    assert_eq!((only(&program).file, only(&program).uses[0].file), (0, 1));
    let first = Source::new("1.job", format!("{HI6}     var po=Pose(1,2,3,4,5,6)\n     end\n"));
    let second = Source::new("2.job", format!("{HI6}S1   move L,po,spd=1%,accu=0,tool=1\n     end\n"));
    assert!(only(&Hyundai.read(&[first, second])).computed.is_some());
}

#[test]
fn shipped_programs_read_as_their_readme_says() {
    let read = |name: &str| {
        let path = format!("{}/programs/hyundai/{name}", env!("CARGO_MANIFEST_DIR"));
        let source = Source::new(name, std::fs::read(path).expect("a shipped program"));
        assert!(Hyundai.recognises(&source));
        let program = Hyundai.read(std::slice::from_ref(&source));
        assert!(
            program.diagnostics.iter().all(|finding| finding.severity == Severity::Note),
            "{:?}",
            program.diagnostics
        );
        let cartesian =
            program.targets.iter().filter(|target| matches!(target.value, TargetValue::Cartesian(_))).count();
        let computed = program
            .targets
            .iter()
            .filter(|target| target.computed.is_some() || target.uses.iter().any(|used| used.computed.is_some()))
            .count();
        let encoding = source.encoding(Hyundai.meta().code_page);
        (encoding, source.newline(), program.targets.len(), cartesian, computed)
    };
    assert_eq!(read("0101_spot.JOB"), (Encoding::Cp949, Newline::CrLf, 78, 75, 0));
    assert_eq!(read("0061_handling.JOB"), (Encoding::Cp949, Newline::CrLf, 23, 11, 8));
    assert_eq!(read("2200_mill.job"), (Encoding::Utf8Bom, Newline::Lf, 3, 0, 0));
    for part in ["2201_mill.job", "2202_mill.job", "2203_mill.job"] {
        assert_eq!(read(part), (Encoding::Utf8Bom, Newline::Lf, 943, 943, 0));
    }
}

proptest! {
    #[test]
    fn any_bytes_are_read_without_a_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let source = Source::new("t", bytes);
        Hyundai.recognises(&source);
        Hyundai.read(&[source]);
    }

    #[test]
    fn damaged_jobs_are_read_and_every_span_lies_inside(
        cuts in proptest::collection::vec((0_usize..900, 0_usize..12), 1..6),
        glue in "[(\\[)\\],\"'#&HU=+ .*0-9A-Z\\\\\r\n]{0,8}",
    ) {
        let mut text = format!(
            "{HI6}     var po=Pose(1850, 0, 2010.5, 0, -90, 0, \"base\", \"nf\")\n     P1={POSE}U1\n     MKUCRD 1,{POSE}\n\
             S1   move P,po,spd=80%,accu=1,tool=1 until di2  [1,2,3,4,5,6,\"u1\"]\nS2   MOVE C,P1,S=1%,A=1,T=1\n\
             S3   SMOV S1,C,S=1%,A=1,T=1  (1,2,3,4,5,6)A\n     _tool[1]=Shift(1,2,3,4,5,6,\"tool\")\n     end\n"
        ).into_bytes();
        for (at, length) in cuts {
            let at = at.min(text.len());
            let end = (at + length).min(text.len());
            text.splice(at..end, glue.bytes());
        }
        let source = Source::new("t", text);
        let program = Hyundai.read(std::slice::from_ref(&source));
        for target in &program.targets {
            prop_assert!(target.span.end <= source.bytes().len() && !target.span.is_empty());
            prop_assert!(!target.uses.is_empty());
            if let TargetValue::Cartesian(numbers) = &target.value {
                prop_assert!(numbers.position.iter().chain(&numbers.orientation).all(|field| target.span.contains(field.span())));
            }
        }
    }
}

#[test]
fn long_and_deep_input_takes_linear_time() {
    for unit in [
        "(",
        "[",
        "\"",
        "\\\"",
        "\"\\\"",
        "S1 MOVE P,",
        "P[",
        "IF A THEN ",
        "P1=P1,",
        "SELUCRD 1\nS1 MOVE L,S=1  (1,2,3,4,5,6)U\nSELUCRD 2\n",
    ] {
        for prefix in ["", "S1   MOVE P,S=1%,A=0,T=1  ", "     P1=", "     CALL ", "     MKUCRD 1,"] {
            let source = Source::new("t", format!("{HI5}{prefix}{}", unit.repeat(200_000 / unit.len())));
            let started = std::time::Instant::now();
            Hyundai.read(std::slice::from_ref(&source));
            assert!(started.elapsed().as_secs() < 5, "{prefix}{unit}");
        }
    }
}
