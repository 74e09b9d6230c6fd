//! The header and the variable length records of one LAS or LAZ file: tolerant of what is known to be wrong
//! in the wild, and never believing a number that the file's size contradicts.

pub mod describe;
pub mod extra_bytes;
pub mod variable_record;

use crate::error::{Error, Result};
use extra_bytes::Described;
use las::raw::Header;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use variable_record::{EXTRA_BYTES, PROJECTION, SPECIFICATION, VariableRecord, WKT, text};

/// Bytes of a record of each point data record format (LAS 1.4 R15, tables 7 to 22), without extra bytes.
pub const RECORD_LENGTHS: [u16; 11] = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67];

/// Bytes of a LAS 1.0 to 1.2 header, the shortest there is.
const SHORTEST_HEADER: u64 = 227;

/// What stands before and after the points of one file.
#[derive(Debug, Clone)]
pub struct Scan {
    pub path: PathBuf,
    pub file_size: u64,
    pub header: Header,
    /// Announced number of points.
    pub points: u64,
    /// Point data record format without the compression bits, 0 to 10 if the file is sound.
    pub point_format: u8,
    /// Whether the points are LAZ.
    pub compressed: bool,
    pub vlrs: Vec<VariableRecord>,
    /// Extended records, without waveform data and COPC hierarchy.
    pub evlrs: Vec<VariableRecord>,
    /// What the extra bytes of a record hold.
    pub extra_bytes: Described,
    /// What was found wrong and passed over.
    pub warnings: Vec<String>,
}

impl Scan {
    /// Reads everything but the points.
    ///
    /// Errors: `INPUT_NOT_FOUND`, `INPUT_MAGIC`, `INPUT_TRUNCATED` (the header or the offset to the points lies
    /// beyond the end), `INPUT_FORMAT` (a LAS version after 1.4), `INPUT_CORRUPT`.
    pub fn read(path: &Path) -> Result<Self> {
        let unopened = |e| Error::not_found(path, format!("the file cannot be opened ({e})"));
        // Looked at before it is opened: opening a pipe waits until somebody writes to it.
        let meta = std::fs::metadata(path).map_err(unopened)?;
        if !meta.is_file() {
            return Err(Error::not_found(path, "this is not a file"));
        }
        let file = File::open(path).map_err(unopened)?;
        let file_size = meta.len();
        let mut reader = BufReader::new(file);
        check_signature(&mut reader, file_size, path)?;
        let header = Header::read_from(&mut reader).map_err(|e| header_error(path, file_size, &e))?;
        check_header(&header, file_size, path)?;

        let mut warnings = Vec::new();
        let points = announced_points(&header, &mut warnings);
        let vlrs = read_vlrs(&mut reader, &header, path, &mut warnings)?;
        let evlrs = read_evlrs(&mut reader, &header, file_size, path, &mut warnings)?;
        let format = header.point_data_record_format;
        warn_of_more(&header, points, file_size, &mut warnings);
        warn_of_second_wkt(vlrs.iter().chain(&evlrs), &mut warnings);
        let extra_bytes = described(&header, vlrs.iter().chain(&evlrs), &mut warnings);
        Ok(Self {
            path: path.to_path_buf(),
            file_size,
            points,
            point_format: format & 0x3f,
            compressed: format & 0xc0 != 0,
            header,
            vlrs,
            evlrs,
            extra_bytes,
            warnings,
        })
    }

    /// All records, the extended ones last.
    pub fn records(&self) -> impl Iterator<Item = &VariableRecord> {
        self.vlrs.iter().chain(&self.evlrs)
    }

    /// The first record of these ids.
    pub fn record(&self, user_id: &str, record_id: u16) -> Option<&VariableRecord> {
        self.records().find(|record| record.is(user_id, record_id))
    }

    pub fn scale(&self) -> [f64; 3] {
        let h = &self.header;
        [h.x_scale_factor, h.y_scale_factor, h.z_scale_factor]
    }

