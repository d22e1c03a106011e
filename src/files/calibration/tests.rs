use super::*;
use crate::base::text::Source;
use crate::files::builtin;
use crate::model::parameters::RowQuantity;

#[test]
fn covariance_and_stations_go_round_and_bad_ones_are_refused() {
    let source = Source::new("m.yaml", model_text());
    let mut calibration = read(&source).expect("readable");
    let ids = vec![ParameterId::Row(1, RowQuantity::A), ParameterId::Effect(1, 0), ParameterId::Effect(4, 0)];
    let covariance = nalgebra::DMatrix::from_row_slice(3, 3, &[4e-10, 1e-15, 0., 1e-15, 1e-18, 0., 0., 0., 2e-18]);
    let (noise_sigma_m, unexplained_sigma_m) = (4e-5, 1e-4);
    let uncertainty = Uncertainty { ids, covariance, freedom: 686.5, noise_sigma_m, unexplained_sigma_m };
    calibration.uncertainty = Some(uncertainty.clone());
    let station_t_measuring = Pose::from_translation(nalgebra::Vector3::new(1.5, 0.0, -0.25));
    calibration.stations = vec![StationFrame { name: "S2".into(), station_t_measuring }];
    let text = write(&calibration).expect("writable");
    let again = read(&Source::new("m.yaml", text.clone())).expect(&text);
    // An identified compliance of zero is written too: the model knows that it is nearly zero.
    assert_eq!(again.uncertainty, Some(uncertainty));
    assert_eq!(again.stations, calibration.stations);
    assert_eq!(again.sigma_of(ParameterId::Row(1, RowQuantity::A)), Some(2e-5));
    assert_eq!(write(&again).expect("writable"), text);
    for (from, to) in [("joint 2 a", "joint 7 a"), ("freedom: 686.5", "freedom: -1.0"), ("- - 4e-10", "- - -1.0")] {
        assert!(text.contains(from), "{from} in {text}");
        let error = read(&Source::new("m.yaml", text.replacen(from, to, 1))).expect_err(to);
        assert_eq!(error.diagnostic.code, "uncertainty", "{to}");
    }
}

fn model_text() -> String {
    let robot = builtin::by_name("hh800-class").expect("built in").expect("sound");
    let mut calibration = Calibration::nominal(robot);
    calibration.arm.parameters.rows[1].a_m = 3.1e-4;
    calibration.arm.parameters.effects[1][0] = 4.3e-8;
    calibration.sigma.push((ParameterId::Row(1, RowQuantity::A), 1.5e-5));
    calibration.region = Some(Region { min_rad: [-1.0; DOF], max_rad: [1.0; DOF] });
    write(&calibration).expect("writable")
}

#[test]
fn a_model_file_goes_round_bit_for_bit() {
    let text = model_text();
    let again = read(&Source::new("m.yaml", text.clone())).expect("readable");
    assert_eq!(again.arm.parameters.rows[1].a_m, 3.1e-4);
    assert_eq!(again.arm.parameters.effects[1][0], 4.3e-8);
    assert_eq!(again.sigma, [(ParameterId::Row(1, RowQuantity::A), 1.5e-5)]);
    assert_eq!(write(&again).expect("writable"), text);
}

#[test]
fn what_is_wrong_is_told_with_its_line() {
    for (from, to, code) in [
        ("quantity: a", "quantity: b", "parameter"),
        ("value: 0.00031", "value: 310.0", "unit-scale"),
        ("unit: m", "unit: mm", "unit"),
        ("effect: joint_compliance", "effect: magic", "effect"),
        ("falsetarget/model/1", "falsetarget/model/9", "schema"),
        ("parameters:\n- at", "parametres:\n- at", "yaml"),
    ] {
        let text = model_text();
        assert!(text.contains(from), "{from} in {text}");
        let source = Source::new("m.yaml", text.replacen(from, to, 1));
        let error = read(&source).expect_err(to);
        assert_eq!(error.diagnostic.code, code, "{to}: {}", error.diagnostic.message);
        let place = error.diagnostic.place.as_ref().expect("a place");
        assert!(code == "schema" || source.line(place.span.start) > 1, "{to}");
    }
}
