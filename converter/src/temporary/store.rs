//! Bytes that are needed later: held in memory while there is room, else in a file of the run's folder.

use crate::error::{Error, Result};
use std::fs::{self, File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The room that a run has, shared by its threads.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    budget: u64,
    resident: AtomicU64,
    spilled: AtomicU64,
    names: AtomicU64,
    log: Mutex<Option<Log>>,
}

/// Where bytes are.
#[derive(Debug)]
pub enum Held {
    Memory(Vec<u8>),
    /// A file of their own, which goes with them.
    File {
        path: PathBuf,
        bytes: u64,
    },
    /// A part of the log, which stays to the end.
    Log {
        at: u64,
        bytes: u64,
    },
}

#[derive(Debug)]
struct Log {
    file: File,
    end: u64,
}

impl Store {
    /// A store of `budget` bytes in memory that spills into a folder.
    pub fn new(folder: &Path, budget: u64) -> Self {
        Self {
            folder: folder.to_path_buf(),
            budget,
            resident: 0.into(),
            spilled: 0.into(),
            names: 0.into(),
            log: Mutex::new(None),
        }
    }

    /// Bytes by which the memory is overdrawn.
    pub fn excess(&self) -> u64 {
        self.resident.load(Ordering::Relaxed).saturating_sub(self.budget)
    }

    /// Half of what may be in memory.
    pub fn half(&self) -> u64 {
        self.budget / 2
    }

    /// All bytes ever written to files.
    pub fn spilled(&self) -> u64 {
        self.spilled.load(Ordering::Relaxed)
    }

    /// Counts bytes that somebody holds in memory on this store's account.
    pub fn charge(&self, bytes: u64) {
        self.resident.fetch_add(bytes, Ordering::Relaxed);
    }

    pub fn release(&self, bytes: u64) {
        self.resident.fetch_sub(bytes, Ordering::Relaxed);
    }

    /// A file of the folder that nobody else uses.
    pub fn unused_path(&self) -> PathBuf {
        self.folder.join(format!("points-{}", self.names.fetch_add(1, Ordering::Relaxed)))
    }

