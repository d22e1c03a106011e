//! Outcomes as tables in Markdown.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use crate::cause::{MOVING_KINDS, OUTSIDE_KINDS, STATIC_KINDS};
use crate::judge::{Fate, Judged, Outcome};
use crate::plan::LEVELS;

/// All tables.
pub fn markdown(outcomes: &[Outcome]) -> String {
    let mut text = String::from(
        "# Concealed trials\n\nWritten by the long form of `tests/concealed` (see [diagnosis.md](diagnosis.md), section 7); not edited.\n\n",
    );
    overview(outcomes, &mut text);
    power(outcomes, &mut text);
    confusion(outcomes, &mut text);
    recovered(outcomes, &mut text);
    several(outcomes, &mut text);
    hardships(outcomes, &mut text);
    outside(outcomes, &mut text);
    by_the_way(outcomes, &mut text);
    text
}

/// `k of n (low to high %)`: a share with Wilson's interval at 95 %.
///
/// Wilson, J. Am. Stat. Assoc. 22 (1927) 209: holds its level for shares near 0 and 1, where trials of a good tool are.
pub fn share(k: usize, n: usize) -> String {
    if n == 0 {
        return "-".into();
    }
    let [low, high] = wilson(k, n);
    format!("{k} of {n} ({:.1} to {:.1} %)", 100.0 * low, 100.0 * high)
}

pub fn wilson(k: usize, n: usize) -> [f64; 2] {
    let (z, n, p) = (1.959_964_f64, n as f64, k as f64 / n as f64);
    let middle = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    [(middle - half) / (1.0 + z * z / n), (middle + half) / (1.0 + z * z / n)].map(|bound| bound.clamp(0.0, 1.0))
}

fn group<'a>(outcomes: &'a [Outcome], name: &'a str) -> impl Iterator<Item = &'a Outcome> {
    outcomes.iter().filter(move |outcome| outcome.group == name)
}

fn count<'a>(outcomes: impl Iterator<Item = &'a Outcome>, what: impl Fn(&Outcome) -> bool) -> (usize, usize) {
    outcomes.fold((0, 0), |(k, n), outcome| (k + usize::from(what(outcome)), n + 1))
}

fn right(judged: &[&Judged]) -> (usize, usize) {
    (judged.iter().filter(|one| one.fate.right()).count(), judged.len())
}

fn overview(outcomes: &[Outcome], text: &mut String) {
    let refused = outcomes.iter().filter(|outcome| outcome.refused.is_some()).count();
    let all = crate::plan::all(0).len();
    let _ = writeln!(text, "{} of {all} trials done; {refused} recordings were refused.\n", outcomes.len());
    let _ = writeln!(text, "| nothing concealed | something named | told as unexplained |\n| --- | --- | --- |");
    for (moving, words) in [(false, "standing"), (true, "moving")] {
        let nulls = || group(outcomes, "null").filter(move |outcome| outcome.moving == moving);
        let (named, n) = count(nulls(), Outcome::alarmed);
        let (flagged, _) = count(nulls(), |outcome| outcome.unexplained);
        let _ = writeln!(text, "| {words} | {} | {} |", share(named, n), share(flagged, n));
    }
    text.push('\n');
}

fn kinds() -> Vec<(&'static str, bool)> {
    STATIC_KINDS.iter().map(|kind| (*kind, false)).chain(MOVING_KINDS.iter().map(|kind| (*kind, true))).collect()
}

fn power(outcomes: &[Outcome], text: &mut String) {
    text.push_str("| one cause concealed | level 3 | level 1 | level 0.3 |\n| --- | --- | --- | --- |\n");
    let singles = |level: f64| {
        group(outcomes, "single").filter(move |outcome| outcome.causes.iter().any(|one| one.wanted == level))
    };
    for (kind, moving) in kinds() {
        let words = if moving { format!("{kind} (moving)") } else { kind.to_string() };
        let _ = write!(text, "| {words} |");
        for level in LEVELS {
            let judged: Vec<&Judged> = singles(level)
                .filter(|outcome| outcome.moving == moving)
                .flat_map(|outcome| &outcome.causes)
                .filter(|one| one.kind == kind)
                .collect();
            let (k, n) = right(&judged);
            let cell = if n == 0 { "-".into() } else { format!("{k} of {n}") };
            let _ = write!(text, " {cell} |");
        }
        text.push('\n');
    }
    for (words, row) in
        [("**right**", 0), ("of these told as equivalent", 1), ("**a wrong name**", 2), ("seen, not named", 3)]
    {
        let _ = write!(text, "| {words} |");
        for level in LEVELS {
            let trials: Vec<&Outcome> = singles(level).collect();
            let k = trials.iter().filter(|outcome| match row {
                0 => outcome.causes.iter().all(|one| one.fate.right()),
                1 => outcome.causes.iter().any(|one| one.fate == Fate::Equivalent),
                2 => outcome.alarmed(),
                _ => outcome.found.is_empty() && outcome.unexplained,
            });
            let _ = write!(text, " {} |", share(k.count(), trials.len()));
        }
        text.push('\n');
    }
    text.push('\n');
}

