//! The mapping of one record (LAS 1.4 R15, "Point Data Record Format" 0 to 10). Formats 6, 7 and 8 pass
//! byte for byte.

use super::Target;
use crate::scan::RECORD_LENGTHS;

/// Class 12 of the formats 0 to 5, "overlap points", which the formats 6 to 10 say with a flag.
const LEGACY_OVERLAP: u8 = 12;
const UNCLASSIFIED: u8 = 1;
const OVERLAP_FLAG: u8 = 0b1000;
/// Degrees per unit of the scan angle of the formats 6 to 10.
const SCAN_ANGLE_UNIT: f64 = 0.006;

/// Byte offset of the GPS time in the formats 1 and 3 to 5.
const LEGACY_GPS_TIME: usize = 20;

/// How the records of one input become records of the output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mapping {
    source: u8,
    target: Target,
    source_length: usize,
    extra: usize,
}

impl Mapping {
    /// `None` if there is no such format or the record is too short for it.
    pub fn new(source: u8, record_length: u16) -> Option<Self> {
        let target = Target::of(source)?;
        let extra = record_length.checked_sub(RECORD_LENGTHS[usize::from(source)])?;
        Some(Self { source, target, source_length: record_length.into(), extra: extra.into() })
    }

    /// The format that records become.
    pub fn target(&self) -> Target {
        self.target
    }

    /// Bytes of a record of the input.
    pub fn source_length(&self) -> usize {
        self.source_length
    }

    /// Bytes of a record of the output.
    pub fn target_length(&self) -> usize {
        self.target.length() + self.extra
    }

    /// Bytes after the standard fields.
    pub fn extra(&self) -> usize {
        self.extra
    }

    /// Whether records pass unchanged.
    pub fn is_identity(&self) -> bool {
        self.source == self.target.id()
    }

    /// Maps one record: `from` of [`Self::source_length`], `to` of [`Self::target_length`] zeroed bytes.
    pub fn apply(&self, from: &[u8], to: &mut [u8]) {
        match self.source {
            0..=5 => self.apply_legacy(from, to),
            // Formats 9 and 10 are 6 and 8 with a waveform packet behind.
            _ => to[..self.target.length()].copy_from_slice(&from[..self.target.length()]),
        }
        let (from_extra, to_extra) = (self.source_length - self.extra, self.target.length());
        to[to_extra..].copy_from_slice(&from[from_extra..]);
    }

    fn apply_legacy(&self, from: &[u8], to: &mut [u8]) {
        to[..14].copy_from_slice(&from[..14]);
        let (returns, class) = (from[14], from[15]);
        to[14] = (returns & 0b111) | ((returns >> 3 & 0b111) << 4);
        let mut flags = class >> 5;
        let mut code = class & 0b1_1111;
        if code == LEGACY_OVERLAP {
            code = UNCLASSIFIED;
            flags |= OVERLAP_FLAG;
        }
        // Scan direction and edge of flight line keep their bits, 6 and 7; scanner channel (4, 5) is 0.
        to[15] = flags | (returns & 0b1100_0000);
        to[16] = code;
        to[17] = from[17];
        let angle = (f64::from(from[16] as i8) / SCAN_ANGLE_UNIT).round() as i16;
        to[18..20].copy_from_slice(&angle.to_le_bytes());
        to[20..22].copy_from_slice(&from[18..20]);
        if super::has_gps_time(self.source) {
            to[22..30].copy_from_slice(&from[LEGACY_GPS_TIME..LEGACY_GPS_TIME + 8]);
        }
        let rgb = match self.source {
            2 => 20,
            3 | 5 => 28,
            _ => return,
        };
        to[30..36].copy_from_slice(&from[rgb..rgb + 6]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn map(format: u8, from: &[u8]) -> Vec<u8> {
        let mapping = Mapping::new(format, from.len() as u16).unwrap();
        let mut to = vec![0; mapping.target_length()];
        mapping.apply(from, &mut to);
        to
    }

    #[test]
    fn returns_flags_class_and_angle() {
        let mut from = [0u8; 20];
        from[14] = 0b1101_1010; // return 2 of 3, scan direction 1, edge 1
        from[15] = 0b1010_0110; // withheld, synthetic, class 6
        from[16] = (-15i8) as u8;
        from[17] = 77;
        from[18..20].copy_from_slice(&513u16.to_le_bytes());
        let to = map(0, &from);
        assert_eq!(to[14], 0x32);
        assert_eq!(to[15], 0b1100_0101);
        assert_eq!(to[16], 6);
        assert_eq!(to[17], 77);
        assert_eq!(i16::from_le_bytes([to[18], to[19]]), -2500);
        assert_eq!(to[20..22], [1, 2]);
        assert_eq!(to[22..30], [0; 8]);
    }

    #[test]
    fn overlap_class_becomes_the_flag() {
        let mut from = [0u8; 28];
        from[15] = 0b0100_1100; // key point, class 12
        let to = map(1, &from);
        assert_eq!((to[15], to[16]), (0b1010, 1));
    }

    #[test]
    fn waveforms_go_and_extra_bytes_stay() {
        let mut from = vec![9u8; 67];
        from[30..38].copy_from_slice(&[1, 2, 3, 4, 5, 6, 7, 8]);
        from.extend([0xaa, 0xbb]);
        let to = map(10, &from);
        assert_eq!(to.len(), 40);
        assert_eq!(to[..38], from[..38]);
        assert_eq!(to[38..], [0xaa, 0xbb]);
    }

    #[test]
    fn unknown_formats_and_short_records_have_no_mapping() {
        assert_eq!(Mapping::new(11, 100), None);
        assert_eq!(Mapping::new(3, 33), None);
    }

    proptest! {
        #[test]
        fn every_field_of_a_legacy_record_can_be_read_back(
            format in 0u8..6,
            bytes in proptest::collection::vec(any::<u8>(), 63..80),
        ) {
            let base = usize::from(RECORD_LENGTHS[usize::from(format)]);
            let from = &bytes[..base + bytes.len() - 63];
            let to = map(format, from);
            prop_assert_eq!(&to[..14], &from[..14]);
            prop_assert_eq!(to[14] & 15, from[14] & 7);
            prop_assert_eq!(to[14] >> 4, from[14] >> 3 & 7);
            prop_assert_eq!(to[15] >> 6, from[14] >> 6);
            prop_assert_eq!(to[15] & 7, from[15] >> 5);
            prop_assert_eq!(to[15] >> 4 & 3, 0);
            let class = if to[15] & OVERLAP_FLAG != 0 { LEGACY_OVERLAP } else { to[16] };
            prop_assert_eq!(class, from[15] & 31);
            let degrees = f64::from(i16::from_le_bytes([to[18], to[19]])) * SCAN_ANGLE_UNIT;
            prop_assert_eq!(degrees.round(), f64::from(from[16] as i8));
            prop_assert!((degrees - f64::from(from[16] as i8)).abs() <= SCAN_ANGLE_UNIT / 2.0);
            prop_assert_eq!(to[17], from[17]);
            prop_assert_eq!(&to[20..22], &from[18..20]);
            prop_assert_eq!(&to[to.len() - (from.len() - base)..], &from[base..]);
        }

        #[test]
        fn formats_6_7_and_8_pass_byte_for_byte(format in 6u8..9, bytes in proptest::collection::vec(any::<u8>(), 38..60)) {
            prop_assert!(Mapping::new(format, bytes.len() as u16).unwrap().is_identity());
            prop_assert_eq!(map(format, &bytes), bytes);
        }
    }
}
