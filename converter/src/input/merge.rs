//! Several inputs in one output: what must be equal, and what is brought to the first input's form.

use super::Source;
use crate::error::{Error, Result};
use crate::record::exact::ExactChange;
use crate::record::has_gps_time;
use crate::scan::Scan;
use crate::scan::variable_record::{GEOTIFF_ASCII, GEOTIFF_DIRECTORY, GEOTIFF_DOUBLES, PROJECTION};

/// Bit of the global encoding that tells adjusted standard GPS time from GPS week time.
const GPS_TIME_TYPE: u16 = 1;

/// Prepares all inputs for the first one's record form, scale and offset, or refuses: `INPUT_MIXED`.
pub fn unify(sources: &mut [Source]) -> Result<()> {
    let Some((first, others)) = sources.split_first_mut() else { return Ok(()) };
    for other in others {
        if let Some(difference) = difference(first, other) {
            let cause = format!("{difference} differ from those of {}", first.scan.path.display());
            return Err(Error::mixed(&other.scan.path, cause));
        }
        let (scale, offset) = (first.scan.scale(), first.scan.offset());
        if (other.scan.scale(), other.scan.offset()) != (scale, offset) {
            let change = ExactChange::between(other.scan.scale(), other.scan.offset(), scale, offset);
            other.change = Some(change.ok_or_else(|| {
                let cause = format!("scale and offset do not go into those of {}", first.scan.path.display());
                Error::mixed(&other.scan.path, cause)
            })?);
        }
    }
    Ok(())
}

/// What two inputs may not differ in.
fn difference(first: &Source, other: &Source) -> Option<&'static str> {
    let (a, b) = (&first.scan, &other.scan);
    if first.mapping.target() != other.mapping.target() {
        return Some("the fields of the point format");
    }
    if first.mapping.extra() != other.mapping.extra() || a.extra_bytes() != b.extra_bytes() {
        return Some("the extra bytes");
    }
    if a.wkt() != b.wkt() || geo_tiff(a) != geo_tiff(b) {
        return Some("the coordinate reference systems");
    }
    let timed = has_gps_time(a.point_format) && has_gps_time(b.point_format);
    if timed && time_type(a) != time_type(b) {
        return Some("the kinds of GPS time");
    }
    None
}

fn geo_tiff(scan: &Scan) -> [Option<&[u8]>; 3] {
    let data = |id| scan.record(PROJECTION, id).map(|record| record.data.as_slice());
    [data(GEOTIFF_DIRECTORY), data(GEOTIFF_DOUBLES), data(GEOTIFF_ASCII)]
}

fn time_type(scan: &Scan) -> u16 {
    if scan.header.version.minor >= 2 { scan.header.global_encoding & GPS_TIME_TYPE } else { 0 }
}
