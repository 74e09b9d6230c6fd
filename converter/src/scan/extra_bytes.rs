//! The descriptors of extra bytes: LAS 1.4 R15, "Extra Bytes" record (user id `LASF_Spec`, record id 4).

use super::variable_record::{padded, text};
use serde::Serialize;
use std::ops::Range;

/// Bytes of one descriptor.
const DESCRIPTOR: usize = 192;
/// Byte of the data type.
const DATA_TYPE_AT: usize = 2;
/// Bytes of each of the two texts.
const TEXT: usize = 32;
const NAME: Range<usize> = 4..4 + TEXT;
const DESCRIPTION: Range<usize> = 160..160 + TEXT;

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

/// The extra bytes of a file's records, as far as their descriptors tell.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Described {
    /// In record order; together they take no more bytes than there are.
    pub attributes: Vec<ExtraBytes>,
    /// Their descriptors, for an output: those of the file, but with names and descriptions in UTF-8.
    pub descriptors: Vec<u8>,
}

impl Described {
    /// What `descriptors` say of the `room` extra bytes of a record. Those that reach beyond it, or have a data type
    /// that the standard does not know, and those behind them are passed over with a warning: readers refuse a file
    /// that describes more bytes than it has.
    pub fn of(descriptors: &[u8], room: usize, warnings: &mut Vec<String>) -> Self {
        let mut described = Self::default();
        let mut at = 0;
        for bytes in descriptors.as_chunks::<DESCRIPTOR>().0 {
            let name = text(&bytes[NAME]);
            let attribute = match attribute(bytes) {
                Some(attribute) if at + attribute.size <= room => attribute,
                Some(ExtraBytes { size, .. }) => {
                    let (first, last) = (at + 1, at + size);
                    warnings.push(format!(
                        "the attribute {name} is described as the extra bytes {first} to {last}, and {room} are there; \
                         it and all described after it are left out"
                    ));
                    break;
                }
                None => {
                    warnings.push(format!(
                        "the attribute {name} has data type {}, which LAS 1.4 does not define; it and all described \
                         after it are left out",
                        bytes[DATA_TYPE_AT]
                    ));
                    break;
                }
            };
            if !is_utf8(&bytes[NAME]) {
                warnings
                    .push(format!("the name of the attribute {name} is not UTF-8; it is read as Latin-1"));
            }
            at += attribute.size;
            described.descriptors.extend(in_utf8(bytes));
            described.attributes.push(attribute);
        }
        if at < room {
            warnings
                .push(format!("{room} extra bytes per point are there, {at} are described; all are kept"));
        }
        described
    }
}

fn is_utf8(field: &[u8]) -> bool {
    let end = field.iter().position(|byte| *byte == 0).unwrap_or(field.len());
    str::from_utf8(&field[..end]).is_ok()
}

/// A descriptor whose texts are UTF-8, as laspy and others want it; unchanged where they are so already.
fn in_utf8(descriptor: &[u8; DESCRIPTOR]) -> [u8; DESCRIPTOR] {
    let mut changed = *descriptor;
    for field in [NAME, DESCRIPTION] {
        if !is_utf8(&descriptor[field.clone()]) {
            let text: [u8; TEXT] = padded(&text(&descriptor[field.clone()]));
            changed[field].copy_from_slice(&text);
        }
    }
    changed
}

