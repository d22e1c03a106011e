//! Which files some process is still writing, as far as the system tells.

use std::collections::HashSet;
use std::path::PathBuf;

/// The files that other processes hold open for writing. Empty where the system does not say, or not to this user.
pub fn files_being_written() -> HashSet<PathBuf> {
    let processes = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let mut found = HashSet::new();
    for process in processes {
        let is_process = process.file_name().to_string_lossy().bytes().all(|byte| byte.is_ascii_digit());
        if !is_process {
            continue;
        }
        let descriptors = std::fs::read_dir(process.path().join("fd")).into_iter().flatten().flatten();
        for descriptor in descriptors {
            let Ok(path) = std::fs::read_link(descriptor.path()) else { continue };
            let information = process.path().join("fdinfo").join(descriptor.file_name());
            if path.is_absolute() && std::fs::read_to_string(information).is_ok_and(|text| may_write(&text)) {
                found.insert(path);
            }
        }
    }
    found
}

/// `flags: 0100001`, octal; the last two bits are 0 for reading alone.
fn may_write(information: &str) -> bool {
    let flags = information.lines().find_map(|line| line.strip_prefix("flags:"));
    flags.and_then(|flags| u32::from_str_radix(flags.trim(), 8).ok()).is_some_and(|flags| flags & 0b11 != 0)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_held_as_long_as_it_is_open_for_writing() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().canonicalize().expect("its name").join("a.mod");
        let writer = std::fs::File::create(&path).expect("a file");
        assert!(files_being_written().contains(&path));
        drop(writer);
        let reader = std::fs::File::open(&path).expect("a file");
        assert!(!files_being_written().contains(&path));
        drop(reader);
    }
}
