//! Point data records: from the formats 0 to 10 to the formats 6, 7 and 8 that COPC knows.

pub mod exact;
pub mod fields;
pub mod mapping;

use crate::scan::RECORD_LENGTHS;

/// The formats that COPC 1.0 allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Format 6: no colour.
    Plain,
    /// Format 7: red, green, blue.
    Rgb,
    /// Format 8: red, green, blue, near infrared.
    RgbNir,
}

impl Target {
    /// The format that keeps every field of `format` but waveforms. `None` for a format that there is not.
    pub fn of(format: u8) -> Option<Self> {
        match format {
            0 | 1 | 4 | 6 | 9 => Some(Self::Plain),
            2 | 3 | 5 | 7 => Some(Self::Rgb),
            8 | 10 => Some(Self::RgbNir),
            _ => None,
        }
    }

    /// The point data record format.
    pub fn id(self) -> u8 {
        match self {
            Self::Plain => 6,
            Self::Rgb => 7,
            Self::RgbNir => 8,
        }
    }

    /// Bytes of a record without extra bytes.
    pub fn length(self) -> usize {
        usize::from(RECORD_LENGTHS[usize::from(self.id())])
    }
}

/// Whether the records of a format hold waveform packets.
pub fn has_waveform(format: u8) -> bool {
    matches!(format, 4 | 5 | 9 | 10)
}

/// Whether the records of a format hold a GPS time.
pub fn has_gps_time(format: u8) -> bool {
    !matches!(format, 0 | 2)
}

/// Byte of red in a record of the formats 7 and 8; green and blue follow.
const COLOUR_AT: usize = 30;

/// Whether the records of an output hold colours.
pub fn has_colour(target: Target) -> bool {
    target != Target::Plain
}

/// Red, green and blue of a record of the formats 7 and 8.
pub fn colour(record: &[u8]) -> [u16; 3] {
    std::array::from_fn(|i| u16::from_le_bytes([record[COLOUR_AT + 2 * i], record[COLOUR_AT + 2 * i + 1]]))
}

/// Replaces red, green and blue of a record of the formats 7 and 8.
pub fn set_colour(record: &mut [u8], colour: [u16; 3]) {
    for (bytes, value) in record[COLOUR_AT..].as_chunks_mut::<2>().0.iter_mut().zip(colour) {
        *bytes = value.to_le_bytes();
    }
}

/// X, Y and Z of a record of any format, as stored.
#[inline]
pub fn position(record: &[u8]) -> [i32; 3] {
    let axis = |at: usize| i32::from_le_bytes([record[at], record[at + 1], record[at + 2], record[at + 3]]);
    [axis(0), axis(4), axis(8)]
}
