//! The reader as a whole, on small applications.

use crate::base::edit::EditSet;
use crate::base::text::Source;
use crate::program::decimal::Decimal;
use crate::program::number::written;
use crate::program::target::{DisplacementKind, PathKind, Program, Reference, Target, TargetValue};

use super::reader::read;
use super::xml::recognises;

const SPACE: &str = "http://www.staubli.com/robotics/VAL3";

fn data(inside: &str) -> Source {
    let head = "\u{feff}<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<Database xmlns=";
    Source::new("a.dtx", format!("{head}\"{SPACE}/Data/2\"><Datas>{inside}</Datas></Database>"))
}

fn code(name: &str, parameters: &str, text: &str) -> Source {
    let program =
        format!("<Program name=\"{name}\">{parameters}<Code><![CDATA[begin\r\n{text}\r\nend]]></Code></Program>");
    Source::new("a.pgx", format!("<Programs xmlns=\"{SPACE}/Program/2\">{program}</Programs>"))
}

fn variable(name: &str, kind: &str, values: &str) -> String {
    format!("<Data name=\"{name}\" access=\"private\" xsi:type=\"array\" type=\"{kind}\" size=\"1\">{values}</Data>")
}

fn named<'a>(program: &'a Program, name: &str) -> &'a Target {
    let found = program.targets.iter().find(|target| target.name.as_deref() == Some(name));
    found.unwrap_or_else(|| panic!("no {name} in {:?}", program.targets))
}

#[test]
fn absent_attributes_are_zero_and_are_put_where_they_belong() {
    let point = variable("p", "pointRx", "<Value key=\"0\" x=\"500\" z='-20.5' rz=\"55\" fatherId=\"world[0]\" />");
    let source = data(&point);
    let program = read(&[source.clone(), code("start", "", "movel(p,t,m)")]);
    let TargetValue::Cartesian(numbers) = &program.targets[0].value else { panic!("a pose") };
    assert_eq!(numbers.position.each_ref().map(|field| field.value), [500.0, 0.0, -20.5]);
    assert_eq!(numbers.orientation.iter().map(|field| field.value).collect::<Vec<_>>(), [0.0, 0.0, 55.0]);
    let mut edits = EditSet::default();
    for (at, field) in numbers.position.iter().chain(&numbers.orientation).enumerate() {
        let (span, text) = written(field, source.slice(field.span()), &Decimal::nearest(at as f64 + 0.25, 2));
        edits.push(span, text);
    }
    let text = String::from_utf8(edits.apply(source.bytes()).expect("disjoint")).expect("utf-8");
    let expected =
        "<Value key=\"0\" x=\"0.25\" y=\"1.25\" z='2.25' rx=\"3.25\" ry=\"4.25\" rz=\"5.25\" fatherId=\"world[0]\" />";
    assert!(text.contains(expected), "{text}");
}

/// VAL3 reference manual, frames: rx about X, then ry about the turned Y, then rz about the turned Z. With rx = 90 the
/// turned Y is the old Z, so that ry = 90 takes the X axis to the old -Z seen along it, which is +Y.
#[test]
fn angles_are_those_of_the_manual() {
    let point = variable("p", "pointRx", "<Value key=\"0\" rx=\"90\" ry=\"90\"/>");
    let program = read(&[data(&point), code("start", "", "movel(p,t,m)")]);
    let TargetValue::Cartesian(numbers) = &program.targets[0].value else { panic!("a pose") };
    let rotation = numbers.pose().expect("a rotation").rotation;
    assert!((rotation.column(0) - nalgebra::Vector3::new(0.0, 1.0, 0.0)).norm() < 1e-12, "{rotation}");
    assert!((rotation.column(2) - nalgebra::Vector3::new(1.0, 0.0, 0.0)).norm() < 1e-12, "{rotation}");
}

#[test]
fn frames_and_tools_stand_in_their_fathers() {
    let all =
        variable("f", "frame", "<Value key=\"0\" x=\"100\" rz=\"90\"/><Value key=\"1\" x=\"10\" fatherId=\"f[0]\"/>")
            + &variable("g", "frame", "<Value key=\"0\" fatherId=\"lib:x[0]\"/>")
            + &variable(
                "t",
                "tool",
                "<Value key=\"0\" z=\"50\" fatherId=\"flange[0]\"/><Value key=\"1\" z=\"25\" fatherId=\"t[0]\"/>",
            )
            + &variable("round", "frame", "<Value key=\"0\" fatherId=\"round[0]\"/>")
            + &variable(
                "p",
                "pointRx",
                "<Value key=\"0\" x=\"1\" fatherId=\"f[1]\"/><Value key=\"1\" x=\"1\" fatherId=\"g[0]\"/>",
            );
    let program = read(&[data(&all), code("start", "", "movel(p,t[1],m)\r\nmovej(p[1],lib:t,m)")]);
    let pose = program.frames["f[1]"].value.as_ref().expect("known").pose;
    assert!((pose.translation - nalgebra::Vector3::new(0.1, 0.01, 0.0)).norm() < 1e-12);
    assert!((program.tools["t[1]"].value.as_ref().expect("known").pose.translation.z - 0.075).abs() < 1e-12);
    assert!(program.frames["round"].value.is_err());
    assert!(!program.frames.contains_key("g"));
    let one = &named(&program, "p").uses[0];
    assert_eq!((&one.tool, &one.frame), (&Reference::Named("t[1]".into()), &Reference::Named("f[1]".into())));
    let other = &named(&program, "p[1]").uses[0];
    assert_eq!((&other.tool, &other.frame), (&Reference::Named("lib:t".into()), &Reference::Named("g".into())));
}

