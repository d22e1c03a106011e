//! The numbers of a block: written ones, and those of the blocks before.

use std::collections::HashMap;

use crate::geometry::orientation::OrientationConvention;
use crate::program::number::{Insertion, NumberField};
use crate::program::target::{CartesianNumbers, LengthUnit, Units};

use super::block::Block;
use super::reader::{POSITION, Reader};

impl Reader<'_> {
    /// The six numbers of a block, those that are left out taken from the blocks before.
    pub(super) fn fields(&mut self, block: &Block) -> Result<CartesianNumbers, String> {
        let turns = self.turns.ok_or("no word says how the tool is turned")?;
        let convention = self.stated.orientation.unwrap_or(OrientationConvention::FixedXyz);
        let axes: Vec<&str> = POSITION.iter().chain(&turns).copied().collect();
        let mut written: HashMap<&str, NumberField> = HashMap::new();
        let mut runtime = None;
        for &address in &axes {
            match block.word(address).map(|word| (&word.value, word.span)) {
                Some((Some(field), _)) => {
                    self.modal.axes.insert(address.into(), field.clone());
                    self.without_point +=
                        usize::from(!self.source.slice(field.span()).contains(&b'.') && field.value != 0.0);
                    written.insert(address, field.clone());
                }
                Some((None, span)) => {
                    self.modal.axes.remove(address);
                    runtime = Some(format!("`{}` is known only at run time", self.source.text(span)));
                }
                None => {}
            }
        }
        if let Some(reason) = runtime {
            return Err(reason);
        }
        // Parts of a vector that are not given beside others are zero.
        let vector = turns[0] == "A3" && turns.iter().any(|address| written.contains_key(address));
        let place = self.insertion_place(block, &axes);
        let mut fields = Vec::with_capacity(axes.len());
        for &address in &axes {
            let zero = vector && turns.contains(&address);
            let field = match (written.remove(address), self.modal.axes.get(address)) {
                (Some(field), _) => field,
                (None, Some(_)) if zero => self.left_out(address, 0.0, 6, place, false),
                (None, None) if zero => self.left_out(address, 0.0, 6, place, false),
                (None, Some(before)) => self.left_out(address, before.value, before.decimals(), place, true),
                (None, None) => return Err(format!("{address} is left out, and no block before says where it stands")),
            };
            if zero {
                self.modal.axes.insert(address.into(), field.clone());
            }
            fields.push(field);
        }
        let orientation = fields.split_off(POSITION.len());
        let position: [NumberField; 3] = fields.try_into().map_err(|_| "an axis is missing".to_owned())?;
        let inches = self.modal.inches.unwrap_or(self.stated.length == Some(LengthUnit::Inch));
        let length = if inches { LengthUnit::Inch } else { self.stated.length.unwrap_or(LengthUnit::Millimetre) };
        let units = Units { length, radians: self.stated.radians.unwrap_or(false) };
        Ok(CartesianNumbers { position, orientation: orientation.into_iter().collect(), convention, units })
    }

    /// Behind the last axis word of the block, and whether words are set apart.
    fn insertion_place(&self, block: &Block, axes: &[&str]) -> (usize, bool) {
        let last = block.words.iter().rfind(|word| axes.contains(&word.address.as_str()));
        let last = last.map_or(block.span, |word| word.span);
        let apart = last.start > block.span.start && self.source.bytes()[last.start - 1].is_ascii_whitespace();
        (last.end, apart || last.start == block.span.start)
    }

    fn left_out(
        &self,
        address: &str,
        value: f64,
        decimals: usize,
        (at, apart): (usize, bool),
        repeats: bool,
    ) -> NumberField {
        let blank = if apart { " " } else { "" };
        let equals = if address.len() > 1 { "=" } else { "" };
        let insertion = Insertion { before: format!("{blank}{address}{equals}"), after: String::new(), repeats };
        // Never without a point: some controls read `Z5` as five increments.
        let decimals = decimals.max(1);
        NumberField::left_out(at, value, decimals, insertion)
    }
}
