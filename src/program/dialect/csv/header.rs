//! The header row: which column is what, in which unit.

use crate::geometry::orientation::OrientationConvention;
use crate::program::dialect::stated::{angle_unit, length_unit};
use crate::program::target::LengthUnit;

/// What the columns of a list are.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Header {
    /// x, y, z.
    pub position: Option<[Column; 3]>,
    /// Orientation numbers, in the order of the convention.
    pub orientation: Option<Orientation>,
    /// Six joints.
    pub joints: Option<[Column; 6]>,
    /// Names.
    pub name: Option<usize>,
    /// Tools.
    pub tool: Option<usize>,
    /// Frames.
    pub frame: Option<usize>,
    /// How to go there.
    pub motion: Option<usize>,
    /// Additional axes by name.
    pub external: Vec<(String, usize)>,
    /// It has a measured joint position: a recording, not a list of targets.
    pub is_recording: bool,
    /// How many cells a row has.
    pub width: usize,
}

/// A column of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Column {
    /// Which.
    pub index: usize,
    /// The unit that its name has.
    pub unit: Option<Unit>,
}

/// A unit in a column's name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unit {
    /// Of a length.
    Length(LengthUnit),
    /// Of an angle: radians or not.
    Angle(bool),
}

/// The columns of an orientation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Orientation {
    /// Which.
    pub columns: Vec<Column>,
    /// What their names say; `None` where the names mean several things.
    pub convention: Option<OrientationConvention>,
    /// Their names, for messages.
    pub names: &'static str,
}

/// Names of orientation columns, in the order in which they are looked for.
const ORIENTATIONS: [(&[&str], &str, Option<OrientationConvention>); 7] = [
    (&["qw", "qx", "qy", "qz"], "qw, qx, qy, qz", Some(OrientationConvention::QuaternionWxyz)),
    (&["roll", "pitch", "yaw"], "roll, pitch, yaw", Some(OrientationConvention::FixedXyz)),
    (&["w", "p", "r"], "w, p, r", Some(OrientationConvention::FixedXyz)),
    (&["o", "a", "t"], "o, a, t", Some(OrientationConvention::EulerZyz)),
    (&["rx", "ry", "rz"], "rx, ry, rz", None),
    (&["a", "b", "c"], "a, b, c", None),
    (&["i", "j", "k"], "i, j, k", None),
];

impl Header {
    /// Reads the cells of a header row.
    pub fn read(cells: &[String]) -> Self {
        let columns: Vec<(String, Option<Unit>)> = cells.iter().map(|cell| name_and_unit(cell)).collect();
        let index = |wanted: &str| columns.iter().position(|(name, _)| name == wanted);
        let column = |wanted: &str| index(wanted).map(|index| Column { index, unit: columns[index].1 });
        let all = |names: &[&str]| names.iter().map(|name| column(name)).collect::<Option<Vec<Column>>>();
        let position = all(&["x", "y", "z"]).or_else(|| all(&["pos_x", "pos_y", "pos_z"]));
        let orientation = ORIENTATIONS
            .iter()
            .find_map(|&(wanted, names, convention)| Some(Orientation { columns: all(wanted)?, convention, names }));
        let external = (1..=6).filter_map(|number| {
            let name = format!("e{number}");
            index(&name).map(|index| (name.to_uppercase(), index))
        });
        Self {
            position: position.and_then(|columns| columns.try_into().ok()),
            orientation,
            joints: all(&["j1", "j2", "j3", "j4", "j5", "j6"]).and_then(|columns| columns.try_into().ok()),
            name: index("name").or_else(|| index("id")).or_else(|| index("label")),
            tool: index("tool"),
            frame: index("frame"),
            motion: index("motion"),
            external: external.collect(),
            is_recording: index("q1").is_some(),
            width: cells.len(),
        }
    }

    /// True when rows under it can be targets.
    pub fn has_targets(&self) -> bool {
        !self.is_recording && (self.joints.is_some() || (self.position.is_some() && self.orientation.is_some()))
    }
}

/// `X_mm`, `x [mm]`, `x (mm)` into the name in lower case and its unit.
fn name_and_unit(cell: &str) -> (String, Option<Unit>) {
    let text = cell.trim().to_lowercase();
    let bracketed = text.strip_suffix(']').and_then(|rest| rest.split_once('['));
    let bracketed = bracketed.or_else(|| text.strip_suffix(')').and_then(|rest| rest.split_once('(')));
    let (name, word) = match bracketed.or_else(|| text.rsplit_once('_')) {
        Some((name, word)) => (name.trim(), word.trim()),
        None => return (text, None),
    };
    let length = length_unit(word).map(Unit::Length);
    match length.or_else(|| angle_unit(word).map(Unit::Angle)) {
        Some(unit) => (name.to_owned(), Some(unit)),
        None => (text, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(line: &str) -> Header {
        Header::read(&line.split(',').map(str::to_owned).collect::<Vec<_>>())
    }

    #[test]
    fn columns_stand_in_any_order_with_their_units() {
        let read = header("id,Z_mm,Y [m],x (inch),qz,qx,qy,qw,speed,E2");
        let [x, y, z] = read.position.expect("a position");
        assert_eq!((x.index, y.index, z.index), (3, 2, 1));
        assert_eq!(x.unit, Some(Unit::Length(LengthUnit::Inch)));
        let orientation = read.orientation.clone().expect("an orientation");
        assert_eq!(orientation.columns.iter().map(|column| column.index).collect::<Vec<_>>(), [7, 5, 6, 4]);
        assert_eq!((read.name, read.external.as_slice()), (Some(0), &[("E2".to_owned(), 9)][..]));
        assert!(read.has_targets());
    }

    #[test]
    fn only_names_that_mean_one_thing_say_what_they_mean() {
        let convention = |line: &str| header(line).orientation.expect("an orientation").convention;
        assert_eq!(convention("x,y,z,w,p,r"), Some(OrientationConvention::FixedXyz));
        assert_eq!(convention("x,y,z,o,a,t"), Some(OrientationConvention::EulerZyz));
        assert_eq!(convention("x,y,z,a,b,c"), None);
        assert_eq!(convention("x,y,z,rx_deg,ry_deg,rz_deg"), None);
    }

    #[test]
    fn recordings_and_tables_of_points_are_no_targets() {
        for line in ["q1_deg,q2_deg,x_mm,y_mm,z_mm,rx,ry,rz", "id,x_mm,y_mm,z_mm,u95_mm", "time,value", ""] {
            assert!(!header(line).has_targets(), "{line}");
        }
    }
}
