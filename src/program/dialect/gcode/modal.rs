//! What holds from block to block.

use std::collections::HashMap;

use crate::program::number::NumberField;

use super::block::Block;

/// Motion of the G-words of group 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    /// `G0`.
    Rapid,
    /// `G1`.
    Line,
    /// `G2`, `G3`.
    Arc,
    /// A drilling cycle, `G81` to `G89`, and `G73`, `G76`.
    Cycle,
}

/// The modes of a control.
#[derive(Clone, Debug, Default)]
pub(super) struct Modal {
    /// Group 1; nothing before the first word.
    pub motion: Option<Motion>,
    /// `G91`.
    pub relative: bool,
    /// `G20`, `G70`: inches; `None` before the first word.
    pub inches: Option<bool>,
    /// `G41`, `G42`.
    pub offset: bool,
    /// Axis words are those of the machine: `TRAFOOF`, `#TRAFO OFF`, `#MCS ON`.
    machine: bool,
    /// What shifts or turns all that follows, with its line.
    shifts: Vec<(&'static str, usize)>,
    /// The last value of each axis word, with the digits that it had.
    pub axes: HashMap<String, NumberField>,
}

/// What shifts, and what ends it; nothing does where it is zero.
const SHIFTS: [(f64, &str, f64); 7] = [
    (68.0, "G68", 69.0),
    (68.2, "G68.2", 69.0),
    (51.0, "G51", 50.0),
    (51.1, "G51.1", 50.1),
    (16.0, "G16", 15.0),
    (52.0, "G52", 0.0),
    (92.0, "G92", 0.0),
];
/// Words that shift, turn or wind up the coordinates for the rest of the program.
const SHIFTING_WORDS: [&str; 10] =
    ["TRANS", "ATRANS", "ROT", "AROT", "SCALE", "ASCALE", "MIRROR", "AMIRROR", "TRANSMIT", "TRACYL"];

impl Modal {
    /// Takes over the G-words and keywords of a block.
    pub fn take(&mut self, block: &Block, line: usize) {
        for code in block.numbers("G") {
            match code {
                0.0 => self.motion = Some(Motion::Rapid),
                1.0 => self.motion = Some(Motion::Line),
                2.0 | 3.0 => self.motion = Some(Motion::Arc),
                73.0 | 76.0 => self.motion = Some(Motion::Cycle),
                80.0 => self.motion = None,
                _ if (81.0..=89.0).contains(&code) => self.motion = Some(Motion::Cycle),
                20.0 | 70.0 | 700.0 => self.inches = Some(true),
                21.0 | 71.0 | 710.0 => self.inches = Some(false),
                40.0 => self.offset = false,
                41.0 | 42.0 => self.offset = true,
                90.0 => self.relative = false,
                91.0 => self.relative = true,
                _ => {}
            }
            for (on, word, off) in SHIFTS {
                if code == on {
                    self.shifts.push((word, line));
                } else if off != 0.0 && code == off {
                    self.shifts.retain(|(shift, _)| *shift != word);
                }
            }
        }
        let says = |word: &str| block.keywords.iter().any(|keyword| keyword == word);
        for keyword in &block.keywords {
            match keyword.as_str() {
                "TRAFOOF" => self.machine = true,
                "TRAORI" => self.machine = false,
                "TRAFO" => self.machine = says("OFF"),
                "MCS" => self.machine = says("ON"),
                "CS" if says("OFF") => self.shifts.retain(|(shift, _)| *shift != "#CS"),
                "CS" if says("ON") => self.shifts.push(("#CS", line)),
                "CIP" | "CT" => self.motion = Some(Motion::Arc),
                other => {
                    let shifting = SHIFTING_WORDS.iter().find(|word| **word == other);
                    self.shifts.extend(shifting.map(|word| (*word, line)));
                }
            }
        }
    }

    /// Why moves do not go where their words say, if so.
    pub fn computed(&self) -> Option<String> {
        let shift = self.shifts.last().map(|(word, line)| format!("shifted by {word} in line {line}"));
        let relative = || self.relative.then(|| "relative to the position before (G91)".to_owned());
        let offset = || self.offset.then(|| "beside the path by the tool's radius (G41, G42)".to_owned());
        let cycle = || (self.motion == Some(Motion::Cycle)).then(|| "a drilling cycle".to_owned());
        let machine = || self.machine.then(|| "in the machine's own axes, without transformation".to_owned());
        shift.or_else(machine).or_else(relative).or_else(offset).or_else(cycle)
    }

    /// Forgets where the axes are: behind calls, jumps, reference runs.
    pub fn forget(&mut self) {
        self.axes.clear();
    }
}
