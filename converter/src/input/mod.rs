//! From a file's points to records of the output's format: planned and checked against the file's size first,
//! then decoded block by block on all threads.

pub mod contain;
mod laz;
pub mod merge;

use crate::copc::checksums::{self, Expected};
use crate::error::{Error, Result};
use crate::record::exact::ExactChange;
use crate::record::mapping::Mapping;
use crate::scan::Scan;
use ::laz::LazVlr;
use std::fs::File;
use std::io::{BufReader, Cursor, Read, Seek, SeekFrom};

/// Points of a piece, if their records are not too long for [`PIECE_BYTES`].
const PIECE_POINTS: usize = 65_536;
const PIECE_BYTES: usize = 1 << 22;

/// A chunk with more bytes is not read into memory before it is decoded.
const LARGE_CHUNK: u64 = 1 << 22;

/// Records that are handed on at a time, a number that depends on nothing but their length.
pub fn piece_points(record_length: usize) -> usize {
    (PIECE_BYTES / record_length.max(1)).clamp(1, PIECE_POINTS)
}

/// Points per block of an uncompressed file.
const BLOCK_POINTS: u64 = 65_536;

/// A run of points that decodes on its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Block {
    /// First byte in the file.
    at: u64,
    bytes: u64,
    points: u64,
    /// What its bytes must be, where the file says so.
    expected: Option<Expected>,
}

/// How the points of a file are stored.
#[derive(Debug)]
enum Storage {
    Plain,
    /// LAZ chunks, found by the chunk table.
    Chunks(LazVlr),
    /// LAZ without a chunk table (or without chunks): one thread reads it from start to end.
    Stream(LazVlr),
}

/// One input, checked as far as that is possible without decoding its points.
#[derive(Debug)]
pub struct Source {
    pub scan: Scan,
    pub mapping: Mapping,
    /// Set where the output's scale and offset are not this file's.
    pub change: Option<ExactChange>,
    /// How points were found that the file's own table does not lead to, and what is lost.
    pub rescued: Option<laz::Rescued>,
    storage: Storage,
    blocks: Vec<Block>,
}

impl Source {
    /// Errors: `INPUT_FORMAT`, `INPUT_EMPTY`, `INPUT_TRUNCATED`, `INPUT_CORRUPT`, `INPUT_CHECKSUM`.
    pub fn plan(mut scan: Scan) -> Result<Self> {
        let path = scan.path.clone();
        let length = scan.header.point_data_record_length;
        if scan.point_format > 10 {
            let cause = format!("point data record format {} is not known", scan.point_format);
            return Err(Error::format(&path, cause));
        }
        let mapping = Mapping::new(scan.point_format, length).ok_or_else(|| {
            let cause =
                format!("records of {length} bytes are too short for point format {}", scan.point_format);
            Error::corrupt(&path, cause)
        })?;
        check_scale(&scan)?;
        if scan.points == 0 {
            return Err(Error::empty(&path, "the header announces 0 points"));
        }
        let mut rescued = None;
        let (storage, blocks) = if scan.compressed {
            let vlr = laz::parameters(&scan)?;
            match laz::chunks(&scan, &vlr)? {
                Some(laz::Chunks { mut blocks, rescued: how }) => {
                    expect(&mut blocks, &scan)?;
                    scan.points = blocks.iter().map(|block| block.points).sum();
                    rescued = how;
                    (Storage::Chunks(vlr), blocks)
                }
                None => (Storage::Stream(vlr), Vec::new()),
            }
        } else {
            (Storage::Plain, plain_blocks(&scan)?)
        };
        Ok(Self { scan, mapping, change: None, rescued, storage, blocks })
    }

    /// Gives up the variable length records, which reading points does not need.
    pub fn forget_records(&mut self) {
        self.scan.vlrs = Vec::new();
        self.scan.evlrs = Vec::new();
    }

