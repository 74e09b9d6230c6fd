//! The output appears whole or not at all: written in a folder of the run's own beside its place, made durable,
//! then renamed. Whatever ends the run before that removes it.

use crate::error::{Error, Result};
use crate::temporary::folder::{self, TempFolder};
use std::fs::{self, File, OpenOptions};
use std::path::{Path, PathBuf};

/// An output that is being made.
#[derive(Debug)]
pub struct PendingFile {
    folder: TempFolder,
    target: PathBuf,
    overwrite: bool,
}

impl PendingFile {
    /// Makes the folder beside the output. Errors: `OUTPUT_EXISTS`, `OUTPUT_WRITE`.
    pub fn create(target: &Path, overwrite: bool) -> Result<Self> {
        check_target(target, overwrite)?;
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let folder = TempFolder::create(parent(target), &name)
            .map_err(|e| Error::output_write(target, format!("the folder takes no file ({e})")))?;
        Ok(Self { folder, target: target.to_path_buf(), overwrite })
    }

    /// The folder beside the output, for other things that go when the run ends.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Opens the file for writing and reading.
    pub fn open(&self) -> Result<File> {
        let file = OpenOptions::new().read(true).write(true).create_new(true).open(self.unfinished());
        file.map_err(|e| Error::output_write(&self.target, format!("the folder takes no file ({e})")))
    }

    /// Makes the written file durable and gives it its name.
    pub fn commit(self, file: File) -> Result<()> {
        let failed = |e: std::io::Error| Error::output_write(&self.target, e);
        file.sync_all().map_err(failed)?;
        drop(file);
        check_target(&self.target, self.overwrite)?;
        let held = folder::hold();
        fs::rename(self.unfinished(), &self.target).map_err(failed)?;
        drop(held);
        // The rename itself is durable once the folder is; a file system that cannot say so is no error.
        if let Ok(folder) = File::open(parent(&self.target)) {
            let _ = folder.sync_all();
        }
        Ok(())
    }

    fn unfinished(&self) -> PathBuf {
        self.folder.path().join("output")
    }
}

/// The folder that a file stands in.
pub fn parent(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Refuses an output that must not or cannot be written, before any work: `OUTPUT_EXISTS`, `OUTPUT_NAME`, `OUTPUT_WRITE`.
pub fn check_target(target: &Path, overwrite: bool) -> Result<()> {
    if target.file_name().is_none() || target.is_dir() {
        return Err(Error::output_write(target, "this is a folder"));
    }
    if !parent(target).is_dir() {
        let cause = format!("there is no folder {}", parent(target).display());
        return Err(Error::output_write(target, cause));
    }
    // Readers go by the name: what is called .las is taken for uncompressed points.
    if !target.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("laz")) {
        return Err(Error::output_name(target, "a COPC file has a name that ends in .laz"));
    }
    if !overwrite && target.symlink_metadata().is_ok() {
        return Err(Error::output_exists(target, "the file already exists"));
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
        let output = PendingFile::create(&target, false).unwrap();
        let mut file = output.open().unwrap();
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
        let output = PendingFile::create(&target, true).unwrap();
        drop(output.open().unwrap());
        drop(output);
        assert_eq!(names(folder.path()), ["a.laz"]);
        assert_eq!(fs::read(&target).unwrap(), b"old");
    }

    #[test]
    fn a_name_says_that_it_is_laz() {
        let folder = tempfile::tempdir().unwrap();
        for (name, code) in
            [("a.las", Some("OUTPUT_NAME")), ("a.LAS", Some("OUTPUT_NAME")), ("a", Some("OUTPUT_NAME"))]
                .into_iter()
                .chain([
                    ("a.copc.laz", None),
                    ("a.laz", None),
                    ("A.LAZ", None),
                    (".laz", Some("OUTPUT_NAME")),
                ])
        {
            let found = check_target(&folder.path().join(name), false).err().map(|error| error.code());
            assert_eq!(found.as_deref(), code, "{name}");
        }
    }

    #[test]
    fn a_folder_that_is_not_there() {
        let error = PendingFile::create(Path::new("/nowhere/at/all.laz"), false).unwrap_err();
        assert_eq!(error.code(), "OUTPUT_WRITE");
    }
}
