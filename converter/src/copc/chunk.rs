//! One node as one LAZ chunk.

use laz::record::{LayeredPointRecordCompressor, RecordCompressor};
use laz::{LazVlr, LazVlrBuilder};

/// The compression of an output: chunks of any number of points.
pub fn parameters(point_format: u8, extra: u16) -> laz::Result<LazVlr> {
    Ok(LazVlrBuilder::default().with_point_format(point_format, extra)?.with_variable_chunk_size().build())
}

/// Compresses whole records of format 6, 7 or 8.
pub fn compress(records: &[u8], vlr: &LazVlr) -> laz::Result<Vec<u8>> {
    let mut compressor = LayeredPointRecordCompressor::new(Vec::with_capacity(records.len() / 4));
    compressor.set_fields_from(vlr.items())?;
    compressor.compress_many(records)?;
    compressor.done()?;
    Ok(compressor.into_inner())
}
