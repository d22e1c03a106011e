//! Reading a recording, each complaint with line and column.

use nalgebra::Vector3;
use sha2::{Digest, Sha256};

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::base::units::{m_from_mm, rad_from_deg};
use crate::files::error::FileError;
use crate::geometry::orientation::OrientationConvention;
use crate::measure::observation::{Measured, Observation, SetName};
use crate::measure::recording::{ApproachSource, Kind, Recording, infer_approach, infer_time};
use crate::model::conditions::Conditions;
use crate::model::robot::{DOF, Mass, Robot};

use super::columns::{Columns, Header};

/// Joint numbers beyond this are no joint numbers, deg: 27 turns.
const LARGEST_JOINT_DEG: f64 = 1e4;
/// Positions beyond this are out of any tracker's reach, mm.
const LARGEST_POSITION_MM: f64 = 1e7;
/// Records that a file may have: enough for a day at 100 Hz.
const MOST_RECORDS: usize = 10_000_000;

/// Reads a recording of this robot, whose payload centre serves records that state only a mass.
///
/// # Errors
/// [`FileError`] with the place: no header, missing columns, a row of another length, a cell that is not a finite
/// number or not a word that belongs there, no record at all.
pub fn read(source: &Source, robot: &Robot) -> Result<Recording, FileError> {
    let separator = separator(source);
    let mut rows =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).delimiter(separator).from_reader(source.bytes());
    let mut raw = csv::ByteRecord::new();
    let mut next = |raw: &mut csv::ByteRecord| rows.read_byte_record(raw).unwrap_or(false);
    if !next(&mut raw) {
        let empty = Diagnostic::error("empty-file", "the file is empty; expected a recording: CSV with a header row");
        return Err(FileError::new(source, empty.at(0, Span::new(0, 0), "")));
    }
    let row = Row::new(source, &raw, separator);
    let names = raw.iter().map(|field| String::from_utf8_lossy(field).trim().trim_matches('\u{feff}').into());
    let header = Header { source, names: names.collect(), span: row.whole() };
    let columns = header.columns()?;
    let mut observations = Vec::new();
    while next(&mut raw) {
        let row = Row::new(source, &raw, separator);
        if raw.iter().all(|field| field.trim_ascii().is_empty()) {
            continue;
        }
        if raw.len() != header.names.len() {
            let message = format!("the row has {} cells; the header has {}", raw.len(), header.names.len());
            return Err(row.complain(row.whole(), "ragged-row", message));
        }
        if observations.len() == MOST_RECORDS {
            return Err(row.complain(row.whole(), "file-size", format!("more than {MOST_RECORDS} records")));
        }
        let number = observations.len() + 1;
        observations.push(row.observation(&header, &columns, robot, number)?);
    }
    if observations.is_empty() {
        return Err(header.complain("the recording has a header but no record".into()));
    }
    let mut approach = ApproachSource::Recorded;
    if columns.approach.is_none() {
        approach = ApproachSource::Inferred;
        infer_approach(&mut observations);
    }
    if columns.time.is_none() {
        infer_time(&mut observations);
    }
    let kind = if columns.speed.is_some() { Kind::Continuous } else { Kind::Static };
    let sha256 = Sha256::digest(source.bytes()).iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(Recording { name: source.name().to_string(), sha256, kind, approach, observations })
}

/// The character between cells, by what the first line holds.
fn separator(source: &Source) -> u8 {
    let first = source.lines().next().map_or(&[][..], |line| source.slice(line));
    [b',', b';', b'\t'].into_iter().find(|separator| first.contains(separator)).unwrap_or(b',')
}

/// A row and where it stands in the file.
struct Row<'a> {
    source: &'a Source,
    cells: &'a csv::ByteRecord,
    start: usize,
    separator: u8,
}

