//! What a conversion is told.

use crate::build::Rules;
use crate::copc::records::Additions;
use crate::error::{Error, Result};
use crate::threads;
use std::path::{Path, PathBuf};

/// Longest data of a variable length record.
const LONGEST_RECORD: usize = u16::MAX as usize;

#[derive(Debug, Clone)]
pub struct Options {
    /// At least one, in the order that their points keep.
    pub inputs: Vec<PathBuf>,
    pub output: PathBuf,
    /// File whose bytes become the georeference record.
    pub record: Option<PathBuf>,
    /// File whose bytes become the transformation record.
    pub transformation: Option<PathBuf>,
    /// The two files are made while the conversion runs: it tells the bounds of the points, and before it writes it
    /// waits for a line on standard input that names them, see [`super::answer`].
    pub wait_for_record: bool,
    /// File with the WKT that the output carries instead of the input's.
    pub wkt: Option<PathBuf>,
    pub overwrite: bool,
    /// Refuses an input whose points can only be read in part, or by other ways than its own tables.
    pub strict: bool,
    /// How a node's points are chosen.
    pub rules: Rules,
    /// Most threads to work with; default: all that there are.
    pub threads: Option<usize>,
    /// Bytes; default: most of what is available.
    pub memory: Option<u64>,
    /// Folder for scratch files; default: the output's.
    pub temp_dir: Option<PathBuf>,
}

impl Options {
    /// A plain conversion of some files.
    pub fn new(inputs: Vec<PathBuf>, output: PathBuf) -> Self {
        Self {
            inputs,
            output,
            record: None,
            transformation: None,
            wait_for_record: false,
            wkt: None,
            overwrite: false,
            strict: false,
            rules: Rules::default(),
            threads: None,
            memory: None,
            temp_dir: None,
        }
    }

    /// Threads to work with.
    pub fn workers(&self) -> usize {
        self.threads.unwrap_or_else(threads::available)
    }

    /// Reads the files that the options name. Errors: `OPTION_RECORD`, `OPTION_TRANSFORMATION`, `OPTION_WKT`.
    pub fn additions(&self) -> Result<Additions> {
        let wkt = self.wkt.as_deref().map(|path| read("WKT", path)).transpose()?.map(wkt).transpose()?;
        let mut additions = Additions { wkt, ..Additions::default() };
        read_records(self.record.as_deref(), self.transformation.as_deref(), &mut additions)?;
        Ok(additions)
    }
}

/// Reads the files of the georeference. Errors: `OPTION_RECORD`, `OPTION_TRANSFORMATION`.
pub fn read_records(
    record: Option<&Path>,
    transformation: Option<&Path>,
    additions: &mut Additions,
) -> Result<()> {
    additions.georeference = record.map(|path| read("RECORD", path)).transpose()?;
    if let Some(bytes) = additions.georeference.as_ref().filter(|bytes| bytes.len() > LONGEST_RECORD) {
        let cause =
            format!("{} bytes do not go into a variable length record of {LONGEST_RECORD}", bytes.len());
        return Err(Error::option("RECORD", cause));
    }
    additions.transformation = transformation.map(|path| read("TRANSFORMATION", path)).transpose()?;
    Ok(())
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
