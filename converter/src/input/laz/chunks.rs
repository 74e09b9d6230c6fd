//! The chunks of a LAZ file: by its chunk table, or by what each of them says of itself.

use super::head::ChunkHead;
use super::is_layered;
use super::table::{TABLE_HEADER, TABLE_POSITION, read_table, table_position};
use crate::error::{Error, Result};
use crate::input::Block;
use crate::scan::Scan;
use laz::LazVlr;
use laz::laszip::{ChunkTableEntry, CompressorType};
use std::fs::File;
use std::io::{BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;

/// The chunks of a file, one after the other.
pub struct Chunks {
    pub blocks: Vec<Block>,
    pub rescued: Option<Rescued>,
}

/// What was found wrong with the chunks of a file that are read all the same.
#[derive(Debug)]
pub struct Rescued {
    /// What is wrong with the chunk table, how the chunks were found, and what is lost.
    pub text: String,
    /// Points that are announced and are not in the file.
    pub lost: u64,
}

impl Rescued {
    /// The fault as an error, for those who want none: `INPUT_TRUNCATED` where points are missing, as of a file
    /// without compression, `INPUT_CORRUPT` where all are there.
    pub fn refusal(&self, path: &Path) -> Error {
        if self.lost > 0 { Error::truncated(path, &self.text) } else { Error::corrupt(path, &self.text) }
    }
}

/// The chunks by the chunk table or by what each says of itself, or `None` if neither is there and the file must be
/// read from start to end.
pub fn chunks(scan: &Scan, vlr: &LazVlr) -> Result<Option<Chunks>> {
    let path = &scan.path;
    if !has_chunks(scan) {
        return Ok(None);
    }
    let start = u64::from(scan.header.offset_to_point_data);
    let mut file = File::open(path).map(BufReader::new).map_err(|e| Error::reading(path, &e))?;
    let table_at = table_position(&mut file, start, scan.file_size).map_err(|e| Error::reading(path, &e))?;
    let Some(table_at) = table_at else {
        if is_layered(vlr) {
            let blocks = walk(&mut file, scan, vlr)?;
            return Ok(Some(Chunks { blocks, rescued: None }));
        }
        if vlr.uses_variable_size_chunks() {
            return Err(Error::corrupt(
                path,
                "chunks of various sizes need a chunk table, and there is none",
            ));
        }
        return Ok(None);
    };
    if table_at.saturating_add(TABLE_HEADER) > scan.file_size {
        let cause = format!("the chunk table should stand at byte {table_at} of {}", scan.file_size);
        return Err(Error::truncated(path, cause));
    }
    let first = start + TABLE_POSITION;
    let table = read_table(&mut file, scan, vlr, table_at, first)?;
    let blocks = blocks_of(&table, scan, vlr, first..table_at)?;
    let found: u64 = blocks.iter().map(|block| block.points).sum();
    match found.cmp(&scan.points) {
        std::cmp::Ordering::Equal => Ok(Some(Chunks { blocks, rescued: None })),
        std::cmp::Ordering::Less => rescue(&mut file, scan, vlr, blocks, first..table_at).map(Some),
        std::cmp::Ordering::Greater => Err(Error::corrupt(
            path,
            format!("the header declares {} points, the chunks hold {found}", scan.points),
        )),
    }
}

/// The chunks as the table lists them, one behind the other from the start of `area`, in which they must lie. Of a table
/// without numbers of points, all but the last chunk hold as many as the LASzip record says.
fn blocks_of(table: &[ChunkTableEntry], scan: &Scan, vlr: &LazVlr, area: Range<u64>) -> Result<Vec<Block>> {
    let path = &scan.path;
    let mut blocks = Vec::with_capacity(table.len());
    let (mut at, mut found) = (area.start, 0u64);
    for entry in table {
        let points = if vlr.uses_variable_size_chunks() {
            entry.point_count
        } else {
            u64::from(vlr.chunk_size()).min(scan.points.saturating_sub(found))
        };
        let end = at.checked_add(entry.byte_count).filter(|end| *end <= area.end);
        let (Some(end), Some(sum)) = (end, found.checked_add(points)) else {
            return Err(Error::corrupt(path, "the chunk table describes more data than the file has"));
        };
        if points > 0 {
            blocks.push(Block { at, bytes: entry.byte_count, points, expected: None });
        } else if entry.byte_count > 0 {
            return Err(Error::corrupt(path, "the file has more chunks than its announced points fill"));
        }
        (at, found) = (end, sum);
    }
    Ok(blocks)
}

/// The chunks of a file whose chunk table leads to fewer points than its header announces, though the file is whole:
/// `area` is where chunks may stand. Layered ones are found by their heads, whatever the table says; of others, only
/// a last one that the table lacks.
fn rescue(
    file: &mut BufReader<File>,
    scan: &Scan,
    vlr: &LazVlr,
    mut listed: Vec<Block>,
    area: Range<u64>,
) -> Result<Chunks> {
    let known: u64 = listed.iter().map(|block| block.points).sum();
    let end_of = |blocks: &[Block]| blocks.last().map_or(0, |block| block.at + block.bytes);
    let short = format!("the chunk table covers {known} of {} points", scan.points);
    if is_layered(vlr) {
        let blocks = by_heads(file, vlr, area, scan.points).map_err(|e| Error::reading(&scan.path, &e))?;
        let found: u64 = blocks.iter().map(|block| block.points).sum();
        if end_of(&blocks) < end_of(&listed) || blocks.is_empty() {
            return Err(Error::corrupt(&scan.path, short));
        }
        let lost = scan.points - found;
        let rest = match lost {
            0 => "all were recovered from the chunks".to_string(),
            _ => format!("{found} were recovered from the chunks, {lost} are not in the file"),
        };
        return Ok(Chunks { blocks, rescued: Some(Rescued { text: format!("{short}; {rest}"), lost }) });
    }
    let at = end_of(&listed).max(area.start);
    let missing = scan.points - known;
    let most = if vlr.uses_variable_size_chunks() { u64::MAX } else { u64::from(vlr.chunk_size()) };
    if at == area.end {
        return Err(Error::truncated(&scan.path, short));
    }
    if missing > most {
        return Err(Error::corrupt(&scan.path, short));
    }
    listed.push(Block { at, bytes: area.end - at, points: missing, expected: None });
    Ok(Chunks {
        blocks: listed,
        rescued: Some(Rescued {
            text: format!("{short}; the others are taken from the chunk behind the last one that it lists"),
            lost: 0,
        }),
    })
}

/// Layered chunks that follow each other from the start of `area`, up to the first that cannot be one.
fn by_heads(
    file: &mut (impl Read + Seek),
    vlr: &LazVlr,
    area: Range<u64>,
    most_points: u64,
) -> std::io::Result<Vec<Block>> {
    let (mut at, mut found, mut blocks) = (area.start, 0, Vec::new());
    while at < area.end {
        file.seek(SeekFrom::Start(at))?;
        let head = match ChunkHead::read(&mut file.by_ref().take(area.end - at), vlr) {
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => break,
            head => head?,
        };
        let (points, bytes) = (u64::from(head.points), head.bytes());
        found += points;
        if points == 0 || found > most_points || bytes > area.end - at {
            break;
        }
        blocks.push(Block { at, bytes, points, expected: None });
        at += bytes;
    }
    Ok(blocks)
}

/// The oldest LAZ files are one stream without chunks, compressor 1.
fn has_chunks(scan: &Scan) -> bool {
    let record = scan.record(LazVlr::USER_ID, LazVlr::RECORD_ID);
    let compressor = record.and_then(|r| r.data.first_chunk::<2>()).map(|b| u16::from_le_bytes(*b));
    compressor != Some(CompressorType::PointWise as u16)
}

/// The layered chunks of a file without chunk table: each one tells its points and its length itself.
fn walk(file: &mut (impl Read + Seek), scan: &Scan, vlr: &LazVlr) -> Result<Vec<Block>> {
    let path = &scan.path;
    let mut at = u64::from(scan.header.offset_to_point_data) + TABLE_POSITION;
    let (mut blocks, mut found) = (Vec::new(), 0);
    while found < scan.points {
        file.seek(SeekFrom::Start(at)).map_err(|e| Error::reading(path, &e))?;
        let head = ChunkHead::read(file, vlr).map_err(|e| Error::reading(path, &e))?;
        let (points, bytes) = (u64::from(head.points), head.bytes());
        if bytes > scan.file_size - at {
            let cause = format!("a chunk of {bytes} bytes begins at byte {at} of {}", scan.file_size);
            return Err(Error::truncated(path, cause));
        }
        found += points;
        if points == 0 || found > scan.points {
            let cause = format!("the header declares {} points, the chunks hold {found}", scan.points);
            return Err(Error::corrupt(path, cause));
        }
        blocks.push(Block { at, bytes, points, expected: None });
        at += bytes;
    }
    Ok(blocks)
}
