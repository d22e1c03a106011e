//! What the reader finds in small programs, checked against what the language says about them.

use approx::assert_abs_diff_eq;

use super::*;
use crate::base::diagnostic::Severity;
use crate::geometry::pose::{rotation_x, rotation_y, rotation_z};
use crate::program::target::{DisplacementKind, PathKind, Reference};

const P: &str = "[[100,20.5,-3E1],[0.6,0,0.8,0],[-1,0,1,4],[1500,9E9,9E+09,9E9,9E9,9E9]]";

fn read(text: &str) -> Program {
    Rapid.read(&[Source::new("t.mod", text)])
}

fn target<'p>(program: &'p Program, name: &str) -> &'p Target {
    program.targets.iter().find(|target| target.name.as_deref() == Some(name)).expect("a target of that name")
}

fn named(name: &str) -> Reference {
    Reference::Named(name.into())
}

fn proc(body: &str) -> String {
    format!("MODULE m\nCONST robtarget p1:={P};\nPERS robtarget p2:={P};\nPROC main()\n{body}\nENDPROC\nENDMODULE\n")
}

#[test]
fn a_named_target_has_its_numbers_and_all_its_uses() {
    let text = proc("MoveL P1,v100,z10,tGun\\WObj:=wA;\nmovej p1 , v100, fine ,tOther, \\Wobj:=WB ;");
    let program = read(&text);
    assert_eq!(program.targets.len(), 1);
    let p1 = target(&program, "p1");
    assert_eq!(&text[p1.span.start..p1.span.end], P);
    let TargetValue::Cartesian(numbers) = &p1.value else { panic!("not cartesian") };
    assert_eq!(numbers.position.each_ref().map(|field| field.value), [100.0, 20.5, -30.0]);
    assert_eq!(numbers.orientation.iter().map(|field| field.value).collect::<Vec<_>>(), [0.6, 0.0, 0.8, 0.0]);
    assert_eq!((p1.configuration.rear, p1.configuration.wrist_negative), (Some(true), Some(false)));
    assert_eq!(p1.external_axes.len(), 1);
    let uses: Vec<_> = p1.uses.iter().map(|used| (&*used.motion, used.path, &used.tool, &used.frame)).collect();
    assert_eq!(
        uses,
        [
            ("MoveL", PathKind::Linear, &named("tGun"), &named("wA")),
            ("movej", PathKind::Joint, &named("tOther"), &named("WB"))
        ]
    );
    assert_eq!(&text[p1.uses[0].span.start..p1.uses[0].span.end], "MoveL P1,v100,z10,tGun\\WObj:=wA");
}

#[test]
fn positions_in_comments_strings_and_unused_declarations_are_no_targets() {
    let program = read(&proc(&format!("! MoveL {P},v1,z1,t;\nTPWrite \"MoveL p1,v1,z1,t;\";\nWaitTime 1;")));
    assert!(program.targets.is_empty());
    assert!(program.diagnostics.is_empty(), "{:?}", program.diagnostics);
}

#[test]
fn arcs_joint_targets_and_process_moves_keep_tool_and_frame() {
    let program = read(&proc(&format!(
        "MoveC p1,{P},v10,z1,t1;\nMoveAbsJ [[1,-2,3.5,0,5,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs,v1,fine,tool0;\n\
         ArcLStart p1,v1,sm1,wd1\\Weave:=wv,z1,t2\\WObj:=w2;\nMoveLDO p1,v1,z1,t3\\WObj:=w3,do1,1;\n\
         MoveLSync p1,v1,z1,t4,\"proc\";\nMoveJ p1\\ID:=10,v1,z1,t5\\WObj:=w5;\nWobbleL p1,v1,fast,t6\\WObj:=w6;\n\
         MoveL\\Conc,p1,v1,z1,t7;"
    )));
    let kinds: Vec<_> = program.targets.iter().flat_map(|target| &target.uses).map(|used| used.path).collect();
    assert!(kinds.contains(&PathKind::ArcVia) && kinds.contains(&PathKind::ArcEnd));
    let tools: Vec<_> = target(&program, "p1").uses.iter().map(|used| used.tool.clone()).collect();
    assert_eq!(tools, ["t1", "t2", "t3", "t4", "t5", "t6", "t7"].map(named));
    let joint = program.targets.iter().find(|target| target.kind() == "joint").expect("a joint target");
    let TargetValue::Joint(numbers) = &joint.value else { panic!("not joint") };
    assert_eq!(numbers.joints.each_ref().map(|field| field.value), [1.0, -2.0, 3.5, 0.0, 5.0, 0.0]);
    assert_eq!(joint.uses[0].frame, named("wobj0"));
}