impl<'a> Row<'a> {
    fn new(source: &'a Source, cells: &'a csv::ByteRecord, separator: u8) -> Self {
        let bytes = source.bytes();
        let mut start = cells.position().map_or(0, |position| position.byte() as usize).min(bytes.len());
        // The reader counts blank lines to the row that follows them.
        while bytes.get(start).is_some_and(|byte| matches!(byte, b'\r' | b'\n')) {
            start += 1;
        }
        Self { source, cells, start, separator }
    }

    fn whole(&self) -> Span {
        let rest = &self.source.bytes()[self.start..];
        let length = rest.iter().position(|byte| matches!(byte, b'\r' | b'\n')).unwrap_or(rest.len());
        Span::new(self.start, self.start + length)
    }

    /// Where a cell stands; the whole row where quotation marks make the counting unsure.
    fn span(&self, column: usize) -> Span {
        let whole = self.whole();
        let text = self.source.slice(whole);
        if text.contains(&b'"') {
            return whole;
        }
        let before: usize = text.split(|&byte| byte == self.separator).take(column).map(|cell| cell.len() + 1).sum();
        let length = self.cells.get(column).map_or(0, <[u8]>::len);
        Span::new(whole.start + before, whole.start + before + length)
    }

    fn complain(&self, span: Span, code: &'static str, message: String) -> FileError {
        FileError::new(self.source, Diagnostic::error(code, message).at(0, span, ""))
    }

