//! One node as one LAZ chunk.

use crate::octree::key::Key;
use crate::temporary::store::Held;
use laz::record::{LayeredPointRecordCompressor, RecordCompressor};
use laz::{LazVlr, LazVlrBuilder};
use std::io::Cursor;

/// The compression of an output: chunks of any number of points.
pub fn parameters(point_format: u8, extra: u16) -> laz::Result<LazVlr> {
    Ok(LazVlrBuilder::default().with_point_format(point_format, extra)?.with_variable_chunk_size().build())
}

/// A finished node: its LAZ chunk, held until the file is written.
#[derive(Debug)]
pub struct Node {
    pub key: Key,
    pub points: u64,
    pub chunk: Held,
}

/// A chunk that is being made of records of format 6, 7 or 8.
pub struct Compressor(LayeredPointRecordCompressor<'static, Cursor<Vec<u8>>>);

impl Compressor {
    /// An empty chunk, compressed as the record says.
    pub fn new(vlr: &LazVlr) -> laz::Result<Self> {
        let mut compressor = LayeredPointRecordCompressor::new(Cursor::new(Vec::new()));
        compressor.set_fields_from(vlr.items())?;
        Ok(Self(compressor))
    }

    /// Appends whole records.
    pub fn add(&mut self, records: &[u8]) -> laz::Result<()> {
        Ok(self.0.compress_many(records)?)
    }

    /// The bytes of the chunk.
    pub fn finish(mut self) -> laz::Result<Vec<u8>> {
        self.0.done()?;
        Ok(self.0.into_inner().into_inner())
    }
}

/// The points that a chunk says it holds, after its first record of `length` bytes.
pub fn points(chunk: &[u8], length: usize) -> Option<u64> {
    chunk.get(length..)?.first_chunk::<4>().map(|bytes| u64::from(u32::from_le_bytes(*bytes)))
}

/// Compresses whole records.
pub fn compress(records: &[u8], vlr: &LazVlr) -> laz::Result<Vec<u8>> {
    let mut compressor = Compressor::new(vlr)?;
    compressor.add(records)?;
    compressor.finish()
}
