//! A sound LAZ file around bytes that are to be decoded as its one chunk.

use groma_core::record::LENGTHS;
use groma_core::scan::variable_record::VariableRecord;
use las::Version;
use las::raw::Header;
use las::raw::header::LargeFile;
use laz::laszip::{ChunkTable, ChunkTableEntry};
use laz::{LazVlr, LazVlrBuilder};

/// Bytes before the chunk: what to decode it as.
const HEAD: usize = 3;

/// Extra bytes per point: enough that their layers are there.
const EXTRA: u16 = 2;

/// `None` where there are too few bytes.
pub fn file_around(data: &[u8]) -> Option<Vec<u8>> {
    let (head, chunk) = data.split_first_chunk::<HEAD>()?;
    let format = head[0] % 11;
    let points = u64::from(u16::from_le_bytes([head[1], head[2]])) + 1;
    let vlr = LazVlrBuilder::default().with_point_format(format, EXTRA).ok()?;
    let vlr = vlr.with_variable_chunk_size().build();
    let mut parameters = Vec::new();
    vlr.write_to(&mut parameters).ok()?;
    let mut area = Vec::new();
    VariableRecord::new(LazVlr::USER_ID, LazVlr::RECORD_ID, "", parameters).write(&mut area).ok()?;
    let version = Version::new(1, 4);
    let header = Header {
        version,
        header_size: version.header_size(),
        offset_to_point_data: u32::from(version.header_size()) + area.len() as u32,
        number_of_variable_length_records: 1,
        point_data_record_format: format | 0x80,
        point_data_record_length: LENGTHS[usize::from(format)] + EXTRA,
        x_scale_factor: 0.01,
        y_scale_factor: 0.01,
        z_scale_factor: 0.01,
        large_file: Some(LargeFile { number_of_point_records: points, number_of_points_by_return: [0; 15] }),
        ..Header::default()
    };
    let mut bytes = Vec::new();
    header.write_to(&mut bytes).ok()?;
    bytes.extend(area);
    let table_at = bytes.len() + 8 + chunk.len();
    bytes.extend((table_at as i64).to_le_bytes());
    bytes.extend(chunk);
    let mut table = ChunkTable::with_capacity(1);
    table.push(ChunkTableEntry { point_count: points, byte_count: chunk.len() as u64 });
    table.write_to(&mut bytes, &vlr).ok()?;
    Some(bytes)
}
