//! Variable length records, plain and extended, as bytes: what is not understood is carried over unchanged.

use std::io::{self, Read, Seek, SeekFrom, Write};

/// Bytes of the header of a variable length record (LAS 1.4 R15, table 6).
pub const HEADER: usize = 54;
/// Bytes of the header of an extended variable length record (LAS 1.4 R15, table 25).
pub const EXTENDED_HEADER: usize = 60;

/// User id of the records that the standard defines for coordinate reference systems.
pub const PROJECTION: &str = "LASF_Projection";
/// User id of the records that the standard defines otherwise.
pub const SPECIFICATION: &str = "LASF_Spec";
pub const WKT: u16 = 2112;
pub const GEOTIFF_DIRECTORY: u16 = 34735;
pub const GEOTIFF_DOUBLES: u16 = 34736;
pub const GEOTIFF_ASCII: u16 = 34737;
pub const EXTRA_BYTES: u16 = 4;
pub const WAVEFORM_DATA: u16 = 65535;
/// User id of COPC's records: 1 is the information record, 1000 the hierarchy.
pub const COPC: &str = "copc";
pub const COPC_INFO: u16 = 1;
pub const COPC_HIERARCHY: u16 = 1000;
/// User id of Groma's records.
pub const GROMA: &str = "groma";
pub const GROMA_GEOREFERENCE: u16 = 1;
pub const GROMA_STATISTICS: u16 = 2;
pub const GROMA_TRANSFORMATION: u16 = 3;
pub const GROMA_CHECKSUMS: u16 = 4;
pub const GROMA_FIRST_PAGE: u16 = 5;

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VariableRecord {
    pub user_id: [u8; 16],
    pub record_id: u16,
    pub description: [u8; 32],
    pub data: Vec<u8>,
}

impl VariableRecord {
    pub fn new(user_id: &str, record_id: u16, description: &str, data: Vec<u8>) -> Self {
        Self { user_id: padded(user_id), record_id, description: padded(description), data }
    }

    /// Whether the user id is text, as LAS 1.4 R15 (2.5) wants it; readers give up at one that is not.
    pub fn is_named(&self) -> bool {
        let end = self.user_id.iter().position(|b| *b == 0).unwrap_or(self.user_id.len());
        self.user_id[..end].is_ascii()
    }

    /// Whether it is the record of these ids.
    pub fn is(&self, user_id: &str, record_id: u16) -> bool {
        self.record_id == record_id && text(&self.user_id) == user_id
    }

    /// Its user id as text.
    pub fn user(&self) -> String {
        text(&self.user_id)
    }

    /// Whether the record describes waveforms: packet descriptors 100 to 354, or the packets themselves.
    pub fn is_waveform(&self) -> bool {
        let described = (100..355).contains(&self.record_id) || self.record_id == WAVEFORM_DATA;
        described && self.user() == SPECIFICATION
    }

    /// Whether the data is too long for a plain record's 16-bit length.
    pub fn needs_extension(&self) -> bool {
        self.data.len() > usize::from(u16::MAX)
    }

    /// Takes one record from the front of `bytes`; `None` if a whole one is not there.
    pub fn parse(bytes: &[u8]) -> Option<(Self, &[u8])> {
        let (head, rest) = bytes.split_at_checked(HEADER)?;
        let length = usize::from(u16::from_le_bytes([head[20], head[21]]));
        let (data, rest) = rest.split_at_checked(length)?;
        Some((Self::from_parts(head, &head[22..54], data.to_vec()), rest))
    }

    /// Reads the extended record at byte `at`. The inner `None` is a record that is skipped, the outer one is
    /// a record that does not lie in the file. Returns also where the next one begins.
    pub fn read_extended(
        source: &mut (impl Read + Seek),
        at: u64,
        file_size: u64,
    ) -> io::Result<Option<(Option<Self>, u64)>> {
        let body = at.saturating_add(EXTENDED_HEADER as u64);
        if at == 0 || body > file_size {
            return Ok(None);
        }
        source.seek(SeekFrom::Start(at))?;
        let mut head = [0; EXTENDED_HEADER];
        source.read_exact(&mut head)?;
        let length = u64::from_le_bytes(head[20..28].try_into().unwrap_or_default());
        let Some(end) = body.checked_add(length).filter(|end| *end <= file_size) else {
            return Ok(None);
        };
        let mut record = Self::from_parts(&head, &head[28..60], Vec::new());
        if record.is(COPC, COPC_HIERARCHY) || record.is_waveform() {
            return Ok(Some((None, end)));
        }
        source.take(length).read_to_end(&mut record.data)?;
        Ok(Some((Some(record), end)))
    }