    /// Number of runs of points that decode on their own, see [`Self::read`].
    pub fn parts(&self) -> usize {
        if matches!(self.storage, Storage::Stream(_)) { 1 } else { self.blocks.len() }
    }

    /// Bytes of memory that reading a part takes, besides the pieces.
    pub fn part_bytes(&self) -> u64 {
        let largest = self.blocks.iter().map(|block| block.bytes).max().unwrap_or(0);
        match &self.storage {
            Storage::Chunks(vlr) if laz::is_layered(vlr) => largest,
            _ => largest.min(LARGE_CHUNK),
        }
    }

    /// Decodes a part, and hands on its records in the output's form, piece by piece and in order. `pieces` are
    /// buffers that may serve again.
    ///
    /// Errors: `INPUT_CHECKSUM`, `INPUT_CORRUPT`, `INPUT_TRUNCATED`, `INPUT_MIXED` (a coordinate that the output's scale
    /// and offset cannot hold exactly), and those of `each`.
    pub fn read(
        &self,
        part: usize,
        pieces: &mut Pieces,
        mut each: impl FnMut(&[u8]) -> Result<()>,
    ) -> Result<()> {
        let each: &mut Each = &mut each;
        let path = &self.scan.path;
        let vlr = match &self.storage {
            Storage::Stream(vlr) => return laz::stream(&self.scan, vlr, &mut self.sink(pieces, each)),
            Storage::Plain => return self.read_plain(&self.blocks[part], &mut self.sink(pieces, each)),
            Storage::Chunks(vlr) => vlr,
        };
        let block = &self.blocks[part];
        let mut file = self.checked(block)?;
        let mut sink = self.sink(pieces, each);
        if block.bytes > LARGE_CHUNK {
            return laz::decode_chunk(BufReader::with_capacity(1 << 18, file), block, path, vlr, &mut sink);
        }
        let mut bytes = vec![0; block.bytes as usize];
        file.read_exact(&mut bytes).map_err(|e| Error::reading(path, &e))?;
        laz::decode_chunk(Cursor::new(bytes), block, path, vlr, &mut sink)
    }

    /// Reads a part without keeping anything: its bytes are held against their checksum or, where there is none,
    /// decoded.
    ///
    /// Errors: as [`Self::read`].
    pub fn verify(&self, part: usize, pieces: &mut Pieces) -> Result<()> {
        match self.blocks.get(part) {
            Some(block) if block.expected.is_some() => self.checked(block).map(drop),
            _ => self.read(part, pieces, |_| Ok(())),
        }
    }

    /// Whether the parts have checksums.
    pub fn has_checksums(&self) -> bool {
        self.blocks.iter().any(|block| block.expected.is_some())
    }

    /// The file, standing at a block whose bytes are what they must be, as far as that is known.
    fn checked(&self, block: &Block) -> Result<File> {
        let path = &self.scan.path;
        let reading = |e| Error::reading(path, &e);
        let mut file = File::open(path).map_err(reading)?;
        file.seek(SeekFrom::Start(block.at)).map_err(reading)?;
        if let Some(Expected { node, checksum }) = block.expected {
            let found = checksums::of_source(&mut file, block.bytes).map_err(reading)?;
            if found != checksum {
                let cause = format!(
                    "the points of node {node} are damaged: their checksum is {found:08x}, {checksum:08x} is stored"
                );
                return Err(Error::checksum(path, cause));
            }
            file.seek(SeekFrom::Start(block.at)).map_err(reading)?;
        }
        Ok(file)
    }

    fn read_plain(&self, block: &Block, sink: &mut Sink) -> Result<()> {
        let path = &self.scan.path;
        let mut file = File::open(path).map_err(|e| Error::reading(path, &e))?;
        file.seek(SeekFrom::Start(block.at)).map_err(|e| Error::reading(path, &e))?;
        sink.fill(block.points, |raw| file.read_exact(raw).map_err(|e| Error::reading(path, &e)))
    }

