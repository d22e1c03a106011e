//! Named positions and the moves that go to them.

use std::collections::HashMap;

use crate::base::text::Span;
use crate::program::shared::Shared;
use crate::program::target::{Configuration, ExternalAxis, Program, Target, TargetValue, Use, Way};

/// A position as the text has it.
#[derive(Clone, Debug)]
pub(in super::super) struct Position {
    /// The whole of it.
    pub span: Span,
    /// Its numbers, or why it has none.
    pub value: Result<TargetValue, String>,
    /// Configuration data.
    pub configuration: Configuration,
    /// Additional axes.
    pub external_axes: Vec<ExternalAxis>,
}

impl Position {
    /// A position without configuration data or additional axes.
    pub fn plain(span: Span, value: Result<TargetValue, String>) -> Self {
        Self { span, value, configuration: Configuration::default(), external_axes: Vec::new() }
    }
}

/// What is known about a name.
#[derive(Debug, Default)]
struct Named {
    given: Option<(Position, usize)>,
    /// Why the text does not say its value, if so.
    changed: Option<String>,
    uses: Vec<Use>,
    /// The first place that names it.
    mention: Option<Span>,
    shown: String,
}

/// The positions of a file while it is read. Names are told apart by a key of the language's choice.
#[derive(Debug)]
pub(in super::super) struct Positions {
    file: usize,
    names: Vec<Named>,
    by_key: HashMap<String, usize>,
    inline: Vec<Target>,
    ways: Shared<Way>,
}

impl Positions {
    /// For a file of the job.
    pub fn new(file: usize) -> Self {
        Self { file, names: Vec::new(), by_key: HashMap::new(), inline: Vec::new(), ways: Shared::default() }
    }

    fn named(&mut self, key: &str, shown: &str) -> &mut Named {
        let index = *self.by_key.entry(key.to_owned()).or_insert_with(|| {
            self.names.push(Named { shown: shown.to_owned(), ..Named::default() });
            self.names.len() - 1
        });
        &mut self.names[index]
    }

    /// A statement gives the name a value, in a line. A second one makes it known only at run time.
    pub fn define(&mut self, key: &str, shown: &str, position: Position, line: usize) {
        let named = self.named(key, shown);
        match &named.given {
            Some((_, first)) => {
                let reason = format!("`{shown}` is set more than once, in lines {first} and {line}");
                named.changed.get_or_insert(reason);
            }
            None => named.given = Some((position, line)),
        }
    }

    /// Something changes the value.
    pub fn change(&mut self, key: &str, shown: &str, reason: impl Into<String>) {
        self.named(key, shown).changed.get_or_insert_with(|| reason.into());
    }

    /// True when the name is given a value somewhere.
    pub fn knows(&self, key: &str) -> bool {
        self.by_key
            .get(key)
            .is_some_and(|&index| self.names[index].given.is_some() || self.names[index].changed.is_some())
    }

    /// The value of a name that gets one and keeps it.
    ///
    /// # Errors
    /// Why the text does not say its value.
    pub fn value(&self, key: &str, shown: &str) -> Result<&Position, String> {
        let named = self.by_key.get(key).map(|&index| &self.names[index]);
        match named.map(|named| (&named.changed, &named.given)) {
            Some((Some(reason), _)) => Err(reason.clone()),
            Some((None, Some((position, _)))) => Ok(position),
            _ => Err(format!("`{shown}` gets no value in this file")),
        }
    }

    /// A move to a name.
    pub fn go(&mut self, key: &str, shown: &str, mention: Span, one: Use) {
        let one = one.sharing(&mut self.ways);
        let named = self.named(key, shown);
        named.mention.get_or_insert(mention);
        named.uses.push(one);
    }

    /// The same for a solution that the move asks for, where the position itself says nothing.
    pub fn ask(&mut self, key: &str, configuration: &Configuration) {
        let Some(&index) = self.by_key.get(key) else { return };
        if let Some((position, _)) = &mut self.names[index].given
            && position.configuration == Configuration::default()
        {
            position.configuration = configuration.clone();
        }
    }

    /// A move to a position that is written in it, or to nothing that is known.
    pub fn go_inline(&mut self, position: Position, one: Use) {
        let one = one.sharing(&mut self.ways);
        let target = self.target(None, position, None, vec![one]);
        self.inline.push(target);
    }

    fn target(&self, name: Option<String>, position: Position, changed: Option<String>, uses: Vec<Use>) -> Target {
        let (value, reason) = match position.value {
            Ok(value) => (value, None),
            Err(reason) => (TargetValue::Unwritten, Some(reason)),
        };
        Target {
            file: self.file,
            name,
            span: position.span,
            value,
            computed: changed.or(reason),
            configuration: position.configuration.into_shared(),
            external_axes: position.external_axes,
            rides_along: false,
            uses,
        }
    }

    /// Adds the targets that moves go to, in the order of the text.
    pub fn finish(mut self, program: &mut Program) {
        for named in std::mem::take(&mut self.names) {
            if named.uses.is_empty() {
                continue;
            }
            let shown = named.shown;
            let (position, changed) = match named.given {
                Some((position, _)) => (position, named.changed),
                None => {
                    let reason = named.changed.unwrap_or_else(|| format!("`{shown}` gets no value in this file"));
                    (Position::plain(named.mention.unwrap_or_default(), Err(reason)), None)
                }
            };
            let target = self.target(Some(shown), position, changed, named.uses);
            self.inline.push(target);
        }
        self.inline.sort_by_key(|target| target.span);
        program.targets.append(&mut self.inline);
    }
}
