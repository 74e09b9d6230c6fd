//! Folders of one run: made with a lock, removed on every way out of the process, and where a process was killed
//! by the next run that uses the same place.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What the names of all such folders begin with.
const PREFIX: &str = ".groma-";

/// The file by whose lock a folder's run shows that it lives.
const LOCK: &str = "lock";

/// Characters of the output's name that go into the folder's.
const LONGEST_NAME: usize = 80;

/// Names tried before giving up: a process may convert to outputs of one name, and another may sweep just now.
const ATTEMPTS: u32 = 100;

/// The folders that an interrupted process has to remove.
static ALIVE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Holds off [`abandon_all`] and waits for it: for a step that must not be interrupted, such as giving the
/// output its name.
pub fn hold() -> MutexGuard<'static, Vec<PathBuf>> {
    ALIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every folder of this process, for the signal handler, which ends the process next: what other threads
/// write meanwhile fails, and whoever wants to [`hold`] waits until the end.
pub fn abandon_all() -> impl Drop {
    let mut folders = hold();
    for folder in folders.drain(..) {
        // Another thread may have made a file between the listing and the removal of the folder.
        for _ in 0..ATTEMPTS {
            if remove(&folder).is_ok() {
                break;
            }
        }
    }
    folders
}

/// The number of this process. One in a page has a folder of its own, and no number.
fn process() -> u32 {
    if cfg!(target_family = "wasm") { 0 } else { std::process::id() }
}

/// A folder that is removed when this is dropped.
#[derive(Debug)]
pub struct TempFolder {
    path: PathBuf,
    lock: Option<File>,
}

impl TempFolder {
    /// Makes `.groma-<name>-<process>` in `parent`, and removes what killed runs have left there.
    pub fn create(parent: &Path, name: &str) -> io::Result<Self> {
        sweep(parent);
        let name: String = name.chars().take(LONGEST_NAME).collect();
        let mut refused = None;
        for attempt in 0..ATTEMPTS {
            let more = if attempt == 0 { String::new() } else { format!("-{attempt}") };
            let path = parent.join(format!("{PREFIX}{name}-{}{more}", process()));
            match Self::at(path) {
                Ok(folder) => return Ok(folder),
                // Taken, or swept away by another run before it had its lock.
                Err(e) if matches!(e.kind(), io::ErrorKind::AlreadyExists) => refused = Some(e),
                Err(e) if e.kind() == io::ErrorKind::NotFound && parent.is_dir() => refused = Some(e),
                Err(e) => return Err(e),
            }
        }
        Err(refused.unwrap_or_else(|| io::ErrorKind::AlreadyExists.into()))
    }

    fn at(path: PathBuf) -> io::Result<Self> {
        let mut folders = hold();
        fs::create_dir(&path)?;
        folders.push(path.clone());
        drop(folders);
        let mut folder = Self { path, lock: None };
        let lock = File::create_new(folder.path.join(LOCK))?;
        if let Err(TryLockError::WouldBlock) = lock.try_lock() {
            return Err(io::ErrorKind::NotFound.into());
        }
        // Another run may have locked the file first, removed the folder, and given the lock back.
        if !folder.path.join(LOCK).exists() {
            return Err(io::ErrorKind::NotFound.into());
        }
        // On a file system without locks no other run can tell that this one lives, and none removes its folder.
        folder.lock = Some(lock);
        Ok(folder)
    }

    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for TempFolder {
    fn drop(&mut self) {
        let mut folders = hold();
        // Some systems keep a file that is open.
        self.lock = None;
        let _ = remove(&self.path);
        folders.retain(|folder| *folder != self.path);
    }
}

/// Removes the folders in `parent` whose runs have ended without doing so.
fn sweep(parent: &Path) {
    let Ok(entries) = fs::read_dir(parent) else { return };
    for entry in entries.flatten() {
        if entry.file_name().to_string_lossy().starts_with(PREFIX) && entry.path().is_dir() {
            let path = entry.path();
            match File::open(path.join(LOCK)) {
                Ok(lock) if lock.try_lock().is_ok() => {
                    let _ = remove(&path);
                }
                Ok(_) => {}
                // Without a lock it is either empty, then this removes it, or none of ours.
                Err(_) => {
                    let _ = fs::remove_dir(&path);
                }
            }
        }
    }
}

/// Removes a folder, its lock last, so that a removal that is itself interrupted can be resumed.
fn remove(folder: &Path) -> io::Result<()> {
    let entries = match fs::read_dir(folder) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(()),
        entries => entries?,
    };
    for entry in entries {
        let entry = entry?;
        if entry.file_name() != LOCK {
            fs::remove_file(entry.path())?;
        }
    }
    match fs::remove_file(folder.join(LOCK)) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => return Err(e),
        _ => {}
    }
    fs::remove_dir(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_there_until_dropped() {
        let parent = tempfile::tempdir().unwrap();
        let folder = TempFolder::create(parent.path(), "out.laz").unwrap();
        let second = TempFolder::create(parent.path(), "out.laz").unwrap();
        assert_ne!(folder.path(), second.path());
        fs::write(folder.path().join("cell"), b"points").unwrap();
        drop(folder);
        assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 1);
        drop(second);
        assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 0);
    }

    #[test]
    fn leftovers_go_and_the_living_stay() {
        let parent = tempfile::tempdir().unwrap();
        let alive = TempFolder::create(parent.path(), "alive").unwrap();
        let leftover = |name: &str, files: &[&str]| {
            let path = parent.path().join(name);
            fs::create_dir(&path).unwrap();
            files.iter().for_each(|file| fs::write(path.join(file), b"x").unwrap());
            path
        };
        let killed = leftover(".groma-out-1", &["lock", "nodes"]);
        let empty = leftover(".groma-out-2", &[]);
        let foreign = leftover(".groma-mine", &["a thing without a lock"]);
        let other = leftover("groma-out-3", &["lock"]);
        drop(TempFolder::create(parent.path(), "next").unwrap());
        assert!(alive.path().is_dir() && foreign.is_dir() && other.is_dir());
        assert!(!killed.exists() && !empty.exists());
    }

    #[test]
    fn runs_that_begin_at_once_leave_each_other_their_folders() {
        let parent = tempfile::tempdir().unwrap();
        std::thread::scope(|scope| {
            for run in 0..4 {
                let parent = parent.path();
                scope.spawn(move || {
                    for _ in 0..500 {
                        let folder = TempFolder::create(parent, &format!("out-{run}")).unwrap();
                        fs::write(folder.path().join("cell"), b"points").unwrap();
                    }
                });
            }
        });
        assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_place_that_is_not_there() {
        assert!(TempFolder::create(Path::new("/nowhere/at/all"), "a").is_err());
    }
}
