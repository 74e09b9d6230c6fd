//! The descriptors of extra bytes: LAS 1.4 R15, "Extra Bytes" record (user id `LASF_Spec`, record id 4).

use super::variable_record::text;
use serde::Serialize;

/// Bytes of one descriptor.
const DESCRIPTOR: usize = 192;

/// Names and sizes of the data types 1 to 10 of the standard's table 24.
const TYPES: [(&str, usize); 10] = [
    ("uint8", 1),
    ("int8", 1),
    ("uint16", 2),
    ("int16", 2),
    ("uint32", 4),
    ("int32", 4),
    ("uint64", 8),
    ("int64", 8),
    ("float32", 4),
    ("float64", 8),
];

/// One attribute stored after the standard fields of a point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExtraBytes {
    pub name: String,
    /// `uint8` to `float64`; `float32[3]` for the deprecated arrays; `bytes[n]` for undocumented bytes.
    #[serde(rename = "type")]
    pub kind: String,
    /// Bytes that it takes in a record.
    #[serde(skip)]
    pub size: usize,
    /// value = stored × scale + offset.
    #[serde(skip)]
    pub scale: f64,
    #[serde(skip)]
    pub offset: f64,
    /// The stored bytes that mean "no value".
    #[serde(skip)]
    pub no_data: Option<[u8; 8]>,
}

/// The attributes of an extra bytes record, in record order.
pub fn parse(data: &[u8]) -> Vec<ExtraBytes> {
    data.chunks_exact(DESCRIPTOR).map(descriptor).collect()
}

fn descriptor(bytes: &[u8]) -> ExtraBytes {
    let (data_type, options) = (bytes[2], bytes[3]);
    let (kind, size) = match data_type {
        0 => (format!("bytes[{options}]"), usize::from(options)),
        1..=30 => {
            let (name, size) = TYPES[usize::from(data_type - 1) % 10];
            let count = usize::from(data_type - 1) / 10 + 1;
            (if count == 1 { name.to_string() } else { format!("{name}[{count}]") }, size * count)
        }
        _ => (format!("unknown[{data_type}]"), 0),
    };
    let eight = |at: usize| -> [u8; 8] { bytes[at..at + 8].try_into().unwrap_or_default() };
    let flag = |bit: u8| data_type != 0 && options & (1 << bit) != 0;
    ExtraBytes {
        name: text(&bytes[4..36]),
        kind,
        size,
        scale: if flag(3) { f64::from_le_bytes(eight(112)) } else { 1.0 },
        offset: if flag(4) { f64::from_le_bytes(eight(136)) } else { 0.0 },
        no_data: flag(0).then(|| eight(40)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(data_type: u8, options: u8, name: &str) -> Vec<u8> {
        let mut descriptor = vec![0; DESCRIPTOR];
        descriptor[2] = data_type;
        descriptor[3] = options;
        descriptor[4..4 + name.len()].copy_from_slice(name.as_bytes());
        descriptor[112..120].copy_from_slice(&0.5f64.to_le_bytes());
        descriptor
    }

    #[test]
    fn types_sizes_and_scale() {
        let mut data = bytes(9, 0, "height");
        data.extend(bytes(13, 0, "pair"));
        data.extend(bytes(0, 5, "raw"));
        data.extend(bytes(4, 8, "scaled"));
        let found = parse(&data);
        let shapes: Vec<_> = found.iter().map(|e| (e.name.as_str(), e.kind.as_str(), e.size)).collect();
        let expected = [
            ("height", "float32", 4),
            ("pair", "uint16[2]", 4),
            ("raw", "bytes[5]", 5),
            ("scaled", "int16", 2),
        ];
        assert_eq!(shapes, expected);
        assert_eq!(found[0].scale, 1.0);
        assert_eq!(found[3].scale, 0.5);
    }

    #[test]
    fn a_short_tail_is_no_descriptor() {
        assert!(parse(&[0; 191]).is_empty());
    }
}
