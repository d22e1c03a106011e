//! Blocks into targets.

use std::sync::Arc;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::dialect::stated::Stated;
use crate::program::selection::{InForce, Selections};
use crate::program::shared::Shared;
use crate::program::target::{Configuration, Definition, PathKind, Program, Reference, Target, TargetValue, Use, Way};

use super::block::{Block, block};
use super::modal::{Modal, Motion};

/// The words of a position.
pub(super) const POSITION: [&str; 3] = ["X", "Y", "Z"];
/// The sets of orientation words.
const TURNS: [[&str; 3]; 3] = [["A3", "B3", "C3"], ["A2", "B2", "C2"], ["A", "B", "C"]];
/// Keywords behind which it is not known where the axes are.
const JUMPS: [&str; 15] = [
    "GOTO", "GOTOF", "GOTOB", "GOTOC", "IF", "ELSE", "ENDIF", "WHILE", "ENDWHILE", "FOR", "ENDFOR", "LOOP", "ENDLOOP",
    "REPEAT", "CALL",
];

/// Reads the files; each has its own modes.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    for (file, source) in sources.iter().enumerate() {
        Reader::new(source, file).read(&mut program);
    }
    program
}

/// A file while it is read.
pub(super) struct Reader<'a> {
    /// The file.
    pub source: &'a Source,
    file: usize,
    /// What it says about itself.
    pub stated: Stated,
    /// What holds from block to block.
    pub modal: Modal,
    /// The orientation words that this file uses.
    pub turns: Option<[&'static str; 3]>,
    tools: Selections,
    frames: Selections,
    joins: Vec<usize>,
    pending_tool: Option<Reference>,
    /// Tools are changed by `M6`, not by `T`.
    changes_by_m6: bool,
    /// Blocks can be jumped to.
    jumps: bool,
    arcs: Vec<Span>,
    ways: Shared<Way>,
    /// Coordinates without a decimal point.
    pub without_point: usize,
}

impl<'a> Reader<'a> {
    /// Looks through the blocks once for what decides how all of them are read; they are not kept, programs are long.
    fn new(source: &'a Source, file: usize) -> Self {
        let (mut used, mut changes_by_m6, mut jumps) = ([false; TURNS.len()], false, false);
        for line in source.lines() {
            let block = block(source.bytes(), line);
            for (used, words) in used.iter_mut().zip(&TURNS) {
                *used |= words.iter().any(|word| block.word(word).is_some());
            }
            changes_by_m6 |= block.numbers("M").any(|code| code == 6.0);
            jumps |= block.keywords.iter().any(|word| word.starts_with("GOTO"));
        }
        Self {
            source,
            file,
            stated: Stated::default(),
            modal: Modal::default(),
            turns: TURNS.into_iter().zip(used).find(|(_, used)| *used).map(|(words, _)| words),
            tools: Selections::default(),
            frames: Selections::default(),
            joins: Vec::new(),
            pending_tool: None,
            changes_by_m6,
            jumps,
            arcs: Vec::new(),
            ways: Shared::default(),
            without_point: 0,
        }
    }

    fn read(mut self, program: &mut Program) {
        let first = program.targets.len();
        for line in self.source.lines() {
            let block = block(self.source.bytes(), line);
            for comment in &block.comments {
                let stated = self.stated.read(self.source, self.file, *comment, &mut program.diagnostics);
                if stated {
                    self.tools.push(comment.start, self.stated.tool.clone());
                    self.frames.push(comment.start, self.stated.frame.clone());
                }
            }
            if !block.words.is_empty() || !block.keywords.is_empty() {
                self.block(&block, program);
            }
        }
        if let Some(target) = program.targets.get(first) {
            self.missing(target.span, program);
        }
        if let Some(arc) = self.arcs.first() {
            let message =
                format!("{} arcs about a centre: corrected ends would not lie on the circle", self.arcs.len());
            let finding = Diagnostic::error("arc-by-centre", message).at(self.file, *arc, "the first");
            program.diagnostics.push(finding.help("let the CAM system write arcs as short lines"));
        }
        if self.without_point > 0 {
            let message = format!(
                "{} coordinates without a decimal point are read as whole units; some controls take them for increments",
                self.without_point
            );
            program.diagnostics.push(Diagnostic::note("no-point", message));
        }
    }

