//! Decodes chunks, and streams without chunks, without trusting what they say of themselves.

use super::head::ChunkHead;
use super::is_layered;
use crate::error::{Error, Result};
use crate::input::contain::contained;
use crate::input::{Block, Sink};
use crate::scan::Scan;
use laz::record::{LayeredPointRecordDecompressor, RecordDecompressor, SequentialPointRecordDecompressor};
use laz::{LasZipDecompressor, LazVlr};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

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
