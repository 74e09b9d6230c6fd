//! LAZ for pages: chunks are decoded, and written as by the core: the same crate, the same chunks, the same bytes.
//!
//! A page copies its input to where `reserve` says, calls one of the functions, and reads the output. Each function says 0,
//! or 1 where the input makes no sense; nothing is kept between calls but both buffers and the chunk that was opened.

use laz::laszip::{ChunkTable, ChunkTableEntry};
use laz::record::{
    LayeredPointRecordCompressor, LayeredPointRecordDecompressor, RecordCompressor, RecordDecompressor,
    SequentialPointRecordDecompressor,
};
use laz::{LazItemRecordBuilder, LazVlr, LazVlrBuilder};
use std::cell::RefCell;
use std::io::Cursor;

thread_local! {
    static INPUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static OUTPUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static OPENED: RefCell<Option<Decompressor>> = const { RefCell::new(None) };
}

type Decompressor = Box<dyn RecordDecompressor<Cursor<Vec<u8>>> + Send + Sync>;

/// Points of a chunk, as LASzip and the core have it.
const CHUNK: u32 = 50_000;

/// Where the next input of this length goes.
#[unsafe(no_mangle)]
pub extern "C" fn reserve(length: usize) -> *mut u8 {
    INPUT.with_borrow_mut(|input| {
        input.clear();
        input.resize(length, 0);
        input.as_mut_ptr()
    })
}

/// Where the last output begins.
#[unsafe(no_mangle)]
pub extern "C" fn output() -> *const u8 {
    OUTPUT.with_borrow(|output| output.as_ptr())
}

#[unsafe(no_mangle)]
pub extern "C" fn output_length() -> usize {
    OUTPUT.with_borrow(Vec::len)
}

/// The content of the record of LASzip for a point format (6 to 8) with extra bytes.
#[unsafe(no_mangle)]
pub extern "C" fn describe(format: u32, extra: u32) -> u32 {
    answer(|_| {
        let mut content = Vec::new();
        parameters(format, extra)?.write_to(&mut content).ok()?;
        Some(content)
    })
}

/// Compresses the input, whole records, as one chunk.
#[unsafe(no_mangle)]
pub extern "C" fn compress(format: u32, extra: u32) -> u32 {
    answer(|records| {
        let vlr = parameters(format, extra)?;
        if records.len() % vlr.items_size() as usize != 0 {
            return None;
        }
        let mut compressor = LayeredPointRecordCompressor::new(Cursor::new(Vec::new()));
        compressor.set_fields_from(vlr.items()).ok()?;
        compressor.compress_many(records).ok()?;
        compressor.done().ok()?;
        Some(compressor.into_inner().into_inner())
    })
}

/// The chunk table of chunks whose lengths, u32 of little endian, are the input.
#[unsafe(no_mangle)]
pub extern "C" fn table(format: u32, extra: u32) -> u32 {
    answer(|lengths| {
        let (lengths, _) = lengths.as_chunks::<4>();
        let mut table = ChunkTable::with_capacity(lengths.len());
        for length in lengths {
            // A table of chunks of one size tells no numbers of points.
            let byte_count = u32::from_le_bytes(*length).into();
            table.push(ChunkTableEntry { point_count: CHUNK.into(), byte_count });
        }
        let mut bytes = Vec::new();
        table.write_to(&mut bytes, &parameters(format, extra)?).ok()?;
        Some(bytes)
    })
}

/// Takes the input as one chunk of records of a point format (0 to 10) and of this length, in the versions that LASzip
/// writes: 2, and 3 from format 6 on.
#[unsafe(no_mangle)]
pub extern "C" fn open(format: u32, length: u32) -> u32 {
    let chunk = Cursor::new(INPUT.take());
    let opened = decompressor(format, length, chunk);
    let failed = opened.is_none();
    OPENED.set(opened);
    failed.into()
}

fn decompressor(format: u32, length: u32, chunk: Cursor<Vec<u8>>) -> Option<Decompressor> {
    let format = format.try_into().ok()?;
    let items = |extra| LazItemRecordBuilder::default_for_point_format_id(format, extra).ok();
    let own: u32 = items(0)?.iter().map(|item| u32::from(item.size())).sum();
    let items = items(length.checked_sub(own)?.try_into().ok()?)?;
    let mut opened: Decompressor = match format {
        ..=5 => Box::new(SequentialPointRecordDecompressor::new(chunk)),
        _ => Box::new(LayeredPointRecordDecompressor::new(chunk)),
    };
    opened.set_fields_from(&items).ok()?;
    Some(opened)
}

/// The next records of the chunk that is open, uncompressed.
#[unsafe(no_mangle)]
pub extern "C" fn decompress(count: usize) -> u32 {
    OPENED.with_borrow_mut(|opened| {
        let mut records = OUTPUT.take();
        let read = opened.as_mut().and_then(|chunk| {
            records.resize(count * chunk.record_size(), 0);
            chunk.decompress_many(&mut records).ok()
        });
        OUTPUT.set(records);
        read.is_none().into()
    })
}

fn parameters(format: u32, extra: u32) -> Option<LazVlr> {
    if !(6..=8).contains(&format) {
        return None;
    }
    let builder = LazVlrBuilder::default().with_point_format(format as u8, extra.try_into().ok()?).ok()?;
    Some(builder.with_fixed_chunk_size(CHUNK).build())
}

fn answer(make: impl FnOnce(&[u8]) -> Option<Vec<u8>>) -> u32 {
    let made = INPUT.with_borrow(|input| make(input));
    let failed = made.is_none();
    OUTPUT.set(made.unwrap_or_default());
    failed.into()
}
