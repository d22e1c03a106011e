//! `Offs` and `RelTool`: a constant displacement of another position.

use std::ops::Range;

use nalgebra::Matrix3;

use crate::geometry::pose::{rotation_x, rotation_y, rotation_z};
use crate::program::number::NumberField;
use crate::program::target::{Displacement, DisplacementKind, TargetValue, Units};

use super::argument::{Argument, arguments, named, number, positional};
use super::position::{Extras, Positions};
use super::statement::FileText;
use super::symbol::{Scope, Storage};
use super::token::TokenKind;

impl<'a> Positions<'_, 'a> {
    /// The target of `Offs(p, dx, dy, dz)` or `RelTool(p, dx, dy, dz \Rx \Ry \Rz)`.
    pub fn displaced(
        &mut self,
        text: &FileText<'a>,
        range: &Range<usize>,
        scope: Scope,
        kind: DisplacementKind,
    ) -> usize {
        match self.displacement(text, range, scope, kind) {
            Ok(displacement) => {
                let base = &self.targets[displacement.base];
                let (configuration, external_axes) = (base.configuration.clone(), base.external_axes.clone());
                let computed = base.computed.clone();
                let value = TargetValue::Displaced(Box::new(displacement));
                let target = self.push(text, range, scope, value, Ok(Extras { configuration, external_axes }));
                self.targets[target].computed = computed;
                target
            }
            Err(reason) => self.unwritten(text, range, scope, reason),
        }
    }

    fn displacement(
        &mut self,
        text: &FileText<'a>,
        range: &Range<usize>,
        scope: Scope,
        kind: DisplacementKind,
    ) -> Result<Displacement, String> {
        let function = text.display(range.start);
        if text.after_group(range.start + 1, range.end) != Some(range.end) {
            return Err("it is an expression".into());
        }
        let all = arguments(text, range.start + 2..range.end - 1);
        let (base, shifts) = match positional(&all).as_slice() {
            [base, x, y, z] => ((*base).clone(), [*x, *y, *z].map(Range::clone)),
            _ => return Err(format!("`{function}` has not its four arguments")),
        };
        let fields: Vec<_> =
            shifts.iter().map(|shift| self.literal_shift(text, shift, scope)).collect::<Result<_, _>>()?;
        let position: [NumberField; 3] = fields.try_into().map_err(|_| String::from("it is an expression"))?;
        let rotation = match kind {
            DisplacementKind::Frame => Matrix3::identity(),
            DisplacementKind::Tool => self.turn(text, &all, scope)?,
        };
        let simple = matches!(text.kind(base.start), Some(TokenKind::Position | TokenKind::Symbol(b'[')))
            || (text.kind(base.start) == Some(TokenKind::Name) && !text.is_symbol(base.start + 1, b'('));
        if !simple {
            return Err(format!("`{function}` displaces what another function gives"));
        }
        let variable_index = base.clone().any(|at| text.is_symbol(at, b'{'))
            && super::change::element_at(text, base.start + 1, base.end).is_none();
        if variable_index {
            return Err(format!("`{}` has a variable index", text.source.text(text.span(&base))));
        }
        match self.targets_of(text, &base, scope).as_slice() {
            &[base] => match (&self.targets[base].value, &self.targets[base].computed) {
                (TargetValue::Unwritten, Some(reason)) => Err(reason.clone()),
                (TargetValue::Cartesian(_), _) => {
                    Ok(Displacement { base, kind, position, rotation, units: Units::MM_DEG })
                }
                _ => Err(format!("`{function}` displaces what is not a robtarget")),
            },
            _ => Err(format!("`{function}` displaces a whole array")),
        }
    }

    /// The turn that the optional arguments ask for.
    ///
    /// R = Rx Ry Rz: first about x of the tool, then about the new y, then about the new z (ABB, RAPID Instructions,
    /// Functions and Data Types 3HAC050917, `RelTool`).
    fn turn(&self, text: &FileText, all: &[Argument], scope: Scope) -> Result<Matrix3<f64>, String> {
        let angle_rad = |name: &str| match named(all, name) {
            None => Ok(0.0),
            Some(range) => self.literal_shift(text, range, scope).map(|field| field.value.to_radians()),
        };
        Ok(rotation_x(angle_rad("rx")?) * rotation_y(angle_rad("ry")?) * rotation_z(angle_rad("rz")?))
    }

    fn literal_shift(&self, text: &FileText, range: &Range<usize>, scope: Scope) -> Result<NumberField, String> {
        if let Some(field) = number(text, range) {
            return Ok(field);
        }
        let written = text.source.text(text.span(range));
        let symbol = if range.len() == 1 { self.job.known_symbol(&text.key(range.start), scope) } else { None };
        let constant = symbol.filter(|symbol| symbol.storage == Storage::Constant).and_then(|symbol| {
            let value = number(&self.job.files[symbol.scope.file], symbol.value.as_ref()?)?;
            Some(value.value)
        });
        Err(match constant {
            Some(value) => format!("its displacement is the constant `{written}` ({value})"),
            None => format!("its displacement `{written}` is not a number"),
        })
    }
}
