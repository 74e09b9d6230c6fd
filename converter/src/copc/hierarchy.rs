//! The hierarchy: an entry of 32 bytes per node, in pages that a reader fetches one by one. It stands behind the points,
//! where COPC has it; a copy of its root page stands before them, so that it comes with the header: user id `groma`,
//! record id 5 (docs/record.md).

use crate::octree::key::Key;
use crate::scan::variable_record::{GROMA, GROMA_FIRST_PAGE, VariableRecord};
use std::collections::{HashMap, VecDeque};

/// Bytes of an entry: level, x, y, z, offset (u64), byte size, point count.
pub const ENTRY: usize = 32;

/// Levels that a page covers before deep branches go to pages of their own.
const PAGE_LEVELS: u32 = 5;

/// A branch with fewer nodes stays in its parent's page: a request costs more than its few bytes.
const SMALLEST_PAGE: usize = 256;

/// Entries that the root page has at most, where fewer levels of it make that possible: it is read with the header.
const ROOT_ENTRIES: usize = 1024;

/// The same for the branches below a root page that covers fewer levels.
const SMALLEST_PAGE_BELOW_ROOT: usize = 32;

/// Bytes before the copy of the root page: version (u32), number of entries (u32), byte of the root page (u64).
const COPY_HEADER: usize = 16;

/// The only version of the copy that there is.
const COPY_VERSION: u32 = 1;

/// Point count of an entry that points to a page.
const PAGE_MARK: i32 = -1;

/// A node's chunk in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Chunk {
    pub key: Key,
    pub offset: u64,
    pub bytes: i32,
    pub points: i32,
    /// See [`super::checksums`].
    pub checksum: u32,
}

/// An entry as it is read: its numbers may be anything.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    /// Level, x, y, z.
    pub key: [u32; 4],
    pub offset: u64,
    pub bytes: i32,
    /// -1 for a reference to a page.
    pub points: i32,
}

impl Entry {
    /// Takes an entry from the front of `bytes`; `None` where a whole one is not there.
    pub fn parse(bytes: &[u8]) -> Option<Self> {
        let bytes: &[u8; ENTRY] = bytes.first_chunk()?;
        let (words, _) = bytes.as_chunks::<4>();
        let word = |index: usize| u32::from_le_bytes(words[index]);
        Some(Self {
            key: std::array::from_fn(word),
            offset: u64::from(word(4)) | u64::from(word(5)) << 32,
            bytes: word(6) as i32,
            points: word(7) as i32,
        })
    }
}

/// Which entries stand in which page, known before the chunks have their places.
pub struct Pages(Vec<(Key, Vec<Slot>)>);

/// The hierarchy as it stands in the file.
pub struct Encoded {
    /// All pages, the root page first.
    pub bytes: Vec<u8>,
    /// Bytes of the root page.
    pub root_bytes: u64,
    /// The checksum of each entry's chunk; 0 for a node without points and for a reference to a page.
    pub checksums: Vec<u32>,
}

/// Bytes of the data of the record that has a copy of a root page.
pub fn copy_length(entries: usize) -> usize {
    COPY_HEADER + (ENTRY + 4) * entries
}

impl Encoded {
    /// The record with the copy of the root page, which itself stands at byte `start`, and the checksums of its entries.
    pub fn first_page(&self, start: u64) -> VariableRecord {
        let page = &self.bytes[..self.root_bytes as usize];
        let entries = page.len() / ENTRY;
        let mut data = Vec::with_capacity(copy_length(entries));
        data.extend(COPY_VERSION.to_le_bytes());
        data.extend((entries as u32).to_le_bytes());
        data.extend(start.to_le_bytes());
        data.extend(page);
        data.extend(self.checksums[..entries].iter().flat_map(|checksum| checksum.to_le_bytes()));
        VariableRecord::new(GROMA, GROMA_FIRST_PAGE, "first page of the octree", data)
    }
}

impl Pages {
    /// The pages for the nodes given, each once, parents before children.
    pub fn of(keys: impl Iterator<Item = Key>) -> Self {
        let tree = Tree::of(keys);
        let mut pages = Vec::new();
        let mut open = VecDeque::from([Key::ROOT]);
        while let Some(root) = open.pop_front() {
            let page = if root == Key::ROOT {
                tree.root_page()
            } else {
                tree.page(root, PAGE_LEVELS, SMALLEST_PAGE)
            };
            open.extend(page.iter().filter_map(|slot| match slot {
                Slot::Page(key) => Some(*key),
                Slot::Node(_) => None,
            }));
            pages.push((root, page));
        }
        Self(pages)
    }

    /// Number of entries of all pages.
    pub fn entries(&self) -> usize {
        self.0.iter().map(|(_, page)| page.len()).sum()
    }

    /// Number of entries of the root page.
    pub fn root_entries(&self) -> usize {
        self.0.first().map_or(0, |(_, page)| page.len())
    }

