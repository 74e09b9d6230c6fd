//! Names of nodes, and Morton codes of positions in the root cube.

/// Bits per axis of a Morton code: three of them fit into 63 bits.
pub const BITS: u32 = 21;

/// The name of a node: its level (root 0) and its place among the 2^level cubes along each axis.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Key {
    pub level: u32,
    pub x: u32,
    pub y: u32,
    pub z: u32,
}

impl Key {
    pub const ROOT: Self = Self { level: 0, x: 0, y: 0, z: 0 };

    /// The node of a level that a code lies in.
    pub fn of(code: u64, level: u32) -> Self {
        let [x, y, z] = coordinates(code >> (3 * (BITS - level)));
        Self { level, x, y, z }
    }

    pub fn child(self, octant: u32) -> Self {
        Self {
            level: self.level + 1,
            x: self.x << 1 | octant & 1,
            y: self.y << 1 | octant >> 1 & 1,
            z: self.z << 1 | octant >> 2 & 1,
        }
    }

    /// The node that this one lies in; the root's is the root.
    pub fn parent(self) -> Self {
        Self { level: self.level.saturating_sub(1), x: self.x >> 1, y: self.y >> 1, z: self.z >> 1 }
    }

    /// The 26 cubes around this one that lie in the root cube.
    pub fn neighbours(self) -> impl Iterator<Item = Self> {
        let last = (1i64 << self.level) - 1;
        let beside = move |value: u32, step: i64| {
            u32::try_from(i64::from(value) + step).ok().filter(|v| i64::from(*v) <= last)
        };
        (0..27i64).filter(|i| *i != 13).filter_map(move |i| {
            let x = beside(self.x, i % 3 - 1)?;
            let y = beside(self.y, i / 3 % 3 - 1)?;
            let z = beside(self.z, i / 9 - 1)?;
            Some(Self { level: self.level, x, y, z })
        })
    }

    /// The cube beyond a face, if it lies in the root cube: faces are low x, high x, low y, high y, low z, high z.
    pub fn beyond(self, face: usize) -> Option<Self> {
        let last = (1u32 << self.level) - 1;
        let step = |value: u32, axis: usize| match face {
            _ if face / 2 != axis => Some(value),
            _ if face.is_multiple_of(2) => value.checked_sub(1),
            _ => (value < last).then(|| value + 1),
        };
        Some(Self { level: self.level, x: step(self.x, 0)?, y: step(self.y, 1)?, z: step(self.z, 2)? })
    }

    /// One of eight numbers; nodes of a level with the same one do not touch.
    pub fn colour(self) -> u32 {
        self.x & 1 | (self.y & 1) << 1 | (self.z & 1) << 2
    }

    /// The key's place in the order of the nodes of its level along the Morton curve.
    pub fn morton(self) -> u64 {
        morton([self.x, self.y, self.z])
    }
}

/// Interleaves three numbers below 2^21: bit 0 of the result is x, bit 1 y, bit 2 z.
#[inline]
pub fn morton([x, y, z]: [u32; 3]) -> u64 {
    spread(x) | spread(y) << 1 | spread(z) << 2
}

/// The inverse of [`morton`].
#[inline]
pub fn coordinates(code: u64) -> [u32; 3] {
    [gather(code), gather(code >> 1), gather(code >> 2)]
}

/// Puts two zero bits before each of the 21 low bits.
#[inline]
fn spread(value: u32) -> u64 {
    let mut v = u64::from(value) & 0x1f_ffff;
    v = (v | v << 32) & 0x001f_0000_0000_ffff;
    v = (v | v << 16) & 0x001f_0000_ff00_00ff;
    v = (v | v << 8) & 0x100f_00f0_0f00_f00f;
    v = (v | v << 4) & 0x10c3_0c30_c30c_30c3;
    (v | v << 2) & 0x1249_2492_4924_9249
}

#[inline]
fn gather(code: u64) -> u32 {
    let mut v = code & 0x1249_2492_4924_9249;
    v = (v | v >> 2) & 0x10c3_0c30_c30c_30c3;
    v = (v | v >> 4) & 0x100f_00f0_0f00_f00f;
    v = (v | v >> 8) & 0x001f_0000_ff00_00ff;
    v = (v | v >> 16) & 0x001f_0000_0000_ffff;
    ((v | v >> 32) & 0x1f_ffff) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn morton_reads_back(p in proptest::array::uniform3(0u32..1 << BITS)) {
            prop_assert_eq!(coordinates(morton(p)), p);
        }

        #[test]
        fn a_code_lies_in_the_child_of_its_node(p in proptest::array::uniform3(0u32..1 << BITS), level in 0u32..BITS) {
            let code = morton(p);
            let octant = (code >> (3 * (BITS - level - 1)) & 7) as u32;
            prop_assert_eq!(Key::of(code, level).child(octant), Key::of(code, level + 1));
        }

        #[test]
        fn order_of_codes_is_order_of_nodes(a in 0u64..1 << 63, b in 0u64..1 << 63, level in 0u32..=BITS) {
            let (low, high) = (a.min(b), a.max(b));
            prop_assert!(Key::of(low, level).morton() <= Key::of(high, level).morton());
        }
    }

    #[test]
    fn neighbours_touch_and_have_other_colours() {
        let inner = Key { level: 2, x: 1, y: 2, z: 1 };
        assert_eq!(inner.neighbours().count(), 26);
        assert!(inner.neighbours().all(|key| key.colour() != inner.colour()));
        assert_eq!(Key { level: 2, x: 3, y: 0, z: 3 }.neighbours().count(), 7);
        assert_eq!(Key::ROOT.neighbours().count(), 0);
        assert_eq!(inner.child(6).parent(), inner);
    }

    #[test]
    fn the_root_holds_every_code() {
        assert_eq!(Key::of(u64::MAX >> 1, 0), Key::ROOT);
        assert_eq!(Key::ROOT.child(5), Key { level: 1, x: 1, y: 0, z: 1 });
    }
}
