//! The reader as a whole, on small programs.

use crate::base::text::Source;
use crate::program::target::{DisplacementKind, PathKind, Program, Reference, Target, TargetValue};

use super::reader::read;
use super::recognise::recognises;

fn program(text: &str) -> Program {
    read(&[Source::new("t.script", text)])
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    program.targets.iter().find(|target| target.name.as_deref() == Some(name)).expect("the target")
}

fn reasons(program: &Program) -> Vec<&str> {
    program.targets.iter().filter_map(|target| target.computed.as_deref()).collect()
}

#[test]
fn poses_and_joint_lists_stand_in_any_move() {
    let read = program(
        "def f():\n  movej(p[.1,-.2,0.3,0,3.14,0], a=1.4)\n  movel([0,-1.5,1.5,0,1.5,0])\n  movec(p[1,2,3,0,0,0],\n  \
         p[1,2,4,0,0,0], a=1)\n  movep(a=1, v=0.2, pose=p[1,2,5,0,0,-1e-3])\n  # movel(p[9,9,9,0,0,0])\nend\n",
    );
    let kinds: Vec<_> = read.targets.iter().map(|target| (target.kind(), target.uses[0].path)).collect();
    let joint = ("joint", PathKind::Linear);
    let (via, end) = (("cartesian", PathKind::ArcVia), ("cartesian", PathKind::ArcEnd));
    assert_eq!(kinds, [("cartesian", PathKind::Joint), joint, via, end, ("cartesian", PathKind::Linear)]);
    let TargetValue::Cartesian(numbers) = &read.targets[0].value else { panic!("a pose") };
    assert_eq!(numbers.position.each_ref().map(|field| field.value), [0.1, -0.2, 0.3]);
    assert_eq!(numbers.pose().expect("a pose").translation.x, 0.1);
    assert!(read.diagnostics.is_empty());
}

#[test]
fn waypoints_of_the_pendant_are_one_target_with_the_solution_near_their_joints() {
    let read = program(
        "def Export():\n  set_tcp(p[0,0,0.1,0,0,0])\n  set_payload(1.5, [0,0,0.05])\n  \
         global W_p=p[-.143968656714, -.435620060803, .202, -.001, 3.116, .0389]\n  \
         global W_q=[-1.6007, -1.7271, -2.203, -0.808, 1.5951, -0.031]\n  while (True):\n    $ 3 \"MoveJ\"\n    \
         movej(get_inverse_kin(W_p, qnear=W_q), a=1.39, v=1.04)\n    movel(W_p, a=1.2)\n  end\nend\n",
    );
    assert_eq!(read.targets.len(), 1);
    let target = named(&read, "W_p");
    assert_eq!(target.uses.len(), 2);
    let near = target.configuration.near_joints_deg.expect("near joints");
    assert!((near[2] + 2.203f64.to_degrees()).abs() < 1e-9);
    let Reference::Named(tool) = &target.uses[0].tool else { panic!("a tool") };
    let tool = read.tools[&Program::key(tool)].value.as_ref().expect("its value");
    assert_eq!(tool.pose.translation.z, 0.1);
    assert_eq!(tool.load.map(|load| (load.mass_kg, load.center_of_mass_m)), Some((1.5, [0.0, 0.0, 0.05])));
    assert_eq!(target.uses[0].grip_load, Reference::Unnamed);
}

#[test]
fn variables_with_one_value_are_constants_and_others_are_not() {
    let read = program(
        "def f(given):\n  once=p[1,0,0,0,0,0]\n  twice=p[2,0,0,0,0,0]\n  movel(once)\n  movel(twice)\n  \
         twice=p[3,0,0,0,0,0]\n  movel(twice)\n  other=once\n  movel(other)\nend\n\
         def g(given):\n  moved=p[4,0,0,0,0,0]\n  moved[2]=0.5\n  movel(moved)\n  movel(given)\n  movel(unknown)\n  \
         movel(pose_add(once,p[0,0,1,0,0,0]))\n  if True:\n    late=p[5,0,0,0,0,0]\n  else:\n    late=p[6,0,0,0,0,0]\n  \
         end\n  movel(late)\n  movel(p[a,0,0,0,0,0])\n  movel(p[1,0,0,0,0,-x])\nend\n",
    );
    assert_eq!(named(&read, "once").uses.len(), 2);
    let twice: Vec<_> = read.targets.iter().filter(|target| target.name.as_deref() == Some("twice")).collect();
    assert_eq!(twice.iter().map(|target| target.uses.len()).collect::<Vec<_>>(), [1, 1]);
    assert!(twice.iter().all(|target| target.computed.is_none()));
    let reasons = reasons(&read);
    assert_eq!(reasons.len(), 7, "{reasons:?}");
    for (reason, word) in reasons.iter().zip(["part", "parameter", "no value", "computed", "more than once"]) {
        assert!(reason.contains(word), "{reason}");
    }
}

