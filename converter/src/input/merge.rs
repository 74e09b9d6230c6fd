//! Several inputs in one output: what must be equal, and what is brought to the first input's form.

use super::Source;
use crate::error::{Error, Result};
use crate::record::exact::ExactChange;
use crate::record::has_gps_time;
use crate::scan::Scan;
use crate::scan::variable_record::{GEOTIFF_ASCII, GEOTIFF_DIRECTORY, GEOTIFF_DOUBLES, PROJECTION};

/// Bit of the global encoding that tells adjusted standard GPS time from GPS week time.
const GPS_TIME_TYPE: u16 = 1;

/// Inputs of one coordinate reference system that an error names; of more, it gives the number.
const NAMED: usize = 3;

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

/// Refuses inputs that declare several coordinate reference systems, naming all of these and who has them. Here
/// declarations are compared as they are spelled; who knows that they mean one system gives it as WKT.
pub fn check_systems(sources: &[Source]) -> Result<()> {
    let mut systems: Vec<(System, Vec<&Source>)> = Vec::new();
    for source in sources {
        let system = System { wkt: source.scan.wkt(), geo_tiff: geo_tiff(&source.scan) };
        match systems.iter_mut().find(|(known, _)| *known == system) {
            Some((_, members)) => members.push(source),
            None => systems.push((system, vec![source])),
        }
    }
    let [_, (_, strangers), ..] = systems.as_slice() else { return Ok(()) };
    let list: Vec<_> = systems
        .iter()
        .map(|(system, members)| {
            let mut names: Vec<_> =
                members.iter().take(NAMED).map(|source| source.scan.path.display().to_string()).collect();
            if members.len() > NAMED {
                names.push(format!("{} more", members.len() - NAMED));
            }
            format!("{} ({})", system.name(), names.join(", "))
        })
        .collect();
    let cause = format!(
        "the inputs have {} coordinate reference systems, which differ: {}",
        systems.len(),
        list.join("; ")
    );
    Err(Error::mixed(&strangers[0].scan.path, cause))
}

/// What a file says of its coordinate reference system.
#[derive(PartialEq)]
struct System<'a> {
    wkt: Option<String>,
    geo_tiff: [Option<&'a [u8]>; 3],
}

impl System<'_> {
    /// The name that the WKT gives, or in words what there is.
    fn name(&self) -> &str {
        match &self.wkt {
            Some(wkt) => wkt.split('"').nth(1).unwrap_or(wkt),
            None if self.geo_tiff.iter().any(Option::is_some) => "GeoTIFF keys",
            None => "none declared",
        }
    }
}

/// What two inputs may not differ in, besides their coordinate reference systems.
fn difference(first: &Source, other: &Source) -> Option<&'static str> {
    let (a, b) = (&first.scan, &other.scan);
    if first.mapping.target() != other.mapping.target() {
        return Some("the fields of the point format");
    }
    if first.mapping.extra() != other.mapping.extra() || a.extra_bytes.attributes != b.extra_bytes.attributes
    {
        return Some("the extra bytes");
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
