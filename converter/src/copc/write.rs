//! Writing the file: header and records, nodes, chunk table, hierarchy and other extended records.

use super::checksums;
use super::chunk::Node;
use super::header::{self, Layout, Points};
use super::hierarchy::{self, Chunk, Pages};
use super::info::{self, Info};
use super::records::Records;
use crate::error::{Error, Result};
use crate::octree::key::Key;
use crate::progress::Meter;
use crate::scan::variable_record::{COPC, COPC_HIERARCHY, EXTENDED_HEADER, HEADER, VariableRecord};
use crate::temporary::store::{Held, Store};
use las::raw::Header;
use laz::LazVlr;
use laz::laszip::{ChunkTable, ChunkTableEntry};
use std::collections::HashSet;
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::Path;

/// Bytes that readers of COPC ask for first. What stands before the points is kept within them where it can be.
const FIRST_REQUEST: usize = 1 << 16;

/// Everything that the file is made of.
pub struct Content<'a> {
    /// Header of the (first) input.
    pub input: &'a Header,
    pub points: Points,
    /// Root cube and GPS time; the page is filled in here.
    pub info: Info,
    pub laz: &'a LazVlr,
    pub records: &'a Records,
    /// Every node that has points, once; see [`ordered`].
    pub nodes: Vec<Node>,
    /// Where the nodes' chunks are.
    pub store: &'a Store,
}

/// Brings nodes into the order of the file: level by level, each along the Morton curve. The nodes above others that
/// have no points of their own come in too, empty, as the hierarchy wants it.
pub fn ordered(mut nodes: Vec<Node>) -> Vec<Node> {
    let mut known: HashSet<Key> = nodes.iter().map(|node| node.key).collect();
    for index in 0..nodes.len() {
        let mut key = nodes[index].key;
        while key.level > 0 && known.insert(key.parent()) {
            key = key.parent();
            nodes.push(Node { key, points: 0, chunk: Held::Memory(Vec::new()) });
        }
    }
    nodes.sort_unstable_by_key(|node| (node.key.level, node.key.morton()));
    nodes
}

/// Writes the whole file and returns its number of bytes.
///
/// Errors: `OUTPUT_WRITE` about `output`, `INTERNAL` where the chunks do not hold as many points as were read, and those
/// of the store.
pub fn write(file: &mut File, content: &Content, output: &Path, meter: &Meter) -> Result<u64> {
    let failed = |e: io::Error| Error::output_write(output, e);

    let mut out = BufWriter::with_capacity(1 << 20, file);
    let Content { input, points, info, laz: _, records, nodes, store: _ } = content;
    let pages = Pages::of(nodes.iter().map(|node| node.key));
    let front: usize = records.plain.iter().map(|record| HEADER + record.data.len()).sum();
    let front = usize::from(header::LENGTH) + HEADER + info::LENGTH + front;
    let copy_bytes = HEADER + hierarchy::copy_length(pages.root_entries());
    let copied = front + copy_bytes <= FIRST_REQUEST;
    let front = if copied { front + copy_bytes } else { front };
    let checksum_bytes = checksums::length(pages.entries());
    let in_front = front + HEADER + checksum_bytes <= FIRST_REQUEST;
    let points_at = if in_front { front + HEADER + checksum_bytes } else { front };
    let points_at = u32::try_from(points_at)
        .map_err(|_| failed(invalid("the variable length records take over 4 GiB")))?;

    // The front is written last, when it is known what stands in it.
    out.seek(SeekFrom::Start(points_at.into())).map_err(failed)?;
    let (chunks, table_end) = write_points(&mut out, content, points_at.into(), output, meter)?;
    let before_pages = if in_front { 0 } else { EXTENDED_HEADER + checksum_bytes };
    let page_at = table_end + (before_pages + EXTENDED_HEADER) as u64;
    let encoded = pages.encode(&chunks, page_at);
    let first_page = copied.then(|| encoded.first_page(page_at));
    let checksums = checksums::record(&encoded.checksums, page_at);
    let mut end = page_at + encoded.bytes.len() as u64;
    let layout = Layout {
        plain_records: 1 + records.plain.len() as u32 + u32::from(copied) + u32::from(in_front),
        points_at,
        extended_records: 1 + records.extended.len() as u32 + u32::from(!in_front),
        extended_at: table_end,
    };
    let info = Info { root_page: (page_at, encoded.root_bytes), ..(*info).clone() };
    let finish = || {
        if !in_front {
            checksums.write_extended(&mut out)?;
        }
        VariableRecord::new(COPC, COPC_HIERARCHY, "EPT hierarchy", encoded.bytes).write_extended(&mut out)?;
        for record in &records.extended {
            record.write_extended(&mut out)?;
            end += (EXTENDED_HEADER + record.data.len()) as u64;
        }
        out.seek(SeekFrom::Start(0))?;
        header::build(input, points, layout).write_to(&mut out).map_err(io::Error::other)?;
        info.record().write(&mut out)?;
        for record in records.plain.iter().chain(&first_page) {
            record.write(&mut out)?;
        }
        if in_front {
            checksums.write(&mut out)?;
        }
        out.flush()
    };
    finish().map_err(failed)?;
    Ok(end)
}

