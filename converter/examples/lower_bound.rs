//! What no converter can beat on a machine: the crate `laz`, on all cores, decompresses a LAZ file, compresses the
//! points again as they are and writes them, with no octree in between.
//!
//! `cargo run --release --example lower_bound IN.laz OUT` prints one JSON object: `{"seconds":…,"bytes":…}`. What it
//! writes are LAZ chunks without a header: bytes, not a file.

use groma_core::scan::Scan;
use laz::{LasZipDecompressor, LazVlr, LazVlrBuilder, ParLasZipCompressor, ParLasZipDecompressor};
use std::fs::File;
use std::io::{BufReader, BufWriter, Seek, SeekFrom, Write};
use std::path::Path;
use std::time::Instant;

/// Points between decompressor and compressor: some LAZ chunks for each thread.
const POINTS: usize = 1_000_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [input, output] = arguments.as_slice() else {
        return Err("usage: lower_bound IN.laz OUT".into());
    };
    let start = Instant::now();
    let scan = Scan::read(Path::new(input))?;
    let record = scan.record(LazVlr::USER_ID, LazVlr::RECORD_ID).ok_or("the points are not compressed")?;
    let vlr = LazVlr::from_buffer(&record.data)?;
    let length = usize::from(scan.header.point_data_record_length);
    let mut file = BufReader::with_capacity(1 << 20, File::open(input)?);
    file.seek(SeekFrom::Start(scan.header.offset_to_point_data.into()))?;
    let extra = length - usize::from(groma_core::scan::RECORD_LENGTHS[usize::from(scan.point_format)]);
    let target = LazVlrBuilder::default().with_point_format(scan.point_format, extra as u16)?.build();
    let mut out = BufWriter::with_capacity(1 << 20, File::create(output)?);
    let mut compressor = ParLasZipCompressor::new(&mut out, target)?;
    let mut buffer = vec![0; POINTS * length];
    let mut left = scan.points as usize;
    let mut pass = |decode: &mut dyn FnMut(&mut [u8]) -> laz::Result<()>| -> laz::Result<()> {
        while left > 0 {
            let points = left.min(POINTS);
            let part = &mut buffer[..points * length];
            decode(part)?;
            compressor.compress_many(part)?;
            left -= points;
        }
        compressor.done()
    };
    match ParLasZipDecompressor::new(file, vlr.clone()) {
        Ok(mut decompressor) => pass(&mut |part| decompressor.decompress_many(part))?,
        // Without a chunk table there is nothing to do at once.
        Err(_) => {
            let mut file = BufReader::with_capacity(1 << 20, File::open(input)?);
            file.seek(SeekFrom::Start(scan.header.offset_to_point_data.into()))?;
            let mut decompressor = LasZipDecompressor::new(file, vlr)?;
            pass(&mut |part| Ok(decompressor.decompress_many(part)?))?;
        }
    }
    drop(compressor);
    out.flush()?;
    out.get_ref().sync_all()?;
    let bytes = out.get_ref().metadata()?.len();
    println!("{}", serde_json::json!({ "seconds": start.elapsed().as_secs_f64(), "bytes": bytes }));
    Ok(())
}