    fn from_parts(head: &[u8], description: &[u8], data: Vec<u8>) -> Self {
        let mut record = Self { user_id: [0; 16], record_id: 0, description: [0; 32], data };
        record.user_id.copy_from_slice(&head[2..18]);
        record.record_id = u16::from_le_bytes([head[18], head[19]]);
        record.description.copy_from_slice(description);
        record
    }

    /// Writes the record in its plain form; its data must fit ([`Self::needs_extension`]).
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let length = u16::try_from(self.data.len()).map_err(|_| io::ErrorKind::InvalidInput)?;
        self.write_parts(out, &length.to_le_bytes())
    }

    pub fn write_extended(&self, out: &mut impl Write) -> io::Result<()> {
        self.write_parts(out, &(self.data.len() as u64).to_le_bytes())
    }

    fn write_parts(&self, out: &mut impl Write, length: &[u8]) -> io::Result<()> {
        out.write_all(&[0; 2])?;
        out.write_all(&self.user_id)?;
        out.write_all(&self.record_id.to_le_bytes())?;
        out.write_all(length)?;
        out.write_all(&self.description)?;
        out.write_all(&self.data)
    }
}

/// A fixed-width text field up to its first NUL, as UTF-8 or, where it is not that, as Latin-1.
pub fn text(field: &[u8]) -> String {
    let end = field.iter().position(|b| *b == 0).unwrap_or(field.len());
    let text = match str::from_utf8(&field[..end]) {
        Ok(text) => text.to_string(),
        Err(_) => latin1(&field[..end]),
    };
    text.trim_end().to_string()
}

/// Each byte as the character with its number: what Latin-1 means, and no byte is lost.
pub fn latin1(bytes: &[u8]) -> String {
    bytes.iter().copied().map(char::from).collect()
}

/// A text cut to a fixed-width field, between two of its characters, and filled with NUL.
pub fn padded<const N: usize>(text: &str) -> [u8; N] {
    let mut field = [0; N];
    let length = (0..=text.len().min(N)).rev().find(|end| text.is_char_boundary(*end)).unwrap_or(0);
    field[..length].copy_from_slice(&text.as_bytes()[..length]);
    field
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[test]
    fn plain_and_extended_forms_read_back() {
        let record = VariableRecord::new("groma", 7, "a description", vec![1, 2, 3]);
        let mut plain = Vec::new();
        record.write(&mut plain).unwrap();
        assert_eq!(VariableRecord::parse(&plain), Some((record.clone(), &[][..])));

        let mut extended = vec![0xff];
        record.write_extended(&mut extended).unwrap();
        let size = extended.len() as u64;
        let read = VariableRecord::read_extended(&mut Cursor::new(extended), 1, size).unwrap();
        assert_eq!(read, Some((Some(record), size)));
    }

    #[test]
    fn a_user_id_is_text_up_to_its_first_zero() {
        let with =
            |user_id: [u8; 16]| VariableRecord { user_id, ..VariableRecord::new("", 1, "", Vec::new()) };
        assert!(VariableRecord::new("LASF_Projection", 2112, "", Vec::new()).is_named());
        assert!(with(*b"sixteen letters!").is_named());
        assert!(with([0; 16]).is_named());
        assert!(with([b'a', 0, 0xff, 0xfe, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9]).is_named());
        assert!(!with([0xe9; 16]).is_named());
        assert!(!with([b'a', 0xc3, 0xa9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]).is_named());
    }

    #[test]
    fn a_length_beyond_the_file_is_no_record() {
        let record = VariableRecord::new("groma", 7, "", vec![0; 10]);
        let mut bytes = Vec::new();
        record.write(&mut bytes).unwrap();
        assert_eq!(VariableRecord::parse(&bytes[..bytes.len() - 1]), None);
        assert_eq!(VariableRecord::parse(&bytes[..20]), None);
        let mut lying = Vec::new();
        record.write_extended(&mut lying).unwrap();
        lying[20..28].copy_from_slice(&u64::MAX.to_le_bytes());
        let size = lying.len() as u64;
        assert_eq!(VariableRecord::read_extended(&mut Cursor::new(lying), 0, size).unwrap(), None);
    }
}
