//! Which files of a folder belong together, told by the names that they give each other.
//!
//! Two files whose moves and positions refer to each other are one job: a target that one of them declares is corrected
//! with the moves of the other. A file from which others only take tools, frames, loads or routines is read with them
//! and written for itself. Programs that are never loaded together do not tie: two files that give the same name are
//! such, and so are all that a third one serves if two of them are.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::hash::{DefaultHasher, Hash, Hasher};

/// A name as it is compared: libraries hold millions. Two names that fall together tie too much, never too little.
pub type NameHash = u64;

/// What a file gives to other files, and takes from them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ties {
    /// Global names that it declares.
    pub gives: Vec<Given>,
    /// Names in it that it does not declare.
    pub takes: Vec<NameHash>,
}

/// A global name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Given {
    /// The name.
    pub name: NameHash,
    /// It is a position: who moves to it decides about the number that stands here.
    pub is_position: bool,
}

/// A file among others.
#[derive(Clone, Copy, Debug)]
pub struct Member<'a> {
    /// Where it lies: files of different places know nothing of each other.
    pub place: &'a str,
    /// The job that it belongs to by its name.
    pub job: &'a str,
    /// Its names.
    pub ties: &'a Ties,
}

/// Files that are one job, by their index.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Group {
    /// Read, corrected and written together.
    pub own: Vec<usize>,
    /// Read with them.
    pub shared: Vec<usize>,
}

/// The hash of a name as the language compares names.
pub fn name_hash(key: &str) -> NameHash {
    let mut hasher = DefaultHasher::new();
    key.hash(&mut hasher);
    hasher.finish()
}

/// Puts files together, in the order of the first file of each job.
pub fn together(members: &[Member<'_>]) -> Vec<Group> {
    let mut reads: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); members.len()];
    let mut taken_from: HashMap<usize, BTreeSet<usize>> = HashMap::new();
    for (taker, giver, is_position) in links(members) {
        match is_position {
            true => taken_from.entry(giver).or_default().insert(taker),
            false => reads[taker].insert(giver),
        };
    }
    let mut bound: Vec<(usize, usize)> = Vec::new();
    for (giver, takers) in taken_from {
        let all: Vec<usize> = takers.iter().copied().chain([giver]).collect();
        match conflict(members, &all) {
            true => takers.iter().for_each(|taker| _ = reads[*taker].insert(giver)),
            false => bound.extend(takers.iter().map(|taker| (*taker, giver))),
        }
    }
    let by_name = by_job(members);
    let mut groups = Vec::new();
    for own in components(members.len(), bound.iter().chain(&by_name)) {
        if bound.iter().any(|(taker, _)| own.contains(taker)) && conflict(members, &own) {
            // A chain of files whose ends are never loaded together: each takes what it needs from the next.
            bound
                .iter()
                .filter(|(taker, _)| own.contains(taker))
                .for_each(|(taker, giver)| _ = reads[*taker].insert(*giver));
            let inside = by_name.iter().filter(|(file, _)| own.contains(file));
            groups.extend(components(members.len(), inside).into_iter().filter(|part| own.contains(&part[0])));
        } else {
            groups.push(own);
        }
    }
    groups.sort();
    groups.into_iter().map(|own| Group { shared: read_with(members, &reads, &own), own }).collect()
}

