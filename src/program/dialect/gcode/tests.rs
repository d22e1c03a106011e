//! The reader as a whole, on small programs.

use crate::base::text::Source;
use crate::program::target::{CartesianNumbers, LengthUnit, PathKind, Program, Reference, TargetValue};

use super::reader::read;
use super::recognise::recognises;

const HEAD: &str = "(falsetarget: orientation=euler-zyx)\nG21 G90 G54\n";

fn program(text: &str) -> Program {
    read(&[Source::new("t.nc", format!("{HEAD}{text}"))])
}

fn numbers(program: &Program, index: usize) -> &CartesianNumbers {
    match &program.targets[index].value {
        TargetValue::Cartesian(numbers) => numbers,
        other => panic!("{other:?}"),
    }
}

fn values(program: &Program, index: usize) -> Vec<f64> {
    let numbers = numbers(program, index);
    numbers.position.iter().chain(&numbers.orientation).map(|field| field.value).collect()
}

fn codes(text: &str) -> Vec<&'static str> {
    read(&[Source::new("t.nc", text)]).diagnostics.iter().map(|finding| finding.code).collect()
}

#[test]
fn words_that_are_left_out_are_those_of_the_block_before() {
    let read = program("T3 M6\nG0 X1.0 Y2.0 Z3.0 A10. B0.0 C180.0\nG1 X5.5 F100.\nC170.\nG1Y7.0\n");
    assert!(read.diagnostics.is_empty(), "{:?}", read.diagnostics);
    assert_eq!(values(&read, 1), [5.5, 2.0, 3.0, 10.0, 0.0, 180.0]);
    assert_eq!(values(&read, 3), [5.5, 7.0, 3.0, 10.0, 0.0, 170.0]);
    let z = &numbers(&read, 1).position[2];
    let insertion = z.insertion.as_ref().expect("an insertion");
    assert_eq!((insertion.before.as_str(), insertion.repeats, z.decimals()), (" Z", true, 1));
    assert_eq!(numbers(&read, 3).position[0].insertion.as_ref().map(|one| one.before.as_str()), Some("X"));
    let one = &read.targets[1].uses[0];
    assert_eq!((&one.tool, &one.frame), (&Reference::Named("T3".into()), &Reference::Named("G54".into())));
    assert_eq!((read.targets[0].uses[0].path, one.path), (PathKind::Joint, PathKind::Linear));
}

#[test]
fn a_block_before_all_words_are_known_is_computed() {
    let read = program("G0 X1.0 Y2.0\nZ3.0 A10. B0. C0.\nG28 Z0.\nG0 X4.0\nM98 P100\nG1 Y1.0\n");
    let reasons: Vec<bool> = read.targets.iter().map(|target| target.computed.is_some()).collect();
    assert_eq!(reasons, [true, false, true, true]);
}

#[test]
fn what_does_not_go_where_its_words_say_is_computed() {
    let read = program(
        "G1 X1. Y2. Z3. A0. B0. C0.\nG91 X1.\nG90 X1. Y2. Z3. A0. B0. C0.\nX#100\nX1. A0. B0. C0. Y2. Z3.\nG53 X0. Y0. Z0. A0. B0. C0.\n\
         G41 X1. Y2. Z3. A0. B0. C0.\nG40 X1. Y2. Z3. A0. B0. C0.\nG68 X0. Y0. R30.\nX1. Y2. Z3. A0. B0. C0.\nG69\nG81 X1. Y2. Z3. A0. B0. C0.\n",
    );
    let computed: Vec<bool> = read.targets.iter().map(|target| target.computed.is_some()).collect();
    assert_eq!(computed, [false, true, false, true, false, true, true, false, true, true]);
}

#[test]
fn without_transformation_words_are_axes_of_the_machine() {
    let read = program(
        "% Using Tool 5: X62.5 Y1 Z100\nN1 TRAFOOF\nN2 G1 JT1=-46. A=71. B=49. C=-30.\nN3 TRAORI\nG1 X1. Y2. Z3. A0. B0. C0.\n#CS ON[1]\nX2.\n\
         #CS OFF ALL\n#MCS ON\nG0 X-46. Y-6. Z-20. A71. B49. C-302.\n#MCS OFF\nG1 X1. Y2. Z3. A0. B0. C0.\n\
         N16 $P_UIFR[1]=CTRANS(X,807.)\nN18 $TC_DP5[3,1]=-62.5\n",
    );
    let computed: Vec<bool> = read.targets.iter().map(|target| target.computed.is_some()).collect();
    assert_eq!(computed, [true, false, true, true, false]);
    assert!(read.frames["g54"].value.is_err() && read.tools["t3"].value.is_err());
}