    fn cell(&self, column: usize) -> std::borrow::Cow<'_, str> {
        String::from_utf8_lossy(self.cells.get(column).unwrap_or_default().trim_ascii())
    }

    fn word(&self, column: Option<usize>) -> Option<String> {
        column.map(|column| self.cell(column).into_owned()).filter(|word| !word.is_empty())
    }

    /// A finite number of at most `largest` in size, or `None` for an empty cell.
    fn number(&self, header: &Header<'_>, column: usize, largest: f64) -> Result<Option<f64>, FileError> {
        let text = self.cell(column);
        if text.is_empty() {
            return Ok(None);
        }
        let name = &header.names[column];
        let wrong = |message: String| Err(self.complain(self.span(column), "number", message));
        match text.parse::<f64>() {
            Ok(number) if !number.is_finite() => {
                wrong(format!("`{name}` is `{text}`; expected a finite number, or nothing where nothing was measured"))
            }
            Ok(number) if number.abs() > largest => {
                wrong(format!("`{name}` is {number}; a value beyond {largest} has another unit or is no measurement"))
            }
            Ok(number) => Ok(Some(number)),
            Err(_) if text.contains(',') => wrong(format!("`{name}` is `{text}`; write decimals with a point")),
            Err(_) => wrong(format!("`{name}` is `{text}`; expected a number")),
        }
    }

    fn optional(&self, header: &Header<'_>, column: Option<usize>, largest: f64) -> Result<Option<f64>, FileError> {
        column.map_or(Ok(None), |column| self.number(header, column, largest))
    }

    /// A positive number.
    fn positive(&self, header: &Header<'_>, column: Option<usize>) -> Result<Option<f64>, FileError> {
        match (self.optional(header, column, 1e6)?, column) {
            (Some(number), Some(column)) if number <= 0.0 => {
                let message = format!("`{}` is {number}; expected a positive number", header.names[column]);
                Err(self.complain(self.span(column), "number", message))
            }
            (number, _) => Ok(number),
        }
    }

    /// Numbers that belong together: all there, or `None` where all cells are empty.
    fn numbers<const N: usize>(
        &self,
        header: &Header<'_>,
        columns: Option<[usize; N]>,
        largest: f64,
    ) -> Result<Option<[f64; N]>, FileError> {
        let Some(columns) = columns else { return Ok(None) };
        if columns.iter().all(|&column| self.cell(column).is_empty()) {
            return Ok(None);
        }
        let mut numbers = [0.0; N];
        for (number, column) in numbers.iter_mut().zip(columns) {
            *number = self.number(header, column, largest)?.ok_or_else(|| {
                let message = format!("`{}` is empty; expected a number as in its neighbours", header.names[column]);
                self.complain(self.span(column), "number", message)
            })?;
        }
        Ok(Some(numbers))
    }

    fn observation(
        &self,
        header: &Header<'_>,
        columns: &Columns,
        robot: &Robot,
        number: usize,
    ) -> Result<Observation, FileError> {
        let joints = self.numbers(header, Some(columns.joints), LARGEST_JOINT_DEG)?.ok_or_else(|| {
            let message = "the row has no joint positions".to_string();
            self.complain(self.whole(), "number", message)
        })?;
        let payload_kg = self.optional(header, columns.payload, 1e5)?;
        if let (Some(mass), Some(column)) = (payload_kg, columns.payload)
            && mass < 0.0
        {
            return Err(self.complain(self.span(column), "number", format!("a payload of {mass} kg")));
        }
        let deg = |numbers: [f64; DOF]| numbers.map(rad_from_deg);
        let conditions = Conditions {
            approach: self.approach(header, columns)?,
            speed_rad_s: self.numbers(header, columns.speed, LARGEST_JOINT_DEG)?.map(deg),
            acceleration_rad_s2: self.numbers(header, columns.acceleration, 1e6)?.map(deg),
            time_s: self.optional(header, columns.time, f64::MAX)?,
            temperature_c: self.optional(header, columns.temperature, 1e3)?,
            payload: payload_kg.map(|mass_kg| Mass { mass_kg, ..robot.payload }),
        };
        let position = self.numbers(header, columns.position, LARGEST_POSITION_MM)?;
        let angles = self.numbers(header, columns.rotation, LARGEST_JOINT_DEG)?;
        let measured = position.map(|position_mm| Measured {
            position_m: Vector3::from(position_mm.map(m_from_mm)),
            rotation: angles.and_then(|angles| OrientationConvention::FixedXyz.rotation(&angles.map(rad_from_deg))),
        });
        Ok(Observation {
            id: self.word(columns.id).unwrap_or_else(|| number.to_string()),
            station: self.word(columns.station),
            numbers_rad: deg(joints),
            conditions,
            measured,
            sigma_m: self.positive(header, columns.sigma)?.map(m_from_mm),
            sigma_rad: self.positive(header, columns.sigma_rotation)?.map(rad_from_deg),
            set: self.set(columns)?,
            line: self.source.line(self.start),
        })
    }

    fn approach(&self, header: &Header<'_>, columns: &Columns) -> Result<[f64; DOF], FileError> {
        let senses = self.numbers(header, columns.approach, f64::MAX)?.unwrap_or([0.0; DOF]);
        for (joint, sense) in senses.iter().enumerate() {
            if let (Some(columns), false) = (columns.approach, [-1.0, 0.0, 1.0].contains(sense)) {
                let message = format!("`dir{}` is {sense}; expected -1, 0 or 1", joint + 1);
                return Err(self.complain(self.span(columns[joint]), "word", message));
            }
        }
        Ok(senses)
    }

    fn set(&self, columns: &Columns) -> Result<Option<SetName>, FileError> {
        let (Some(word), Some(column)) = (self.word(columns.set), columns.set) else {
            return Ok(None);
        };
        let found = SetName::ALL.iter().find(|(known, _)| *known == word);
        match found {
            Some((_, set)) => Ok(Some(*set)),
            None => {
                let message = format!("`set` is `{word}`; expected identify, train, validate or nothing");
                Err(self.complain(self.span(column), "word", message))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::builtin;

    const HEADER: &str = "id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm";

    fn robot() -> Robot {
        builtin::by_name("hh800-class").expect("built in").expect("sound")
    }

    fn read_text(text: &str) -> Result<Recording, FileError> {
        read(&Source::new("rec.csv", text), &robot())
    }

    fn refused(text: &str) -> (String, usize, usize) {
        let error = read_text(text).expect_err(text);
        let place = error.diagnostic.place.expect("a place");
        let at = error.source_text.line_column(place.span.start);
        (error.diagnostic.message, at.line, at.column)
    }

    #[test]
    fn units_sets_and_payload_arrive() {
        let text = "z_mm,y_mm,x_mm,q6_deg,q5_deg,q4_deg,q3_deg,q2_deg,q1_deg,set,payload_kg,extra,station\r\n\
                    3,2,1,60,50,40,30,20,180,train,12,whatever,W1\r\n";
        let recording = read_text(text).expect("readable");
        let record = &recording.observations[0];
        assert_eq!(record.numbers_rad[0], std::f64::consts::PI);
        assert_eq!(record.measured.expect("a position").position_m, Vector3::new(0.001, 0.002, 0.003));
        assert_eq!(record.set, Some(SetName::Train));
        assert_eq!(record.station.as_deref(), Some("W1"));
        let payload = record.conditions.payload.expect("a payload");
        assert_eq!(payload.mass_kg, 12.0);
        assert_eq!(payload.center_of_mass_m, robot().payload.center_of_mass_m);
        assert_eq!((record.id.as_str(), record.line), ("1", 2));
        assert_eq!(recording.approach, ApproachSource::Inferred);
    }

    #[test]
    fn a_pose_without_measurement_is_kept() {
        let text = format!("{HEADER}\n7,1,2,3,4,5,6,,,\n");
        let recording = read_text(&text).expect("readable");
        assert_eq!(recording.observations[0].measured, None);
        assert_eq!(recording.observations[0].id, "7");
    }

    #[test]
    fn what_is_wrong_is_told_with_line_and_column() {
        let (message, line, column) = refused(&format!("{HEADER}\n1,1,2,3,4,5,6,7,8,9\n2,1,2,3,4,5,6,7,NaN,9\n"));
        assert!(message.contains("`y_mm`") && message.contains("finite"), "{message}");
        assert_eq!((line, column), (3, 17));
        let (message, line, _) = refused(&format!("{HEADER}\n1,1,2,3,4,5,6,7,8\n"));
        assert!(message.contains("9 cells") && message.contains("10"), "{message}");
        assert_eq!(line, 2);
        let (message, ..) = refused("q1_deg,q2_deg,q4_deg,q5_deg,q6_deg\n1,2,3,4,5\n");
        assert!(message.contains("`q3_deg`"), "{message}");
        let (message, ..) = refused("a,b\n1,2\n");
        assert!(message.contains("`q1_deg`"), "{message}");
        let (message, ..) = refused(&format!("{HEADER}\n"));
        assert!(message.contains("no record"), "{message}");
        let (message, _, column) = refused(&format!("{HEADER}\n1,1,x,3,4,5,6,7,8,9\n"));
        assert!(message.contains("`q2_deg`"), "{message}");
        assert_eq!(column, 5);
        let (message, ..) = refused(&format!("{HEADER}\n1,1,2,3,4,5,6,7,,9\n"));
        assert!(message.contains("`y_mm` is empty"), "{message}");
        let (message, ..) = refused(&format!("{HEADER},set\n1,1,2,3,4,5,6,7,8,9,test\n"));
        assert!(message.contains("identify, train, validate"), "{message}");
    }

    #[test]
    fn semicolons_serve_too_and_decimal_commas_are_named() {
        let text = format!("{HEADER}\n1,1,2,3,4,5,6,7,8,9\n").replace(',', ";");
        assert_eq!(read_text(&text).expect("readable").observations.len(), 1);
        let (message, ..) = refused(&format!("{}\n1;1,5;2;3;4;5;6;7;8;9\n", HEADER.replace(',', ";")));
        assert!(message.contains("with a point"), "{message}");
    }

    proptest::proptest! {
        #[test]
        fn no_bytes_make_it_panic(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..200)) {
            let mut text = format!("{HEADER}\n").into_bytes();
            text.extend(&bytes);
            let _ = read(&Source::new("r", text), &robot());
            let _ = read(&Source::new("r", bytes), &robot());
        }
    }
}