#[test]
fn arrays_are_one_target_an_element() {
    let text = format!(
        "CONST robtarget a{{2}}:=[{P},\n {P}];\nPROC x(num i)\nMoveL a{{2}},v1,z1,t;\nMoveL a{{i}},v1,z1,t;\nENDPROC\n"
    );
    let program = read(&text);
    let uses: Vec<_> = program.targets.iter().map(|t| (t.name.clone().unwrap_or_default(), t.uses.len())).collect();
    assert_eq!(uses, [("a{1}".to_owned(), 1), ("a{2}".to_owned(), 2)]);
    assert!(program.targets.iter().all(|target| target.computed.is_none()));
}

#[test]
fn displacements_by_numbers_have_a_base_and_others_are_computed() {
    let program = read(&proc(
        "MoveL Offs(p1,1,-2,+3.5),v1,z1,t;\nMoveL RelTool(p1,0,0,-60,\\Rx:=10\\Ry:=-20\\Rz:=30),v1,z1,t;\n\
         MoveL Offs(p1,0,0,h),v1,z1,t;\nMoveL Offs(Offs(p1,0,0,1),0,0,1),v1,z1,t;\nMoveL Offs(p1,0,0,- 5),v1,z1,t;",
    ));
    let displaced: Vec<_> = program
        .targets
        .iter()
        .filter_map(|target| match &target.value {
            TargetValue::Displaced(displacement) => Some(displacement),
            _ => None,
        })
        .collect();
    let [offs, reltool] = displaced.as_slice() else { panic!("two displacements, not {}", displaced.len()) };
    assert_eq!(program.targets[offs.base].name.as_deref(), Some("p1"));
    assert_eq!(program.targets[reltool.base].name.as_deref(), Some("p1"));
    assert_eq!((offs.kind, reltool.kind), (DisplacementKind::Frame, DisplacementKind::Tool));
    assert_eq!(offs.position.each_ref().map(|field| field.value), [1.0, -2.0, 3.5]);
    let turn = |degrees: f64| degrees.to_radians();
    let expected = rotation_x(turn(10.0)) * rotation_y(turn(-20.0)) * rotation_z(turn(30.0));
    assert_abs_diff_eq!(reltool.rotation, expected, epsilon = 1e-15);
    let reasons: Vec<_> = program.targets.iter().filter_map(|target| target.computed.as_deref()).collect();
    assert_eq!(reasons.len(), 3);
    assert!(reasons[0].contains("`h`") && reasons[0].contains("line 7"), "{reasons:?}");
}

#[test]
fn the_base_of_a_displacement_is_listed_only_if_it_is_needed() {
    let program = read(&proc("MoveL Offs(p1,0,0,1),v1,z1,t;\nMoveL Offs(pX,0,0,1),v1,z1,t;"));
    let listed: Vec<_> = program.targets.iter().map(|t| (t.name.as_deref(), t.uses.len())).collect();
    assert_eq!(listed, [(Some("p1"), 0), (None, 1), (None, 1)]);
}