#[test]
fn a_tool_axis_is_written_as_a_vector_whose_missing_parts_are_zero() {
    let read = read(&[Source::new(
        "t.mpf",
        "; falsetarget: orientation=tool-axis,+x frame=base\nG71 G90\nTRAORI\nG1 X1 Y2 Z3 A3=0.1 C3=0.99499\nX2\n",
    )]);
    assert_eq!(read.diagnostics.iter().map(|finding| finding.code).collect::<Vec<_>>(), ["no-point"]);
    assert_eq!(values(&read, 0), [1.0, 2.0, 3.0, 0.1, 0.0, 0.99499]);
    let left_out = numbers(&read, 0).orientation[1].insertion.as_ref().expect("an insertion");
    assert_eq!((left_out.before.as_str(), left_out.repeats), (" B3=", false));
    assert_eq!(values(&read, 1), [2.0, 2.0, 3.0, 0.1, 0.0, 0.99499]);
    assert_eq!(read.targets[0].uses[0].frame, Reference::Unnamed);
    assert!(numbers(&read, 0).pose().expect("a pose").rotation[(2, 2)] < -0.99);
}

#[test]
fn what_stands_nowhere_is_not_guessed() {
    let move_there = "G1 X1. Y2. Z3. A0. B0. C0.\n";
    assert_eq!(codes(&format!("G21\n{move_there}")), ["orientation-missing"]);
    assert_eq!(codes(&format!("(falsetarget: orientation=euler-zyx)\n{move_there}")), ["unit-missing"]);
    assert_eq!(codes("G21\nG1 X1. Y2. Z3.\n"), ["orientation-missing"]);
    assert_eq!(codes(&format!("(falsetarget: orientation=tool-axis,+x)\nG21 {move_there}")), ["orientation-missing"]);
    assert_eq!(codes(&format!("{HEAD}{move_there}G2 X2. I1. J0.\n")), ["arc-by-centre"]);
    let inches = read(&[Source::new("t", format!("(falsetarget: orientation=fixed-xyz)\nG20 {move_there}"))]);
    assert_eq!(numbers(&inches, 0).units.length, LengthUnit::Inch);
}

#[test]
fn tools_behind_a_jump_are_open() {
    let read = program(
        "N1 T1 M6\nG1 X1. Y2. Z3. A0. B0. C0.\nN2 T2 M6\nG1 X1. Y2. Z3. A0. B0. C0.\nIF [#1 EQ 2] GOTO 1\nN3 G1 X1. Y2. Z3. A0. B0. C0.\n",
    );
    assert_eq!(read.targets[1].uses[0].tool, Reference::Named("T2".into()));
    assert!(matches!(read.targets[2].uses[0].tool, Reference::Runtime(_)));
}

#[test]
fn only_gcode_is_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is("%\nO1000 (POCKET)\nN10 G21 G90\nN20 G0 X0. Y0. A0. B90. C0.\n%\n"));
    assert!(is("; head\r\nTRAORI\r\nG1 X1 Y2 Z3 A3=0 B3=0 C3=1 F2000\r\nX2\r\n"));
    assert!(is(
        "% program: Program()\n\nN1 G90\n#HSC [BSPLINE PATH_DEV 0.0]\nN5 G54\n#TRAFO ON\nN2 G1 X1. Y2. Z3. A0. B0. C0.\n"
    ));
    for text in [
        "",
        "G21\n",
        "DEF main( )\nPTP {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n",
        "10 MOV P1\n20 MVS P2\n",
        "MODULE m\nMoveL p1,v100,z10,tool0;\nENDMODULE\n",
        "PARTNO PART\nGOTO/1,2,3,0,0,1\n",
        "/PROG A\n/MN\n 1:J P[1] 100% FINE ;\n",
        "x,y,z\n1,2,3\n",
    ] {
        assert!(!is(text), "{text}");
    }
}