#[test]
fn composed_poses_are_in_a_frame_or_displace_a_target() {
    let read = program(
        "def f():\n  plane=p[.5,0,0,0,0,1.57]\n  pick=p[.4,.1,.2,0,3.14,0]\n  \
         approach=pose_trans(pick, p[0,0,-.1,0,0,0])\n  movel(approach)\n  movel(pick)\n  movel(approach)\n  \
         movel(pose_trans(plane, p[.1,.2,.3,0,0,0]))\n  movel(pose_trans(pose_trans(plane, pick), p[0,0,1,0,0,0]))\n  \
         movel(pose_trans(get_actual_tcp_pose(), p[0,0,1,0,0,0]))\nend\n",
    );
    let kinds: Vec<_> = read.targets.iter().map(|target| std::mem::discriminant(&target.value)).collect();
    assert_eq!(read.targets.len(), 5, "{kinds:?}");
    let TargetValue::Displaced(displacement) = &read.targets[1].value else { panic!("displaced") };
    assert_eq!((displacement.base, displacement.kind), (0, DisplacementKind::Tool));
    assert_eq!(read.targets[1].uses.len(), 2);
    let Reference::Named(frame) = &read.targets[2].uses[0].frame else { panic!("a frame") };
    let frame = read.frames[&Program::key(frame)].value.as_ref().expect("its value");
    assert_eq!(frame.pose.translation.x, 0.5);
    assert_eq!(reasons(&read).len(), 2);
}

#[test]
fn one_displacement_of_several_targets_serves_none() {
    let read = program(
        "def f():\n  a=p[.4,.1,.2,0,3.14,0]\n  b=p[.4,.2,.2,0,3.14,0]\n  up=p[0,0,-.1,0,0,0]\n  movel(a)\n  movel(b)\n  \
         movel(pose_trans(a,up))\n  movel(pose_trans(b,up))\nend\n",
    );
    assert_eq!(reasons(&read).len(), 2);
}

#[test]
fn tools_and_loads_that_depend_on_the_way_are_runtime() {
    let read = program(
        "def f():\n  movel(p[1,0,0,0,0,0])\n  set_tcp(p[0,0,.1,0,0,0])\n  movel(p[2,0,0,0,0,0])\n  while True:\n    \
         movel(p[3,0,0,0,0,0])\n    set_tcp(p[0,0,.2,0,0,0])\n    set_payload(m_part)\n    movel(p[4,0,0,0,0,0])\n  end\n  \
         force_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,1,0,0,0],2,[1,1,1,1,1,1])\n  movel(p[5,0,0,0,0,0])\n  \
         end_force_mode()\nend\n",
    );
    let use_of = |index: usize| &read.targets[index].uses[0];
    assert_eq!(use_of(0).tool, Reference::Unnamed);
    assert!(matches!(&use_of(1).tool, Reference::Named(name) if name.contains("line 3")));
    assert!(matches!(use_of(2).tool, Reference::Runtime(_)));
    assert!(matches!(&use_of(3).tool, Reference::Named(name) if name.contains("line 7")));
    assert!(matches!(use_of(3).grip_load, Reference::Runtime(_)));
    assert!(use_of(4).computed.is_some() && use_of(3).computed.is_none());
}

#[test]
fn broken_lists_and_brackets_are_errors() {
    let codes = |text: &str| program(text).diagnostics.iter().map(|finding| finding.code).collect::<Vec<_>>();
    assert_eq!(codes("def f():\n  movel(p[1,2,3])\nend\n"), ["list-length"]);
    assert_eq!(codes("def f():\n  movel(p[1,2,3,4,5,6], a=1\n  movel(p[1,2,3,4,5,6])\nend\n"), ["truncated"]);
    assert_eq!(codes("def f():\n  movel(p[1,2,3,4,5,6])\n"), ["missing-end"]);
    assert!(codes("def f():\n  set_tcp(p[1,2,3])\n  servoj(q, t=1, {{REPLACE}})\nend\n").is_empty());
}

#[test]
fn only_urscript_is_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is("def f():\n  movel(p[0.1,0.2,0.3,0,0,0], a=1.2, v=0.25, t=0, r=0)\nend\n"));
    assert!(is("# x\nmovej(p[0.1,0.2,0.3,0,0,0])\r\n"));
    for text in [
        "",
        "def f():\n    movej([0, 0, 0, 0, 0, 0])\n    return 1\n",
        "def f\n  puts 1\nend\n",
        "movej(posj(0,0,90,0,90,0), vel=60, acc=60)\nmovel(posx(1,2,3,4,5,6))\n",
        "DEF main( )\nPTP {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n",
        "PROC f()\n  MoveL p1,v100,z10,tool0;\nENDPROC\n",
        "MOVJ P001 VJ=50.00\nEND\n",
    ] {
        assert!(!is(text), "{text}");
    }
}

#[test]
fn a_block_that_sets_no_tcp_leaves_the_one_before_it() {
    let pose = |x: u32| format!("  movel(p[0.{x},0,0.3,0,3.14159,0])\n");
    let (a, b) = ("  set_tcp(p[0,0,0.1,0,0,0])\n", "  set_tcp(p[0,0,0.2,0,0,0])\n");
    let text = format!(
        "def p():\n{a}{}  if x:\n{}{b}  end\n{}{a}  while True:\n{}    if y:\n      z=1\n    else:\n      z=2\n    end\n{}  end\n{}end\n",
        pose(1),
        pose(2),
        pose(3),
        pose(4),
        pose(5),
        pose(6)
    );
    let read = program(&text);
    let open: Vec<bool> =
        read.targets.iter().map(|target| matches!(target.uses[0].tool, Reference::Runtime(_))).collect();
    assert_eq!(open, [false, false, true, false, false, false]);
}