#[test]
fn what_changes_at_run_time_is_computed_and_says_where() {
    for (statement, said) in [
        ("p2:=CRobT();", "line 6"),
        ("p2.trans.x:=5;", "line 6"),
        ("IF a=1 p2.rot:=[1,0,0,0];", "line 6"),
        ("SearchL di1,p2,p1,v1,t;", "SearchL"),
        ("p1b:=Approach(p2);", "Approach"),
        ("Measure p2;", "Measure"),
    ] {
        let program = read(&proc(&format!("MoveL p2,v1,z1,t;\n{statement}")));
        let reason = target(&program, "p2").computed.clone().unwrap_or_default();
        assert!(reason.contains(said), "{statement}: {reason}");
    }
    for statement in ["x:=Distance(p2.trans,p1.trans);", "j:=CalcJointT(p2,t);", "MoveL Offs(p2,0,0,1),v1,z1,t;"] {
        let program = read(&proc(&format!("MoveL p2,v1,z1,t;\n{statement}")));
        assert_eq!(target(&program, "p2").computed, None, "{statement}");
        let notes: Vec<_> = program.diagnostics.iter().map(|finding| (finding.code, finding.severity)).collect();
        assert_eq!(notes, [("pers-saved-back", Severity::Note)]);
    }
    let searched = read(&proc("SearchL di1,found,p1,v1,t\\WObj:=w;"));
    assert_eq!((target(&searched, "p1").uses.len(), &target(&searched, "p1").computed), (1, &None));
}

#[test]
fn a_constant_cannot_be_changed_and_one_element_leaves_the_others() {
    assert_eq!(target(&read(&proc("MoveL p1,v1,z1,t;\nMeasure p1;")), "p1").computed, None);
    let array = read(&format!(
        "VAR robtarget a{{2}}:=[{P},{P}];\nPROC x()\na{{1}}:=CRobT();\nMoveL a{{1}},v1,z1,t;\nMoveL a{{2}},v1,z1,t;\nENDPROC"
    ));
    assert!(target(&array, "a{1}").computed.is_some() && target(&array, "a{2}").computed.is_none());
}

#[test]
fn every_position_that_cannot_be_read_is_listed_with_its_reason() {
    let program = read(&proc(
        "MoveL pNowhere,v1,z1,t;\nMoveL GetIt(1),v1,z1,t;\nMoveL [p1.trans,[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],v1,z1,t;\n\
         MoveL rec.pos,v1,z1,t;",
    ));
    assert_eq!(program.targets.len(), 4);
    for target in &program.targets {
        assert!(matches!(target.value, TargetValue::Unwritten) && target.uses.len() == 1);
        assert!(target.computed.as_deref().is_some_and(|reason| reason.contains("line ")), "{target:?}");
    }
}

#[test]
fn local_names_shadow_and_parameters_are_computed() {
    let program = read(&format!(
        "MODULE a\nCONST robtarget p:={P};\nPROC one()\nCONST robtarget p:={P};\nMoveL p,v1,z1,t1;\nENDPROC\n\
         PROC two(robtarget p,PERS tooldata tl)\nMoveJ p,v1,z1,tl;\nENDPROC\nPROC three()\nMoveL p,v1,z1,t3;\ntwo p,t1;\n\
         ENDPROC\nENDMODULE"
    ));
    let tools: Vec<_> = program.targets.iter().map(|target| target.uses[0].tool.clone()).collect();
    assert_eq!(tools[..2], [named("t3"), named("t1")]);
    assert!(matches!(tools[2], Reference::Runtime(_)));
    assert!(program.targets[2].computed.as_deref().is_some_and(|reason| reason.contains("parameter")));
    // The module's own p also reaches the move in `two`, as an argument.
    let handed = &program.targets[0].uses[1];
    assert!(handed.computed.as_deref().is_some_and(|reason| reason.contains("`two`")), "{handed:?}");
}

