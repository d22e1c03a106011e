//! Which variables a job changes while it runs, so that their declaration is not what the arm goes to.

use std::collections::HashMap;
use std::ops::Range;

use super::motion::{motion_name, stands_still};
use super::position::is_position_type;
use super::statement::{FileText, Statement, StatementKind};
use super::symbol::{Job, Lookup, Scope, Storage};
use super::token::TokenKind;

/// Functions and instructions of ABB's that take positions, tools or frames without changing them.
const READERS: &[&str] = &[
    "offs",
    "reltool",
    "calcjointt",
    "calcrobt",
    "distance",
    "mirpos",
    "orobt",
    "valtostr",
    "dim",
    "ispers",
    "isvar",
    "type",
    "defdframe",
    "defframe",
    "defaccframe",
    "posemult",
    "posevect",
    "poseinv",
    "eulerzyx",
    "orientzyx",
    "vectmagn",
    "dotprod",
    "crobt",
    "cjointt",
    "cpos",
    "ctool",
    "cwobj",
    "present",
    "numtostr",
    "strpart",
    "abs",
    "round",
    "trunc",
    "sqrt",
    "pow",
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "atan2",
    "tpwrite",
    "write",
    "writebin",
    "uimsgbox",
    "errwrite",
    "waittime",
    "waituntil",
    "gripload",
    "mechunitload",
    "pdispset",
    "pdispon",
    "eoffsset",
    "eoffson",
    "triggequip",
    "triggio",
    "triggint",
    "wzboxdef",
    "wzsphdef",
    "wzcyldef",
    "wzhomejointdef",
    "wzlimjointdef",
    "moveextj",
    "packrawbytes",
    "isreachable",
    "getmotorlinkload",
    "setgo",
    "setao",
    "setdo",
    "socketsend",
    "arcmovejointtarget",
];

/// Instructions and functions of ABB's that write into what they are given.
const WRITERS: &[&str] =
    &["getdataval", "setdataval", "unpackrawbytes", "readcfgdata", "strtoval", "readanybin", "loadid", "parid"];

/// All changes of a job.
#[derive(Default)]
pub struct Changes {
    /// By symbol and element (`{2}`; none for all of it): the first statement that changes it.
    by_symbol: HashMap<usize, HashMap<Option<String>, String>>,
}

impl Changes {
    /// Goes through all statements of a job.
    pub fn of(job: &Job) -> Self {
        let mut changes = Self::default();
        for (file, text) in job.files.iter().enumerate() {
            for (index, statement) in text.statements.iter().enumerate() {
                let scope = job.scopes[file][index];
                match statement.kind {
                    StatementKind::Assignment => changes.assignment(job, text, statement, scope),
                    StatementKind::Declaration | StatementKind::Routine => continue,
                    _ => {}
                }
                changes.passed(job, text, statement, scope);
            }
        }
        changes
    }

    /// Why the value of a symbol, or of one element of it (`{2}`), is not what its declaration says.
    pub fn reason(&self, symbol: usize, element: &str) -> Option<&str> {
        let changes = self.by_symbol.get(&symbol)?;
        changes.get(&None).or_else(|| changes.get(&Some(element.to_owned()))).map(String::as_str)
    }

    fn add(&mut self, job: &Job, symbol: usize, element: Option<String>, reason: String) {
        if job.symbols[symbol].storage == Storage::Constant {
            return;
        }
        self.by_symbol.entry(symbol).or_default().entry(element).or_insert(reason);
    }

    fn assignment(&mut self, job: &Job, text: &FileText, statement: &Statement, scope: Scope) {
        let start = statement.tokens.start;
        let Lookup::Found(symbol) = job.symbol(&text.key(start), scope) else { return };
        let reason = format!("`{}` is assigned in line {}", text.display(start), text.line(start));
        self.add(job, symbol, element_at(text, start + 1, statement.tokens.end), reason);
    }

    /// Variables handed to something that may change them.
    fn passed(&mut self, job: &Job, text: &FileText, statement: &Statement, scope: Scope) {
        let Range { start, end } = statement.tokens.clone();
        let is_call = statement.kind == StatementKind::Call;
        let may_write = is_call && !Self::only_moves(job, text, start, scope);
        let mut calls = vec![Call { callee: may_write.then_some(start), searches: 0 }];
        for at in start + usize::from(is_call)..end {
            match text.kind(at) {
                Some(TokenKind::Symbol(b'(' | b'[' | b'{')) => {
                    let named = text.is_symbol(at, b'(') && at > start && text.kind(at - 1) == Some(TokenKind::Name);
                    calls.push(Call { callee: named.then(|| at - 1), searches: 0 });
                }
                Some(TokenKind::Symbol(b')' | b']' | b'}')) if calls.len() > 1 => {
                    calls.pop();
                }
                Some(TokenKind::Name) => {
                    if let Some(call) = calls.last_mut() {
                        self.passed_name(job, text, at..end, scope, call);
                    }
                }
                _ => {}
            }
        }
    }