    /// What has to be stated and is not.
    fn missing(&self, place: Span, program: &mut Program) {
        let mut say = |code, message: &str| {
            let help = "state it in a comment before the first move: \
                        `(falsetarget: units=mm,deg orientation=euler-zyx)`";
            program.diagnostics.push(Diagnostic::error(code, message).at(self.file, place, "").help(help));
        };
        let tool_axis = self.stated.orientation.is_some_and(|convention| convention.spin_rule().is_some());
        match (self.turns, self.stated.orientation) {
            (None, _) => {
                say("orientation-missing", "no block says how the tool is turned: no A, B, C, no A3=, B3=, C3=")
            }
            (Some(_), None) => {
                say("orientation-missing", "what the orientation words mean stands nowhere in the program")
            }
            (Some(words), Some(_)) if tool_axis != (words[0] == "A3") => {
                say("orientation-missing", "a tool axis is written as A3=, B3=, C3=, angles are not");
            }
            (Some(_), Some(convention)) if convention.is_quaternion() => {
                say("orientation-missing", "three orientation words are no quaternion");
            }
            _ => {}
        }
        if self.modal.inches.is_none() && self.stated.length.is_none() {
            say("unit-missing", "the unit of lengths stands nowhere: no G20, G21, G70 or G71");
        }
    }

    fn block(&mut self, block: &Block, program: &mut Program) {
        let line = self.source.line(block.span.start);
        self.modal.take(block, line);
        self.defined(block, line, program);
        let called =
            block.numbers("M").any(|code| matches!(code, 97.0 | 98.0)) || block.numbers("G").any(|code| code == 65.0);
        let jumped_to = self.jumps && block.word("N").is_some();
        let jumping = block.keywords.iter().any(|word| JUMPS.contains(&word.as_str()));
        if called || jumped_to || jumping {
            self.modal.forget();
            self.joins.push(block.span.start);
        }
        self.select(block);
        let code = |wanted: &[f64]| block.numbers("G").any(|code| wanted.contains(&code));
        // Dwell, offsets by program, reference points: their axis words are no goal.
        if code(&[4.0, 10.0, 51.0, 51.1, 52.0, 68.0, 68.2, 74.0, 92.0]) || self.is_shift(block) {
            return;
        }
        if code(&[28.0, 30.0]) {
            return self.modal.forget();
        }
        let axes = POSITION.iter().chain(self.turns.iter().flatten());
        let has_axis = axes.clone().any(|address| block.word(address).is_some());
        let Some(motion) = self.modal.motion.filter(|_| has_axis) else { return };
        let own_frame = code(&[53.0, 153.0]);
        self.target(block, motion, own_frame, program);
    }

    /// `$P_UIFR[1]=..` sets G54, `$TC_DP3[1,1]=..` the tool T1: their values are computed.
    fn defined(&self, block: &Block, line: usize, program: &mut Program) {
        if !block.opaque {
            return;
        }
        let text = self.source.text(block.span).to_ascii_uppercase();
        let number = |mark: &str| -> Option<u32> {
            let rest = text.split_once(mark)?.1.split_once('[')?.1;
            rest.chars().take_while(char::is_ascii_digit).collect::<String>().parse().ok()
        };
        let (file, span) = (self.file, block.span);
        if let Some(index) = number("P_UIFR") {
            let name =
                if index <= 4 { format!("g{}", 53 + u64::from(index)) } else { format!("g{}", 500 + u64::from(index)) };
            let value = Err(format!("it is set in line {line}"));
            program.frames.insert(name, Definition { file, span, value });
        }
        if let Some(tool) = number("TC_DP") {
            let value = Err(format!("it is set in line {line}"));
            program.tools.insert(format!("t{tool}"), Definition { file, span, value });
        }
    }

