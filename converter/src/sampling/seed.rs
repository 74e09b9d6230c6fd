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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_split_mix_64() {
        // The first numbers that the generator gives from these states.
        assert_eq!(hash(1_234_567), 6_457_827_717_110_365_317);
        assert_eq!(hash(0), 0xe220_a839_7b1d_cdaf);
        assert_eq!(hash(0x9e37_79b9_7f4a_7c15), 0x6e78_9e6a_a1b9_65f4);
    }

    /// Equal seeds would leave the choice to the order of the input.
    #[test]
    fn seeds_differ_by_level_place_node_and_number() {
        let places =
            [[1.0, 2.0, 3.0], [2.0, 1.0, 3.0], [1.0, 3.0, 2.0], [-1.0, 2.0, 3.0], [0.0; 3], [1.0; 3]];
        let of_places = (0..20).flat_map(|level| places.map(|place| of_place(level, &place)));
        let of_numbers = (0..20).flat_map(|node| (0..200).map(move |number| of_number(node, number)));
        let seeds: std::collections::HashSet<u64> = of_places.chain(of_numbers).collect();
        assert_eq!(seeds.len(), 20 * (places.len() + 200));
    }
}