    /// Encodes the pages to stand at byte `start` of the file. `chunks` has every node that the pages were made for.
    pub fn encode(&self, chunks: &[Chunk], start: u64) -> Encoded {
        let mut places = HashMap::new();
        let mut at = start;
        for (root, page) in &self.0 {
            let bytes = page.len() * ENTRY;
            places.insert(*root, (at, bytes));
            at += bytes as u64;
        }
        let chunks: HashMap<Key, &Chunk> = chunks.iter().map(|chunk| (chunk.key, chunk)).collect();
        let mut bytes = Vec::with_capacity((at - start) as usize);
        let mut checksums = Vec::with_capacity(self.entries());
        for slot in self.0.iter().flat_map(|(_, page)| page) {
            match slot {
                Slot::Node(key) => {
                    let chunk = chunks[key];
                    push(&mut bytes, *key, chunk.offset, chunk.bytes, chunk.points);
                    checksums.push(chunk.checksum);
                }
                Slot::Page(key) => {
                    let (offset, length) = places[key];
                    push(&mut bytes, *key, offset, length as i32, PAGE_MARK);
                    checksums.push(0);
                }
            }
        }
        Encoded { bytes, root_bytes: places[&Key::ROOT].1 as u64, checksums }
    }
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
    Node(Key),
    Page(Key),
}

/// Number of nodes from each node down, itself counted.
struct Tree(HashMap<Key, usize>);

impl Tree {
    fn of(keys: impl Iterator<Item = Key>) -> Self {
        let keys: Vec<_> = keys.collect();
        let mut sizes: HashMap<_, _> = keys.iter().map(|key| (*key, 1)).collect();
        for key in keys.iter().rev().filter(|key| key.level > 0) {
            let size = sizes[key];
            *sizes.entry(key.parent()).or_insert(0) += size;
        }
        Self(sizes)
    }

    /// The root page, of as many levels as keep it short.
    fn root_page(&self) -> Vec<Slot> {
        let mut page = self.page(Key::ROOT, PAGE_LEVELS, SMALLEST_PAGE);
        for levels in (2..PAGE_LEVELS).rev() {
            if page.len() <= ROOT_ENTRIES {
                break;
            }
            page = self.page(Key::ROOT, levels, SMALLEST_PAGE_BELOW_ROOT);
        }
        page
    }

    /// The entries of the page that begins with a node, level by level. Branches of `smallest` nodes or more that begin
    /// `levels` below it have pages of their own.
    fn page(&self, root: Key, levels: u32, smallest: usize) -> Vec<Slot> {
        let mut slots = Vec::new();
        let mut open = VecDeque::from([root]);
        while let Some(key) = open.pop_front() {
            let Some(size) = self.0.get(&key) else { continue };
            if key.level == root.level + levels && *size >= smallest {
                slots.push(Slot::Page(key));
                continue;
            }
            slots.push(Slot::Node(key));
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
                checksum: 7 * i as u32,
            };
            chunks.extend(level.iter().enumerate().map(chunk));
            level = level.iter().flat_map(|key| (0..4).map(|octant| key.child(octant))).collect();
        }
        chunks
    }

    /// Reads the pages as a COPC reader does, and the checksum of each entry where docs/record.md has it.
    fn read(encoded: &Encoded, start: u64, page: (u64, u64), nodes: &mut Vec<Chunk>, pages: &mut usize) {
        *pages += 1;
        let first = (page.0 - start) as usize / ENTRY;
        for index in first..first + page.1 as usize / ENTRY {
            let entry = Entry::parse(&encoded.bytes[index * ENTRY..]).unwrap();
            let Entry { key: [level, x, y, z], offset, bytes, points } = entry;
            let checksum = encoded.checksums[index];
            let key = Key { level, x, y, z };
            match points {
                PAGE_MARK => read(encoded, start, (offset, bytes as u64), nodes, pages),
                points => nodes.push(Chunk { key, offset, bytes, points, checksum }),
            }
        }
    }

    fn round_trip(chunks: &[Chunk]) -> usize {
        let layout = Pages::of(chunks.iter().map(|chunk| chunk.key));
        let encoded = layout.encode(chunks, 5000);
        let (mut nodes, mut pages) = (Vec::new(), 0);
        read(&encoded, 5000, (5000, encoded.root_bytes), &mut nodes, &mut pages);
        let order = |c: &Chunk| (c.key.level, c.key.morton());
        let mut expected = chunks.to_vec();
        expected.sort_by_key(order);
        nodes.sort_by_key(order);
        assert_eq!(nodes, expected);
        assert_eq!(encoded.bytes.len(), (chunks.len() + pages - 1) * ENTRY);
        assert_eq!([layout.entries(), encoded.checksums.len()], [chunks.len() + pages - 1; 2]);
        pages
    }

    #[test]
    fn a_small_tree_is_one_page() {
        assert_eq!(round_trip(&full_tree(1)), 1);
        assert_eq!(round_trip(&full_tree(5)), 1);
    }

    #[test]
    fn a_large_tree_has_pages() {
        // The root page covers four levels, since five would have 1,365 entries; the pages below it five each.
        assert_eq!(round_trip(&full_tree(10)), 1 + 4usize.pow(4));
    }

    #[test]
    fn the_root_page_is_short_whatever_the_tree() {
        for levels in 1..10 {
            let entries = Pages::of(full_tree(levels).iter().map(|chunk| chunk.key)).root_entries();
            assert!(entries <= ROOT_ENTRIES, "{levels} levels: {entries}");
        }
        assert_eq!(Pages::of(full_tree(5).iter().map(|chunk| chunk.key)).root_entries(), 341);
    }
}