    /// Appends to a file. Errors: `TEMP_SPACE`, `TEMP_FILE`.
    pub fn append<'a>(&self, path: &Path, parts: impl IntoIterator<Item = &'a [u8]>) -> Result<()> {
        let write = || {
            let mut file = OpenOptions::new().append(true).create(true).open(path)?;
            for part in parts {
                file.write_all(part)?;
                self.spilled.fetch_add(part.len() as u64, Ordering::Relaxed);
            }
            Ok(())
        };
        write().map_err(|e| Error::temporary(&self.folder, &e))
    }

    /// Keeps bytes for one later [`Self::take`].
    pub fn keep(&self, bytes: Vec<u8>) -> Result<Held> {
        if self.admit(bytes.len() as u64) {
            return Ok(Held::Memory(bytes));
        }
        let path = self.unused_path();
        self.append(&path, [bytes.as_slice()])?;
        Ok(Held::File { path, bytes: bytes.len() as u64 })
    }

    /// Keeps bytes to the end of the run; files of many small ones are spared.
    pub fn record(&self, bytes: Vec<u8>) -> Result<Held> {
        if self.admit(bytes.len() as u64) {
            return Ok(Held::Memory(bytes));
        }
        let write = |slot: &mut Option<Log>| {
            let log = match slot {
                Some(log) => log,
                None => {
                    let path = self.folder.join("log");
                    let file = OpenOptions::new().read(true).write(true).create_new(true).open(path)?;
                    slot.insert(Log { file, end: 0 })
                }
            };
            log.file.seek(SeekFrom::Start(log.end))?;
            log.file.write_all(&bytes)?;
            let at = log.end;
            log.end += bytes.len() as u64;
            self.spilled.fetch_add(bytes.len() as u64, Ordering::Relaxed);
            Ok(Held::Log { at, bytes: bytes.len() as u64 })
        };
        write(&mut self.log()).map_err(|e| Error::temporary(&self.folder, &e))
    }

    /// Takes bytes out of the store.
    pub fn take(&self, held: Held) -> Result<Vec<u8>> {
        match held {
            Held::Memory(bytes) => {
                self.release(bytes.len() as u64);
                Ok(bytes)
            }
            Held::File { path, bytes } => {
                let mut all = Vec::with_capacity(bytes as usize);
                let read = File::open(&path).and_then(|mut file| file.read_to_end(&mut all));
                read.and_then(|_| fs::remove_file(&path)).map_err(|e| Error::temporary(&self.folder, &e))?;
                Ok(all)
            }
            Held::Log { .. } => self.with(&held, <[u8]>::to_vec),
        }
    }

    /// Shows bytes that stay in the store.
    pub fn with<T>(&self, held: &Held, show: impl FnOnce(&[u8]) -> T) -> Result<T> {
        let read = || match held {
            Held::Memory(bytes) => Ok(show(bytes)),
            Held::File { path, .. } => Ok(show(&fs::read(path)?)),
            Held::Log { at, bytes } => {
                let mut part = vec![0; *bytes as usize];
                let mut log = self.log();
                let log = log.as_mut().ok_or(std::io::ErrorKind::NotFound)?;
                log.file.seek(SeekFrom::Start(*at))?;
                log.file.read_exact(&mut part)?;
                Ok(show(&part))
            }
        };
        read().map_err(|e: std::io::Error| Error::temporary(&self.folder, &e))
    }

    /// Reads a file of the folder piece by piece, then removes it.
    pub fn drain(&self, path: &Path, piece: usize, mut each: impl FnMut(&[u8]) -> Result<()>) -> Result<()> {
        let failed = |e: std::io::Error| Error::temporary(&self.folder, &e);
        let mut file = File::open(path).map_err(failed)?;
        let mut left = file.metadata().map_err(failed)?.len();
        let mut bytes = vec![0; piece.min(left as usize)];
        while left > 0 {
            let part = &mut bytes[..piece.min(left as usize)];
            file.read_exact(part).map_err(failed)?;
            left -= part.len() as u64;
            each(part)?;
        }
        fs::remove_file(path).map_err(failed)
    }

    /// Charges bytes if there is room for them.
    fn admit(&self, bytes: u64) -> bool {
        self.resident
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, |now| {
                now.checked_add(bytes).filter(|sum| *sum <= self.budget)
            })
            .is_ok()
    }

    fn log(&self) -> MutexGuard<'_, Option<Log>> {
        self.log.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_room_goes_to_files_and_comes_back() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::new(folder.path(), 10);
        let files = || fs::read_dir(folder.path()).unwrap().count();
        let first = store.keep(vec![1; 8]).unwrap();
        let second = store.keep(vec![2; 8]).unwrap();
        let third = store.record(vec![3; 8]).unwrap();
        let fourth = store.record(vec![4; 5]).unwrap();
        assert!(matches!(first, Held::Memory(_)));
        assert_eq!((files(), store.spilled()), (2, 21));
        assert_eq!(store.with(&third, <[u8]>::to_vec).unwrap(), [3; 8]);
        assert_eq!(store.take(fourth).unwrap(), [4; 5]);
        assert_eq!(store.take(second).unwrap(), [2; 8]);
        assert_eq!(store.take(first).unwrap(), [1; 8]);
        assert_eq!(files(), 1);
        assert!(matches!(store.keep(vec![5; 10]).unwrap(), Held::Memory(_)));
        assert_eq!(store.excess(), 0);
        store.charge(7);
        assert_eq!(store.excess(), 7);
    }

    #[test]
    fn a_file_is_read_in_pieces_and_removed() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::new(folder.path(), 0);
        let path = store.unused_path();
        store.append(&path, [&[1u8, 2, 3][..], &[4, 5][..]]).unwrap();
        store.append(&path, [&[6u8, 7][..]]).unwrap();
        let mut seen = Vec::new();
        store
            .drain(&path, 3, |piece| {
                seen.push(piece.to_vec());
                Ok(())
            })
            .unwrap();
        assert_eq!(seen, [vec![1, 2, 3], vec![4, 5, 6], vec![7]]);
        assert!(!path.exists());
    }
}