    pub fn offset(&self) -> [f64; 3] {
        let h = &self.header;
        [h.x_offset, h.y_offset, h.z_offset]
    }
}

fn check_signature(reader: &mut BufReader<File>, file_size: u64, path: &Path) -> Result<()> {
    let mut signature = Vec::new();
    reader.by_ref().take(4).read_to_end(&mut signature).map_err(|e| Error::reading(path, &e))?;
    if signature.is_empty() {
        return Err(Error::magic(path, "the file is empty"));
    }
    if !b"LASF".starts_with(&signature) {
        return Err(Error::magic(path, "the file does not begin with `LASF`"));
    }
    if file_size < SHORTEST_HEADER {
        return Err(Error::truncated(path, format!("{file_size} bytes are less than a LAS header")));
    }
    reader.rewind().map_err(|e| Error::reading(path, &e))
}

fn header_error(path: &Path, file_size: u64, error: &las::Error) -> Error {
    match error {
        las::Error::Io(e) if e.kind() == std::io::ErrorKind::UnexpectedEof => {
            Error::truncated(path, format!("the file ends inside its header, after {file_size} bytes"))
        }
        _ => Error::corrupt(path, format!("the header cannot be read ({error})")),
    }
}

fn check_header(header: &Header, file_size: u64, path: &Path) -> Result<()> {
    let version = header.version;
    if version.major != 1 || version.minor > 4 {
        return Err(Error::format(path, format!("LAS version {version} is not known")));
    }
    if header.header_size < version.header_size() {
        let cause = format!("a header of {} bytes is too short for LAS {version}", header.header_size);
        return Err(Error::corrupt(path, cause));
    }
    let points_at = u64::from(header.offset_to_point_data);
    if points_at > file_size {
        let cause = format!("the points begin at byte {points_at} of {file_size}");
        return Err(Error::truncated(path, cause));
    }
    if points_at < u64::from(header.header_size) {
        return Err(Error::corrupt(path, "the points begin inside the header"));
    }
    Ok(())
}

/// The number of points that the header announces: the 64-bit field of LAS 1.4 unless it is zero.
fn announced_points(header: &Header, warnings: &mut Vec<String>) -> u64 {
    let legacy = u64::from(header.number_of_point_records);
    let large = header.large_file.map_or(0, |l| l.number_of_point_records);
    if large != 0 && legacy != 0 && large != legacy {
        warnings.push(format!(
            "the header announces {large} points and, in the legacy field, {legacy}; {large} is taken"
        ));
    }
    if large != 0 { large } else { legacy }
}

/// Warns where uncompressed records follow that the header does not announce: a writer may have died before it mended
/// its count.
fn warn_of_more(header: &Header, points: u64, file_size: u64, warnings: &mut Vec<String>) {
    if header.point_data_record_format & 0xc0 != 0 || points == 0 {
        return;
    }
    let start = u64::from(header.offset_to_point_data);
    let after = [header.start_of_waveform_data_packet_record, header.evlr.map(|e| e.start_of_first_evlr)];
    let end = after.into_iter().flatten().filter(|at| *at > start).fold(file_size, u64::min);
    let room = (end - start) / u64::from(header.point_data_record_length.max(1));
    if room > points {
        warnings.push(format!(
            "the header declares {points} points, the file has room for {room}; the rest is skipped"
        ));
    }
}

/// Warns where a file declares its coordinate reference system as WKT more than once, and not in the same words.
fn warn_of_second_wkt<'a>(records: impl Iterator<Item = &'a VariableRecord>, warnings: &mut Vec<String>) {
    let mut texts = records.filter(|record| record.is(PROJECTION, WKT)).map(|record| text(&record.data));
    let Some(first) = texts.next() else { return };
    if let Some(other) = texts.find(|other| *other != first) {
        let name = |wkt: &str| wkt.split('"').nth(1).unwrap_or("no name").to_string();
        warnings.push(format!(
            "the file has several WKT records that differ ({}; {}); the first is used",
            name(&first),
            name(&other)
        ));
    }
}

