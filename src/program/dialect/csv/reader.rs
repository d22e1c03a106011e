//! The rows of a list into targets.

use std::sync::Arc;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::geometry::orientation::OrientationConvention;
use crate::program::dialect::stated::Stated;
use crate::program::number::{NumberField, number_at};
use crate::program::shared::Shared;
use crate::program::target::{
    CartesianNumbers, Configuration, ExternalAxis, JointNumbers, LengthUnit, OrientationFields, PathKind, Program,
    Reference, Target, TargetValue, Units, Use, Way,
};

use super::header::{Column, Header, Unit};
use super::row::{cells, delimiter, trimmed};

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// True for a header with targets and a first row of numbers under it.
pub(super) fn recognises(source: &Source) -> bool {
    let mut lines = meaningful(source).filter(|&line| source.bytes()[line.start] != b'#');
    let Some(first) = lines.next() else { return false };
    let delimiter = delimiter(source.slice(first));
    let header = Header::read(&texts(source, first, delimiter));
    let is_number = |cells: &[Span], index: usize| {
        cells.get(index).is_some_and(|&cell| cell.is_empty() || whole_number(source, cell).is_some())
    };
    header.has_targets()
        && lines.next().is_some_and(|row| {
            let cells = cells(source.bytes(), row, delimiter);
            let of_joints = header.joints.iter().flatten();
            header.position.iter().flatten().chain(of_joints).all(|column| is_number(&cells, column.index))
        })
}

/// Reads the lists; each has its own header.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    for (file, source) in sources.iter().enumerate() {
        let mut list = List { source, file, stated: Stated::default(), table: None, ways: Shared::default() };
        for line in meaningful(source) {
            list.line(line, &mut program);
        }
    }
    program
}

/// Lines with text, without blanks around it and without a byte-order mark.
fn meaningful(source: &Source) -> impl Iterator<Item = Span> + '_ {
    source.lines().filter_map(|line| {
        let marked = line.start == 0 && source.slice(line).starts_with(BYTE_ORDER_MARK);
        let start = if marked { line.start + BYTE_ORDER_MARK.len() } else { line.start };
        let whole = Span::new(start, line.end);
        let text = trimmed(source.bytes(), whole);
        // Tabs at the ends are empty cells.
        let comment = source.slice(text).first() == Some(&b'#');
        (!text.is_empty()).then_some(if comment { text } else { whole })
    })
}

fn texts(source: &Source, line: Span, delimiter: u8) -> Vec<String> {
    cells(source.bytes(), line, delimiter).into_iter().map(|cell| source.text(cell).into_owned()).collect()
}

fn whole_number(source: &Source, cell: Span) -> Option<NumberField> {
    number_at(source.bytes(), cell.start).filter(|number| number.span().end == cell.end)
}

/// A list while it is read.
struct List<'a> {
    source: &'a Source,
    file: usize,
    stated: Stated,
    table: Option<Table>,
    ways: Shared<Way>,
}

/// What the header says.
struct Table {
    header: Header,
    delimiter: u8,
    /// The header's line, and whether something is missing in it.
    incomplete: bool,
}