    fn is_shift(&self, block: &Block) -> bool {
        block.keywords.iter().any(|word| {
            word.contains("TRANS") || word.contains("ROT") || word.contains("SCALE") || word.contains("MIRROR")
        })
    }

    /// Tools and frames.
    fn select(&mut self, block: &Block) {
        let at = block.span.start;
        for word in block.words.iter().filter(|word| matches!(word.address.as_str(), "T" | "G" | "M")) {
            let value = word.value.as_ref().map(|field| field.value);
            match (word.address.as_str(), value) {
                ("T", value) => {
                    let tool = match value {
                        Some(number) => Reference::Named(format!("T{number}").into()),
                        None => Reference::Runtime("the tool's number is a parameter".into()),
                    };
                    if self.changes_by_m6 {
                        self.pending_tool = Some(tool);
                    } else {
                        self.tools.push(at, tool);
                    }
                }
                ("G", Some(number)) if (54.0..60.0).contains(&number) || (505.0..600.0).contains(&number) => {
                    let page = block.numbers("P").next().filter(|_| number == 54.1);
                    let name = page.map_or(format!("G{number}"), |page| format!("G54.1 P{page}"));
                    self.frames.push(at, Reference::Named(name.into()));
                }
                ("G", Some(500.0)) => self.frames.push(at, Reference::Unnamed),
                _ => {}
            }
        }
        if block.numbers("M").any(|code| code == 6.0) {
            let unknown = || Reference::Runtime("a tool is changed, which one stands nowhere".into());
            self.tools.push(at, self.pending_tool.take().unwrap_or_else(unknown));
        }
    }

    fn target(&mut self, block: &Block, motion: Motion, own_frame: bool, program: &mut Program) {
        if motion == Motion::Arc {
            self.arcs.push(block.span);
        }
        let shifted = self.modal.computed();
        let in_machine = own_frame.then(|| "in the machine's own coordinates (G53)".to_owned());
        let arc = (motion == Motion::Arc).then(|| "an arc about a centre".to_owned());
        let path = match motion {
            Motion::Rapid => PathKind::Joint,
            Motion::Line => PathKind::Linear,
            Motion::Arc | Motion::Cycle => PathKind::Other,
        };
        let fields = self.fields(block);
        let goes_elsewhere = shifted.or(in_machine).or(arc);
        if goes_elsewhere.is_some() {
            // Where the words do not say where the tool goes, they do not say where it is afterwards.
            POSITION.iter().chain(self.turns.iter().flatten()).for_each(|address| {
                self.modal.axes.remove(*address);
            });
        }
        // Without numbers: nothing may be written into such a block.
        let (value, computed) = match (fields, goes_elsewhere) {
            (Ok(numbers), None) => (TargetValue::Cartesian(Box::new(numbers)), None),
            (_, Some(reason)) | (Err(reason), None) => (TargetValue::Unwritten, Some(reason)),
        };
        let way = Way {
            motion: Arc::from(match motion {
                Motion::Rapid => "G0",
                Motion::Line => "G1",
                Motion::Arc => "G2",
                Motion::Cycle => "G81",
            }),
            path,
            tool: self.in_force(&self.tools, block, &self.stated.tool, "tools"),
            frame: self.in_force(&self.frames, block, &self.stated.frame, "frames"),
            grip_load: Reference::Unnamed,
            computed: None,
        };
        let one = Use::new(self.file, block.span, self.ways.share(way));
        program.targets.push(Target {
            file: self.file,
            name: None,
            span: block.span,
            value,
            computed,
            configuration: Configuration::unsaid(),
            external_axes: Vec::new(),
            rides_along: false,
            uses: vec![one],
        });
    }

    fn in_force(&self, selections: &Selections, block: &Block, otherwise: &Reference, what: &str) -> Reference {
        // A word in this block holds for its own move.
        match selections.at(block.span.start + 1, &self.joins) {
            InForce::Nothing => otherwise.clone(),
            InForce::Known(selected) => selected.clone(),
            InForce::Open => Reference::Runtime(format!("several {what} are selected; which holds depends on the way")),
        }
    }
}
