//! The hierarchy: an entry of 32 bytes per node, in pages that a reader fetches one by one.

use crate::octree::key::Key;
use std::collections::{HashMap, VecDeque};

/// Bytes of an entry: level, x, y, z, offset (u64), byte size, point count.
pub const ENTRY: usize = 32;

/// Levels that a page covers before deep branches go to pages of their own.
const PAGE_LEVELS: u32 = 5;

/// A branch with fewer nodes stays in its parent's page: a request costs more than its few bytes.
const SMALLEST_PAGE: usize = 256;

/// Point count of an entry that points to a page.
const PAGE_MARK: i32 = -1;

/// A node's chunk in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Chunk {
    pub key: Key,
    pub offset: u64,
    pub bytes: i32,
    pub points: i32,
}

/// Encodes the hierarchy to stand at `start` in the file. The root page comes first; the second value is its
/// number of bytes. `chunks` holds every node once, parents before children.
pub fn encode(chunks: &[Chunk], start: u64) -> (Vec<u8>, u64) {
    let tree = Tree::of(chunks);
    let mut pages = Vec::new();
    let mut open = VecDeque::from([Key::ROOT]);
    while let Some(root) = open.pop_front() {
        let page = tree.page(root);
        open.extend(page.iter().filter_map(|slot| match slot {
            Slot::Page(key) => Some(*key),
            Slot::Node(_) => None,
        }));
        pages.push((root, page));
    }
    let mut places = HashMap::new();
    let mut at = start;
    for (root, page) in &pages {
        let bytes = page.len() * ENTRY;
        places.insert(*root, (at, bytes));
        at += bytes as u64;
    }
    let mut out = Vec::with_capacity((at - start) as usize);
    for slot in pages.iter().flat_map(|(_, page)| page) {
        match slot {
            Slot::Node(chunk) => push(&mut out, chunk.key, chunk.offset, chunk.bytes, chunk.points),
            Slot::Page(key) => {
                let (offset, bytes) = places[key];
                push(&mut out, *key, offset, bytes as i32, PAGE_MARK);
            }
        }
    }
    (out, places[&Key::ROOT].1 as u64)
}

fn push(out: &mut Vec<u8>, key: Key, offset: u64, bytes: i32, points: i32) {
    for value in [key.level, key.x, key.y, key.z] {
        out.extend(value.to_le_bytes());
    }
    out.extend(offset.to_le_bytes());
    out.extend(bytes.to_le_bytes());
    out.extend(points.to_le_bytes());
}

enum Slot {
    Node(Chunk),
    Page(Key),
}

struct Tree {
    chunks: HashMap<Key, Chunk>,
    /// Number of nodes from a node down, itself counted.
    sizes: HashMap<Key, usize>,
}

impl Tree {
    fn of(chunks: &[Chunk]) -> Self {
        let mut sizes: HashMap<_, _> = chunks.iter().map(|c| (c.key, 1)).collect();
        for key in chunks.iter().rev().map(|c| c.key).filter(|key| key.level > 0) {
            let size = sizes[&key];
            let parent = Key { level: key.level - 1, x: key.x >> 1, y: key.y >> 1, z: key.z >> 1 };
            *sizes.entry(parent).or_insert(0) += size;
        }
        Self { chunks: chunks.iter().map(|c| (c.key, *c)).collect(), sizes }
    }

    /// The entries of the page that begins with a node, level by level.
    fn page(&self, root: Key) -> Vec<Slot> {
        let mut slots = Vec::new();
        let mut open = VecDeque::from([root]);
        while let Some(key) = open.pop_front() {
            let Some(chunk) = self.chunks.get(&key) else { continue };
            if key.level == root.level + PAGE_LEVELS && self.sizes[&key] >= SMALLEST_PAGE {
                slots.push(Slot::Page(key));
                continue;
            }
            slots.push(Slot::Node(*chunk));
            open.extend((0..8).map(|octant| key.child(octant)));
        }
        slots
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn full_tree(levels: u32) -> Vec<Chunk> {
        let mut chunks = Vec::new();
        let mut level = vec![Key::ROOT];
        for _ in 0..levels {
            let chunk = |(i, key): (usize, &Key)| Chunk {
                key: *key,
                offset: i as u64,
                bytes: 10,
                points: 1 + i as i32,
            };
            chunks.extend(level.iter().enumerate().map(chunk));
            level = level.iter().flat_map(|key| (0..4).map(|octant| key.child(octant))).collect();
        }
        chunks
    }

    /// Reads the pages as a COPC reader does.
    fn read(bytes: &[u8], start: u64, page: (u64, u64), nodes: &mut Vec<Chunk>, pages: &mut usize) {
        *pages += 1;
        let from = (page.0 - start) as usize;
        for entry in bytes[from..from + page.1 as usize].chunks_exact(ENTRY) {
            let int = |at: usize| i32::from_le_bytes(entry[at..at + 4].try_into().unwrap());
            let key = Key { level: int(0) as u32, x: int(4) as u32, y: int(8) as u32, z: int(12) as u32 };
            let offset = u64::from_le_bytes(entry[16..24].try_into().unwrap());
            match int(28) {
                PAGE_MARK => read(bytes, start, (offset, int(24) as u64), nodes, pages),
                points => nodes.push(Chunk { key, offset, bytes: int(24), points }),
            }
        }
    }

    fn round_trip(chunks: &[Chunk]) -> usize {
        let (bytes, root) = encode(chunks, 5000);
        let (mut nodes, mut pages) = (Vec::new(), 0);
        read(&bytes, 5000, (5000, root), &mut nodes, &mut pages);
        let order = |c: &Chunk| (c.key.level, c.key.morton());
        let mut expected = chunks.to_vec();
        expected.sort_by_key(order);
        nodes.sort_by_key(order);
        assert_eq!(nodes, expected);
        assert_eq!(bytes.len(), (chunks.len() + pages - 1) * ENTRY);
        pages
    }

    #[test]
    fn a_small_tree_is_one_page() {
        assert_eq!(round_trip(&full_tree(1)), 1);
        assert_eq!(round_trip(&full_tree(6)), 1);
    }

    #[test]
    fn a_large_tree_has_pages() {
        assert_eq!(round_trip(&full_tree(10)), 1 + 4usize.pow(5));
    }
}
