//! From the integers of a record to source coordinates and to a place in the root cube.

use super::cube::{Bounds, Cube, Grid};
use crate::record::position;

/// value = integer × scale + offset, on each axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    pub scale: [f64; 3],
    pub offset: [f64; 3],
}

/// Smallest and largest integers on each axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Extent {
    pub low: [i32; 3],
    pub high: [i32; 3],
}

impl Frame {
    #[inline]
    pub fn coordinates(&self, integers: [i32; 3]) -> [f64; 3] {
        std::array::from_fn(|i| f64::from(integers[i]) * self.scale[i] + self.offset[i])
    }

    /// Finds the places of records in a cube.
    pub fn locator(&self, cube: &Cube) -> Locator {
        Locator { frame: *self, grid: cube.grid() }
    }

    /// The integers nearest to bounds in source coordinates; `None` where there are none, because the bounds are not
    /// numbers, stand the wrong way round or lie beyond all integers.
    pub fn nearest(&self, bounds: &Bounds) -> Option<Extent> {
        let mut extent = Extent::EMPTY;
        for i in 0..3 {
            if bounds.min[i] > bounds.max[i] {
                return None;
            }
            for value in [bounds.min[i], bounds.max[i]] {
                let step = ((value - self.offset[i]) / self.scale[i]).round();
                if !(f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&step) {
                    return None;
                }
                extent.low[i] = extent.low[i].min(step as i32);
                extent.high[i] = extent.high[i].max(step as i32);
            }
        }
        Some(extent)
    }

    /// The bounds of an extent. A negative scale turns an axis round.
    pub fn bounds(&self, extent: &Extent) -> Bounds {
        let (a, b) = (self.coordinates(extent.low), self.coordinates(extent.high));
        Bounds { min: std::array::from_fn(|i| a[i].min(b[i])), max: std::array::from_fn(|i| a[i].max(b[i])) }
    }
}

/// The places of records in a root cube.
#[derive(Debug, Clone, Copy)]
pub struct Locator {
    frame: Frame,
    grid: Grid,
}

impl Locator {
    /// The Morton code of a record.
    #[inline]
    pub fn code(&self, record: &[u8]) -> u64 {
        let [x, y, z] = position(record);
        let Frame { scale, offset } = &self.frame;
        let coordinate = |integer: i32, i: usize| f64::from(integer) * scale[i] + offset[i];
        self.grid.code([coordinate(x, 0), coordinate(y, 1), coordinate(z, 2)])
    }
}

impl Extent {
    /// What holds nothing.
    pub const EMPTY: Self = Self { low: [i32::MAX; 3], high: [i32::MIN; 3] };

    /// The extent of whole records of `length` bytes.
    pub fn of(records: &[u8], length: usize) -> Self {
        let mut extent = Self::EMPTY;
        for record in records.chunks_exact(length) {
            let position = position(record);
            for ((low, high), value) in extent.low.iter_mut().zip(&mut extent.high).zip(position) {
                *low = value.min(*low);
                *high = value.max(*high);
            }
        }
        extent
    }

    pub fn join(&mut self, other: &Self) {
        for i in 0..3 {
            self.low[i] = self.low[i].min(other.low[i]);
            self.high[i] = self.high[i].max(other.high[i]);
        }
    }

    pub fn contains(&self, other: &Self) -> bool {
        (0..3).all(|i| self.low[i] <= other.low[i] && other.high[i] <= self.high[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame { scale: [0.01, -0.5, 1.0], offset: [100.0, 0.0, -7.0] };

    #[test]
    fn declared_bounds_find_their_integers() {
        let extent = Extent { low: [-3, 4, 5], high: [9, 6, 7] };
        let mut bounds = FRAME.bounds(&extent);
        assert_eq!((bounds.min[1], bounds.max[1]), (-3.0, -2.0));
        bounds.min[0] += 0.004;
        assert_eq!(FRAME.nearest(&bounds), Some(extent));
    }

    #[test]
    fn bounds_that_are_none() {
        let bounds = |min, max| Bounds { min: [min, 0.0, 0.0], max: [max, 1.0, 1.0] };
        for (min, max) in
            [(f64::NAN, 1.0), (0.0, f64::NAN), (2.0, 1.0), (0.0, 1e300), (f64::NEG_INFINITY, 0.0)]
        {
            assert_eq!(FRAME.nearest(&bounds(min, max)), None, "{min} {max}");
        }
    }

    #[test]
    fn extents_of_records() {
        let mut records = Vec::new();
        for position in [[1i32, 5, -9], [i32::MIN, i32::MAX, 0]] {
            position.iter().for_each(|v| records.extend(v.to_le_bytes()));
            records.push(0);
        }
        let extent = Extent::of(&records, 13);
        assert_eq!(extent, Extent { low: [i32::MIN, 5, -9], high: [1, i32::MAX, 0] });
        let mut joined = Extent::EMPTY;
        joined.join(&extent);
        assert!(joined == extent && joined.contains(&extent) && extent.contains(&Extent::EMPTY));
    }
}
