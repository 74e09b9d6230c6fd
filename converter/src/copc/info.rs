//! The COPC information record: user id `copc`, record id 1, the first record after the header.

use crate::octree::cube::{Cube, GRID};
use crate::scan::variable_record::{COPC, COPC_INFO, VariableRecord};

/// Bytes of the record's data.
pub const LENGTH: usize = 160;

/// What the record says.
#[derive(Debug, Clone, PartialEq)]
pub struct Info {
    pub cube: Cube,
    /// Where the data of the root hierarchy page begins in the file, and its bytes.
    pub root_page: (u64, u64),
    /// Smallest and largest GPS time; zeros where the points have none.
    pub gps_time: [f64; 2],
}

impl Info {
    /// Distance of the root node's points, in source units.
    pub fn spacing(&self) -> f64 {
        self.cube.side() / f64::from(GRID)
    }

    pub fn record(&self) -> VariableRecord {
        let mut data = Vec::with_capacity(LENGTH);
        let [x, y, z] = self.cube.center;
        for value in [x, y, z, self.cube.half_size, self.spacing()] {
            data.extend(value.to_le_bytes());
        }
        data.extend(self.root_page.0.to_le_bytes());
        data.extend(self.root_page.1.to_le_bytes());
        for value in self.gps_time {
            data.extend(value.to_le_bytes());
        }
        data.resize(LENGTH, 0);
        VariableRecord::new(COPC, COPC_INFO, "COPC info VLR", data)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_stand_where_the_specification_has_them() {
        let cube = Cube { center: [1.0, 2.0, 3.0], half_size: 64.0 };
        let record = Info { cube, root_page: (1000, 32), gps_time: [5.0, 6.0] }.record();
        let float = |at: usize| f64::from_le_bytes(record.data[at..at + 8].try_into().unwrap());
        assert_eq!(record.data.len(), LENGTH);
        assert_eq!([float(0), float(8), float(16), float(24), float(32)], [1.0, 2.0, 3.0, 64.0, 1.0]);
        assert_eq!(record.data[40..48], 1000u64.to_le_bytes());
        assert_eq!(record.data[48..56], 32u64.to_le_bytes());
        assert_eq!([float(56), float(64)], [5.0, 6.0]);
    }
}
