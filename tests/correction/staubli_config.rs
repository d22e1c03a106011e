//! Staubli's `shoulder`, `elbow` and `wrist` against the arm: the words of a joint position lead back to it.
//!
//! The words are told here by the VAL3 reference manual's figures, from joint values alone: lefty with the wrist in front
//! of axis 1, epositive with joint 3 positive, wpositive with joint 5 positive.

use falsetarget::base::text::Source;
use falsetarget::files::builtin::by_name;
use falsetarget::kinematics::choose::Wish;
use falsetarget::kinematics::controller::Controller;
use falsetarget::program::dialect;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Lengths of the TX90L, mm: axis 1 to 2, upper arm, forearm.
const LENGTHS: [f64; 3] = [50.0, 500.0, 550.0];

#[test]
fn the_words_of_a_position_lead_back_to_its_joints() {
    let robot = by_name("staubli-tx90l").expect("built in").expect("sound");
    let controller = Controller::new(&robot);
    let mut random = ChaCha8Rng::seed_from_u64(90);
    let mut seen = std::collections::HashSet::new();
    for _ in 0..400 {
        let spans = [(-170.0, 170.0), (-120.0, 140.0), (-140.0, 140.0), (-85.0, 85.0), (-110.0, 130.0), (-85.0, 85.0)];
        let joints: [f64; 6] = spans.map(|(low, high)| random.random_range(low..high));
        let [_, q2, q3, _, q5, _] = joints.map(f64::to_radians);
        let front_mm = LENGTHS[0] + LENGTHS[1] * q2.sin() + LENGTHS[2] * (q2 + q3).sin();
        // Where two postures meet the words say little.
        if front_mm.abs() < 80.0 || q3.sin().abs() < 0.1 || q5.sin().abs() < 0.1 || q3.cos() < -0.75 {
            continue;
        }
        let words = [
            if front_mm > 0.0 { "lefty" } else { "righty" },
            if q3 > 0.0 { "epositive" } else { "enegative" },
            if q5 > 0.0 { "wpositive" } else { "wnegative" },
        ];
        let asked = configuration(words);
        let wish = Wish {
            rear: asked.rear,
            elbow_down: asked.elbow_down,
            wrist_negative: asked.wrist_negative,
            near_rad: Some(joints.map(|degrees| degrees.signum() * 0.7)),
            ..Wish::default()
        };
        let numbers = joints.map(f64::to_radians);
        let flange = controller.forward(&numbers).expect("a pose");
        let choice = controller.solve(&flange, &wish, None).expect("reachable");
        let apart = |joint: usize| (choice.numbers_rad[joint] - numbers[joint]).sin().abs();
        assert!([0, 1, 2, 4].into_iter().all(|joint| apart(joint) < 1e-6), "{joints:?} {words:?}: {choice:?}");
        seen.insert(words);
    }
    assert_eq!(seen.len(), 8, "every posture was met");
}

/// What the reader makes of the words.
fn configuration([shoulder, elbow, wrist]: [&str; 3]) -> falsetarget::program::target::Configuration {
    let space = "http://www.staubli.com/robotics/VAL3";
    let data = format!(
        "<Database xmlns=\"{space}/Data/2\"><Datas><Data name=\"p\" type=\"pointRx\"><Value key=\"0\" \
         shoulder=\"{shoulder}\" elbow=\"{elbow}\" wrist=\"{wrist}\"/></Data></Datas></Database>"
    );
    let code = format!(
        "<Programs xmlns=\"{space}/Program/2\"><Program name=\"start\"><Code><![CDATA[movel(p,t,m)]]></Code></Program></Programs>"
    );
    let read = dialect::by_id("val3").expect("VAL3").read(&[Source::new("d", data), Source::new("c", code)]);
    read.targets[0].configuration.as_ref().clone()
}