    fn sink<'a>(&'a self, pieces: &'a mut Pieces, each: &'a mut Each<'a>) -> Sink<'a> {
        Sink { source: self, pieces, each }
    }

    fn change_positions(&self, out: &mut [u8]) -> Result<()> {
        let Some(change) = &self.change else { return Ok(()) };
        for record in out.chunks_exact_mut(self.mapping.target_length()) {
            change.apply(record).ok_or_else(|| {
                let cause = "a coordinate cannot be stored with the first input's scale and offset";
                Error::mixed(&self.scan.path, cause)
            })?;
        }
        Ok(())
    }
}

/// Who gets the records.
type Each<'a> = dyn FnMut(&[u8]) -> Result<()> + 'a;

/// Buffers for one piece.
#[derive(Debug, Default)]
pub struct Pieces {
    raw: Vec<u8>,
    mapped: Vec<u8>,
}

/// Maps decoded records of the input's form into the output's, and hands them on.
struct Sink<'a> {
    source: &'a Source,
    pieces: &'a mut Pieces,
    each: &'a mut Each<'a>,
}

impl Sink<'_> {
    /// Has pieces of `points` records in all decoded into the buffer, one after the other.
    fn fill(&mut self, points: u64, mut decode: impl FnMut(&mut [u8]) -> Result<()>) -> Result<()> {
        let mapping = &self.source.mapping;
        let (from, to) = (mapping.source_length(), mapping.target_length());
        let Pieces { raw, mapped } = &mut *self.pieces;
        let mut left = points;
        while left > 0 {
            let count = left.min(piece_points(from.max(to)) as u64) as usize;
            raw.resize(count * from, 0);
            decode(raw)?;
            let records = if mapping.is_identity() {
                &mut *raw
            } else {
                mapped.clear();
                mapped.resize(count * to, 0);
                for (record, out) in raw.chunks_exact(from).zip(mapped.chunks_exact_mut(to)) {
                    mapping.apply(record, out);
                }
                &mut *mapped
            };
            self.source.change_positions(records)?;
            (self.each)(records)?;
            left -= count as u64;
        }
        Ok(())
    }
}

fn check_scale(scan: &Scan) -> Result<()> {
    let usable = scan.scale().iter().all(|s| s.is_finite() && *s != 0.0)
        && scan.offset().iter().all(|o| o.is_finite());
    // An int32 times a scale, plus an offset, must be a number for every record that may come.
    let largest = (0..3).map(|i| scan.scale()[i].abs() * 2f64.powi(31) + scan.offset()[i].abs());
    if usable && largest.into_iter().all(f64::is_finite) {
        return Ok(());
    }
    let cause = format!("scale {:?} and offset {:?} give no coordinates", scan.scale(), scan.offset());
    Err(Error::corrupt(&scan.path, cause))
}

/// Tells the chunks of a file what they must be, where it has checksums.
fn expect(blocks: &mut [Block], scan: &Scan) -> Result<()> {
    let Some(expected) = checksums::expected(scan)? else { return Ok(()) };
    for block in blocks {
        block.expected = expected.get(&block.at).copied();
        if block.expected.is_none() {
            let cause = format!("its octree has no node for the points at byte {}", block.at);
            return Err(Error::checksum(&scan.path, cause));
        }
    }
    Ok(())
}

fn plain_blocks(scan: &Scan) -> Result<Vec<Block>> {
    let length = u64::from(scan.header.point_data_record_length);
    let start = u64::from(scan.header.offset_to_point_data);
    let there = (scan.file_size - start) / length;
    if there < scan.points {
        let cause = format!("the header declares {} points, the file holds {there}", scan.points);
        return Err(Error::truncated(&scan.path, cause));
    }
    let blocks = (0..scan.points.div_ceil(BLOCK_POINTS)).map(|index| {
        let first = index * BLOCK_POINTS;
        let points = BLOCK_POINTS.min(scan.points - first);
        Block { at: start + first * length, bytes: points * length, points, expected: None }
    });
    Ok(blocks.collect())
}
