//! What line-oriented robot languages share: tokens, statements, named positions that moves go to.

mod positions;
mod selected;
mod token;

pub(super) use positions::{Position, Positions};
pub(super) use selected::{Selected, under_condition};
pub(super) use token::{Kind, Lexis, Text, Tokens, joints_of, pose_of};
