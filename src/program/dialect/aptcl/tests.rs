//! The reader as a whole, on small files.

use crate::base::text::Source;
use crate::program::target::{CartesianNumbers, LengthUnit, PathKind, Program, Reference, TargetValue};

use super::reader::{read, recognises};

const HEAD: &str = "PARTNO TEST\n$$ falsetarget: orientation=tool-axis,+x\nUNITS/MM\nMULTAX/ON\n";

fn program(text: &str) -> Program {
    read(&[Source::new("t.apt", format!("{HEAD}{text}"))])
}

fn numbers(program: &Program, index: usize) -> &CartesianNumbers {
    match &program.targets[index].value {
        TargetValue::Cartesian(numbers) => numbers,
        other => panic!("{other:?}"),
    }
}

fn codes(text: &str) -> Vec<&'static str> {
    read(&[Source::new("t", text)]).diagnostics.iter().map(|finding| finding.code).collect()
}

#[test]
fn points_with_their_axes() {
    let read = program(
        "LOADTL/5\nFROM/0.0,0.0,100.0,0.0,0.0,1.0\nRAPID\nGOTO/10.0,0.0,$\n  50.,0.0,0.6,0.8\nFEDRAT/800.,MMPM\n\
         GOTO/10.0,0.0,2.5 $$ down\nLOAD/TOOL,7\nGOTO/11.,0.,2.5,0.,0.,1.\nFINI\n",
    );
    assert!(read.diagnostics.is_empty(), "{:?}", read.diagnostics);
    assert_eq!(read.targets.len(), 3);
    let second = numbers(&read, 1);
    assert_eq!(second.orientation.iter().map(|field| field.value).collect::<Vec<_>>(), [0.0, 0.6, 0.8]);
    assert!(second.orientation.iter().all(|field| field.repeats()));
    assert!(second.position.iter().all(|field| field.insertion.is_none()));
    // Tip to holder is against the tool's Z.
    assert!((second.pose().expect("a pose").rotation[(1, 2)] + 0.6).abs() < 1e-12);
    let tools: Vec<_> = read.targets.iter().map(|target| target.uses[0].tool.clone()).collect();
    assert_eq!(tools, ["T5", "T5", "T7"].map(|name| Reference::Named(name.into())));
    assert_eq!(read.targets[0].uses[0].path, PathKind::Other);
    assert_eq!(read.targets[0].uses[0].frame, Reference::Named("work".into()));
}

#[test]
fn points_that_are_not_where_the_tool_goes_are_computed() {
    let read = program(
        "GOTO/1,2,3,0,0,1\nCYCLE/DRILL,DEPTH,5.\nGOTO/1,2,3\nCYCLE/OFF\nGOTO/1,2,3\nGODLTA/0,0,5\nGOTO/PT1\nGOTO/1,2,3,0,0,1\n\
         ORIGIN/0,0,0\nGOTO/1,2,3\nTRACUT/MX1\nGOTO/1,2,3\nTRACUT/NOMORE\nGOTO/4,5,6\nMSYS/0,0,0,1,0,0,0,1,0\nGOTO/4,5,6\n\
         MSYS/1,0,0,1,0,0,0,1,0\nGOTO/4,5,6\n",
    );
    let computed: Vec<bool> = read.targets.iter().map(|target| target.computed.is_some()).collect();
    assert_eq!(computed, [false, true, false, true, true, false, false, true, false, false, true]);
}

#[test]
fn what_stands_nowhere_is_not_guessed() {
    assert_eq!(codes("UNITS/MM\nGOTO/1,2,3,0,0,1\n"), ["orientation-missing"]);
    assert_eq!(codes("$$ falsetarget: orientation=tool-axis,-y\nGOTO/1,2,3,0,0,1\n"), ["unit-missing"]);
    assert_eq!(codes(&format!("{HEAD}GOTO/1,2,3\n")), ["axis-missing"]);
    assert_eq!(codes(&format!("{HEAD}GOTO/1,2,3,0,0,1\nCIRCLE/0,0,0,0,0,1,5\nGOTO/1,2,3\n")), ["arc-by-centre"]);
    let inches =
        read(&[Source::new("t", "PPRINT falsetarget: orientation=tool-axis,+x\nUNITS/INCHES\nGOTO/1,2,3,0,0,1")]);
    assert!(inches.diagnostics.is_empty());
    assert_eq!(numbers(&inches, 0).units.length, LengthUnit::Inch);
}

#[test]
fn only_cutter_locations_are_recognised() {
    let is = |text: &str| recognises(&Source::new("t", text));
    assert!(is("PARTNO A\nMULTAX/ON\nGOTO/1.0,2.0,3.0,0,0,1\nFINI\n"));
    assert!(is("$$ x\r\ngoto/1.0, 2.0, 3.0\r\n"));
    for text in [
        "",
        "PARTNO A\nFINI\n",
        "GOTO/PT1\n",
        "G1 X1 Y2\n",
        "/PROG A\n/MN\n   1:J P[1] 100% FINE ;\n/END\n",
        "def f():\n  movel(p[1,2,3,0,0,0])\nend\n",
        "GOTO 10\nMOV P1\n",
    ] {
        assert!(!is(text), "{text}");
    }
}
