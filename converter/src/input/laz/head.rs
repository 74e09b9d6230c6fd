//! The head of a layered chunk, by which chunks are found and checked.

use laz::{LazItemType, LazVlr};
use std::io::Read;

/// How a layered chunk (LASzip 3) begins: one plain record, the number of points (u32), the size of each layer (u32).
/// Its layers follow.
pub struct ChunkHead {
    /// Bytes of itself.
    pub bytes: u64,
    pub points: u32,
    /// Bytes of all layers.
    pub layers: u64,
}

impl ChunkHead {
    /// Reads it from where `source` stands, for the items of a LASzip record.
    pub fn read(source: &mut impl Read, vlr: &LazVlr) -> std::io::Result<Self> {
        let layers: usize = vlr.items().iter().map(|item| layers_of(item.item_type())).sum();
        let record: usize = vlr.items().iter().map(|item| usize::from(item.size())).sum();
        let mut head = vec![0; record + 4 + layers * 4];
        source.read_exact(&mut head)?;
        let mut numbers = head[record..].as_chunks::<4>().0.iter().map(|b| u32::from_le_bytes(*b));
        let points = numbers.next().unwrap_or(0);
        Ok(Self { bytes: head.len() as u64, points, layers: numbers.map(u64::from).sum() })
    }

    /// Bytes of the chunk.
    pub fn bytes(&self) -> u64 {
        self.bytes + self.layers
    }
}

fn layers_of(item: LazItemType) -> usize {
    match item {
        LazItemType::Point14 => 9,
        LazItemType::RGBNIR14 => 2,
        LazItemType::Byte14(count) => count.into(),
        _ => 1,
    }
}