impl List<'_> {
    fn line(&mut self, line: Span, program: &mut Program) {
        if self.source.bytes()[line.start] == b'#' {
            let comment = Span::new(line.start + 1, line.end);
            self.stated.read(self.source, self.file, comment, &mut program.diagnostics);
            return;
        }
        match self.table.take() {
            None => self.table = Some(self.header(line, program)),
            Some(table) => {
                if !table.incomplete {
                    self.row(line, &table, program);
                }
                self.table = Some(table);
            }
        }
    }

    /// Reads the header; says what it has to state.
    fn header(&self, line: Span, program: &mut Program) -> Table {
        let delimiter = delimiter(self.source.slice(line));
        let header = Header::read(&texts(self.source, line, delimiter));
        let mut missing: Vec<(&'static str, String)> = Vec::new();
        if header.position.is_none() && header.joints.is_none() {
            let message = "the first row names no columns x, y, z or j1 to j6: a target list needs a header row";
            missing.push(("header-missing", message.into()));
        } else if header.position.is_some() && header.orientation.is_none() && header.joints.is_none() {
            let message = "positions without orientation: a correction turns the tool, which this list cannot hold; \
                           add orientation columns, such as qw, qx, qy, qz";
            missing.push(("orientation-missing", message.into()));
        }
        if let Some(orientation) = &header.orientation {
            match orientation.convention.or(self.stated.orientation) {
                None => {
                    let message = format!("columns {} mean different things to different robots", orientation.names);
                    missing.push(("orientation-missing", message));
                }
                Some(convention) if convention.count() != orientation.columns.len() => {
                    let message = format!(
                        "the stated orientation has {} numbers; columns {} are {}",
                        convention.count(),
                        orientation.names,
                        orientation.columns.len()
                    );
                    missing.push(("orientation-missing", message));
                }
                Some(_) => {}
            }
        }
        for (what, columns) in self.without_unit(&header) {
            missing.push(("unit-missing", format!("{columns}: no single unit of {what} is stated")));
        }
        let incomplete = !missing.is_empty();
        for (code, message) in missing {
            let help = "state it in the columns' names (`x_mm`, `rx_deg`), or in a line above: \
                        `# falsetarget: units=mm,deg orientation=fixed-xyz`";
            program.diagnostics.push(Diagnostic::error(code, message).at(self.file, line, "").help(help));
        }
        Table { header, delimiter, incomplete }
    }

    fn without_unit(&self, header: &Header) -> Vec<(&'static str, &'static str)> {
        let convention = header.orientation.as_ref().and_then(|columns| columns.convention.or(self.stated.orientation));
        let turns: &[Column] = header.orientation.as_ref().map_or(&[], |orientation| &orientation.columns);
        let angles = convention.is_none_or(OrientationConvention::has_angles);
        let all = [
            (one_unit(header.position.iter().flatten().map(|column| self.length(*column))), ("lengths", "x, y, z")),
            (!angles || one_unit(turns.iter().map(|column| self.radians(*column))), ("angles", "the orientation")),
            (one_unit(header.joints.iter().flatten().map(|column| self.radians(*column))), ("joints", "j1 to j6")),
        ];
        all.into_iter().filter(|(known, _)| !known).map(|(_, words)| words).collect()
    }

    fn length(&self, column: Column) -> Option<LengthUnit> {
        match column.unit {
            Some(Unit::Length(unit)) => Some(unit),
            Some(Unit::Angle(_)) => None,
            None => self.stated.length,
        }
    }

    fn radians(&self, column: Column) -> Option<bool> {
        match column.unit {
            Some(Unit::Angle(radians)) => Some(radians),
            Some(Unit::Length(_)) => None,
            None => self.stated.radians,
        }
    }

    fn row(&mut self, line: Span, table: &Table, program: &mut Program) {
        let cells = cells(self.source.bytes(), line, table.delimiter);
        let header = &table.header;
        let broken = |message: String, at: Span| Diagnostic::error("broken-row", message).at(self.file, at, "");
        if cells.len() != header.width {
            let message = format!("{} cells; the header has {}", cells.len(), header.width);
            program.diagnostics.push(broken(message, line));
            return;
        }
        let value = match self.value(&cells, header) {
            Ok(value) => value,
            Err(cell) => {
                let text = self.source.text(cell);
                let message = format!("`{text}` is no number (a decimal point, not a comma, is expected)");
                program.diagnostics.push(broken(message, if cell.is_empty() { line } else { cell }));
                return;
            }
        };
        let text = |column: Option<usize>| {
            column.map(|index| self.source.text(cells[index]).into_owned()).filter(|text| !text.is_empty())
        };
        let named = |column: Option<usize>, stated: &Reference| {
            text(column).map_or_else(|| stated.clone(), |name| Reference::Named(name.into()))
        };
        let external_axes = header.external.iter().filter_map(|(name, index)| {
            Some(ExternalAxis { name: name.clone(), value: whole_number(self.source, cells[*index])?.value })
        });
        let near = match &value {
            TargetValue::Cartesian(_) => self.joints(&cells, header).ok().map(|joints| joints.numbers_rad()),
            _ => None,
        };
        let motion = text(header.motion).unwrap_or_else(|| "row".into());
        let way = Way {
            path: path(&motion),
            motion: Arc::from(motion),
            tool: named(header.tool, &self.stated.tool),
            frame: named(header.frame, &self.stated.frame),
            grip_load: Reference::Unnamed,
            computed: None,
        };
        let one = Use::new(self.file, line, self.ways.share(way));
        let near_joints_deg = near.map(|numbers| numbers.map(f64::to_degrees));
        program.targets.push(Target {
            file: self.file,
            name: text(header.name),
            span: line,
            value,
            computed: None,
            configuration: Configuration { near_joints_deg, ..Configuration::default() }.into_shared(),
            external_axes: external_axes.collect(),
            rides_along: false,
            uses: vec![one],
        });
    }

    /// The numbers of a row, or the cell that holds none.
    fn value(&self, cells: &[Span], header: &Header) -> Result<TargetValue, Span> {
        let (Some(position), Some(orientation)) = (&header.position, &header.orientation) else {
            return Ok(TargetValue::Joint(Box::new(self.joints(cells, header)?)));
        };
        let empty = position.iter().chain(&orientation.columns).all(|column| cells[column.index].is_empty());
        if empty && header.joints.is_some() {
            return Ok(TargetValue::Joint(Box::new(self.joints(cells, header)?)));
        }
        let number = |column: &Column| whole_number(self.source, cells[column.index]).ok_or(cells[column.index]);
        let convention = orientation.convention.or(self.stated.orientation).ok_or(cells[position[0].index])?;
        let [x, y, z] = position;
        let length = self.length(*x).ok_or(cells[x.index])?;
        let radians = orientation.columns.first().and_then(|column| self.radians(*column)).unwrap_or(false);
        let turned: Result<OrientationFields, Span> = orientation.columns.iter().map(number).collect();
        Ok(TargetValue::Cartesian(Box::new(CartesianNumbers {
            position: [number(x)?, number(y)?, number(z)?],
            orientation: turned?,
            convention,
            units: Units { length, radians },
        })))
    }

    fn joints(&self, cells: &[Span], header: &Header) -> Result<JointNumbers, Span> {
        let columns = header.joints.as_ref().ok_or_else(|| cells.first().copied().unwrap_or_default())?;
        let mut joints = Vec::with_capacity(columns.len());
        for column in columns {
            joints.push(whole_number(self.source, cells[column.index]).ok_or(cells[column.index])?);
        }
        let radians = self.radians(columns[0]).unwrap_or(false);
        let joints = joints.try_into().map_err(|_| cells[columns[0].index])?;
        Ok(JointNumbers { joints, units: Units { length: LengthUnit::Millimetre, radians } })
    }
}

/// True when all columns have the same unit.
fn one_unit<T: PartialEq>(mut units: impl Iterator<Item = Option<T>>) -> bool {
    let Some(first) = units.next() else { return true };
    first.is_some() && units.all(|unit| unit == first)
}

/// What the word of a motion column says.
fn path(word: &str) -> PathKind {
    match word.to_lowercase().as_str() {
        "movej" | "ptp" | "j" | "joint" | "movj" | "jmove" => PathKind::Joint,
        "movel" | "lin" | "l" | "linear" | "movl" | "lmove" => PathKind::Linear,
        _ => PathKind::Other,
    }
}
