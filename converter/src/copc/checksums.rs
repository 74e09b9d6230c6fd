//! Checksums of the nodes' chunks: user id `groma`, record id 4 (docs/record.md). LAZ has none of its own, so that a
//! damaged chunk may decode to wrong points.
//!
//! They are CRC-32C (Castagnoli's polynomial, RFC 3720, appendix B.4): four bytes a node, no error within 32 bits in a
//! row goes unseen, of others one in 2^32, and processors have an instruction for it.

use super::hierarchy::{ENTRY, Entry};
use crate::error::{Error, Result};
use crate::scan::Scan;
use crate::scan::variable_record::{COPC, COPC_INFO, GROMA, GROMA_CHECKSUMS, VariableRecord};
use std::collections::HashMap;
use std::fmt;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};

/// Bytes before the checksums: the method (u32), their number (u32), the first byte of the hierarchy (u64).
const HEADER: usize = 16;

/// The only method that there is.
const CRC_32C: u32 = 1;

/// Byte of the root page's offset in the data of COPC's information record.
const ROOT_PAGE_AT: usize = 40;

/// Bytes of a record's data for so many entries of the hierarchy.
pub fn length(entries: usize) -> usize {
    HEADER + 4 * entries
}

/// The checksum of a chunk.
pub fn of(chunk: &[u8]) -> u32 {
    crc32c::crc32c(chunk)
}

/// The checksum of the first `length` bytes that a source gives.
pub fn of_source(source: &mut impl Read, length: u64) -> std::io::Result<u32> {
    let mut part = vec![0; length.min(1 << 18) as usize];
    let (mut checksum, mut left) = (0, length);
    while left > 0 {
        let part = &mut part[..left.min(1 << 18) as usize];
        source.read_exact(part)?;
        checksum = crc32c::crc32c_append(checksum, part);
        left -= part.len() as u64;
    }
    Ok(checksum)
}

/// The record of the checksums of a hierarchy's entries, which begins at a byte of the file.
pub fn record(checksums: &[u32], hierarchy_at: u64) -> VariableRecord {
    let mut data = Vec::with_capacity(length(checksums.len()));
    data.extend(CRC_32C.to_le_bytes());
    data.extend((checksums.len() as u32).to_le_bytes());
    data.extend(hierarchy_at.to_le_bytes());
    data.extend(checksums.iter().flat_map(|checksum| checksum.to_le_bytes()));
    VariableRecord::new(GROMA, GROMA_CHECKSUMS, "checksums of the nodes", data)
}

/// What a chunk must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Expected {
    pub node: Node,
    pub checksum: u32,
}

/// Level, x, y and z of a node, written `3-1-2-0`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Node(pub [u32; 4]);

impl fmt::Display for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [level, x, y, z] = self.0;
        write!(f, "{level}-{x}-{y}-{z}")
    }
}

/// What a file has to say of checksums.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stored<'a> {
    /// There are none.
    No,
    /// They were made for another file, or by a method that is not known: a program that rewrites a file may take the
    /// records of the old one along.
    Foreign,
    /// One for each entry of the hierarchy, four bytes each, which begins at a byte of the file.
    Yes { checksums: &'a [[u8; 4]], hierarchy_at: u64 },
}

/// The checksums of a file, as it says them.
pub fn stored(scan: &Scan) -> Stored<'_> {
    let Some(record) = scan.record(GROMA, GROMA_CHECKSUMS) else { return Stored::No };
    let root_page =
        scan.record(COPC, COPC_INFO).and_then(|info| info.data.get(ROOT_PAGE_AT..)?.first_chunk());
    let Some((head, checksums)) = record.data.split_first_chunk::<HEADER>() else { return Stored::Foreign };
    let (words, _) = head.as_chunks::<4>();
    let (checksums, rest) = checksums.as_chunks::<4>();
    let hierarchy_at = u64::from_le_bytes([words[2], words[3]].concat().try_into().unwrap_or_default());
    let is_own = u32::from_le_bytes(words[0]) == CRC_32C
        && u32::from_le_bytes(words[1]) as usize == checksums.len()
        && rest.is_empty()
        && scan.is_copc()
        && root_page == Some(&hierarchy_at.to_le_bytes());
    if is_own { Stored::Yes { checksums, hierarchy_at } } else { Stored::Foreign }
}

/// What the chunks of a file must be, by their first bytes; `None` where the file has no checksums of its own.
///
/// Errors: `INPUT_TRUNCATED` where the file ends before its hierarchy does.
pub fn expected(scan: &Scan) -> Result<Option<HashMap<u64, Expected>>> {
    let Stored::Yes { checksums, hierarchy_at } = stored(scan) else { return Ok(None) };
    let path = &scan.path;
    let end = hierarchy_at.saturating_add((checksums.len() * ENTRY) as u64);
    if end > scan.file_size {
        let cause = format!("its octree is told up to byte {end} of {}", scan.file_size);
        return Err(Error::truncated(path, cause));
    }
    let reading = |e| Error::reading(path, &e);
    let mut file = File::open(path).map(BufReader::new).map_err(reading)?;
    file.seek(SeekFrom::Start(hierarchy_at)).map_err(reading)?;
    let mut chunks = HashMap::with_capacity(checksums.len());
    let mut bytes = [0; ENTRY];
    for checksum in checksums {
        file.read_exact(&mut bytes).map_err(reading)?;
        if let Some(Entry { key, offset, points: 1.., .. }) = Entry::parse(&bytes) {
            chunks.insert(offset, Expected { node: Node(key), checksum: u32::from_le_bytes(*checksum) });
        }
    }
    Ok(Some(chunks))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_crc_32c() {
        // RFC 3720, appendix B.4: 32 bytes of zeros, of ones, ascending.
        assert_eq!(of(&[0; 32]), 0x8a91_36aa);
        assert_eq!(of(&[0xff; 32]), 0x62a8_ab43);
        let ascending: Vec<u8> = (0..32).collect();
        assert_eq!(of(&ascending), 0x46dd_794e);
        let long: Vec<u8> = (0..700_000u32).map(|i| (i.wrapping_mul(i) >> 3) as u8).collect();
        assert_eq!(of_source(&mut long.as_slice(), 600_000).unwrap(), of(&long[..600_000]));
        assert!(of_source(&mut long.as_slice(), 700_001).is_err());
    }

    #[test]
    fn the_record_is_laid_out_as_documented() {
        let record = record(&[0x0102_0304, 0xfffe_fdfc], 0x1122_3344_5566);
        let expected = [
            [1, 0, 0, 0, 2, 0, 0, 0, 0x66, 0x55, 0x44, 0x33, 0x22, 0x11, 0, 0].as_slice(),
            &[4, 3, 2, 1, 0xfc, 0xfd, 0xfe, 0xff],
        ]
        .concat();
        assert!(record.is("groma", 4) && record.data == expected && length(2) == expected.len());
    }
}