/// Writes the position of the chunk table, the chunks in the order of the nodes, and the table. Returns the
/// chunks and the end.
fn write_points(
    out: &mut (impl Write + Seek),
    content: &Content,
    points_at: u64,
    output: &Path,
    meter: &Meter,
) -> Result<(Vec<Chunk>, u64)> {
    let failed = |e: io::Error| Error::output_write(output, e);
    out.write_all(&[0; ChunkTable::OFFSET_SIZE]).map_err(failed)?;
    let mut at = points_at + ChunkTable::OFFSET_SIZE as u64;
    let nodes = &content.nodes;
    let mut chunks = Vec::with_capacity(nodes.len());
    let mut table = ChunkTable::with_capacity(nodes.len());
    let mut written = 0;
    for Node { key, points, chunk } in nodes {
        let mut chunk_of = Chunk { key: *key, offset: 0, bytes: 0, points: 0, checksum: 0 };
        if *points > 0 {
            chunk_of.points =
                i32::try_from(*points).map_err(|_| failed(invalid("a node has over 2^31 points")))?;
            let (held, bytes) = content.store.with(chunk, |bytes| {
                let held = super::chunk::points(bytes, usize::from(content.points.record_length));
                chunk_of.checksum = checksums::of(bytes);
                (held, out.write_all(bytes).map(|()| bytes.len()))
            })?;
            let bytes = bytes.map_err(failed)?;
            if held != Some(*points) {
                let cause = format!("a node of {points} points has a chunk of {}", held.unwrap_or(0));
                return Err(Error::internal(output, cause));
            }
            written += points;
            chunk_of.bytes = i32::try_from(bytes).map_err(|_| failed(invalid("a node takes over 2 GiB")))?;
            chunk_of.offset = at;
            table.push(ChunkTableEntry { point_count: *points, byte_count: bytes as u64 });
            at += bytes as u64;
            meter.add(*points);
        }
        chunks.push(chunk_of);
    }
    if written != content.points.count {
        let cause = format!("{} points were read, the nodes hold {written}", content.points.count);
        return Err(Error::internal(output, cause));
    }
    let mut finish = || {
        table.write_to(&mut *out, content.laz)?;
        let end = out.stream_position()?;
        out.seek(SeekFrom::Start(points_at))?;
        out.write_all(&at.to_le_bytes())?;
        out.seek(SeekFrom::Start(end))
    };
    let end = finish().map_err(failed)?;
    Ok((chunks, end))
}

fn invalid(cause: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, cause)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::copc::chunk;
    use crate::octree::cube::{Bounds, Cube};
    use crate::progress::{Silent, Stage};
    use crate::record::Target;

    /// Writes two nodes of three and two points, which are said to hold `said` points, in a file of `count`.
    fn written(said: [u64; 2], count: u64) -> Result<u64> {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::new(folder.path(), 1 << 20);
        let laz = chunk::parameters(6, 0).unwrap();
        let node = |key, there: usize, points| {
            let chunk = chunk::compress(&vec![0; there * Target::Plain.length()], &laz).unwrap();
            Node { key, points, chunk: store.keep(chunk).unwrap() }
        };
        let nodes = vec![node(Key::ROOT, 3, said[0]), node(Key::ROOT.child(0), 2, said[1])];
        let bounds = Bounds { min: [0.0; 3], max: [1.0; 3] };
        let record_length = Target::Plain.length() as u16;
        let content = Content {
            input: &Header::default(),
            points: Points { target: Target::Plain, record_length, count, by_return: [0; 15], bounds },
            info: Info { cube: Cube::around(&bounds, [0.01; 3]), root_page: (0, 0), gps_time: [0.0; 2] },
            laz: &laz,
            records: &Records { plain: Vec::new(), extended: Vec::new() },
            nodes,
            store: &store,
        };
        let path = folder.path().join("out.copc.laz");
        let meter = Meter::start(&Silent, Stage::Write, count);
        write(&mut File::create(&path).unwrap(), &content, &path, &meter)
    }

    #[test]
    fn points_that_are_missing_or_too_many_are_a_fault_of_the_program() {
        assert!(written([3, 2], 5).is_ok());
        for (said, count) in [([3, 2], 6), ([3, 2], 4), ([4, 1], 5), ([3, 3], 6)] {
            assert_eq!(written(said, count).unwrap_err().code(), "INTERNAL", "{said:?} of {count}");
        }
    }
}