/// What the extra bytes are said to hold; some writers give each attribute its own record.
fn described<'a>(
    header: &Header,
    records: impl Iterator<Item = &'a VariableRecord>,
    warnings: &mut Vec<String>,
) -> Described {
    let descriptors: Vec<u8> = records
        .filter(|record| record.is(SPECIFICATION, EXTRA_BYTES))
        .flat_map(|record| record.data.iter().copied())
        .collect();
    let format = usize::from(header.point_data_record_format & 0x3f);
    let base = RECORD_LENGTHS.get(format).copied().unwrap_or(u16::MAX);
    let room = usize::from(header.point_data_record_length.saturating_sub(base));
    Described::of(&descriptors, room, warnings)
}

/// The records between header and points. A count that does not fit in there is passed over with a warning:
/// what is there is read, the rest is garbage.
fn read_vlrs(
    reader: &mut BufReader<File>,
    header: &Header,
    path: &Path,
    warnings: &mut Vec<String>,
) -> Result<Vec<VariableRecord>> {
    let room = u64::from(header.offset_to_point_data) - u64::from(header.header_size);
    reader.seek(SeekFrom::Start(header.header_size.into())).map_err(|e| Error::reading(path, &e))?;
    let mut area = Vec::new();
    reader.by_ref().take(room).read_to_end(&mut area).map_err(|e| Error::reading(path, &e))?;
    let announced = header.number_of_variable_length_records;
    let mut rest = area.as_slice();
    let mut records = Vec::new();
    for _ in 0..announced {
        let Some((record, after)) = VariableRecord::parse(rest) else {
            let found = records.len();
            warnings.push(format!("{announced} variable length records are announced, {found} are there"));
            break;
        };
        records.push(record);
        rest = after;
    }
    Ok(records)
}

/// The records after the points (LAS 1.4). Waveform data and COPC hierarchy are skipped unread: neither goes
/// into the output, and both may be large.
fn read_evlrs(
    reader: &mut BufReader<File>,
    header: &Header,
    file_size: u64,
    path: &Path,
    warnings: &mut Vec<String>,
) -> Result<Vec<VariableRecord>> {
    let mut records = Vec::new();
    let Some(evlr) = header.evlr.filter(|e| e.number_of_evlrs > 0) else {
        return Ok(records);
    };
    let mut at = evlr.start_of_first_evlr;
    for found in 0..evlr.number_of_evlrs {
        let Some((record, next)) =
            VariableRecord::read_extended(reader, at, file_size).map_err(|e| Error::reading(path, &e))?
        else {
            let announced = evlr.number_of_evlrs;
            warnings.push(format!(
                "{announced} extended variable length records are announced, {found} are there"
            ));
            break;
        };
        records.extend(record);
        at = next;
    }
    Ok(records)
}

#[cfg(test)]
mod tests {
    use super::{PROJECTION, VariableRecord, WKT, warn_of_second_wkt};

    #[test]
    fn several_wkt_records_are_told_where_they_differ() {
        let warned = |texts: &[&str]| {
            let record = |wkt: &&str| VariableRecord::new(PROJECTION, WKT, "", wkt.as_bytes().to_vec());
            let records: Vec<_> = texts.iter().map(record).collect();
            let mut warnings = Vec::new();
            warn_of_second_wkt(records.iter(), &mut warnings);
            warnings
        };
        assert!(warned(&[]).is_empty());
        assert!(warned(&["CRS[\"a\"]", "CRS[\"a\"]\0"]).is_empty());
        let told = "the file has several WKT records that differ (a; b); the first is used";
        assert_eq!(warned(&["CRS[\"a\"]", "CRS[\"a\"]", "CRS[\"b\"]"]), [told]);
    }
}