fn confusion(outcomes: &[Outcome], text: &mut String) {
    text.push_str("| concealed alone, level 1 and 3 | named (how often) |\n| --- | --- |\n");
    for (kind, moving) in kinds() {
        let mut named: BTreeMap<String, usize> = BTreeMap::new();
        let trials = group(outcomes, "single").filter(|outcome| outcome.moving == moving);
        for outcome in trials.filter(|outcome| outcome.causes.iter().any(|one| one.kind == kind && one.wanted >= 1.0)) {
            let effects: BTreeSet<&String> = outcome.found.iter().map(|(effect, _)| effect).collect();
            effects.iter().for_each(|effect| *named.entry((*effect).clone()).or_default() += 1);
            if effects.is_empty() {
                let word = if outcome.unexplained { "*unexplained*" } else { "*nothing*" };
                *named.entry(word.into()).or_default() += 1;
            }
        }
        let mut list: Vec<(String, usize)> = named.into_iter().collect();
        list.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
        let list: Vec<String> = list.into_iter().map(|(word, times)| format!("{word} {times}")).collect();
        let words = if moving { format!("{kind} (moving)") } else { kind.to_string() };
        let _ = writeln!(text, "| {words} | {} |", list.join(", "));
    }
    text.push('\n');
}

/// A number, or a dash where there is none.
fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "-".into() }
}

/// The value below which this part of the sorted list lies.
fn quantile(values: &mut [f64], part: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        n => values[((part * (n - 1) as f64).round() as usize).min(n - 1)],
    }
}

fn recovered(outcomes: &[Outcome], text: &mut String) {
    text.push_str("| share of the missing error recovered | trials | median | lowest tenth | below 0.70 |\n");
    text.push_str("| --- | --- | --- | --- | --- |\n");
    let mut row = |words: &str, trials: Vec<&Outcome>| {
        let mut values: Vec<f64> = trials.iter().filter_map(|outcome| outcome.recovered).collect();
        if values.is_empty() {
            return;
        }
        let low = values.iter().filter(|value| **value < 0.7).count();
        let (median, tenth) = (quantile(&mut values, 0.5), quantile(&mut values, 0.1));
        let _ = writeln!(text, "| {words} | {} | {median:.2} | {tenth:.2} | {low} |", values.len());
    };
    for level in LEVELS {
        let of_level = |outcome: &&Outcome| outcome.causes.iter().any(|one| one.wanted == level);
        row(&format!("one cause, level {level}"), group(outcomes, "single").filter(of_level).collect());
    }
    row("several causes", group(outcomes, "several").collect());
    // What the tracker does is none of the arm's: an updated model must not hold it.
    let of_arm = |outcome: &&Outcome| !outcome.causes.iter().any(|one| one.kind == "tracker_angle");
    row("outside the table, level 3", group(outcomes, "outside").filter(of_arm).collect());
    text.push('\n');
}

fn several(outcomes: &[Outcome], text: &mut String) {
    text.push_str("| causes at once | causes right | all right | a wrong name |\n| --- | --- | --- | --- |\n");
    for size in 2..=4 {
        let trials: Vec<&Outcome> = group(outcomes, "several").filter(|outcome| outcome.causes.len() == size).collect();
        let judged: Vec<&Judged> = trials.iter().flat_map(|outcome| &outcome.causes).collect();
        let (k, n) = right(&judged);
        let whole = trials.iter().filter(|outcome| outcome.causes.iter().all(|one| one.fate.right())).count();
        let wrong = trials.iter().filter(|outcome| outcome.alarmed()).count();
        if trials.is_empty() {
            continue;
        }
        let _ = writeln!(
            text,
            "| {size} | {} | {} | {} |",
            share(k, n),
            share(whole, trials.len()),
            share(wrong, trials.len())
        );
    }
    text.push('\n');
}

