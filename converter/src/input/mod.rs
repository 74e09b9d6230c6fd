//! From a file's points to records of the output's format: planned and checked against the file's size first,
//! then decoded block by block on all threads.

pub mod contain;
mod laz;
pub mod merge;

use crate::error::{Error, Result};
use crate::progress::Meter;
use crate::record::exact::ExactChange;
use crate::record::mapping::Mapping;
use crate::scan::Scan;
use ::laz::LazVlr;
use rayon::prelude::*;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

/// Points per block of an uncompressed file.
const BLOCK_POINTS: u64 = 65_536;

/// A run of points that decodes on its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Block {
    /// First byte in the file.
    at: u64,
    bytes: u64,
    points: u64,
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
    storage: Storage,
    blocks: Vec<Block>,
}

impl Source {
    /// Errors: `INPUT_FORMAT`, `INPUT_EMPTY`, `INPUT_TRUNCATED`, `INPUT_CORRUPT`.
    pub fn plan(scan: Scan) -> Result<Self> {
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
        let (storage, blocks) = if scan.compressed {
            let vlr = laz::parameters(&scan)?;
            match laz::chunks(&scan, &vlr)? {
                Some(blocks) => (Storage::Chunks(vlr), blocks),
                None => (Storage::Stream(vlr), Vec::new()),
            }
        } else {
            (Storage::Plain, plain_blocks(&scan)?)
        };
        Ok(Self { scan, mapping, change: None, storage, blocks })
    }

    /// Decodes every point into `out`: zeroed, as many records of [`Mapping::target_length`] as there are points.
    ///
    /// Errors: `INPUT_CORRUPT`, `INPUT_TRUNCATED`, `INPUT_MIXED` (a coordinate that the output's scale and offset
    /// cannot hold exactly).
    pub fn read(&self, out: &mut [u8], meter: &Meter) -> Result<()> {
        if let Storage::Stream(vlr) = &self.storage {
            return laz::stream(&self.scan, vlr, out, self.mapping.target_length(), |raw, part| {
                self.finish(raw, part)?;
                meter.add((raw.len() / self.mapping.source_length()) as u64);
                Ok(())
            });
        }
        let mut rest = out;
        let mut work = Vec::with_capacity(self.blocks.len());
        for block in &self.blocks {
            let length = block.points as usize * self.mapping.target_length();
            let (part, after) = rest.split_at_mut(length);
            work.push((block, part));
            rest = after;
        }
        work.into_par_iter().try_for_each(|(block, part)| {
            self.read_block(block, part)?;
            meter.add(block.points);
            Ok(())
        })
    }

    fn read_block(&self, block: &Block, out: &mut [u8]) -> Result<()> {
        let path = &self.scan.path;
        let bytes = read_range(path, block)?;
        match &self.storage {
            Storage::Plain => self.finish(&bytes, out),
            Storage::Chunks(vlr) | Storage::Stream(vlr) if self.mapping.is_identity() => {
                laz::decode_chunk(&bytes, vlr, out).map_err(|cause| Error::corrupt(path, cause))?;
                self.change_positions(out)
            }
            Storage::Chunks(vlr) | Storage::Stream(vlr) => {
                let mut raw = vec![0; block.points as usize * self.mapping.source_length()];
                laz::decode_chunk(&bytes, vlr, &mut raw).map_err(|cause| Error::corrupt(path, cause))?;
                self.finish(&raw, out)
            }
        }
    }

    /// Maps decoded records of the input's format into records of the output.
    fn finish(&self, raw: &[u8], out: &mut [u8]) -> Result<()> {
        let records = raw.chunks_exact(self.mapping.source_length());
        if self.mapping.is_identity() {
            out.copy_from_slice(raw);
        } else {
            for (from, to) in records.zip(out.chunks_exact_mut(self.mapping.target_length())) {
                self.mapping.apply(from, to);
            }
        }
        self.change_positions(out)
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

fn plain_blocks(scan: &Scan) -> Result<Vec<Block>> {
    let length = u64::from(scan.header.point_data_record_length);
    let start = u64::from(scan.header.offset_to_point_data);
    let there = (scan.file_size - start) / length;
    if there < scan.points {
        let cause = format!("{} points are announced, {there} whole records are there", scan.points);
        return Err(Error::truncated(&scan.path, cause));
    }
    let blocks = (0..scan.points.div_ceil(BLOCK_POINTS)).map(|index| {
        let first = index * BLOCK_POINTS;
        let points = BLOCK_POINTS.min(scan.points - first);
        Block { at: start + first * length, bytes: points * length, points }
    });
    Ok(blocks.collect())
}

/// The bytes of one block, which planning has seen to lie in the file.
fn read_range(path: &Path, block: &Block) -> Result<Vec<u8>> {
    let read = || {
        let mut file = File::open(path)?;
        file.seek(SeekFrom::Start(block.at))?;
        let mut bytes = vec![0; block.bytes as usize];
        file.read_exact(&mut bytes)?;
        Ok(bytes)
    };
    read().map_err(|e: std::io::Error| Error::reading(path, &e))
}
