//! Files of one run, in a folder of this process: the core reads files, not bytes.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// In memory where the system has such a folder.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let shared = Path::new("/dev/shm");
    let base = if shared.is_dir() { shared.to_path_buf() } else { std::env::temp_dir() };
    base.join(format!("groma-fuzz-{}", std::process::id()))
});

pub struct Scratch(());

impl Scratch {
    /// Calls back with an empty folder, which is removed afterwards.
    pub fn with(work: impl FnOnce(&Self)) {
        fs::create_dir_all(&*FOLDER).expect("a scratch folder");
        work(&Self(()));
        let left = fs::read_dir(&*FOLDER).expect("the scratch folder").flatten();
        let names: Vec<_> = left.map(|entry| entry.file_name()).collect();
        fs::remove_dir_all(&*FOLDER).expect("the scratch folder");
        let known = ["in", "once", "twice"];
        assert!(names.iter().all(|name| known.iter().any(|known| name == known)), "left behind: {names:?}");
    }

    pub fn path(&self, name: &str) -> PathBuf {
        FOLDER.join(name)
    }

    /// A file with these bytes.
    pub fn input(&self, data: &[u8]) -> PathBuf {
        let path = self.path("in");
        fs::write(&path, data).expect("a scratch file");
        path
    }
}