fn hardships(outcomes: &[Outcome], text: &mut String) {
    text.push_str(
        "| hardship (causes at level 2) | nothing concealed: named | right | a wrong name | recovered (median) |\n",
    );
    text.push_str("| --- | --- | --- | --- | --- |\n");
    let mut row = |words: &str, trials: Vec<&Outcome>| {
        let (nulls, others): (Vec<&Outcome>, Vec<&Outcome>) = trials.into_iter().partition(|one| one.causes.is_empty());
        let alarms = nulls.iter().filter(|outcome| outcome.alarmed()).count();
        let judged: Vec<&Judged> = others.iter().flat_map(|outcome| &outcome.causes).collect();
        let (k, n) = right(&judged);
        let wrong = others.iter().filter(|outcome| outcome.alarmed()).count();
        let mut values: Vec<f64> = others.iter().filter_map(|outcome| outcome.recovered).collect();
        let median = quantile(&mut values, 0.5);
        let (all_nulls, all) = (nulls.len(), others.len());
        if all_nulls + all == 0 {
            return;
        }
        let _ = writeln!(
            text,
            "| {words} | {alarms} of {all_nulls} | {k} of {n} | {wrong} of {all} | {} |",
            number(median)
        );
    };
    for (_, words) in crate::trial::Hardship::ALL {
        row(
            words,
            group(outcomes, "hard").filter(|outcome| outcome.hardships.iter().any(|own| own == words)).collect(),
        );
    }
    row("several of these together", group(outcomes, "together").collect());
    text.push('\n');
}

fn outside(outcomes: &[Outcome], text: &mut String) {
    text.push_str(
        "| outside the table, level 3 | told as unexplained | at its joint | a wrong name | the named cause beside it is right |\n",
    );
    text.push_str("| --- | --- | --- | --- | --- |\n");
    for kind in OUTSIDE_KINDS {
        for (alone, words) in [(true, "alone"), (false, "beside a named one")] {
            let of_kind = |outcome: &&Outcome| {
                outcome.causes.iter().any(|one| one.kind == kind) && (outcome.causes.len() == 1) == alone
            };
            let trials: Vec<&Outcome> = group(outcomes, "outside").filter(of_kind).collect();
            let flagged = trials.iter().filter(|outcome| outcome.unexplained).count();
            let located = trials.iter().filter(|outcome| outcome.located == Some(true)).count();
            let has_joint = trials.iter().any(|outcome| outcome.located.is_some());
            let wrong = trials.iter().filter(|outcome| outcome.alarmed()).count();
            let named: Vec<&Judged> =
                trials.iter().flat_map(|outcome| &outcome.causes).filter(|one| one.kind != kind).collect();
            let (k, n) = right(&named);
            let beside = if alone { "-".to_string() } else { format!("{k} of {n}") };
            let all = trials.len();
            if all == 0 {
                continue;
            }
            let located = if has_joint { format!("{located} of {all}") } else { "-".to_string() };
            let _ =
                writeln!(text, "| {kind}, {words} | {flagged} of {all} | {located} | {wrong} of {all} | {beside} |");
        }
    }
    text.push('\n');
}

fn by_the_way(outcomes: &[Outcome], text: &mut String) {
    let (found, there) = outcomes.iter().fold((0, 0), |(a, b), one| (a + one.outliers[0], b + one.outliers[1]));
    let accused: usize = outcomes.iter().map(|outcome| outcome.accused).sum();
    let _ = writeln!(text, "Gross errors found: {}; good records taken for such: {accused}.\n", share(found, there));
    for (moving, words) in [(false, "240 standing records"), (true, "1,500 moving records")] {
        let mut seconds: Vec<f64> = outcomes
            .iter()
            .filter(|one| one.moving == moving && one.refused.is_none())
            .map(|one| one.seconds)
            .collect();
        if !seconds.is_empty() {
            let (median, most) = (quantile(&mut seconds, 0.5), quantile(&mut seconds, 1.0));
            let _ = writeln!(text, "Time for {words}: median {median:.1} s, longest {most:.1} s.\n");
        }
    }
}
