//! The chunk table of a LAZ file: where it stands, and what it lists.

use crate::error::{Error, Result};
use crate::input::contain::contained;
use crate::scan::Scan;
use laz::LazVlr;
use laz::laszip::{ChunkTable, ChunkTableEntry};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};

/// Bytes of the position of the chunk table, with which the point data begins.
pub const TABLE_POSITION: u64 = 8;
/// Bytes before the entries of the chunk table: version and number of chunks.
pub const TABLE_HEADER: u64 = 8;

/// The first byte of the chunk table, which is told before the points, at `start`, or, by a writer that could not go back,
/// in the last eight bytes of the file; `None` where neither tells one.
pub fn table_position(
    file: &mut BufReader<File>,
    start: u64,
    file_size: u64,
) -> std::io::Result<Option<u64>> {
    let mut read_at = |at: u64| -> std::io::Result<Option<u64>> {
        let mut bytes = [0; 8];
        file.seek(SeekFrom::Start(at))?;
        file.read_exact(&mut bytes)?;
        Ok(u64::try_from(i64::from_le_bytes(bytes)).ok().filter(|position| *position > start))
    };
    if let Some(position) = read_at(start)? {
        return Ok(Some(position));
    }
    let last = read_at(file_size - TABLE_POSITION)?;
    Ok(last.filter(|position| *position < file_size))
}

/// The entries of the chunk table that begins at byte `table_at`; the chunks begin at byte `first`.
///
/// Errors: `INPUT_CORRUPT` for more chunks than have room in between, and for a table that cannot be decoded.
pub fn read_table(
    file: &mut BufReader<File>,
    scan: &Scan,
    vlr: &LazVlr,
    table_at: u64,
    first: u64,
) -> Result<Vec<ChunkTableEntry>> {
    let path = &scan.path;
    let mut head = [0; TABLE_HEADER as usize];
    file.seek(SeekFrom::Start(table_at)).map_err(|e| Error::reading(path, &e))?;
    file.read_exact(&mut head).map_err(|e| Error::reading(path, &e))?;
    let announced = u64::from(u32::from_le_bytes([head[4], head[5], head[6], head[7]]));
    // A chunk begins with an uncompressed record, so no more chunks than records' lengths can be there; one
    // more for an empty last chunk.
    let room = table_at.saturating_sub(first) / u64::from(scan.header.point_data_record_length);
    if announced > room + 1 {
        return Err(Error::corrupt(path, format!("{announced} chunks are announced, {room} have room")));
    }
    file.seek(SeekFrom::Start(table_at)).map_err(|e| Error::reading(path, &e))?;
    let fail = |cause| Error::corrupt(path, format!("chunk table: {cause}"));
    let table = contained(fail, || Ok(ChunkTable::read(file, vlr.uses_variable_size_chunks())?))?;
    Ok(table.as_ref().to_vec())
}
