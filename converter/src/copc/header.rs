//! The output's LAS 1.4 header.

use crate::octree::cube::Bounds;
use crate::record::Target;
use crate::scan::variable_record::padded;
use las::Version;
use las::raw::Header;
use las::raw::header::{Evlr, LargeFile};

/// Bits of the global encoding (LAS 1.4 R15, table 4).
const GPS_TIME_TYPE: u16 = 1;
const SYNTHETIC_RETURNS: u16 = 1 << 3;
const WKT: u16 = 1 << 4;

/// Bytes of a LAS 1.4 header.
pub const LENGTH: u16 = 375;

/// What the header says about the points.
#[derive(Debug, Clone, PartialEq)]
pub struct Points {
    pub target: Target,
    pub record_length: u16,
    pub count: u64,
    pub by_return: [u64; 15],
    pub bounds: Bounds,
}

/// Where the parts of the file are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    pub plain_records: u32,
    pub points_at: u32,
    pub extended_records: u32,
    pub extended_at: u64,
}

/// A header for the points, with scale, offset, identifiers and date of the (first) input.
///
/// The legacy counts are zero, as formats 6 to 10 demand, and the WKT bit is set, for the same reason. The
/// version 1.0 and 1.1 had no global encoding: their bytes are not taken.
pub fn build(input: &Header, points: &Points, layout: Layout) -> Header {
    let encoding = if input.version.minor >= 2 { input.global_encoding } else { 0 };
    let bounds = &points.bounds;
    Header {
        file_source_id: input.file_source_id,
        global_encoding: encoding & (GPS_TIME_TYPE | SYNTHETIC_RETURNS) | WKT,
        guid: input.guid,
        version: Version::new(1, 4),
        system_identifier: input.system_identifier,
        generating_software: padded(concat!("groma ", env!("CARGO_PKG_VERSION"))),
        file_creation_day_of_year: input.file_creation_day_of_year,
        file_creation_year: input.file_creation_year,
        header_size: LENGTH,
        offset_to_point_data: layout.points_at,
        number_of_variable_length_records: layout.plain_records,
        // LASzip sets bit 7 of the format of compressed points.
        point_data_record_format: points.target.id() | 0x80,
        point_data_record_length: points.record_length,
        number_of_point_records: 0,
        number_of_points_by_return: [0; 5],
        x_scale_factor: input.x_scale_factor,
        y_scale_factor: input.y_scale_factor,
        z_scale_factor: input.z_scale_factor,
        x_offset: input.x_offset,
        y_offset: input.y_offset,
        z_offset: input.z_offset,
        min_x: bounds.min[0],
        min_y: bounds.min[1],
        min_z: bounds.min[2],
        max_x: bounds.max[0],
        max_y: bounds.max[1],
        max_z: bounds.max[2],
        start_of_waveform_data_packet_record: None,
        evlr: Some(Evlr {
            start_of_first_evlr: layout.extended_at,
            number_of_evlrs: layout.extended_records,
        }),
        large_file: Some(LargeFile {
            number_of_point_records: points.count,
            number_of_points_by_return: points.by_return,
        }),
        ..Header::default()
    }
}
