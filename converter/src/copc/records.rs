//! Which variable length records the output carries, and in which order.

use crate::scan::Scan;
use crate::scan::variable_record::{
    COPC, EXTRA_BYTES, GEOTIFF_ASCII, GEOTIFF_DIRECTORY, GEOTIFF_DOUBLES, GROMA, GROMA_GEOREFERENCE,
    GROMA_STATISTICS, GROMA_TRANSFORMATION, PROJECTION, SPECIFICATION, VariableRecord, WKT,
};
use laz::LazVlr;

/// What goes into the output besides what the input brings.
#[derive(Debug, Clone, Default)]
pub struct Additions {
    /// Replaces the input's WKT.
    pub wkt: Option<Vec<u8>>,
    /// Bytes of the georeference record.
    pub georeference: Option<Vec<u8>>,
    /// Bytes of the transformation record.
    pub transformation: Option<Vec<u8>>,
    /// JSON of the statistics record.
    pub statistics: Vec<u8>,
}

/// The output's records, without the COPC ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Records {
    /// To stand between header and points: LASzip, WKT, Groma's, extra bytes, then the input's others.
    pub plain: Vec<VariableRecord>,
    /// To stand behind the points: extended records of the input, and plain ones that are too long.
    pub extended: Vec<VariableRecord>,
}

impl Records {
    /// Whether the file says in WKT what its coordinates mean.
    pub fn has_wkt(&self) -> bool {
        self.plain.iter().chain(&self.extended).any(|record| record.is(PROJECTION, WKT))
    }
}

/// Collects the records for the first input's points, with what is added. Waveform records go with the
/// waveforms; COPC, LASzip and Groma records of the input describe another file; records without a readable name
/// would keep others from reading the file.
pub fn collect(scan: &Scan, laz: &LazVlr, additions: &Additions) -> std::io::Result<Records> {
    let mut laz_data = Vec::new();
    laz.write_to(&mut laz_data)?;
    let mut front =
        vec![VariableRecord::new(LazVlr::USER_ID, LazVlr::RECORD_ID, LazVlr::DESCRIPTION, laz_data)];
    match &additions.wkt {
        Some(wkt) => {
            front.push(VariableRecord::new(PROJECTION, WKT, "OGC coordinate system WKT", wkt.clone()))
        }
        None => front.extend(scan.record(PROJECTION, WKT).cloned()),
    }
    if let Some(bytes) = &additions.georeference {
        front.push(VariableRecord::new(GROMA, GROMA_GEOREFERENCE, "georeference", bytes.clone()));
    }
    let statistics = additions.statistics.clone();
    front.push(VariableRecord::new(GROMA, GROMA_STATISTICS, "attribute statistics", statistics));
    if let Some(bytes) = &additions.transformation {
        front.push(VariableRecord::new(GROMA, GROMA_TRANSFORMATION, "transformation", bytes.clone()));
    }
    let extra_bytes = scan.extra_bytes.descriptors.clone();
    if !extra_bytes.is_empty() {
        front.push(VariableRecord::new(SPECIFICATION, EXTRA_BYTES, "Extra Bytes Record", extra_bytes));
    }

    let (long, mut plain): (Vec<_>, Vec<_>) = front.into_iter().partition(VariableRecord::needs_extension);
    let mut extended = long;
    let has_wkt = plain.iter().chain(&extended).any(|record| record.is(PROJECTION, WKT));
    let is_kept = |record: &&VariableRecord| is_carried(record) && !(has_wkt && is_geotiff(record));
    plain.extend(scan.vlrs.iter().filter(is_kept).cloned());
    extended.extend(scan.evlrs.iter().filter(is_kept).cloned());
    Ok(Records { plain, extended })
}

/// Beside WKT these would say the same a second time, or something else; the output's point formats require WKT
/// (LAS 1.4 R15, 2.6).
fn is_geotiff(record: &VariableRecord) -> bool {
    [GEOTIFF_DIRECTORY, GEOTIFF_DOUBLES, GEOTIFF_ASCII].iter().any(|id| record.is(PROJECTION, *id))
}

fn is_carried(record: &VariableRecord) -> bool {
    let replaced = [(PROJECTION, WKT), (SPECIFICATION, EXTRA_BYTES), (LazVlr::USER_ID, LazVlr::RECORD_ID)];
    let user = record.user();
    !replaced.iter().any(|(user, id)| record.is(user, *id))
        && user != COPC
        && user != GROMA
        && !record.is_waveform()
        && record.is_named()
}
