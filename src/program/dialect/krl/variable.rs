//! Where variables are declared, what they are assigned, and what may change them.

use std::collections::{HashMap, HashSet};

use crate::base::text::Span;
use crate::program::number::number_at;
use crate::program::scan::Cursor;

use super::job::{Job, Kind, Statement};
use super::reference::{Index, Reference, reference};
use super::statement::{name, split_at_commas, trimmed};

/// Where a name is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Scope {
    /// In a routine.
    Routine(usize),
    /// In a module: a `.src` and its `.dat`.
    Module(usize),
    /// Everywhere.
    Global,
}

/// An element of a variable: scope, name and constant index.
pub(super) type Element = (Scope, String);

/// An assignment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Write {
    /// File of the job.
    pub file: usize,
    /// What is assigned.
    pub value: Span,
}

/// What is known of an element.
#[derive(Clone, Debug)]
pub(super) enum Known {
    /// It is assigned this, once and never changed.
    Once(Write),
    /// It changes while the program runs; its first value, if any is in the text.
    Changes(String, Option<Write>),
    /// Nothing is assigned in the job's files.
    Nowhere(String),
}

/// All variables of a job.
#[derive(Default)]
pub(super) struct Variables {
    declared: HashSet<Element>,
    writes: HashMap<Element, Vec<Write>>,
    elements: HashMap<Element, Vec<String>>,
    changes: HashMap<Element, String>,
}

impl Variables {
    /// Collects them.
    pub fn of(job: &Job<'_>) -> Self {
        let mut variables = Self::default();
        for (index, routine) in job.routines.iter().enumerate() {
            for (parameter, _) in &routine.parameters {
                let element = (Scope::Routine(index), parameter.clone());
                let of = routine.name.as_deref().unwrap_or_default();
                variables.changes.insert(element.clone(), format!("`{parameter}` is a parameter of `{of}`"));
                variables.declared.insert(element);
            }
            for statement in routine.statements.iter().filter(|statement| statement.kind == Kind::Declaration) {
                variables.declare(job, index, statement);
            }
        }
        for (index, routine) in job.routines.iter().enumerate() {
            for statement in &routine.statements {
                variables.write(job, index, statement);
            }
        }
        variables
    }

    /// Where a name of a routine is declared.
    pub fn scope(&self, job: &Job<'_>, routine: usize, name: &str) -> Scope {
        let module = Scope::Module(job.modules[job.routines[routine].file]);
        let declared = |scope: &Scope| self.declared.contains(&(*scope, name.to_string()));
        [Scope::Routine(routine), module].into_iter().find(declared).unwrap_or(Scope::Global)
    }

    /// What is known of an element; `spelled` is for people.
    pub fn get(&self, element: &Element, spelled: &str) -> Known {
        let (scope, name) = element;
        let base = name.split('[').next().unwrap_or(name);
        let writes = self.writes.get(element).map(Vec::as_slice).unwrap_or_default();
        let change = self.changes.get(element).or_else(|| self.changes.get(&(*scope, base.to_string())));
        match (change, writes) {
            (Some(reason), writes) => Known::Changes(reason.clone(), writes.first().copied()),
            (None, []) => Known::Nowhere(format!("no value of `{spelled}` is in the files of this job")),
            (None, [one]) => Known::Once(*one),
            (None, [first, ..]) => {
                let times = writes.len();
                Known::Changes(format!("`{spelled}` is assigned {times} times"), Some(*first))
            }
        }
    }

    /// The elements of an array that are assigned something.
    pub fn elements(&self, scope: Scope, base: &str) -> &[String] {
        self.elements.get(&(scope, base.to_string())).map(Vec::as_slice).unwrap_or_default()
    }

    /// The constant whole number that an expression is, directly or through a constant variable.
    pub fn integer(&self, job: &Job<'_>, routine: usize, file: usize, expression: Span) -> Option<i64> {
        let bytes = job.bytes(file);
        let expression = trimmed(bytes, expression);
        if let Some(field) = number_at(bytes, expression.start) {
            let whole = field.value.fract() == 0.0 && field.value.abs() < 1e6;
            return (whole && field.span() == expression).then_some(field.value as i64);
        }
        let mut cursor = Cursor::new(bytes, expression);
        let found = reference(bytes, &mut cursor)?;
        if !cursor.at_end() || found.member.is_some() {
            return None;
        }
        let element = (self.scope(job, routine, &found.base), found.element()?);
        let Known::Once(write) = self.get(&element, &found.base) else { return None };
        let field = number_at(job.bytes(write.file), write.value.start)?;
        (field.value.fract() == 0.0 && field.value.abs() < 1e6 && field.span() == write.value)
            .then_some(field.value as i64)
    }

    /// Says that something may change what a reference names.
    pub fn change(&mut self, job: &Job<'_>, routine: usize, found: &Reference, reason: String) {
        let scope = self.scope(job, routine, &found.base);
        let name = match &found.index {
            Index::Constant(index) if index != "[]" => format!("{}{index}", found.base),
            _ => found.base.clone(),
        };
        self.changes.entry((scope, name)).or_insert(reason);
    }

