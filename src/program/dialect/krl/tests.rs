//! Whole jobs, small enough to be read in one glance.

use crate::base::text::Source;
use crate::program::dialect::Dialect;
use crate::program::target::{Program, Reference, Target, TargetValue};

use super::Krl;

const CONFIG: &str = "DEFDAT $CONFIG PUBLIC
DECL FRAME TOOL_DATA[2]
TOOL_DATA[1]={X 0.0,Y 0.0,Z 100.0,A 0.0,B 0.0,C 0.0}
TOOL_DATA[2]={X 10.0,Y 0.0,Z 200.0,A 0.0,B 0.0,C 0.0}
BASE_DATA[1]={X 1000.0,Y 0.0,Z 500.0,A 0.0,B 0.0,C 0.0}
LOAD_DATA[1]={M 12.5,CM {X 10.0,Y 0.0,Z 90.0,A 0.0,B 0.0,C 0.0},J {X 0.0,Y 0.0,Z 0.0}}
LOAD_DATA[2]={M -1.0,CM {X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0},J {X 0.0,Y 0.0,Z 0.0}}
DECL FDAT FHOME={TOOL_NO 1,BASE_NO 0,IPO_FRAME #BASE}
E6AXIS XHOME={A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 0.0,A6 0.0,E1 0.0}
ENDDAT
";
const DATA: &str = "DEFDAT JOB
DECL E6POS XP1={X 1.0,Y 2.0,Z 3.0,A 4.0,B 5.0,C 6.0,S 2,T 35,E1 0.0,E2 0.0}
DECL FDAT FP1={BASE_NO 1,TOOL_NO 2,IPO_FRAME #BASE,POINT2[] \" \"}
DECL FDAT FTCP={TOOL_NO 1,BASE_NO 1,IPO_FRAME #TCP}
DECL FRAME fix={X 5.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 90.0}
ENDDAT
";
const HERE: &str = "{X 1,Y 2,Z 3,A 4,B 5,C 6}";

fn read(body: &str) -> Program {
    let job = format!("DEF job( )\n{body}\nEND\n");
    Krl.read(&[Source::new("job.src", job), Source::new("job.dat", DATA), Source::new("$config.dat", CONFIG)])
}

fn spoken(reference: &Reference) -> String {
    match reference {
        Reference::Unnamed => "-".into(),
        Reference::Named(name) => name.to_string(),
        Reference::Runtime(_) => "?".into(),
    }
}

/// Tool, base and load of the last motion.
fn last(body: &str) -> String {
    let program = read(&format!("{body}\nLIN {HERE}"));
    let target = program.targets.iter().filter(|target| target.file == 0).max_by_key(|target| target.span);
    let one = &target.expect("a target").uses[0];
    format!("{} {} {}", spoken(&one.tool), spoken(&one.frame), spoken(&one.grip_load))
}

fn by_name<'p>(program: &'p Program, name: &str) -> &'p Target {
    program.targets.iter().find(|target| target.name.as_deref() == Some(name)).expect("the target")
}

fn reason(target: &Target) -> &str {
    target.computed.as_deref().unwrap_or("-")
}

#[test]
fn settings_by_assignment() {
    assert_eq!(last(""), "- - -");
    assert_eq!(last("$TOOL=TOOL_DATA[2]\n$base = base_data[ 1 ]"), "2 1 -");
    assert_eq!(last("$TOOL=$NULLFRAME\n$BASE=$WORLD"), "$nullframe - -");
    assert_eq!(last("$BASE=fix\n$TOOL={FRAME: X 1,Y 0,Z 2,A 0,B 0,C 0}"), "$tool@3 fix -");
    assert_eq!(last("$BASE=elsewhere"), "- elsewhere -");
    assert_eq!(last("$TOOL=TOOL_DATA[n]\n$BASE=EK(MACHINE_DEF[2].ROOT,#EASYS,BASE_DATA[1])"), "? ? -");
    assert_eq!(last("$TOOL=TOOL_DATA[1] : fix\n$BASE=BASE_DATA[1]\n$BASE.X=5"), "? ? -");
    assert_eq!(last("TOOL_DATA[2].Z=5\n$TOOL=TOOL_DATA[2]"), "? - -");
    assert_eq!(last("$LOAD=LOAD_DATA[1]"), "- - load_data[1]");
    assert_eq!(last("$LOAD.M=5"), "- - ?");
}

#[test]
fn settings_by_bas_and_frame_data() {
    assert_eq!(last("BAS (#INITMOV,0 )"), "1 - -");
    assert_eq!(last("BAS(#TOOL,1)\nBAS(#BASE,1)"), "1 1 load_data[1]");
    assert_eq!(last("BAS(#TOOL,2)\nBAS(#BASE,0)"), "2 - -", "a negative mass is the machine's own");
    assert_eq!(last("BAS(#TOOL,0)"), "$nullframe - -");
    assert_eq!(last("BAS(#TOOL,nTool)"), "? - ?");
    assert_eq!(last("FDAT_ACT=FP1\nBAS(#PTP_PARAMS,100)"), "2 1 -");
    assert_eq!(last("FDAT_ACT={TOOL_NO 1,BASE_NO 0,IPO_FRAME #BASE}\nBAS(#FRAMES)"), "1 - load_data[1]");
    assert_eq!(last("FDAT_ACT=FNOWHERE\nBAS(#CP_PARAMS,0.2)"), "? ? ?");
    assert_eq!(last("FDAT_ACT=FP1\nFDAT_ACT.BASE_NO=n\nBAS(#FRAMES)"), "? ? ?");
    assert_eq!(last("FDAT_ACT=FP1\nIF a THEN\nFDAT_ACT=FHOME\nENDIF\nBAS(#FRAMES)"), "? ? ?");
}

#[test]
fn a_list_behind_with_holds_for_its_motion_or_its_block() {
    let body = "$TOOL=TOOL_DATA[1]
SLIN XP1 WITH $TOOL = STOOL2(FP1), $BASE = SBASE(FP1.BASE_NO), $IPO_MODE = SIPO_MODE(FP1.IPO_FRAME), $LOAD = SLOAD(FP1.TOOL_NO) C_Spl";
    let program = read(body);
    let one = &by_name(&program, "XP1").uses[0];
    assert_eq!((spoken(&one.tool), spoken(&one.frame), spoken(&one.grip_load)), ("2".into(), "1".into(), "-".into()));
    assert_eq!(last(body), "1 - -");
    let block = "SPLINE WITH $BASE = BASE_DATA[1]\nSPL {X 0,Y 0,Z 0,A 0,B 0,C 0}";
    assert_eq!(last(block), "- 1 -");
    assert_eq!(last(&format!("{block}\nENDSPLINE")), "- - -");
}

#[test]
fn settings_follow_the_order_of_the_program() {
    assert_eq!(last("$BASE=BASE_DATA[1]\nIF a THEN\n$BASE=$WORLD\nENDIF"), "- ? -");
    assert_eq!(last("SWITCH n\nCASE 1\n$BASE=fix\nDEFAULT\n$BASE=fix\nENDSWITCH"), "- fix -");
    assert_eq!(last("$BASE=fix\nGOTO on\n$BASE=$WORLD\non:"), "- fix -");
    assert_eq!(last("other( )\nEND\nDEF other( )\n$BASE=fix\nEND\nDEF last( )\nother( )"), "- fix -");
    assert_eq!(last("elsewhere( )"), "? ? -", "a routine that is not in the job may set what nothing else sets");
    assert_eq!(last("$TOOL=TOOL_DATA[1]\n$BASE=fix\nelsewhere( )"), "1 fix -");
}

#[test]
fn a_stationary_tool_changes_the_sides() {
    assert_eq!(last("FDAT_ACT=FTCP\nBAS(#FRAMES)"), "base_data[1] tool_data[1] load_data[1]");
    let program = read(&format!("$IPO_MODE=#TCP\n$TOOL=TOOL_DATA[2]\n$BASE=BASE_DATA[1]\nLIN {HERE}"));
    let tool = program.tools["base_data[1]"].value.as_ref().expect("written");
    assert!(!tool.held_by_robot && (tool.pose.translation.x - 1.0).abs() < 1e-12);
    assert!(program.frames["tool_data[2]"].value.as_ref().expect("written").held_by_robot);
    assert_eq!(last("$IPO_MODE=#TCP"), "? ? -");
}

#[test]
fn loads_are_those_of_the_flange() {
    let program = read("BAS(#TOOL,1)\nPTP XP1");
    let load = program.flange_loads["load_data[1]"].value.as_ref().expect("written");
    assert_eq!((load.mass_kg, load.center_of_mass_m), (12.5, [0.01, 0.0, 0.09]));
}

#[test]
fn bases_are_given_in_the_world_and_come_out_in_the_robot() {
    let root = "DEFDAT $MACHINE PUBLIC\nFRAME $ROBROOT={X 0.0,Y 0.0,Z 300.0,A 90.0,B 0.0,C 0.0}\nENDDAT\n";
    let job = format!("DEF a()\n$BASE=BASE_DATA[1]\nLIN {HERE}\n$BASE=$WORLD\nLIN {HERE}\nEND\n");
    let sources = [Source::new("a.src", job), Source::new("$machine.dat", root), Source::new("$config.dat", CONFIG)];
    let program = Krl.read(&sources);
    // By hand: the base lies at (1000, 0, 500) in the world; turned back by 90 degrees about z, lowered by 300.
    let frame = program.frames["1"].value.as_ref().expect("written");
    assert!((frame.pose.translation - nalgebra::Vector3::new(0.0, -1.0, 0.2)).norm() < 1e-12);
    assert!(program.frames.contains_key("$world"));
}

#[test]
fn positions_that_the_text_does_not_hold_are_computed() {
    let why = |motion: &str| read(motion).targets[0].computed.clone().unwrap_or_else(|| "-".into());
    assert_eq!(why("PTP $POS_ACT"), "`$POS_ACT` is known only at run time");
    assert_eq!(why("LIN_REL {Z 100} #TOOL"), "LIN_REL goes on from where the arm stands");
    assert_eq!(why("LIN XP1 : {X 0,Y 0,Z 5,A 0,B 0,C 0}"), "its goal is `XP1 : {X 0,Y 0,Z 5,A 0,B 0,C 0}`");
    assert_eq!(why("PTP {Z 100}"), "X, Y, A, B, C stay as they are when the arm comes there");
    assert_eq!(why("LIN {X h+5,Y 0,Z 0,A 0,B 0,C 0}"), "its X is `h+5`");
    assert_eq!(why("LIN nowhere"), "no value of `nowhere` is in the files of this job");
    assert_eq!(why("LIN pallet[i].top"), "`pallet[i].top` is known only at run time");
    assert_eq!(reason(by_name(&read("XP1.X=XP1.X+5\nLIN XP1"), "XP1")), "`XP1.X` is set in line 2");
    assert_eq!(
        reason(by_name(&read("shift(XP1)\nLIN XP1"), "XP1")),
        "`XP1` is handed to `shift` in line 2, which may change it"
    );
    assert_eq!(reason(by_name(&read("BAS(#TOOL,1)\nh=dist(2)\nLIN XP1"), "XP1")), "-");
    assert!(read("$H_POS=XHOME\n;LIN XP1 {X 1}\nXP1={X 5,Y 2}").targets.is_empty());
}

#[test]
fn a_declared_position_is_one_target_with_all_its_uses() {
    let program = read("PTP XP1\nLIN xp1 C_DIS\nCIRC XP1, {X 9,Y 2,Z 3,A 4,B 5,C 6}, CA 90");
    assert_eq!(program.targets.len(), 2);
    let target = by_name(&program, "XP1");
    let motions: Vec<&str> = target.uses.iter().map(|one| &*one.motion).collect();
    assert_eq!((target.file, motions), (1, vec!["PTP", "LIN", "CIRC"]));
    assert!(target.external_axes.is_empty(), "axes that never move are not there");
    assert!(program.diagnostics.iter().any(|finding| finding.code == "arc-angle"));
}

#[test]
fn an_index_that_varies_reaches_every_element() {
    let element = "X 1,Y 2,Z 3,A 4,B 5,C 6";
    let program = read(&format!("p[1]={{{element}}}\np[2]={{{element},E1 5}}\nFOR i=1 TO 2\nPTP p[i]\nENDFOR"));
    assert_eq!(program.targets.len(), 2);
    assert!(program.targets.iter().all(|target| target.uses.len() == 1 && target.computed.is_none()));
    assert_eq!(by_name(&program, "p[2]").external_axes[0].value, 5.0);
}

#[test]
fn local_names_shadow_those_of_the_data_list() {
    let program = read(&format!("DECL E6POS XP1\nXP1={HERE}\nLIN XP1"));
    assert_eq!(program.targets[0].file, 0);
    let program = read("PTP XP1\nEND\nDEF other(XP1:OUT)\nPTP XP1");
    assert_eq!(program.targets.len(), 2);
    assert!(program.targets.iter().any(|target| reason(target) == "`xp1` is a parameter of `other`"));
}

#[test]
fn status_and_turn_count_where_the_arm_travels_point_to_point() {
    let asks = |body: &str| by_name(&read(body), "XP1").configuration.rear.is_some();
    assert!(asks("PTP XP1"));
    assert!(asks("LIN XP1"), "nothing says from where the line starts");
    assert!(!asks(&format!("PTP {HERE}\nLIN XP1")));
    assert!(asks(&format!("PTP {HERE}\nPTP $POS_ACT\nLIN XP1")));
    assert!(asks(&format!("PTP {HERE}\nLIN XP1\nSPTP XP1")));
}

#[test]
fn what_is_cut_off_is_an_error() {
    let codes = |text: &str| -> Vec<&'static str> {
        Krl.read(&[Source::new("a.src", text)]).diagnostics.iter().map(|finding| finding.code).collect()
    };
    assert_eq!(codes("DEF a()\nLIN {X 1,Y 2"), ["truncated", "missing-end"]);
    assert_eq!(codes("DEF a()\nLIN {X 1,Y 2\nPTP XHOME\nEND\n"), ["malformed-position"]);
    assert_eq!(codes("DEFDAT a\nDECL E6POS XP1={X 1,"), ["truncated", "missing-end"]);
    assert!(codes("DEF a()\nPTP XHOME\nEND").is_empty());
}

