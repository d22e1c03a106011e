//! The reader as a whole, on small programs.

use crate::base::text::Source;
use crate::geometry::orientation::OrientationConvention;
use crate::program::target::{PathKind, Program, Reference, Target, TargetValue};

use super::reader::{read, recognises};

fn program(text: &str) -> Program {
    read(&[Source::new("t.drl", text)])
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    program.targets.iter().find(|target| target.name.as_deref() == Some(name)).expect("the target")
}

#[test]
fn positions_written_and_named() {
    let read = program(
        "home = posj(0, 0, 90, 0, 90, 0)\nx1 = posx(367.3, -7.07, 204.32, 89.42, 179.98, 89.33)  # here\nq = [0,0,90,0,90,0]\n\
         movej(home, vel=30, acc=30)\nmovel(x1, v=100, a=200)\nmovej(q)\nmovel([400, 0, 300, 0, 180, 0], 100, 200)\n\
         movec(posx(1,2,3,0,180,0), pos2=posx([4,5,6,0,180,0]))\nxs = [x1, posx(7,8,9,0,180,0)]\nmovesx(xs, vel=100)\n\
         amovel(x1)\n",
    );
    assert_eq!(read.diagnostics, []);
    let shape: Vec<_> = read.targets.iter().map(|target| (target.kind(), target.uses[0].path)).collect();
    assert_eq!(
        shape,
        [
            ("joint", PathKind::Joint),
            ("cartesian", PathKind::Linear),
            ("joint", PathKind::Joint),
            ("cartesian", PathKind::Linear),
            ("cartesian", PathKind::ArcVia),
            ("cartesian", PathKind::ArcEnd),
            ("cartesian", PathKind::Other),
        ]
    );
    assert_eq!(named(&read, "x1").uses.len(), 3);
    let TargetValue::Cartesian(numbers) = &named(&read, "x1").value else { panic!("a pose") };
    assert_eq!((numbers.convention, numbers.orientation[1].value), (OrientationConvention::EulerZyz, 179.98));
}

#[test]
fn zyz_angles_as_the_vendor_has_them() {
    // A tool that points down: B = 180. Turning it by A about base Z is turning it by -C about its own.
    let rotation = |a: f64, b: f64, c: f64| {
        let read = program(&format!("movel(posx(0,0,0,{a},{b},{c}))\n"));
        let TargetValue::Cartesian(numbers) = &read.targets[0].value else { panic!("a pose") };
        numbers.pose().expect("a pose").rotation
    };
    let difference = rotation(30.0, 180.0, 10.0) - rotation(20.0, 180.0, 0.0);
    assert!(difference.norm() < 1e-12);
    assert!((rotation(0.0, 90.0, 0.0).column(2) - nalgebra::Vector3::x()).norm() < 1e-12);
}

#[test]
fn names_belong_to_their_function_and_what_changes_is_computed() {
    let read = program(
        "p = posx(1,0,0,0,180,0)\ntwice = posx(2,0,0,0,180,0)\nmoved = posx(3,0,0,0,180,0)\n\
         def pick(given, height=50):\n    p = posx(4,0,0,0,180,0)\n    movel(p)\n    movel(given)\n    \
         movel(trans(p, [0,0,height,0,0,0]))\n    global moved\n    moved = posx(5,0,0,0,180,0)\n\
         movel(p)\ntwice = posx(6,0,0,0,180,0)\nmovel(twice)\nmovel(moved)\np2 = p\nmovel(p2)\n\
         for one in [p, twice]:\n    movel(one)\nmoved2 = posx(1,2,3,0,180,0)\nmoved2[2] += 50\nmovel(moved2)\nmovel(nowhere)\n",
    );
    let own: Vec<_> = read.targets.iter().filter(|target| target.name.as_deref() == Some("p")).collect();
    assert_eq!(own.iter().map(|target| target.uses.len()).collect::<Vec<_>>(), [2, 1]);
    assert!(own.iter().all(|target| target.computed.is_none()));
    for (name, word) in [
        ("given", "parameter"),
        ("twice", "more than once"),
        ("moved", "more than once"),
        ("one", "loop"),
        ("moved2", "changed in line"),
        ("nowhere", "no value"),
    ] {
        let reason = named(&read, name).computed.as_deref().unwrap_or_default();
        assert!(reason.contains(word), "{name}: {reason}");
    }
    assert!(
        read.targets.iter().any(|target| target.computed.as_deref().is_some_and(|reason| reason.contains("trans")))
    );
}

#[test]
fn tools_frames_and_solutions() {
    let read = program(
        "set_tcp(\"gripper\")\nmovel(posx(1,0,0,0,180,0), ref=DR_WORLD)\nmovel(posx(2,0,0,0,180,0), ref=101)\n\
         movel(posx(3,0,0,0,180,0), mod=DR_MV_MOD_REL)\nset_ref_coord(102)\nmovel(posx(4,0,0,0,180,0))\n\
         movejx(posx(5,0,0,0,180,0), vel=10, acc=10, sol=2, ref=0)\nif x:\n    set_tcp('other')\nmovel(posx(6,0,0,0,180,0), ref=DR_TOOL)\n",
    );
    let uses: Vec<_> = read.targets.iter().map(|target| &target.uses[0]).collect();
    assert_eq!(
        (&uses[0].tool, &uses[0].frame),
        (&Reference::Named("gripper".into()), &Reference::Named("world".into()))
    );
    assert_eq!(uses[1].frame, Reference::Named("101".into()));
    assert!(uses[2].computed.is_some());
    assert_eq!(uses[3].frame, Reference::Named("102".into()));
    let solution = &read.targets[4].configuration;
    assert_eq!((solution.rear, solution.elbow_down, solution.wrist_negative), (Some(false), Some(false), Some(false)));
    assert_eq!(uses[4].frame, Reference::Unnamed);
    assert!(matches!((&uses[5].tool, &uses[5].frame), (Reference::Runtime(_), Reference::Runtime(_))));
}

#[test]
fn only_drl_is_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is("movej(posj(0,0,90,0,90,0), vel=60, acc=60)\nmovel(posx(1,2,3,4,5,6))\n"));
    assert!(is("from DSR_ROBOT2 import *\r\np = posx(1,2,3,0,180,0)\r\ndef main():\r\n    amovel(p)\r\n"));
    for text in [
        "",
        "def f():\n  movel(p[0.1,0.2,0.3,0,0,0], a=1.2)\nend\n",
        "p = posx(1,2,3,4,5,6)\n",
        "movej([0,0,0,0,0,0])\n",
        "# movel(posx(1,2,3,4,5,6))\n",
    ] {
        assert!(!is(text), "{text}");
    }
}

#[test]
fn a_tcp_under_a_condition_in_one_line_is_known_only_at_run_time() {
    let read = program(
        "set_tcp(\"a\")\nmovel(posx(1,2,3,0,180,0))\nif ready: set_tcp(\"b\")\nmovel(posx(4,5,6,0,180,0))\n\
         set_tcp(\"a\")\nmovel(posx(7,8,9,0,180,0))\n",
    );
    let tools: Vec<_> = read.targets.iter().map(|target| target.uses[0].tool.clone()).collect();
    let a = Reference::Named("a".into());
    assert_eq!(tools, [a.clone(), Reference::Runtime("set under a condition in line 3".into()), a]);
}
