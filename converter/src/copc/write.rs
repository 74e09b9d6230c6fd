//! Writing the file: header and records, nodes, chunk table, hierarchy and other extended records.

use super::chunk;
use super::header::{self, Layout, Points};
use super::hierarchy::{self, Chunk};
use super::info::{self, Info};
use super::records::Records;
use crate::octree::sample::Node;
use crate::progress::Meter;
use crate::scan::variable_record::{COPC, COPC_HIERARCHY, EXTENDED_HEADER, HEADER, VariableRecord};
use las::raw::Header;
use laz::LazVlr;
use laz::laszip::{ChunkTable, ChunkTableEntry};
use rayon::prelude::*;
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};

/// Points compressed at a time: enough nodes for all threads, few enough to keep memory small.
const GROUP_POINTS: usize = 2_000_000;

/// Everything that the file is made of.
pub struct Content<'a> {
    /// Header of the (first) input.
    pub input: &'a Header,
    pub points: Points,
    /// Root cube and GPS time; the page is filled in here.
    pub info: Info,
    pub laz: &'a LazVlr,
    pub records: &'a Records,
    /// Records of `points.record_length`, which the nodes number.
    pub data: &'a [u8],
    pub nodes: &'a [Node],
}

/// Writes the whole file and returns its number of bytes.
pub fn write(file: &mut File, content: &Content, meter: &Meter) -> io::Result<u64> {
    let mut out = BufWriter::with_capacity(1 << 20, file);
    let records = content.records;
    let front: usize = records.plain.iter().map(|record| HEADER + record.data.len()).sum();
    let points_at = usize::from(header::LENGTH) + HEADER + info::LENGTH + front;
    let points_at =
        u32::try_from(points_at).map_err(|_| invalid("the variable length records take over 4 GiB"))?;

    // The front is written last, when it is known what stands in it.
    out.seek(SeekFrom::Start(points_at.into()))?;
    let (chunks, table_end) = write_points(&mut out, content, points_at.into(), meter)?;
    let page_at = table_end + EXTENDED_HEADER as u64;
    let (pages, root_bytes) = hierarchy::encode(&chunks, page_at);
    let mut end = page_at + pages.len() as u64;
    VariableRecord::new(COPC, COPC_HIERARCHY, "EPT hierarchy", pages).write_extended(&mut out)?;
    for record in &records.extended {
        record.write_extended(&mut out)?;
        end += (EXTENDED_HEADER + record.data.len()) as u64;
    }

    let layout = Layout {
        plain_records: 1 + records.plain.len() as u32,
        points_at,
        extended_records: 1 + records.extended.len() as u32,
        extended_at: table_end,
    };
    out.seek(SeekFrom::Start(0))?;
    header::build(content.input, &content.points, layout).write_to(&mut out).map_err(io::Error::other)?;
    let info = Info { root_page: (page_at, root_bytes), ..content.info.clone() };
    info.record().write(&mut out)?;
    for record in &records.plain {
        record.write(&mut out)?;
    }
    out.flush()?;
    Ok(end)
}

/// Writes the position of the chunk table, the chunks in the order of the nodes, and the table. Returns the
/// chunks and the end.
fn write_points(
    out: &mut (impl Write + Seek),
    content: &Content,
    points_at: u64,
    meter: &Meter,
) -> io::Result<(Vec<Chunk>, u64)> {
    out.write_all(&[0; ChunkTable::OFFSET_SIZE])?;
    let mut at = points_at + ChunkTable::OFFSET_SIZE as u64;
    let mut chunks = Vec::with_capacity(content.nodes.len());
    let mut table = ChunkTable::with_capacity(content.nodes.len());
    for group in groups(content.nodes) {
        let compressed: Vec<_> = group.par_iter().map(|node| compress(node, content, meter)).collect();
        for (node, bytes) in group.iter().zip(compressed) {
            let bytes = bytes?;
            let size = i32::try_from(bytes.len()).map_err(|_| invalid("a node takes over 2 GiB"))?;
            let points =
                i32::try_from(node.points.len()).map_err(|_| invalid("a node has over 2^31 points"))?;
            chunks.push(Chunk { key: node.key, offset: at, bytes: size, points });
            table.push(ChunkTableEntry {
                point_count: node.points.len() as u64,
                byte_count: bytes.len() as u64,
            });
            out.write_all(&bytes)?;
            at += bytes.len() as u64;
        }
    }
    table.write_to(&mut *out, content.laz)?;
    let end = out.stream_position()?;
    out.seek(SeekFrom::Start(points_at))?;
    out.write_all(&at.to_le_bytes())?;
    out.seek(SeekFrom::Start(end))?;
    Ok((chunks, end))
}

/// Runs of nodes of about [`GROUP_POINTS`], at least one node each.
fn groups(nodes: &[Node]) -> impl Iterator<Item = &[Node]> {
    let mut rest = nodes;
    std::iter::from_fn(move || {
        let mut points = 0;
        let count = rest.iter().take_while(|node| {
            let room = points < GROUP_POINTS;
            points += node.points.len();
            room
        });
        let (group, after) = rest.split_at(count.count());
        rest = after;
        (!group.is_empty()).then_some(group)
    })
}

fn compress(node: &Node, content: &Content, meter: &Meter) -> io::Result<Vec<u8>> {
    let length = usize::from(content.points.record_length);
    let mut records = Vec::with_capacity(node.points.len() * length);
    for index in &node.points {
        let from = *index as usize * length;
        records.extend_from_slice(&content.data[from..from + length]);
    }
    let bytes = chunk::compress(&records, content.laz).map_err(io::Error::other)?;
    meter.add(node.points.len() as u64);
    Ok(bytes)
}

fn invalid(cause: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, cause)
}