#[test]
fn keys_are_numbers_or_words() {
    let values = "<Value key=\"drop off\" x=\"1\"/><Value key=\"1, 2\" x=\"2\"/>";
    let text = "movel(p[\"drop off\"],t,m)\r\nmovel(p[1,2],t,m)";
    let program = read(&[data(&variable("p", "pointRx", values)), code("start", "", text)]);
    assert_eq!(program.targets.iter().filter(|target| target.computed.is_none()).count(), 2);
}

#[test]
fn values_inside_of_user_types_comments_and_strings_are_none() {
    let all = variable(
        "s",
        "MotionCmd",
        "<Value key=\"0\"><Field name=\"p\" type=\"pointRx\"><Value key=\"0\" x=\"1\"/></Field></Value>",
    ) + "<!-- <Data name=\"p\" type=\"pointRx\"><Value key=\"0\" x=\"9\"/></Data> -->"
        + &variable("p", "pointRx", "<Value key=\"0\" x=\"1\"/>");
    let text = "// movel(p,t,m)\r\nsay(\"movel(p,t,m)\")\r\nmovel(s.p,t,m)";
    let program = read(&[data(&all), code("start", "", text)]);
    assert_eq!(program.targets.len(), 1);
    assert!(named(&program, "s.p").computed.is_some());
}

#[test]
fn what_is_set_at_run_time_is_computed() {
    let points: String = ["a", "b", "c", "d", "e", "g", "h"]
        .map(|name| variable(name, "pointRx", "<Value key=\"0\" x=\"1\"/><Value key=\"1\" x=\"2\"/>"))
        .concat();
    let text = "a=here(t,world)\r\nb[n].trsf.x=5\r\nlink(c,f)\r\nsetFrame(d,d[1],e,f)\r\ncall sub(g)\r\nif h==a\r\nendIf\r\n\
                movel(a,t,m)\r\nmovel(b[1],t,m)\r\nmovel(c,t,m)\r\nmovel(d,t,m)\r\nmovel(e,t,m)\r\nmovel(g,t,m)\r\n\
                movel(h,t,m)\r\nmovel(none,t,m)\r\nmovel(compose(h,w,x),t,m)\r\nmovel(h[2],t,m)";
    let program = read(&[data(&points), code("start", "", text)]);
    for name in ["a", "b[1]", "c", "d", "e", "g", "none", "compose(h,w,x)", "h[2]"] {
        assert!(named(&program, name).computed.is_some(), "{name}");
    }
    assert!(named(&program, "h").computed.is_none());
}

#[test]
fn parameters_that_are_only_read_leave_the_point_as_it_is() {
    let points = variable("p", "pointRx", "<Value key=\"0\" x=\"1\"/>")
        + &variable("q", "pointRx", "<Value key=\"0\" x=\"1\"/>");
    let main = code("start", "", "call go(p,q)\r\nmovel(p,t,m)\r\nmovel(q,t,m)");
    let parameters = "<Parameters><Parameter name=\"x_a\" type=\"pointRx\" use=\"reference\" /><Parameter name=\"q\" \
                      type=\"pointRx\" use=\"reference\" /></Parameters>";
    let go = code("go", parameters, "movel(x_a,t,m)\r\nq.trsf.x=1\r\nmovel(q,t,m)");
    let program = read(&[data(&points), main, go]);
    assert!(named(&program, "p").computed.is_none());
    assert_eq!(named(&program, "p").uses.len(), 1);
    // The parameter is changed, which the variable handed over under its name becomes.
    let changed = program.targets.iter().find(|target| target.file == 0 && target.name.as_deref() == Some("q"));
    assert!(changed.is_some_and(|target| target.computed.is_some()));
}

