//! A scan as the JSON object that `groma-core scan` prints.

use super::Scan;
use super::extra_bytes::ExtraBytes;
use super::variable_record::{
    COPC, COPC_INFO, GEOTIFF_ASCII, GEOTIFF_DIRECTORY, GEOTIFF_DOUBLES, GROMA, GROMA_GEOREFERENCE,
    GROMA_STATISTICS, GROMA_TRANSFORMATION, PROJECTION, VariableRecord, WKT, latin1, text,
};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use serde_json::Value;

/// Bit 4 of the global encoding (LAS 1.4 R15, table 4).
const WKT_BIT: u16 = 1 << 4;

/// Bytes; a transformation with EGM96 for the whole earth takes two megabytes. A longer record is none.
const LONGEST_TRANSFORMATION: usize = 1 << 24;

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Description {
    file: String,
    file_size: u64,
    version: String,
    point_format: u8,
    points: u64,
    record_length: u16,
    compressed: bool,
    copc: bool,
    scale: [f64; 3],
    offset: [f64; 3],
    min: [f64; 3],
    max: [f64; 3],
    system_identifier: String,
    generating_software: String,
    /// ISO date, or `null` where the header's day and year are no date.
    creation: Option<String>,
    extra_bytes: Vec<ExtraBytes>,
    /// Whether the header says that the coordinate reference system is declared as WKT, not as GeoTIFF keys.
    wkt_bit: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    wkt: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    geo_tiff: Option<GeoTiff>,
    #[serde(skip_serializing_if = "Option::is_none")]
    groma: Option<Groma>,
    warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
struct GeoTiff {
    directory: Vec<u16>,
    doubles: Vec<f64>,
    ascii: String,
}

#[derive(Debug, Serialize)]
struct Groma {
    #[serde(rename = "1", skip_serializing_if = "Option::is_none")]
    georeference: Option<String>,
    #[serde(rename = "2", skip_serializing_if = "Option::is_none")]
    statistics: Option<Value>,
    #[serde(rename = "3", skip_serializing_if = "Option::is_none")]
    transformation: Option<String>,
}

impl Scan {
    /// The coordinate reference system as WKT, if the file has it so.
    pub fn wkt(&self) -> Option<String> {
        let wkt = text(&self.record(PROJECTION, WKT)?.data);
        (!wkt.is_empty()).then_some(wkt)
    }

    /// COPC 1.0: the information record is the first, directly after the header.
    pub fn is_copc(&self) -> bool {
        self.vlrs.first().is_some_and(|record| record.is(COPC, COPC_INFO))
    }

    pub fn describe(&self) -> Description {
        let h = &self.header;
        Description {
            file: self.path.display().to_string(),
            file_size: self.file_size,
            version: format!("{}.{}", h.version.major, h.version.minor),
            point_format: self.point_format,
            points: self.points,
            record_length: h.point_data_record_length,
            compressed: self.compressed,
            copc: self.is_copc(),
            scale: self.scale(),
            offset: self.offset(),
            min: [h.min_x, h.min_y, h.min_z],
            max: [h.max_x, h.max_y, h.max_z],
            system_identifier: text(&h.system_identifier),
            generating_software: text(&h.generating_software),
            creation: date(h.file_creation_year, h.file_creation_day_of_year),
            extra_bytes: self.extra_bytes.attributes.clone(),
            // Versions 1.0 and 1.1 have no global encoding; 1.2 and 1.3 leave the bit clear.
            wkt_bit: h.version.minor >= 2 && h.global_encoding & WKT_BIT != 0,
            wkt: self.wkt(),
            geo_tiff: self.geo_tiff(),
            groma: self.groma(),
            warnings: self.warnings.clone(),
        }
    }

    fn geo_tiff(&self) -> Option<GeoTiff> {
        let data = |id| self.record(PROJECTION, id).map_or(&[][..], |record| record.data.as_slice());
        let directory = &self.record(PROJECTION, GEOTIFF_DIRECTORY)?.data;
        let (shorts, _) = directory.as_chunks::<2>();
        let (doubles, _) = data(GEOTIFF_DOUBLES).as_chunks::<8>();
        Some(GeoTiff {
            directory: shorts.iter().map(|b| u16::from_le_bytes(*b)).collect(),
            doubles: doubles.iter().map(|b| f64::from_le_bytes(*b)).collect(),
            ascii: key_texts(data(GEOTIFF_ASCII)),
        })
    }

    fn groma(&self) -> Option<Groma> {
        let data = |id| self.record(GROMA, id).map(|record: &VariableRecord| record.data.as_slice());
        let georeference = data(GROMA_GEOREFERENCE).map(|bytes| STANDARD.encode(bytes));
        let statistics = data(GROMA_STATISTICS).and_then(|bytes| serde_json::from_slice(bytes).ok());
        let transformation = data(GROMA_TRANSFORMATION)
            .filter(|bytes| bytes.len() <= LONGEST_TRANSFORMATION)
            .map(|bytes| STANDARD.encode(bytes));
        let any = georeference.is_some() || statistics.is_some() || transformation.is_some();
        any.then_some(Groma { georeference, statistics, transformation })
    }
}

/// The texts of GeoTIFF keys, which address characters by their byte, so that each byte becomes one character.
fn key_texts(bytes: &[u8]) -> String {
    latin1(bytes).trim_end_matches('\0').to_string()
}

/// The ISO date of the `day`th day (1 is January 1) of a year.
fn date(year: u16, day: u16) -> Option<String> {
    let leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let months = [31, if leap { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut rest = day.checked_sub(1)?;
    for (index, length) in months.into_iter().enumerate() {
        if rest < length {
            return (year > 0).then(|| format!("{year:04}-{:02}-{:02}", index + 1, rest + 1));
        }
        rest -= length;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn days_of_the_year() {
        assert_eq!(date(2024, 60).as_deref(), Some("2024-02-29"));
        assert_eq!(date(2023, 60).as_deref(), Some("2023-03-01"));
        assert_eq!(date(2023, 365).as_deref(), Some("2023-12-31"));
        assert_eq!(date(2023, 366), None);
        assert_eq!(date(0, 1), None);
        assert_eq!(date(2023, 0), None);
    }
}
