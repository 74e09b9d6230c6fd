//! Where the attributes of a record of format 6, 7 or 8 lie, and how to read one as a number.

use super::Target;
use crate::scan::extra_bytes::ExtraBytes;

/// How the bytes of a field are a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    LowNibble,
    HighNibble,
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F32,
    F64,
}

impl Kind {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "uint8" => Self::U8,
            "int8" => Self::I8,
            "uint16" => Self::U16,
            "int16" => Self::I16,
            "uint32" => Self::U32,
            "int32" => Self::I32,
            "uint64" => Self::U64,
            "int64" => Self::I64,
            "float32" => Self::F32,
            "float64" => Self::F64,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::LowNibble | Self::HighNibble | Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }
}

/// One numeric attribute of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    pub name: String,
    /// Byte in the record.
    pub at: usize,
    pub kind: Kind,
    /// value = stored × scale + offset.
    pub scale: f64,
    pub offset: f64,
    /// The stored bytes that mean "no value".
    no_data: Option<[u8; 8]>,
}

impl Field {
    /// The stored number, or `None` where the record says that there is no value.
    #[inline]
    pub fn stored(&self, record: &[u8]) -> Option<f64> {
        let bytes = &record[self.at..self.at + self.kind.size()];
        if self.no_data.is_some_and(|none| none[..bytes.len()] == *bytes) {
            return None;
        }
        Some(match *bytes {
            [a] => match self.kind {
                Kind::LowNibble => f64::from(a & 15),
                Kind::HighNibble => f64::from(a >> 4),
                Kind::I8 => f64::from(a as i8),
                _ => f64::from(a),
            },
            [a, b] => match self.kind {
                Kind::I16 => f64::from(i16::from_le_bytes([a, b])),
                _ => f64::from(u16::from_le_bytes([a, b])),
            },
            [a, b, c, d] => match self.kind {
                Kind::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
                Kind::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
                _ => f64::from(u32::from_le_bytes([a, b, c, d])),
            },
            _ => {
                let bytes: [u8; 8] = bytes.try_into().ok()?;
                match self.kind {
                    Kind::F64 => f64::from_le_bytes(bytes),
                    Kind::I64 => i64::from_le_bytes(bytes) as f64,
                    _ => u64::from_le_bytes(bytes) as f64,
                }
            }
        })
    }
}

impl Field {
    /// Hands on the stored numbers of whole records, one after the other.
    #[inline]
    pub fn each(&self, records: &[u8], length: usize, mut hand: impl FnMut(f64)) {
        // A loop for each of the common kinds, which asks nothing per record.
        let at = self.at;
        let records = records.chunks_exact(length);
        match self.kind {
            _ if self.no_data.is_some() => records.filter_map(|record| self.stored(record)).for_each(hand),
            Kind::U8 => records.for_each(|r| hand(f64::from(r[at]))),
            Kind::LowNibble => records.for_each(|r| hand(f64::from(r[at] & 15))),
            Kind::HighNibble => records.for_each(|r| hand(f64::from(r[at] >> 4))),
            Kind::U16 => records.for_each(|r| hand(f64::from(u16::from_le_bytes([r[at], r[at + 1]])))),
            Kind::I32 => {
                records.for_each(|r| {
                    hand(f64::from(i32::from_le_bytes([r[at], r[at + 1], r[at + 2], r[at + 3]])))
                });
            }
            _ => records.filter_map(|record| self.stored(record)).for_each(hand),
        }
    }
}

/// The attributes of a record: the standard ones (names of the LAS 1.4 tables in camel case; scan angle in
/// degrees), then the numeric extra bytes under their own names.
pub fn fields(
    target: Target,
    scale: [f64; 3],
    offset: [f64; 3],
    extra: &[ExtraBytes],
    record_length: usize,
) -> Vec<Field> {
    let field = |name: &str, at, kind, scale, offset| Field {
        name: name.into(),
        at,
        kind,
        scale,
        offset,
        no_data: None,
    };
    let plain = |name, at, kind| field(name, at, kind, 1.0, 0.0);
    let mut fields = vec![
        field("x", 0, Kind::I32, scale[0], offset[0]),
        field("y", 4, Kind::I32, scale[1], offset[1]),
        field("z", 8, Kind::I32, scale[2], offset[2]),
        plain("intensity", 12, Kind::U16),
        plain("returnNumber", 14, Kind::LowNibble),
        plain("numberOfReturns", 14, Kind::HighNibble),
        plain("classification", 16, Kind::U8),
        plain("userData", 17, Kind::U8),
        field("scanAngle", 18, Kind::I16, 0.006, 0.0),
        plain("pointSourceId", 20, Kind::U16),
        plain("gpsTime", 22, Kind::F64),
    ];
    if target != Target::Plain {
        fields.extend([
            plain("red", 30, Kind::U16),
            plain("green", 32, Kind::U16),
            plain("blue", 34, Kind::U16),
        ]);
    }
    if target == Target::RgbNir {
        fields.push(plain("nir", 36, Kind::U16));
    }
    let mut at = target.length();
    for attribute in extra {
        let end = at + attribute.size;
        if let Some(kind) = Kind::named(&attribute.kind).filter(|_| end <= record_length) {
            let ExtraBytes { name, scale, offset, no_data, .. } = attribute.clone();
            fields.push(Field { name, at, kind, scale, offset, no_data });
        }
        at = end;
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extra_bytes_follow_the_standard_fields() {
        let attribute = |name: &str, kind: &str, size, no_data| ExtraBytes {
            name: name.into(),
            kind: kind.into(),
            size,
            scale: 2.0,
            offset: 1.0,
            no_data,
        };
        let extra =
            [attribute("skipped", "bytes[3]", 3, None), attribute("depth", "int16", 2, Some([0xff; 8]))];
        let all = fields(Target::Rgb, [1.0; 3], [0.0; 3], &extra, 41);
        let depth = all.last().unwrap();
        assert_eq!((depth.name.as_str(), depth.at), ("depth", 39));
        let mut record = [0u8; 41];
        record[39..].copy_from_slice(&(-2i16).to_le_bytes());
        assert_eq!(depth.stored(&record), Some(-2.0));
        record[39..].copy_from_slice(&[0xff; 2]);
        assert_eq!(depth.stored(&record), None);
        assert!(fields(Target::Rgb, [1.0; 3], [0.0; 3], &extra, 40).iter().all(|f| f.name != "depth"));
    }
}
