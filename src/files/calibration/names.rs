//! What parameters are called in files.

use crate::model::parameters::{ParameterId, Rod, RowQuantity};
use crate::model::robot::DOF;

const COMPONENTS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
const QUANTITIES: [(&str, RowQuantity); 5] = [
    ("offset", RowQuantity::Offset),
    ("d", RowQuantity::D),
    ("a", RowQuantity::A),
    ("alpha", RowQuantity::Alpha),
    ("beta", RowQuantity::Beta),
];
const RODS: [(&str, Rod); 2] = [("crank", Rod::Crank), ("coupler", Rod::Coupler)];

/// All geometric parameters, in the order in which files list them.
pub(super) fn geometry_ids() -> impl Iterator<Item = ParameterId> {
    let base = (0..6).map(ParameterId::Base);
    let rows = (0..DOF).flat_map(|joint| QUANTITIES.map(|(_, quantity)| ParameterId::Row(joint, quantity)));
    let rods = RODS.map(|(_, rod)| ParameterId::Loop(rod));
    base.chain(rows).chain(rods).chain((0..6).map(ParameterId::Tool))
}

/// `("joint 2", "a")`; `None` for parameters of effects.
pub fn geometry_name(id: ParameterId) -> Option<(String, String)> {
    Some(match id {
        ParameterId::Row(joint, quantity) => {
            let (name, _) = QUANTITIES.iter().find(|(_, known)| *known == quantity)?;
            (format!("joint {}", joint + 1), (*name).to_string())
        }
        ParameterId::Base(component) => ("base".into(), (*COMPONENTS.get(component)?).into()),
        ParameterId::Tool(component) => ("tool".into(), (*COMPONENTS.get(component)?).into()),
        ParameterId::Loop(rod) => ("loop".into(), RODS.iter().find(|(_, known)| *known == rod)?.0.into()),
        ParameterId::Effect(..) => return None,
    })
}

/// The parameter of that name.
pub(super) fn geometry_id(at: &str, quantity: &str) -> Option<ParameterId> {
    geometry_ids().find(|&id| geometry_name(id).is_some_and(|(place, name)| place == at && name == quantity))
}

/// The unit of a geometric parameter, in files and inside.
pub fn geometry_unit(id: ParameterId) -> &'static str {
    match id {
        ParameterId::Row(_, RowQuantity::D | RowQuantity::A) | ParameterId::Loop(_) => "m",
        ParameterId::Base(component) | ParameterId::Tool(component) if component < 3 => "m",
        _ => "rad",
    }
}