    /// True for a plain motion instruction: it reads its own arguments. Most statements of long programs are that.
    fn only_moves(job: &Job, text: &FileText, callee: usize, scope: Scope) -> bool {
        let name = text.key(callee);
        motion_name(&name).is_some_and(|motion| !motion.search) && job.routine(&name, scope).is_none()
    }

    fn passed_name(&mut self, job: &Job, text: &FileText, rest: Range<usize>, scope: Scope, call: &mut Call) {
        let at = rest.start;
        let Some(callee) = call.callee else { return };
        let begins = at == callee + 1
            || matches!(text.kind(at - 1), Some(TokenKind::Assign | TokenKind::Symbol(b',' | b'(' | b'\\')));
        if !begins {
            return;
        }
        let Lookup::Found(symbol) = job.symbol(&text.key(at), scope) else { return };
        let mut after = at + 1;
        if text.is_symbol(after, b'{') {
            after = text.after_group(after, rest.end.min(after + 16)).unwrap_or(after);
        }
        let whole = after >= rest.end || matches!(text.kind(after), Some(TokenKind::Symbol(b',' | b')' | b'\\')));
        let name = text.key(callee);
        let data_type = job.symbols[symbol].data_type.as_str();
        let carries_pose = matches!(data_type, "robtarget" | "jointtarget" | "tooldata" | "wobjdata" | "loaddata");
        if !whole || !carries_pose {
            return;
        }
        let writes = match motion_name(&name) {
            _ if job.routine(&name, scope).is_some() => by_reference(job, &name, scope, data_type),
            // The first position of a search is the variable for what was found.
            Some(motion) if motion.search && data_type == "robtarget" => {
                call.searches += 1;
                call.searches == 1
            }
            Some(_) => false,
            // Calibrations read joint targets and write a tool.
            None if name.ends_with("calib") => data_type == "tooldata",
            None if WRITERS.contains(&name.as_str()) => true,
            // Tools and work objects are handed to every process move, whatever its name.
            None if !is_position_type(data_type) => false,
            None => {
                let reads = READERS.contains(&name.as_str()) || stands_still(&name);
                !reads && !moves_by_shape(text, callee, at, rest.end)
            }
        };
        if writes {
            let reason = format!("`{}` in line {} may change it", text.display(callee), text.line(callee));
            self.add(job, symbol, element_at(text, at + 1, rest.end), reason);
        }
    }
}

struct Call {
    callee: Option<usize>,
    searches: usize,
}

/// True for an instruction, not a function, with at least two arguments behind the position: an unknown process move
/// is taken to read only.
fn moves_by_shape(text: &FileText, callee: usize, at: usize, end: usize) -> bool {
    let function = text.is_symbol(callee + 1, b'(');
    let positional = callee + 1 == at || text.is_symbol(at - 1, b',');
    let mut behind = at + 1..end.min(at + 64);
    // A position is three commas at least.
    let commas = behind.clone().filter(|&next| text.is_symbol(next, b',')).count();
    let enough = commas >= 2 || behind.any(|next| text.kind(next) == Some(TokenKind::Position));
    !function && positional && enough
}

/// True when a routine of the job takes values of this type by reference. Optional arguments make places ambiguous,
/// so the type decides.
fn by_reference(job: &Job, routine: &str, scope: Scope, data_type: &str) -> bool {
    let parameters = job.routine(routine, scope).map(|index| job.routines[index].parameters.as_slice());
    parameters.unwrap_or_default().iter().any(|&parameter| {
        let parameter = &job.symbols[parameter];
        parameter.storage == Storage::Reference && parameter.data_type == data_type
    })
}

/// The literal index at a token (`{2}`), as [`Job::elements`] spells it; `None` without one or with a variable one.
pub fn element_at(text: &FileText, at: usize, end: usize) -> Option<String> {
    if !text.is_symbol(at, b'{') {
        return None;
    }
    let close = (at..end.min(at + 16)).find(|&index| text.is_symbol(index, b'}'))?;
    let literal =
        (at + 1..close).all(|index| matches!(text.kind(index), Some(TokenKind::Number | TokenKind::Symbol(b','))));
    let inner: String = (at + 1..close).map(|index| text.source.text(text.tokens[index].span()).into_owned()).collect();
    literal.then(|| format!("{{{inner}}}"))
}
