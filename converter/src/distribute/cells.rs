//! The points of the cells, each cell's in the order of the input: the first ones in a file, the last ones in memory.

use crate::error::Result;
use crate::octree::key::Key;
use crate::temporary::store::Store;
use std::collections::HashMap;
use std::path::PathBuf;

/// Bytes that a cell takes from memory at a time: a quarter of what it has, between these.
const SMALLEST_BLOCK: usize = 1 << 12;
const LARGEST_BLOCK: usize = 1 << 18;

/// The points of one cell.
#[derive(Debug, Default)]
pub struct Cell {
    pub points: u64,
    /// Smallest and largest Morton code.
    pub codes: (u64, u64),
    file: Option<PathBuf>,
    /// Whole records each.
    blocks: Vec<Vec<u8>>,
    /// Bytes of all blocks, used or not.
    resident: usize,
}

impl Cell {
    /// Appends whole records of `length` bytes with codes between two.
    pub fn append(&mut self, mut records: &[u8], length: usize, codes: (u64, u64), store: &Store) {
        let before = if self.points == 0 { codes } else { self.codes };
        self.codes = (before.0.min(codes.0), before.1.max(codes.1));
        self.points += (records.len() / length) as u64;
        while !records.is_empty() {
            let room = self.blocks.last().map_or(0, |block| block.capacity() - block.len()) / length * length;
            if room == 0 {
                let block = (self.resident / 4).clamp(SMALLEST_BLOCK, LARGEST_BLOCK).max(length);
                let block = Vec::with_capacity(block / length * length);
                store.charge(block.capacity() as u64);
                self.resident += block.capacity();
                self.blocks.push(block);
                continue;
            }
            let (now, later) = records.split_at(room.min(records.len()));
            if let Some(block) = self.blocks.last_mut() {
                block.extend_from_slice(now);
            }
            records = later;
        }
    }

    /// Moves what is in memory to the file.
    fn spill(&mut self, store: &Store) -> Result<()> {
        let path = self.file.get_or_insert_with(|| store.unused_path());
        store.append(path, self.blocks.iter().map(Vec::as_slice))?;
        self.blocks = Vec::new();
        store.release(self.resident as u64);
        self.resident = 0;
        Ok(())
    }

    /// Hands on all records in order, at most `piece` bytes at a time, and gives up their room.
    pub fn drain(self, piece: usize, store: &Store, mut each: impl FnMut(&[u8]) -> Result<()>) -> Result<()> {
        if let Some(path) = &self.file {
            store.drain(path, piece, &mut each)?;
        }
        for block in self.blocks {
            for part in block.chunks(piece) {
                each(part)?;
            }
            store.release(block.capacity() as u64);
        }
        Ok(())
    }

    /// Gives up all points unread.
    fn discard(self, store: &Store) {
        if let Some(path) = &self.file {
            // What cannot be removed now goes with the folder.
            let _ = std::fs::remove_file(path);
        }
        store.release(self.resident as u64);
    }

    /// All records, in order. They leave the store.
    pub fn load(self, length: usize, store: &Store) -> Result<Vec<u8>> {
        let mut all = Vec::with_capacity(self.points as usize * length);
        self.drain(LARGEST_BLOCK / length * length + length, store, |part| {
            all.extend_from_slice(part);
            Ok(())
        })?;
        Ok(all)
    }
}

/// The cells that hold points. They may be of various levels; none lies in another.
#[derive(Debug, Default)]
pub struct Cells(HashMap<Key, Cell>);

impl Cells {
    /// Appends records of `length` bytes to a cell; `codes` are their least and greatest Morton code.
    pub fn append(&mut self, key: Key, records: &[u8], length: usize, codes: (u64, u64), store: &Store) {
        self.0.entry(key).or_default().append(records, length, codes, store);
    }

    /// Where the store is overdrawn, spills the cells that hold most until half of it is free.
    pub fn relieve(&mut self, store: &Store) -> Result<()> {
        let excess = store.excess();
        if excess == 0 {
            return Ok(());
        }
        let mut left = excess + store.half();
        let mut largest: Vec<_> = self.0.values_mut().filter(|cell| cell.resident > 0).collect();
        largest.sort_unstable_by_key(|cell| std::cmp::Reverse(cell.resident));
        for cell in largest {
            let bytes = cell.resident as u64;
            cell.spill(store)?;
            left = left.saturating_sub(bytes);
            if left == 0 {
                break;
            }
        }
        Ok(())
    }

    /// Gives up all points.
    pub fn clear(&mut self, store: &Store) {
        std::mem::take(&mut self.0).into_values().for_each(|cell| cell.discard(store));
    }

    /// Takes out the cells with more than `most` points that a division makes smaller.
    pub fn take_larger(&mut self, most: u64) -> Vec<(Key, Cell)> {
        self.0.extract_if(|_, cell| cell.points > most && cell.codes.0 != cell.codes.1).collect()
    }

    /// The cells, in no order.
    pub fn into_cells(self) -> impl Iterator<Item = (Key, Cell)> {
        self.0.into_iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_is_kept_whatever_is_spilled() {
        let folder = tempfile::tempdir().unwrap();
        for budget in [0, 20_000, u64::MAX / 2] {
            let store = Store::new(folder.path(), budget);
            let mut cells = Cells::default();
            let keys = [Key::ROOT.child(1), Key::ROOT.child(6)];
            for round in 0..200u32 {
                for (index, key) in keys.iter().enumerate() {
                    let records: Vec<u8> =
                        (0..50 * (index as u32 + 1)).flat_map(|i| (round * 1000 + i).to_le_bytes()).collect();
                    cells.append(*key, &records, 4, (u64::from(round), u64::from(round)), &store);
                    cells.relieve(&store).unwrap();
                }
            }
            assert_eq!(store.spilled() > 0, budget < 1 << 20);
            let mut found = 0;
            for (key, cell) in cells.into_cells() {
                assert_eq!(cell.codes, (0, 199));
                let count = if key == keys[0] { 50 } else { 100 };
                let expected: Vec<u8> = (0..200u32)
                    .flat_map(|round| (0..count).flat_map(move |i| (round * 1000 + i).to_le_bytes()))
                    .collect();
                assert_eq!(cell.points, 200 * u64::from(count));
                assert!(cell.load(4, &store).unwrap() == expected);
                found += 1;
            }
            assert_eq!(found, 2);
            store.charge(1);
            store.release(1);
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        }
    }
}