#[test]
fn tools_work_objects_and_loads_are_read_or_refused() {
    let program = read(
        "PERS tooldata tA:=[TRUE,[[10,0,200],[1,0,0,0]],[5,[1,2,3],[1,0,0,0],0,0,0]];\n\
         PERS tooldata tB:=[FALSE,[[1000,0,0],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]];\n\
         PERS wobjdata wA:=[FALSE,TRUE,\"\",[[1000,0,0],[0.70710678,0,0,0.70710678]],[[100,0,0],[1,0,0,0]]];\n\
         PERS wobjdata wB:=[FALSE,FALSE,\"STN1\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n\
         PERS wobjdata wC:=[TRUE,TRUE,\"\",[[0,0,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n\
         PERS loaddata ld:=[18.5,[35,0,210],[1,0,0,0],0,0,0];\nPROC main()\nwA.uframe.trans:=[0,0,0];\nENDPROC",
    );
    let tool = program.tools["ta"].value.clone().expect("a tool");
    assert_abs_diff_eq!(tool.pose.translation[2], 0.2, epsilon = 1e-15);
    assert_eq!(tool.load.map(|load| load.mass_kg), Some(5.0));
    assert!(!program.tools["tb"].value.clone().expect("a tool").held_by_robot);
    assert!(program.frames["wa"].value.clone().expect_err("assigned").contains("line 8"));
    assert_eq!(program.frames["wb"].value.clone().expect("moved").on.as_deref(), Some("STN1"));
    assert!(program.frames["wc"].value.clone().expect("a frame").held_by_robot);
    assert_eq!(program.loads["ld"].value.clone().expect("a load").center_of_mass_m, [0.035, 0.0, 0.21]);
    assert!(program.tools.contains_key("tool0") && program.frames.contains_key("wobj0"));
}

#[test]
fn a_work_object_is_its_user_frame_times_its_object_frame() {
    // A quarter turn about z: the object frame's x lies along the base's y.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let program =
        read(&format!("PERS wobjdata w:=[FALSE,TRUE,\"\",[[1000,0,0],[{half},0,0,{half}]],[[100,0,0],[1,0,0,0]]];"));
    let frame = program.frames["w"].value.clone().expect("a frame");
    assert_abs_diff_eq!(frame.pose.translation, nalgebra::Vector3::new(1.0, 0.1, 0.0), epsilon = 1e-12);
}

fn grips(body: &str) -> Vec<Reference> {
    let program = read(&proc(body));
    let mut uses: Vec<_> = program.targets.iter().flat_map(|target| &target.uses).collect();
    uses.sort_by_key(|used| used.span);
    uses.iter().map(|used| used.grip_load.clone()).collect()
}

#[test]
fn the_gripped_load_follows_the_program() {
    let m = "MoveL p1,v1,z1,t;";
    assert_eq!(
        grips(&format!("{m}\nGripLoad ldA;\n{m}\nGripLoad load0;\n{m}")),
        [Reference::Unnamed, named("ldA"), named("load0")]
    );
    let branches =
        grips(&format!("IF a=1 THEN\nGripLoad ldA;\n{m}\nELSE\nGripLoad ldA;\nENDIF\n{m}\nIF a=2 GripLoad ldB;\n{m}"));
    assert_eq!(branches[..2], [named("ldA"), named("ldA")]);
    assert!(matches!(branches[2], Reference::Runtime(_)));
    let in_loop = grips(&format!("GripLoad load0;\nWHILE TRUE DO\n{m}\nGripLoad ldA;\nENDWHILE"));
    assert!(matches!(in_loop[0], Reference::Runtime(_)));
    let left = grips(&format!("GripLoad ldA;\nIF a=1 THEN\nGripLoad load0;\nRETURN;\nENDIF\n{m}"));
    assert_eq!(left, [named("ldA")]);
}

#[test]
fn the_gripped_load_crosses_calls() {
    let m = "MoveL p1,v1,z1,t;";
    let called = grips(&format!(
        "take;\n{m}\nput;\nGripLoad ldA;\nuse;\nENDPROC\nPROC take()\nGripLoad ldA;\nENDPROC\nPROC put()\nENDPROC\nPROC use()\n{m}"
    ));
    assert_eq!(called, [named("ldA"), named("ldA")]);
}

#[test]
fn a_displacement_in_force_makes_moves_computed_until_it_is_off() {
    let m = "MoveL p1,v1,z1,t;";
    let program = read(&proc(&format!("PDispSet fr;\n{m}\nPDispOff;\n{m}")));
    let uses: Vec<_> = target(&program, "p1").uses.iter().map(|used| used.computed.clone()).collect();
    assert!(uses[0].as_deref().is_some_and(|reason| reason.contains("line 5")), "{uses:?}");
    assert_eq!(uses[1], None);
}

