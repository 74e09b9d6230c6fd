//! LAZ: where the chunks are, and how one is decoded without trusting it.

use super::contain::contained;
use super::{Block, Sink};
use crate::error::{Error, Result};
use crate::scan::Scan;
use laz::laszip::{ChunkTable, CompressorType};
use laz::record::{LayeredPointRecordDecompressor, RecordDecompressor, SequentialPointRecordDecompressor};
use laz::{LasZipDecompressor, LazItemRecordBuilder, LazItemType, LazVlr};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;

/// Bytes of the position of the chunk table, with which the point data begins.
const TABLE_POSITION: u64 = 8;
/// Bytes before the entries of the chunk table: version and number of chunks.
const TABLE_HEADER: u64 = 8;

/// The compression parameters, checked against the header.
pub fn parameters(scan: &Scan) -> Result<LazVlr> {
    let path = &scan.path;
    let record = scan.record(LazVlr::USER_ID, LazVlr::RECORD_ID);
    let record = record.ok_or_else(|| {
        Error::corrupt(path, "the points are compressed, but the LASzip record is not there")
    })?;
    let fail = |cause| Error::corrupt(path, format!("LASzip record: {cause}"));
    let vlr = contained(fail, || LazVlr::from_buffer(&record.data))?;
    let types = |items: &[laz::LazItem]| items.iter().map(|i| (i.item_type(), i.size())).collect::<Vec<_>>();
    let extra = scan.header.point_data_record_length - crate::record::LENGTHS[usize::from(scan.point_format)];
    let expected = LazItemRecordBuilder::default_for_point_format_id(scan.point_format, extra);
    let expected = expected.map_err(|e| Error::corrupt(path, e))?;
    if types(vlr.items()) != types(&expected) {
        return Err(Error::corrupt(
            path,
            "the LASzip record does not fit the point format and record length",
        ));
    }
    Ok(vlr)
}

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
    let mut blocks = Vec::with_capacity(table.len());
    let (mut at, mut found) = (first, 0u64);
    for entry in &table {
        let points = if vlr.uses_variable_size_chunks() {
            entry.point_count
        } else {
            u64::from(vlr.chunk_size()).min(scan.points.saturating_sub(found))
        };
        let end = at.checked_add(entry.byte_count).filter(|end| *end <= table_at);
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
    match found.cmp(&scan.points) {
        std::cmp::Ordering::Equal => Ok(Some(Chunks { blocks, rescued: None })),
        std::cmp::Ordering::Less => rescue(&mut file, scan, vlr, blocks, first..table_at).map(Some),
        std::cmp::Ordering::Greater => Err(Error::corrupt(
            path,
            format!("the header declares {} points, the chunks hold {found}", scan.points),
        )),
    }
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
        let head = ChunkHead::read(file, vlr)?;
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

/// Where the chunk table stands: said before the points, or, by a writer that could not go back, in the last
/// eight bytes of the file.
fn table_position(file: &mut BufReader<File>, start: u64, file_size: u64) -> std::io::Result<Option<u64>> {
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

fn read_table(
    file: &mut BufReader<File>,
    scan: &Scan,
    vlr: &LazVlr,
    table_at: u64,
    first: u64,
) -> Result<Vec<laz::laszip::ChunkTableEntry>> {
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

/// Whether the chunks are those of LASzip 3, whose layers must be in memory as a whole.
pub fn is_layered(vlr: &LazVlr) -> bool {
    vlr.items().first().is_some_and(|item| item.version() >= 3)
}

/// Decodes one chunk, at whose first byte `source` stands.
pub fn decode_chunk<R: Read + Seek + Send + Sync>(
    mut source: R,
    block: &Block,
    path: &Path,
    vlr: &LazVlr,
    sink: &mut Sink,
) -> Result<()> {
    let fail = |cause: String| {
        Error::corrupt(path, format!("a chunk of {} bytes cannot be decoded ({cause})", block.bytes))
    };
    if is_layered(vlr) {
        check_head(&mut source, block, vlr).map_err(fail)?;
        decode(LayeredPointRecordDecompressor::new(source), block.points, vlr, sink, fail)
    } else {
        decode(SequentialPointRecordDecompressor::new(source), block.points, vlr, sink, fail)
    }
}

fn decode<R>(
    mut decoder: impl RecordDecompressor<R>,
    points: u64,
    vlr: &LazVlr,
    sink: &mut Sink,
    fail: impl Fn(String) -> Error,
) -> Result<()> {
    contained(&fail, || decoder.set_fields_from(vlr.items()))?;
    sink.fill(points, |raw| contained(&fail, || Ok(decoder.decompress_many(raw)?)))
}

/// How a layered chunk (LASzip 3) begins: one plain record, the number of points (u32), the size of each layer (u32).
/// Its layers follow.
struct ChunkHead {
    /// Bytes of itself.
    bytes: u64,
    points: u32,
    /// Bytes of all layers.
    layers: u64,
}

impl ChunkHead {
    fn read(source: &mut impl Read, vlr: &LazVlr) -> std::io::Result<Self> {
        let layers: usize = vlr.items().iter().map(|item| layers_of(item.item_type())).sum();
        let record: usize = vlr.items().iter().map(|item| usize::from(item.size())).sum();
        let mut head = vec![0; record + 4 + layers * 4];
        source.read_exact(&mut head)?;
        let mut numbers = head[record..].as_chunks::<4>().0.iter().map(|b| u32::from_le_bytes(*b));
        let points = numbers.next().unwrap_or(0);
        Ok(Self { bytes: head.len() as u64, points, layers: numbers.map(u64::from).sum() })
    }

    /// Bytes of the chunk.
    fn bytes(&self) -> u64 {
        self.bytes + self.layers
    }
}

/// The decoder allocates each layer by its announced size, so the sizes must lie in the chunk; and it decodes as many
/// points as it is asked for, so they must be as many as there are. Leaves `source` where it was.
fn check_head(
    source: &mut (impl Read + Seek),
    block: &Block,
    vlr: &LazVlr,
) -> std::result::Result<(), String> {
    let head = ChunkHead::read(source, vlr).map_err(|e| e.to_string())?;
    source.seek(SeekFrom::Current(-(head.bytes as i64))).map_err(|e| e.to_string())?;
    if head.bytes() > block.bytes {
        return Err(format!("its layers are announced with {} bytes", head.layers));
    }
    if u64::from(head.points) != block.points {
        return Err(format!("it holds {} points, and {} should be there", head.points, block.points));
    }
    Ok(())
}

fn layers_of(item: LazItemType) -> usize {
    match item {
        LazItemType::Point14 => 9,
        LazItemType::RGBNIR14 => 2,
        LazItemType::Byte14(count) => count.into(),
        _ => 1,
    }
}

/// Decodes a file without chunk table from start to end; one of layered chunks has been walked through instead.
pub fn stream(scan: &Scan, vlr: &LazVlr, sink: &mut Sink) -> Result<()> {
    let path = &scan.path;
    if is_layered(vlr) {
        return Err(Error::corrupt(
            path,
            "layers need chunks, and the LASzip record says that there are none",
        ));
    }
    let mut file = File::open(path).map(BufReader::new).map_err(|e| Error::reading(path, &e))?;
    file.seek(SeekFrom::Start(scan.header.offset_to_point_data.into()))
        .map_err(|e| Error::reading(path, &e))?;
    let fail = |cause| Error::corrupt(path, cause);
    let mut decoder = contained(fail, || LasZipDecompressor::new(Forward(file), vlr.clone()))?;
    sink.fill(scan.points, |raw| {
        let mut early = false;
        let decoded = contained(fail, || {
            decoder.decompress_many(raw).map_err(|e| {
                early = e.kind() == std::io::ErrorKind::UnexpectedEof;
                e.into()
            })
        });
        decoded.map_err(
            |error| {
                if early { Error::truncated(path, "the compressed points end early") } else { error }
            },
        )
    })
}

/// A source that is read from here on and nowhere else: given a seekable one, the decoder looks for the chunk
/// table that is not there, and loses its place.
struct Forward(BufReader<File>);

impl Read for Forward {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        self.0.read(buffer)
    }
}

impl Seek for Forward {
    fn seek(&mut self, _: SeekFrom) -> std::io::Result<u64> {
        Err(std::io::ErrorKind::NotSeekable.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use laz::LazVlrBuilder;
    use std::io::Cursor;

    fn chunk(points: &[u8], format: u8) -> (Vec<u8>, LazVlr) {
        let vlr =
            LazVlrBuilder::default().with_point_format(format, 0).unwrap().with_variable_chunk_size().build();
        let bytes = crate::copc::chunk::compress(points, &vlr).unwrap();
        (bytes, vlr)
    }

    fn decoded(bytes: &[u8], vlr: &LazVlr, out: &mut [u8]) -> std::result::Result<(), String> {
        let mut source = Cursor::new(bytes);
        let block = Block { at: 0, bytes: bytes.len() as u64, points: out.len() as u64 / 36, expected: None };
        check_head(&mut source, &block, vlr)?;
        let fail = |cause| Error::corrupt(Path::new("a.laz"), cause);
        let decoded = contained(fail, || {
            let mut decoder = LayeredPointRecordDecompressor::new(source);
            decoder.set_fields_from(vlr.items())?;
            Ok(decoder.decompress_many(out)?)
        });
        decoded.map_err(|error| error.cause().to_string())
    }

    #[test]
    fn garbage_is_an_error_and_never_a_panic() {
        let points: Vec<u8> = (0..30 * 36u32).map(|i| (i * i % 251) as u8).collect();
        let (good, vlr) = chunk(&points, 7);
        let mut out = vec![0; points.len()];
        decoded(&good, &vlr, &mut out).unwrap();
        assert_eq!(out, points);
        for at in (0..good.len()).step_by(11) {
            let mut bad = good.clone();
            bad[at] ^= 0x55;
            let _ = decoded(&bad, &vlr, &mut out);
            assert!(decoded(&good[..at], &vlr, &mut out).is_err() || at + 8 > good.len(), "cut at {at}");
        }
    }

    #[test]
    fn lying_layer_sizes_are_refused_before_allocation() {
        let (mut bytes, vlr) = chunk(&[0; 360], 7);
        bytes[40..44].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(decoded(&bytes, &vlr, &mut [0; 360]).unwrap_err().contains("announced"));
    }

    #[test]
    fn another_number_of_points_is_refused() {
        let (bytes, vlr) = chunk(&[0; 360], 7);
        decoded(&bytes, &vlr, &mut [0; 360]).unwrap();
        for points in [9, 11] {
            let cause = decoded(&bytes, &vlr, &mut vec![0; points * 36]).unwrap_err();
            assert!(cause.contains("holds 10 points"), "{cause}");
        }
    }
}
