//! The order of the points in a node. LAZ stores differences, so it is worth a sixth of the file which points follow each
//! other: those of a scanner best in the order in which it saw them, others along a curve through space.

use super::site::Site;
use crate::copc::chunk;
use crate::error::Result;

/// Points that are compressed both ways to find out.
const PROBE: usize = 2_048;

/// How the points of a node follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// As they came.
    Input,
    /// Along the Morton curve.
    Morton,
}

/// The order of the nodes of one job, found out with the first of them.
#[derive(Debug, Default)]
pub struct Arranger {
    order: Option<Order>,
    keys: Vec<(u64, u32)>,
}

impl Arranger {
    /// Brings records of `length` bytes, which stand in the input's order, into the better one.
    pub fn arrange(&mut self, site: &Site, records: Vec<u8>) -> Result<Vec<u8>> {
        let length = site.inputs.length;
        if self.order == Some(Order::Input) {
            return Ok(records);
        }
        self.keys.clear();
        let codes = records.chunks_exact(length).map(|record| site.inputs.frame.code(record, &site.cube));
        self.keys.extend(codes.zip(0..));
        self.keys.sort_unstable();
        let mut sorted = Vec::with_capacity(records.len());
        for (_, number) in &self.keys {
            sorted.extend_from_slice(&records[*number as usize * length..][..length]);
        }
        let order = match self.order {
            Some(order) => order,
            None => {
                let better = better(&records, &sorted, site)?;
                *self.order.insert(better)
            }
        };
        Ok(if order == Order::Morton { sorted } else { records })
    }

    /// Forgets what was found out: another job begins.
    pub fn reset(&mut self) {
        self.order = None;
    }
}

/// Compresses as many points from the middle of both.
fn better(input: &[u8], morton: &[u8], site: &Site) -> Result<Order> {
    let length = site.inputs.length;
    let points = input.len() / length;
    let start = points.saturating_sub(PROBE) / 2 * length;
    let size = |records: &[u8]| -> Result<usize> {
        let part = &records[start..records.len().min(start + PROBE * length)];
        Ok(chunk::compress(part, site.laz).map_err(Site::uncompressed)?.len())
    };
    Ok(if size(morton)? < size(input)? { Order::Morton } else { Order::Input })
}