#[test]
fn configurations_that_are_not_supervised_ask_for_nothing() {
    let off = read(&proc("ConfL\\Off;\nMoveL p1,v1,z1,t;"));
    assert!(target(&off, "p1").configuration.joint_intervals_deg.is_empty());
    let on = read(&proc("ConfL\\Off;\nMoveL p1,v1,z1,t;\nMoveJ p1,v1,z1,t;"));
    assert_eq!(target(&on, "p1").configuration.joint_intervals_deg.len(), 3);
}

#[test]
fn suspicious_numbers_are_said() {
    let bad = read("MoveL [[1,2,3],[0.5,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],v1,z1,t;");
    assert_eq!(bad.diagnostics.iter().map(|finding| finding.code).collect::<Vec<_>>(), ["quaternion"]);
    let metres = "MoveL [[1.25,0.2,0.3],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],v1,z1,t;\n".repeat(5);
    assert_eq!(read(&metres).diagnostics.iter().map(|finding| finding.code).collect::<Vec<_>>(), ["unit-scale"]);
}

#[test]
fn names_of_modules_reach_each_other_unless_local() {
    let data = Source::new(
        "data.mod",
        format!("MODULE d\nCONST robtarget pg:={P};\nLOCAL CONST robtarget pl:={P};\nENDMODULE"),
    );
    let moves =
        Source::new("main.mod", "MODULE m\nPROC main()\nMoveL pg,v1,z1,t;\nMoveL pl,v1,z1,t;\nENDPROC\nENDMODULE");
    let program = Rapid.read(&[data, moves]);
    assert_eq!((target(&program, "pg").file, target(&program, "pg").uses[0].file), (0, 1));
    assert!(target(&program, "pl").computed.as_deref().is_some_and(|reason| reason.contains("not declared")));
}

#[test]
fn invalid_names_of_off_line_tools_are_kept_whole() {
    let program = read(
        "PERS tooldata Grip(Closed):=[TRUE,[[0,0,1],[1,0,0,0]],[1,[0,0,20],[1,0,0,0],0,0,0]];\n\
         MoveAbsJ [[0,0,0,0,0,0]],v50,z1,Grip(Closed) \\WObj:=Frame2;",
    );
    assert_eq!(program.targets[0].uses[0].tool, named("Grip(Closed)"));
    assert!(program.tools.contains_key("grip(closed)"));
}

fn indexed_uses() -> String {
    (1..9_999).map(|index| format!("MoveL a{{{index}}},v,z,t;a{{{index}}}:=CRobT();")).collect()
}

#[test]
fn hostile_texts_take_linear_time_and_no_stack() {
    let start = std::time::Instant::now();
    for text in [
        "[".repeat(1_000_000),
        format!("CONST robtarget p:={};\nMoveL p,v,z,t;", "[".repeat(1_000_000)),
        "IF ".repeat(300_000),
        "IF a THEN GripLoad b;".repeat(50_000),
        "PROC x(".repeat(200_000),
        format!("MoveL {};", "Offs(".repeat(300_000)),
        "MoveL p{i},v,z,t;".repeat(100_000),
        "%%%".repeat(300_000),
        "\"".repeat(500_001),
        "a:".repeat(400_000),
        "TEST ".repeat(300_000),
        format!("VAR robtarget a{{9}}:=[{}{P}];\n{}", format!("{P},").repeat(9_999), "MoveL a{i},v,z,t;".repeat(9_999)),
        format!("VAR robtarget a{{9}}:=[{}{P}];\n{}", format!("{P},").repeat(9_999), indexed_uses()),
    ] {
        let source = Source::new("t", text);
        Rapid.recognises(&source);
        Rapid.read(&[source]);
    }
    // Unoptimised builds take a few seconds; anything quadratic takes minutes.
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
}
