//! The output appears whole or not at all: written beside its place under a name of its own, made durable,
//! then renamed. Whatever ends the run before that removes it.

use crate::error::{Error, Result};
use std::fs::{self, File, OpenOptions};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The files that an interrupted process has to remove.
static PENDING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn pending() -> MutexGuard<'static, Vec<PathBuf>> {
    PENDING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every unfinished output. Holds off any rename that has not begun; for the signal handler, which
/// ends the process next.
pub fn abandon_all() -> impl Drop {
    let mut files = pending();
    for file in files.drain(..) {
        let _ = fs::remove_file(file);
    }
    files
}

/// An output that is being written.
#[derive(Debug)]
pub struct PendingFile {
    temporary: PathBuf,
    target: PathBuf,
    overwrite: bool,
}

impl PendingFile {
    /// Errors: `OUTPUT_EXISTS`, `OUTPUT_WRITE`.
    pub fn create(target: &Path, overwrite: bool) -> Result<(Self, File)> {
        check_target(target, overwrite)?;
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let temporary = target.with_file_name(format!(".{name}.groma-{}.tmp", std::process::id()));
        let mut files = pending();
        let file = OpenOptions::new().write(true).create_new(true).open(&temporary);
        let file =
            file.map_err(|e| Error::output_write(target, format!("the folder takes no file ({e})")))?;
        files.push(temporary.clone());
        Ok((Self { temporary, target: target.to_path_buf(), overwrite }, file))
    }

    /// Makes the written file durable and gives it its name.
    pub fn commit(self, file: File) -> Result<()> {
        let failed = |e: std::io::Error| Error::output_write(&self.target, e);
        file.sync_all().map_err(failed)?;
        drop(file);
        check_target(&self.target, self.overwrite)?;
        let mut files = pending();
        fs::rename(&self.temporary, &self.target).map_err(failed)?;
        files.retain(|f| *f != self.temporary);
        // The rename itself is durable once the folder is; a file system that cannot say so is no error.
        let folder = self.target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if let Ok(folder) = File::open(folder) {
            let _ = folder.sync_all();
        }
        Ok(())
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        let mut files = pending();
        if files.contains(&self.temporary) {
            let _ = fs::remove_file(&self.temporary);
            files.retain(|f| *f != self.temporary);
        }
    }
}

/// Refuses an output that must not or cannot be written, before any work.
pub fn check_target(target: &Path, overwrite: bool) -> Result<()> {
    if target.file_name().is_none() || target.is_dir() {
        return Err(Error::output_write(target, "this is a folder"));
    }
    if !overwrite && target.symlink_metadata().is_ok() {
        return Err(Error::output_exists(target, "the file is there already"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn appears_only_when_committed() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.laz");
        let (output, mut file) = PendingFile::create(&target, false).unwrap();
        file.write_all(b"whole").unwrap();
        assert!(!target.exists());
        output.commit(file).unwrap();
        assert_eq!(names(folder.path()), ["a.laz"]);
        assert_eq!(fs::read(&target).unwrap(), b"whole");
        assert_eq!(PendingFile::create(&target, false).unwrap_err().code(), "OUTPUT_EXISTS");
    }

    #[test]
    fn dropped_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.laz");
        fs::write(&target, b"old").unwrap();
        drop(PendingFile::create(&target, true).unwrap());
        assert_eq!(names(folder.path()), ["a.laz"]);
        assert_eq!(fs::read(&target).unwrap(), b"old");
    }

    #[test]
    fn a_folder_that_is_not_there() {
        let error = PendingFile::create(Path::new("/nowhere/at/all.laz"), false).unwrap_err();
        assert_eq!(error.code(), "OUTPUT_WRITE");
    }
}