#[test]
fn joint_targets_are_read_from_the_shared_file() {
    let program = read("PTP XHOME");
    let target = by_name(&program, "XHOME");
    let TargetValue::Joint(numbers) = &target.value else { panic!("no joint target") };
    assert_eq!((target.file, numbers.joints[1].value), (2, -90.0));
}

#[test]
fn reading_takes_time_in_proportion_to_the_text() {
    let line = format!("LIN {HERE} C_DIS\n");
    let deep = "(".repeat(100_000) + &"[".repeat(100_000) + &"{".repeat(100_000);
    let jobs = [
        format!("DEF a()\n{}END\n", line.repeat(20_000)),
        format!("DEF a()\nx = {deep}\nLIN {deep}\nfoo{deep}\n$TOOL={deep}\nEND\n"),
        "DEF a()\n".repeat(20_000),
        "IF a THEN\nLOOP\n".repeat(10_000),
    ];
    for job in jobs {
        let started = std::time::Instant::now();
        Krl.read(&[Source::new("a.src", job)]);
        assert!(started.elapsed().as_secs() < 10);
    }
}

#[test]
fn an_initial_move_under_a_condition_leaves_the_interpolation_mode_as_it_is() {
    let setting = |before: &str| {
        let body = format!("{before}\n$TOOL=TOOL_DATA[2]\n$BASE=BASE_DATA[1]\nLIN {HERE}");
        let one = read(&body).targets[0].uses[0].clone();
        (spoken(&one.tool), spoken(&one.frame))
    };
    assert_eq!(setting("IF $T1 THEN\nBAS(#INITMOV,0)\nENDIF"), ("2".into(), "1".into()));
    assert_eq!(setting("IF $T1 THEN\n$IPO_MODE=#BASE\nENDIF"), ("2".into(), "1".into()));
    assert_eq!(setting("IF $T1 THEN\n$IPO_MODE=#TCP\nENDIF"), ("?".into(), "?".into()));
}