#[test]
fn approaches_are_displaced_and_arcs_have_two_goals() {
    let points = variable("p", "pointRx", "<Value key=\"0\" x=\"1\"/><Value key=\"1\" x=\"2\"/>");
    let text = "movel(appro(p,{0,0,-100,0,0,90}),t,m)\r\nmovej(appro(p[1],trUp),t,m)\r\nnId=movec(p,p[1],t,m)\r\nmovel(p[n],t,m)";
    let program = read(&[data(&points), code("start", "", text)]);
    let TargetValue::Displaced(displacement) = &named(&program, "appro(p,{0,0,-100,0,0,90})").value else {
        panic!("displaced")
    };
    assert_eq!(displacement.kind, DisplacementKind::Tool);
    assert_eq!(displacement.position.each_ref().map(|field| field.value), [0.0, 0.0, -100.0]);
    assert_eq!(program.targets[displacement.base].name.as_deref(), Some("p"));
    let paths = |name: &str| named(&program, name).uses.iter().map(|one| one.path).collect::<Vec<_>>();
    assert_eq!(paths("p"), [PathKind::ArcVia, PathKind::Linear]);
    assert_eq!(paths("p[1]"), [PathKind::Joint, PathKind::ArcEnd, PathKind::Linear]);
    assert!(named(&program, "p[1]").uses[0].computed.is_some());
}

#[test]
fn positions_may_stand_in_the_move() {
    let text = "movej({0,-30,120,0,60,0},t,m)\r\nmovel({{500,-20.5,30,180,0,0},{lefty,enegative,wsame}},t,m)";
    let program = read(&[code("start", "", text)]);
    assert_eq!(program.targets.iter().map(Target::kind).collect::<Vec<_>>(), ["joint", "cartesian"]);
    let asked = &program.targets[1].configuration;
    assert_eq!((asked.rear, asked.elbow_down, asked.wrist_negative), (Some(false), Some(true), None));
}

#[test]
fn what_is_cut_off_or_broken_is_said() {
    let codes =
        |sources: &[Source]| -> Vec<_> { read(sources).diagnostics.iter().map(|finding| finding.code).collect() };
    assert_eq!(codes(&[data(&variable("p", "pointRx", "<Value key=\"0\" x=\"1,5\"/>"))]), ["broken-value"]);
    assert_eq!(codes(&[Source::new("t", "<Database><Datas><Data name=\"p\" typ")]), ["truncated"]);
    assert_eq!(codes(&[Source::new("t", "<Program name=\"a\"><Code><![CDATA[begin movel(")]), ["truncated"]);
}

#[test]
fn only_val3_is_recognised() {
    assert!(recognises(data("").bytes()));
    assert!(recognises(code("start", "", "").bytes()));
    for text in ["", "<a xmlns=\"http://www.w3.org/1999/xhtml\"/>", "http://www.staubli.com/robotics/VAL3/", "<"] {
        assert!(!recognises(text.as_bytes()), "{text}");
    }
}

/// As applications of version 6 look (TX60, CS8C).
#[test]
fn version_6_is_read() {
    let data = "<?xml version=\"1.0\"?><dataList xmlns=\"DataNameSpace\"><frameSection><frame name=\"f\"><fFather alias=\"\" \
                name=\"world\" fatherIndex=\"0\"/><valueFrame index=\"0\"><tfValue x=\"100\" y=\"0\" z=\"0\" rx=\"0\" ry=\"0\" \
                rz=\"0\"/></valueFrame></frame></frameSection><pointSection><point name=\"p\"><pFather alias=\"\" name=\"f\" \
                fatherIndex=\"0\"/><valuePoint index=\"0\"><tpValue x=\"1\" y=\"2\" z=\"3\" rx=\"4\" ry=\"5\" rz=\"6\"/><cpValue \
                shoulder=\"righty\" elbow=\"enegative\" wrist=\"wsame\"/></valuePoint><valuePoint index=\"1\"><tpValue \
                x=\"9\"/></valuePoint></point></pointSection></dataList>";
    let code = "<programList xmlns=\"ProgramNameSpace\"><program name=\"start\"><paramSection/><localSection><local \
                name=\"l_p\"/></localSection><source><code>begin\n  movel(p[0],flange,m)\n  if n&lt;5\n  movej(p[1],flange,m)\n\
                movel(l_p,flange,m)\nend</code></source></program></programList>";
    let (data, code) = (Source::new("a.dtx", data), Source::new("start.pgx", code));
    assert!(recognises(data.bytes()) && recognises(code.bytes()));
    let program = read(&[data, code]);
    let p = named(&program, "p");
    let TargetValue::Cartesian(numbers) = &p.value else { panic!("a pose") };
    assert_eq!(numbers.position.each_ref().map(|field| field.value), [1.0, 2.0, 3.0]);
    assert_eq!((p.configuration.rear, p.configuration.elbow_down), (Some(true), Some(true)));
    assert_eq!(p.uses[0].frame, Reference::Named("f".into()));
    assert!((program.frames["f"].value.as_ref().expect("known").pose.translation.x - 0.1).abs() < 1e-12);
    assert_eq!(named(&program, "p[1]").uses.len(), 1);
    assert!(named(&program, "l_p").computed.is_some());
}
