//! Seeds, which say in which order points are looked at.

/// The seed of a point for the choice of a level: by its place alone, so that neighbours know it too.
pub fn of_place(level: u32, position: &[f64; 3]) -> u64 {
    hash(position.iter().fold(u64::from(level), |seed, v| hash(seed ^ v.to_bits())))
}

/// The seed of the numbered point of a node: points at one place have seeds of their own.
pub fn of_number(node: u64, number: u32) -> u64 {
    hash(hash(node) ^ u64::from(number))
}

/// A number with no visible relation to another (SplitMix64: Steele, Lea, Flood 2014).
pub fn hash(value: u64) -> u64 {
    let mut v = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    v = (v ^ v >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    v = (v ^ v >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    v ^ v >> 31
}
