//! LAZ: where the chunks are, and how one is decoded without trusting it.

mod chunks;
mod decode;
mod head;
mod table;

pub use chunks::{Chunks, Rescued, chunks};
pub use decode::{decode_chunk, stream};

use super::contain::contained;
use crate::error::{Error, Result};
use crate::scan::Scan;
use laz::{LazItemRecordBuilder, LazVlr};

/// The compression parameters, checked against the header.
pub fn parameters(scan: &Scan) -> Result<LazVlr> {
    let path = &scan.path;
    let record = scan.record(LazVlr::USER_ID, LazVlr::RECORD_ID);
    let record = record.ok_or_else(|| {
        Error::corrupt(path, "the points are compressed, but the LASzip record is not there")
    })?;
    let fail = |cause| Error::corrupt(path, format!("LASzip record: {cause}"));
    let vlr = contained(fail, || LazVlr::from_buffer(&record.data))?;
    let types = |items: &[laz::LazItem]| items.iter().map(|i| (i.item_type(), i.size())).collect::<Vec<_>>();
    let extra =
        scan.header.point_data_record_length - crate::scan::RECORD_LENGTHS[usize::from(scan.point_format)];
    let expected = LazItemRecordBuilder::default_for_point_format_id(scan.point_format, extra);
    let expected = expected.map_err(|e| Error::corrupt(path, e))?;
    if types(vlr.items()) != types(&expected) {
        return Err(Error::corrupt(
            path,
            "the LASzip record does not fit the point format and record length",
        ));
    }
    Ok(vlr)
}

/// Whether the chunks are those of LASzip 3, whose layers must be in memory as a whole.
pub fn is_layered(vlr: &LazVlr) -> bool {
    vlr.items().first().is_some_and(|item| item.version() >= 3)
}
