//! The floors of the house: a module may use only what lies on lower floors. And a few rules of the house that no lint
//! knows.

#![allow(clippy::expect_used, reason = "a test may stop where its own preparation fails")]

use std::fs;
use std::path::{Path, PathBuf};

/// The modules of the crate from the ground up. Modules on one floor do not know each other.
const FLOORS: &[&[&str]] = &[
    &["base"],
    &["geometry"],
    &["program", "model"],
    &["kinematics", "measure"],
    &["files"],
    &["invert", "identify"],
    &["rewrite", "learn"],
    &["diagnose"],
    &["report"],
    &["cli"],
];

fn floor(module: &str) -> Option<usize> {
    FLOORS.iter().position(|modules| modules.contains(&module))
}

fn sources() -> Vec<(PathBuf, String)> {
    fn walk(folder: &Path, found: &mut Vec<(PathBuf, String)>) {
        for entry in fs::read_dir(folder).expect("src/").flatten() {
            let path = entry.path();
            if path.is_dir() {
                walk(&path, found);
            } else if path.extension().is_some_and(|extension| extension == "rs") && !path.ends_with("tests.rs") {
                let text = fs::read_to_string(&path).expect("UTF-8 source");
                found.push((path, text));
            }
        }
    }
    let mut found = Vec::new();
    walk(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut found);
    found
}

fn module_of(path: &Path) -> String {
    let inside = path.strip_prefix(Path::new(env!("CARGO_MANIFEST_DIR")).join("src")).expect("under src/");
    let first = inside.components().next().expect("a file").as_os_str().to_string_lossy().into_owned();
    first.trim_end_matches(".rs").to_string()
}

#[test]
fn imports_point_downward() {
    let mut arrows = 0;
    for (path, text) in sources() {
        let module = module_of(&path);
        if module == "lib" || module == "main" {
            continue;
        }
        let own = floor(&module).unwrap_or_else(|| panic!("{module} stands on no floor: add it to FLOORS"));
        // Tests may look anywhere below the floor they test.
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        for piece in code.split("crate::").skip(1) {
            let used: String = piece.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            let Some(used_floor) = floor(&used) else { continue };
            let sound = used == module || used_floor < own;
            assert!(sound, "{}: {module} (floor {own}) uses {used} (floor {used_floor})", path.display());
            arrows += 1;
        }
    }
    assert!(arrows > 100, "the test sees only {arrows} imports: it no longer reads them");
}

#[test]
fn only_the_command_line_touches_files_and_terminals() {
    for (path, text) in sources() {
        let module = module_of(&path);
        if matches!(module.as_str(), "cli" | "main") {
            continue;
        }
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        for forbidden in ["std::fs", "std::env::", "std::io::std", "SystemTime", "Instant::now"] {
            assert!(!code.contains(forbidden), "{} uses {forbidden}", path.display());
        }
    }
}

#[test]
fn files_are_small() {
    for (path, text) in sources() {
        let lines = text.lines().count();
        assert!(lines <= 600, "{} has {lines} lines; split it", path.display());
    }
}
