//! What a conversion is told.

use crate::copc::records::Additions;
use crate::error::{Error, Result};
use std::path::{Path, PathBuf};

/// Longest data of a variable length record.
const LONGEST_RECORD: usize = u16::MAX as usize;

#[derive(Debug, Clone, Default)]
pub struct Options {
    /// At least one.
    pub inputs: Vec<PathBuf>,
    pub output: PathBuf,
    /// File whose bytes become the georeference record.
    pub record: Option<PathBuf>,
    /// File with the WKT that the output carries instead of the input's.
    pub wkt: Option<PathBuf>,
    pub overwrite: bool,
    /// Bytes; default: what is available.
    pub memory: Option<u64>,
}

impl Options {
    /// Reads the files that the options name. Errors: `OPTION_RECORD`, `OPTION_WKT`.
    pub fn additions(&self) -> Result<Additions> {
        let georeference = self.record.as_deref().map(|path| read("RECORD", path)).transpose()?;
        if let Some(bytes) = georeference.as_ref().filter(|bytes| bytes.len() > LONGEST_RECORD) {
            let cause =
                format!("{} bytes do not go into a variable length record of {LONGEST_RECORD}", bytes.len());
            return Err(Error::option("RECORD", cause));
        }
        let wkt = self.wkt.as_deref().map(|path| read("WKT", path)).transpose()?.map(wkt).transpose()?;
        Ok(Additions { wkt, georeference, statistics: Vec::new() })
    }
}

fn read(option: &'static str, path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).map_err(|e| Error::option(option, format!("{} cannot be read ({e})", path.display())))
}

/// The standard wants the text to end with a NUL.
fn wkt(bytes: Vec<u8>) -> Result<Vec<u8>> {
    let text = String::from_utf8(bytes).map_err(|_| Error::option("WKT", "the file is not UTF-8"))?;
    let text = text.trim_end_matches('\0').trim();
    if text.is_empty() {
        return Err(Error::option("WKT", "the file is empty"));
    }
    Ok(format!("{text}\0").into_bytes())
}
