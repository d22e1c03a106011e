//! The files of a job: moves become uses of poses, joint lists and displacements.

use std::sync::Arc;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::target::{Program, Reference, Use, Way};

use super::expression::File;
use super::motion::motion;
use super::statement::statements;
use super::targets::{Found, collect};
use super::token::{Text, tokens};
use super::tool::Tools;
use super::variable::Variables;

/// Reads the files; each sees its own variables only.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    for (file, source) in sources.iter().enumerate() {
        let tokens = tokens(source);
        let text = Text { source, tokens: &tokens };
        let code = statements(text);
        let variables = Variables::of(text, &code);
        if code.unclosed {
            let span = code.statements.last().map(|last| text.span(&last.tokens)).unwrap_or_default();
            let message = "a bracket is not closed: nothing behind it can be read";
            program.diagnostics.push(Diagnostic::error("truncated", message).at(file, span, ""));
        } else if code.open > 0 {
            let end = Span::new(source.bytes().len(), source.bytes().len());
            let message = format!("{} block(s) have no `end`: the program may have been cut off", code.open);
            program.diagnostics.push(Diagnostic::warning("missing-end", message).at(file, end, "the text stops here"));
        }
        File { file, text, code: &code, variables: &variables }.read(&mut program);
    }
    program
}

impl File<'_> {
    fn read(self, program: &mut Program) {
        let tools = Tools::of(self.text, self.code, |range, at| self.constant(range, at, 0).map(|(pose, _)| pose));
        if let Some(place) = tools.incomplete_payload {
            let message = "a payload without a centre of gravity is not used";
            let finding = Diagnostic::note("incomplete-payload", message).at(self.file, place, "");
            program.diagnostics.push(finding.help("without a payload the one of the model holds"));
        }
        let found = self.moves(&tools, program);
        collect(self, &found, program);
    }

    fn moves(self, tools: &Tools, program: &mut Program) -> Vec<Found> {
        let mut found = Vec::new();
        let mut guided: Option<String> = None;
        for (index, statement) in self.code.statements.iter().enumerate() {
            let tokens = &statement.tokens;
            for at in self.text.calls(tokens) {
                let word = self.text.word(at);
                let line = || self.text.source.line(self.text.tokens[at].span.start);
                match word {
                    b"force_mode" => guided = Some(format!("guided by force since line {}", line())),
                    b"track_conveyor_linear" | b"track_conveyor_circular" | b"path_offset_enable" => {
                        guided = Some(format!("displaced by `{}` in line {}", String::from_utf8_lossy(word), line()));
                    }
                    b"end_force_mode" | b"stop_conveyor_tracking" | b"path_offset_disable" => guided = None,
                    _ => {}
                }
                let defines = at > tokens.start && self.text.word(at - 1) == b"def";
                let Some(motion) = motion(self.text, at, tokens.end).filter(|_| !defines) else { continue };
                let (tool, grip_load) = tools.at(self.text.tokens[at].span.start, self.file, program);
                for (range, path) in motion.goals {
                    let (goal, near_joints_deg, own_tool) = self.goal(&range, index);
                    let tool = own_tool.unwrap_or_else(|| tool.clone());
                    let one = Use::new(
                        self.file,
                        self.text.span(tokens),
                        Way {
                            motion: Arc::from(String::from_utf8_lossy(word).as_ref()),
                            path,
                            tool,
                            frame: Reference::Unnamed,
                            grip_load: grip_load.clone(),
                            computed: guided.clone(),
                        },
                    );
                    found.push(Found { goal, near_joints_deg, place: self.text.span(&range), one });
                }
            }
        }
        found
    }
}
