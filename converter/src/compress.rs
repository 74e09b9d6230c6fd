//! LAS into LAZ: the same records, in the same order, with all that stands around them.

use crate::copc::chunk;
use crate::error::{Error, Result};
use crate::scan::Scan;
use crate::scan::variable_record::{HEADER, VariableRecord};
use crate::threads;
use laz::laszip::{ChunkTable, ChunkTableEntry};
use laz::{LazVlr, LazVlrBuilder};
use serde::Serialize;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// Points of a chunk, as LASzip has it.
const CHUNK: u32 = 50_000;

/// Where the header has what changes (LAS 1.4 R15, table 3).
const POINTS_AT: usize = 96;
const RECORD_COUNT: usize = 100;
const FORMAT: usize = 104;
const EXTENDED_AT: usize = 235;
const COMPRESSED: u8 = 0x80;

/// What was compressed.
#[derive(Debug, Serialize)]
pub struct Compressed {
    event: &'static str,
    points: u64,
    bytes: u64,
}

/// Compresses the points of a LAS 1.4 file of format 6, 7 or 8; everything else is copied byte for byte.
///
/// Memory is a few chunks for each processor. Errors: `INPUT_FORMAT` for other files, `INPUT_TRUNCATED`,
/// `INPUT_CORRUPT`, `OUTPUT_WRITE`.
pub fn compress(input: &Path, output: &Path) -> Result<Compressed> {
    let scan = Scan::read(input)?;
    let (laz, length) = parameters(&scan)?;
    let failed = |e: io::Error| Error::output_write(output, e);
    let reading = |e: io::Error| Error::reading(input, &e);

    let mut source = BufReader::with_capacity(1 << 20, File::open(input).map_err(reading)?);
    let mut front = vec![0; scan.header.offset_to_point_data as usize];
    source.read_exact(&mut front).map_err(reading)?;
    let mut content = Vec::new();
    laz.write_to(&mut content).map_err(failed)?;
    let record = VariableRecord::new(LazVlr::USER_ID, LazVlr::RECORD_ID, LazVlr::DESCRIPTION, content);
    let points_at = front.len() + HEADER + record.data.len();

    let mut out = BufWriter::with_capacity(1 << 20, File::create_new(output).map_err(failed)?);
    out.seek(SeekFrom::Start(points_at as u64)).map_err(failed)?;
    let points_end = write_points(&mut source, &mut out, &scan, &laz, length, output)?;
    let behind = io::copy(&mut source, &mut out).map_err(failed)?;
    rewrite_front(&mut front, points_at as u32, if behind > 0 { points_end } else { 0 });
    let mut finish = || {
        out.seek(SeekFrom::Start(0))?;
        out.write_all(&front)?;
        record.write(&mut out)?;
        out.flush()?;
        out.get_ref().sync_all()
    };
    finish().map_err(failed)?;
    Ok(Compressed { event: "compressed", points: scan.points, bytes: points_end + behind })
}

/// The compression, and the bytes of a record.
fn parameters(scan: &Scan) -> Result<(LazVlr, usize)> {
    let path = &scan.path;
    let extended = scan.header.version.minor >= 4 && (6..=8).contains(&scan.point_format);
    if scan.compressed || !extended {
        return Err(Error::format(path, "only LAS 1.4 of point format 6, 7 or 8 is compressed"));
    }
    let length = scan.header.point_data_record_length;
    let base = las::point::Format::new(scan.point_format).map_err(|e| Error::format(path, e))?.len();
    let extra = length.checked_sub(base).ok_or_else(|| Error::corrupt(path, "its records are too short"))?;
    let builder = LazVlrBuilder::default().with_point_format(scan.point_format, extra);
    let laz = builder.map_err(|e| Error::format(path, e))?.with_fixed_chunk_size(CHUNK).build();
    Ok((laz, usize::from(length)))
}

/// Writes the position of the chunk table, the chunks and the table, and returns the end.
fn write_points(
    source: &mut impl Read,
    out: &mut (impl Write + Seek),
    scan: &Scan,
    laz: &LazVlr,
    length: usize,
    output: &Path,
) -> Result<u64> {
    let failed = |e: io::Error| Error::output_write(output, e);
    let points_at = out.stream_position().map_err(failed)?;
    out.write_all(&[0; ChunkTable::OFFSET_SIZE]).map_err(failed)?;
    let threads = threads::available();
    let mut table = ChunkTable::with_capacity(scan.points.div_ceil(CHUNK.into()) as usize);
    let mut left = scan.points;
    while left > 0 {
        let mut blocks = Vec::new();
        while left > 0 && blocks.len() < threads {
            let count = left.min(CHUNK.into());
            let mut records = vec![0; count as usize * length];
            source.read_exact(&mut records).map_err(|e| Error::reading(&scan.path, &e))?;
            blocks.push((count, records));
            left -= count;
        }
        let chunks: Vec<_> = std::thread::scope(|scope| {
            let work: Vec<_> =
                blocks.iter().map(|(_, records)| scope.spawn(|| chunk::compress(records, laz))).collect();
            work.into_iter().map(|one| one.join()).collect()
        });
        for ((count, _), compressed) in blocks.iter().zip(chunks) {
            let bytes = match compressed {
                Ok(Ok(bytes)) => bytes,
                Ok(Err(e)) => return Err(Error::corrupt(&scan.path, e)),
                Err(_) => return Err(Error::internal(output, "a chunk could not be compressed")),
            };
            out.write_all(&bytes).map_err(failed)?;
            table.push(ChunkTableEntry { point_count: *count, byte_count: bytes.len() as u64 });
        }
    }
    let mut finish = || {
        let at = out.stream_position()?;
        table.write_to(&mut *out, laz)?;
        let end = out.stream_position()?;
        out.seek(SeekFrom::Start(points_at))?;
        out.write_all(&at.to_le_bytes())?;
        out.seek(SeekFrom::Start(end))
    };
    finish().map_err(failed)
}

fn rewrite_front(front: &mut [u8], points_at: u32, extended_at: u64) {
    front[POINTS_AT..POINTS_AT + 4].copy_from_slice(&points_at.to_le_bytes());
    let count = u32::from_le_bytes(front[RECORD_COUNT..RECORD_COUNT + 4].try_into().unwrap_or_default()) + 1;
    front[RECORD_COUNT..RECORD_COUNT + 4].copy_from_slice(&count.to_le_bytes());
    front[FORMAT] |= COMPRESSED;
    front[EXTENDED_AT..EXTENDED_AT + 8].copy_from_slice(&extended_at.to_le_bytes());
}
