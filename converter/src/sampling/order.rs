//! The order of seeds.

/// Points by seed, then by place.
#[derive(Debug, Default)]
pub struct Order {
    keys: Vec<(u64, u32)>,
}

impl Order {
    /// The numbers of all points, the least seed first.
    pub fn all(&mut self, seed: &[u64]) -> impl ExactSizeIterator<Item = u32> {
        self.fill(seed);
        self.keys.sort_unstable();
        self.keys.iter().map(|(_, index)| *index)
    }

    /// The numbers of the `count` points of least seed, in no order.
    pub fn least(&mut self, seed: &[u64], count: usize) -> impl ExactSizeIterator<Item = u32> {
        self.fill(seed);
        if count < self.keys.len() {
            self.keys.select_nth_unstable(count);
        }
        self.keys[..count.min(seed.len())].iter().map(|(_, index)| *index)
    }

    fn fill(&mut self, seed: &[u64]) {
        self.keys.clear();
        self.keys.extend(seed.iter().copied().zip(0..));
    }
}