    /// Files the names of `DECL [GLOBAL] [CONST] TYPE a[3], b={..}`.
    fn declare(&mut self, job: &Job<'_>, routine: usize, statement: &Statement) {
        let bytes = job.bytes(statement.file);
        let (names, global) = declared_names(bytes, statement.span);
        let module = job.modules[statement.file];
        let scope = match &job.routines[routine] {
            _ if global || job.is_global[statement.file] => Scope::Global,
            own if own.name.is_some() => Scope::Routine(routine),
            _ => Scope::Module(module),
        };
        for part in names {
            let mut cursor = Cursor::new(bytes, part);
            if let Some(found) = reference(bytes, &mut cursor) {
                self.declared.insert((scope, found.base));
            }
        }
    }

    /// Files what a statement assigns.
    fn write(&mut self, job: &Job<'_>, routine: usize, statement: &Statement) {
        let bytes = job.bytes(statement.file);
        let parts = match statement.kind {
            Kind::Declaration => declared_names(bytes, statement.span).0,
            Kind::Assignment => vec![statement.span],
            _ => return,
        };
        for part in parts {
            let mut cursor = Cursor::new(bytes, part);
            let Some(found) = reference(bytes, &mut cursor) else { continue };
            cursor.skip_blanks();
            if !cursor.eat(b'=') {
                continue;
            }
            let value = trimmed(bytes, Span::new(cursor.offset(), part.end));
            let line = job.sources[statement.file].line(statement.span.start);
            let whole =
                found.element().filter(|_| found.member.is_none() && found.index != Index::Constant("[]".into()));
            let Some(element) = whole else {
                let text = job.sources[statement.file].text(found.span).into_owned();
                self.change(job, routine, &found, format!("`{text}` is set in line {line}"));
                continue;
            };
            let scope = self.scope(job, routine, &found.base);
            let writes = self.writes.entry((scope, element.clone())).or_default();
            writes.push(Write { file: statement.file, value });
            if writes.len() == 1 {
                self.elements.entry((scope, found.base)).or_default().push(element);
            }
        }
    }
}

/// The parts of a declaration behind its words and type, and whether it says `GLOBAL`.
fn declared_names(bytes: &[u8], statement: Span) -> (Vec<Span>, bool) {
    let mut cursor = Cursor::new(bytes, statement);
    let mut global = false;
    loop {
        let before = cursor;
        let word = name(&mut cursor).map(|span| bytes[span.start..span.end].to_ascii_lowercase());
        cursor.skip_blanks();
        match word.as_deref() {
            Some(b"decl" | b"const") => {}
            Some(b"global") => global = true,
            // The type, perhaps with its length: `CHAR[128]`.
            Some(_) => {
                if cursor.eat(b'[') {
                    cursor.skip_while(|byte| byte != b']');
                    cursor.eat(b']');
                    cursor.skip_blanks();
                }
                if cursor.at_end() || cursor.peek() == Some(b'=') {
                    cursor = before;
                }
                return (split_at_commas(bytes, Span::new(cursor.offset(), statement.end)), global);
            }
            None => return (Vec::new(), global),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::text::Source;

    fn known(dat: &str, src: &str, name: &str) -> String {
        let sources = [Source::new("a.src", src), Source::new("a.dat", dat)];
        let job = Job::read(&sources);
        let variables = Variables::of(&job);
        let routine = job.routine("a").expect("the routine");
        let base = name.split('[').next().unwrap_or(name);
        match variables.get(&(variables.scope(&job, routine, base), name.into()), name) {
            Known::Once(write) => sources[write.file].text(write.value).into_owned(),
            Known::Changes(reason, _) => format!("? {reason}"),
            Known::Nowhere(_) => "-".into(),
        }
    }

    #[test]
    fn values_and_what_changes_them() {
        let dat = "DEFDAT A\nDECL GLOBAL E6POS XP1={X 1}, XP2={X 2}\nDECL FRAME p[2]\np[1]={X 3}\nINT n=4\nENDDAT\n";
        let src = "DEF a(q)\nXP2.X = 5\nLIN XP1\nEND\n";
        assert_eq!(known(dat, src, "xp1"), "{X 1}");
        assert_eq!(known(dat, src, "xp2"), "? `XP2.X` is set in line 2");
        assert_eq!(known(dat, src, "p[1]"), "{X 3}");
        assert_eq!(known(dat, src, "p[2]"), "-");
        assert_eq!(known(dat, src, "q"), "? `q` is a parameter of `a`");
        assert_eq!(known(dat, "DEF a()\np[i]={X 1}\nEND\n", "p[1]"), "? `p[i]` is set in line 2");
        assert_eq!(known(dat, "DEF a()\nXP1={X 9}\nEND\n", "xp1"), "? `xp1` is assigned 2 times");
        assert_eq!(known(dat, "DEF a()\nDECL E6POS XP1\nXP1={X 9}\nEND\n", "xp1"), "{X 9}");
    }
}