/// Who takes which name from whom, where a single file of the place gives it.
fn links(members: &[Member<'_>]) -> Vec<(usize, usize, bool)> {
    let mut givers: HashMap<(&str, NameHash), Vec<(usize, bool)>> = HashMap::new();
    for (file, member) in members.iter().enumerate() {
        for given in &member.ties.gives {
            givers.entry((member.place, given.name)).or_default().push((file, given.is_position));
        }
    }
    let mut links = Vec::new();
    for (taker, member) in members.iter().enumerate() {
        for name in &member.ties.takes {
            if let Some([(giver, is_position)]) = givers.get(&(member.place, *name)).map(Vec::as_slice) {
                links.push((taker, *giver, *is_position));
            }
        }
    }
    links.retain(|(taker, giver, _)| taker != giver);
    links
}

/// Some name is given twice: these files are never loaded together.
fn conflict(members: &[Member<'_>], files: &[usize]) -> bool {
    let mut seen = HashSet::new();
    files.iter().flat_map(|file| &members[*file].ties.gives).any(|given| !seen.insert(given.name))
}

/// Pairs of files that are one job by their names.
fn by_job(members: &[Member<'_>]) -> Vec<(usize, usize)> {
    let mut first: HashMap<(&str, &str), usize> = HashMap::new();
    let files = members.iter().enumerate();
    files.map(|(file, member)| (file, *first.entry((member.place, member.job)).or_insert(file))).collect()
}

/// The parts of a graph, each in order.
fn components<'a>(count: usize, edges: impl Iterator<Item = &'a (usize, usize)>) -> Vec<Vec<usize>> {
    let mut root: Vec<usize> = (0..count).collect();
    fn find(root: &mut [usize], mut file: usize) -> usize {
        while root[file] != file {
            root[file] = root[root[file]];
            file = root[file];
        }
        file
    }
    for &(a, b) in edges {
        let (a, b) = (find(&mut root, a), find(&mut root, b));
        root[a.max(b)] = a.min(b);
    }
    let mut parts: Vec<Vec<usize>> = vec![Vec::new(); count];
    for file in 0..count {
        parts[find(&mut root, file)].push(file);
    }
    parts.retain(|part| !part.is_empty());
    parts
}

/// What a job reads, and what that reads in turn.
fn read_with(members: &[Member<'_>], reads: &[BTreeSet<usize>], own: &[usize]) -> Vec<usize> {
    let mut names: HashSet<NameHash> = HashSet::new();
    names.extend(own.iter().flat_map(|file| &members[*file].ties.gives).map(|given| given.name));
    let mut found: BTreeSet<usize> = BTreeSet::new();
    let mut open: Vec<usize> = own.to_vec();
    while let Some(file) = open.pop() {
        for &next in &reads[file] {
            let fits = || members[next].ties.gives.iter().all(|given| !names.contains(&given.name));
            if !own.contains(&next) && !found.contains(&next) && fits() {
                found.insert(next);
                open.push(next);
            }
        }
    }
    found.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ties(gives: &[&str], takes: &[&str]) -> Ties {
        let given = |name: &&str| Given { name: name_hash(name), is_position: name.starts_with('p') };
        Ties { gives: gives.iter().map(given).collect(), takes: takes.iter().map(|name| name_hash(name)).collect() }
    }

    fn grouped(all: &[(&str, Ties)]) -> Vec<(Vec<usize>, Vec<usize>)> {
        let members: Vec<Member<'_>> = all.iter().map(|(job, ties)| Member { place: "folder", job, ties }).collect();
        together(&members).into_iter().map(|group| (group.own, group.shared)).collect()
    }

    #[test]
    fn positions_bind_and_tools_are_read() {
        let all = [
            ("main.mod", ties(&["main"], &["p1", "tgun", "weld"])),
            ("points.mod", ties(&["p1", "p2"], &[])),
            ("tools.sys", ties(&["tgun"], &["wfix"])),
            ("weld.mod", ties(&["weld"], &["tgun"])),
            ("frames.sys", ties(&["wfix"], &["unknown"])),
        ];
        let expected = [(vec![0, 1], vec![2, 3, 4]), (vec![2], vec![4]), (vec![3], vec![2, 4]), (vec![4], vec![])];
        assert_eq!(grouped(&all), expected);
    }

    #[test]
    fn programs_that_exclude_each_other_share_and_do_not_bind() {
        let all = [
            ("a.mod", ties(&["main", "p1"], &["phome", "p1"])),
            ("b.mod", ties(&["main", "p1"], &["phome", "p2"])),
            ("home.mod", ties(&["phome", "p2"], &[])),
        ];
        assert_eq!(grouped(&all), [(vec![0], vec![2]), (vec![1], vec![2]), (vec![2], vec![])]);
        // A name that two others give is nobody's.
        let all = [("a", ties(&[], &["p1"])), ("b", ties(&["p1"], &[])), ("c", ties(&["p1"], &[]))];
        assert_eq!(grouped(&all), [(vec![0], vec![]), (vec![1], vec![]), (vec![2], vec![])]);
    }

    #[test]
    fn a_chain_with_a_conflict_at_its_ends_falls_apart_into_jobs_by_name() {
        let all = [
            ("a", ties(&["main"], &["p1"])),
            ("b", ties(&["p1"], &["p2"])),
            ("c", ties(&["main", "p2"], &[])),
            ("b", ties(&[], &[])),
        ];
        assert_eq!(grouped(&all), [(vec![0], vec![1]), (vec![1, 3], vec![2]), (vec![2], vec![])]);
    }
}
