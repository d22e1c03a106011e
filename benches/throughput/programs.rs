//! A RAPID program with as many inline positions as wanted: a raster over a slightly curved surface.

use std::fmt::Write;

use falsetarget::geometry::orientation::quaternion_from_rotation;
use falsetarget::geometry::pose::{Pose, rotation_x, rotation_y};
use falsetarget::kinematics::choose::Wish;
use falsetarget::kinematics::controller::Controller;
use nalgebra::Vector3;

/// The tool of the program, straight out of the flange, m.
const TOOL_M: f64 = 0.25;
/// Points a line of the raster.
const A_LINE: usize = 200;

const HEAD: &str = "MODULE Raster\n\
    PERS tooldata tMill:=[TRUE,[[0,0,250],[1,0,0,0]],[400,[0,0,200],[1,0,0,0],0,0,0]];\n\
    PERS wobjdata wPart:=[FALSE,TRUE,\"\",[[1500,0,900],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n\
    PROC main()\n";
const TAIL: &str = "ENDPROC\nENDMODULE\n";

/// The program. Three decimals of a millimetre and eight of a quaternion, as post processors write them.
pub fn raster(controller: &Controller, targets: usize) -> String {
    let mut text = String::with_capacity(160 * targets + 400);
    text.push_str(HEAD);
    let mut previous = None;
    for index in 0..targets {
        let target = point(index, targets);
        let base_t_frame = Pose::from_translation(Vector3::new(1.5, 0.0, 0.9));
        let flange = base_t_frame * target * Pose::from_translation(Vector3::new(0.0, 0.0, -TOOL_M));
        let choice = controller.solve(&flange, &Wish::default(), previous.as_ref()).expect("in reach");
        previous = Some(choice.numbers_rad);
        let quarter = |joint: usize| (choice.numbers_rad[joint].to_degrees() / 90.0).floor();
        let bits = [choice.posture.rear, choice.posture.elbow_down, choice.posture.wrist_negative];
        let solution = bits.iter().fold(0, |number, &bit| 2 * number + u8::from(bit));
        let [x, y, z] = (target.translation * 1e3).into();
        let [qw, qx, qy, qz] = quaternion_from_rotation(&target.rotation);
        let written = writeln!(
            text,
            "  MoveL [[{x:.3},{y:.3},{z:.3}],[{qw:.8},{qx:.8},{qy:.8},{qz:.8}],[{},{},{},{solution}],\
             [9E9,9E9,9E9,9E9,9E9,9E9]],v100,z1,tMill\\WObj:=wPart;",
            quarter(0),
            quarter(3),
            quarter(5)
        );
        written.expect("memory");
    }
    text.push_str(TAIL);
    text
}

/// A point of the raster in the work object, the tool pointing down and leaning with the surface.
fn point(index: usize, targets: usize) -> Pose {
    let (line, along) = (index / A_LINE, index % A_LINE);
    let along = if line % 2 == 0 { along } else { A_LINE - 1 - along };
    let x = 0.8 * line as f64 / (targets as f64 / A_LINE as f64);
    let y = 0.8 * (along as f64 / A_LINE as f64 - 0.5);
    let lean = rotation_x(std::f64::consts::PI + 0.3 * y) * rotation_y(0.1 + 0.2 * x);
    Pose { rotation: lean, translation: Vector3::new(x, y, 0.1 * (3.0 * y).cos()) }
}