/// What a descriptor says; `None` where its data type is none.
fn attribute(bytes: &[u8; DESCRIPTOR]) -> Option<ExtraBytes> {
    let (data_type, options) = (bytes[DATA_TYPE_AT], bytes[3]);
    let (kind, size) = match data_type {
        0 => (format!("bytes[{options}]"), usize::from(options)),
        1..=30 => {
            let (name, size) = TYPES[usize::from(data_type - 1) % 10];
            let count = usize::from(data_type - 1) / 10 + 1;
            (if count == 1 { name.to_string() } else { format!("{name}[{count}]") }, size * count)
        }
        _ => return None,
    };
    let eight = |at: usize| -> [u8; 8] { bytes[at..at + 8].try_into().unwrap_or_default() };
    let flag = |bit: u8| data_type != 0 && options & (1 << bit) != 0;
    Some(ExtraBytes {
        name: text(&bytes[NAME]),
        kind,
        size,
        scale: if flag(3) { f64::from_le_bytes(eight(112)) } else { 1.0 },
        offset: if flag(4) { f64::from_le_bytes(eight(136)) } else { 0.0 },
        no_data: flag(0).then(|| eight(40)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(data_type: u8, options: u8, name: impl AsRef<[u8]>) -> Vec<u8> {
        let name = name.as_ref();
        let mut descriptor = vec![0; DESCRIPTOR];
        descriptor[2] = data_type;
        descriptor[3] = options;
        descriptor[4..4 + name.len()].copy_from_slice(name);
        descriptor[112..120].copy_from_slice(&0.5f64.to_le_bytes());
        descriptor
    }

    #[test]
    fn types_sizes_and_scale() {
        let mut data = bytes(9, 0, "height");
        data.extend(bytes(13, 0, "pair"));
        data.extend(bytes(0, 5, "raw"));
        data.extend(bytes(4, 8, "scaled"));
        let mut warnings = Vec::new();
        let described = Described::of(&data, 15, &mut warnings);
        let found = &described.attributes;
        assert!(warnings.is_empty() && described.descriptors == data);
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
        assert_eq!(Described::of(&[0; 191], 0, &mut Vec::new()), Described::default());
    }

    /// The attributes that are left of `uint8` a, `float64` b and `uint8` c in a record of so many extra bytes, the
    /// number of descriptors for an output, and the warnings.
    fn left(types: [u8; 3], room: usize) -> (String, usize, Vec<String>) {
        let data = [bytes(types[0], 0, "a"), bytes(types[1], 0, "b"), bytes(types[2], 0, "c")].concat();
        let mut warnings = Vec::new();
        let Described { attributes, descriptors } = Described::of(&data, room, &mut warnings);
        (attributes.iter().map(|a| a.name.as_str()).collect(), descriptors.len() / DESCRIPTOR, warnings)
    }

    #[test]
    fn what_has_no_room_or_no_type_is_not_described() {
        assert_eq!(left([1, 10, 1], 10), ("abc".into(), 3, vec![]));
        for (room, names) in [(9, "ab"), (8, "a"), (0, "")] {
            let (found, descriptors, warnings) = left([1, 10, 1], room);
            assert_eq!((found.as_str(), descriptors), (names, names.len()), "{room}");
            assert!(warnings[0].contains("left out"), "{warnings:?}");
        }
        let (found, descriptors, warnings) = left([1, 31, 1], 10);
        assert_eq!((found.as_str(), descriptors), ("a", 1));
        assert!(
            warnings[0].contains("data type 31") && warnings[1].contains("10 extra bytes"),
            "{warnings:?}"
        );
    }

    #[test]
    fn latin_1_becomes_utf_8_and_all_else_stays() {
        let mut warnings = Vec::new();
        let latin = bytes(1, 0, b"H\xf6he");
        let described = Described::of(&latin, 1, &mut warnings);
        assert_eq!(described.attributes[0].name, "H\u{f6}he");
        assert_eq!(described.descriptors, bytes(1, 0, "H\u{f6}he"));
        assert!(warnings[0].contains("Latin-1"), "{warnings:?}");
        // Twice as long in UTF-8: cut between two characters.
        let long = Described::of(&bytes(1, 0, [b"a".as_slice(), &[0xe9; 31]].concat()), 1, &mut warnings);
        assert_eq!(long.descriptors[NAME], padded::<TEXT>(&format!("a{}", "\u{e9}".repeat(15))));
        warnings.clear();
        let utf8 = bytes(1, 0, "H\u{f6}he");
        assert_eq!(Described::of(&utf8, 1, &mut warnings).descriptors, utf8);
        assert!(warnings.is_empty());
    }
}
