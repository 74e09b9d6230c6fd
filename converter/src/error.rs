//! What can go wrong, as one enum: a stable code, the file (or option) it is about, what was found and what
//! the reader can do about it.

use serde::Serialize;
use std::fmt;
use std::path::Path;

pub type Result<T> = std::result::Result<T, Error>;

/// The part of an error that differs from case to case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Detail {
    /// The file or option that the error is about.
    pub file: String,
    /// What was found, as a clause without a closing stop.
    pub cause: String,
}

#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// The input cannot be opened.
    NotFound(Detail),
    /// The input is not a LAS or LAZ file.
    Magic(Detail),
    /// The input ends before what its header announces.
    Truncated(Detail),
    /// The input contradicts itself, or its compressed data cannot be decoded.
    Corrupt(Detail),
    /// A chunk of the input is not the one whose checksum its writer has stored.
    Checksum(Detail),
    /// The input holds no point.
    Empty(Detail),
    /// A version or point data record format that the LAS 1.4 standard does not know.
    Format(Detail),
    /// Several inputs that cannot stand in one file without changing a record.
    Mixed(Detail),
    /// The output is there already, and overwriting was not asked for.
    OutputExists(Detail),
    OutputInput(Detail),
    /// The output's name says that it is something else than LAZ.
    OutputName(Detail),
    /// The output cannot be written.
    OutputWrite(Detail),
    /// The folder for scratch files has too little room.
    TempSpace(Detail),
    /// A scratch file cannot be written or read back.
    TempFile(Detail),
    /// An option has a value that cannot be used. The name becomes part of the code: `OPTION_MEMORY`.
    Option(&'static str, Detail),
    /// The process was asked to stop.
    Interrupted(Detail),
    /// What is to be written is not what was read: a fault of this program, found before the output has its name.
    Internal(Detail),
}

macro_rules! constructors {
    ($($name:ident => $variant:ident),* $(,)?) => {
        impl Error {
            $(pub fn $name(file: &Path, cause: impl fmt::Display) -> Self {
                Self::$variant(Detail::new(file.display(), cause))
            })*
        }
    };
}

constructors! {
    not_found => NotFound,
    magic => Magic,
    truncated => Truncated,
    corrupt => Corrupt,
    checksum => Checksum,
    empty => Empty,
    format => Format,
    mixed => Mixed,
    output_exists => OutputExists,
    output_input => OutputInput,
    output_name => OutputName,
    output_write => OutputWrite,
    temp_space => TempSpace,
    temp_file => TempFile,
    interrupted => Interrupted,
    internal => Internal,
}

impl Detail {
    fn new(file: impl fmt::Display, cause: impl fmt::Display) -> Self {
        Self { file: file.to_string(), cause: cause.to_string() }
    }
}

impl Error {
    /// An option's fault. `name` in capitals, as in the code: `MEMORY` for `--memory`.
    pub fn option(name: &'static str, cause: impl fmt::Display) -> Self {
        Self::Option(name, Detail::new(format!("--{}", name.to_lowercase().replace('_', "-")), cause))
    }

    /// A read that failed: `Truncated` at an early end, otherwise `NotFound`.
    pub fn reading(file: &Path, error: &std::io::Error) -> Self {
        match error.kind() {
            std::io::ErrorKind::UnexpectedEof => Self::truncated(file, "the file ends early"),
            _ => Self::not_found(file, format!("the file cannot be read ({error})")),
        }
    }

    /// Work with a scratch file that failed: `TempSpace` on a full disk, otherwise `TempFile`.
    pub fn temporary(folder: &Path, error: &std::io::Error) -> Self {
        match error.kind() {
            std::io::ErrorKind::StorageFull | std::io::ErrorKind::QuotaExceeded => {
                Self::temp_space(folder, "the disk is full")
            }
            _ => Self::temp_file(folder, format!("a scratch file cannot be used ({error})")),
        }
    }

    /// The stable code, never reused for another meaning.
    pub fn code(&self) -> String {
        match self {
            Self::NotFound(_) => "INPUT_NOT_FOUND".into(),
            Self::Magic(_) => "INPUT_MAGIC".into(),
            Self::Truncated(_) => "INPUT_TRUNCATED".into(),
            Self::Corrupt(_) => "INPUT_CORRUPT".into(),
            Self::Checksum(_) => "INPUT_CHECKSUM".into(),
            Self::Empty(_) => "INPUT_EMPTY".into(),
            Self::Format(_) => "INPUT_FORMAT".into(),
            Self::Mixed(_) => "INPUT_MIXED".into(),
            Self::OutputExists(_) => "OUTPUT_EXISTS".into(),
            Self::OutputInput(_) => "OUTPUT_INPUT".into(),
            Self::OutputName(_) => "OUTPUT_NAME".into(),
            Self::OutputWrite(_) => "OUTPUT_WRITE".into(),
            Self::TempSpace(_) => "TEMP_SPACE".into(),
            Self::TempFile(_) => "TEMP_FILE".into(),
            Self::Option(name, _) => format!("OPTION_{name}"),
            Self::Interrupted(_) => "INTERRUPTED".into(),
            Self::Internal(_) => "INTERNAL".into(),
        }
    }

    fn detail(&self) -> &Detail {
        match self {
            Self::NotFound(d)
            | Self::Magic(d)
            | Self::Truncated(d)
            | Self::Corrupt(d)
            | Self::Checksum(d)
            | Self::Empty(d)
            | Self::Format(d)
            | Self::Mixed(d)
            | Self::OutputExists(d)
            | Self::OutputInput(d)
            | Self::OutputName(d)
            | Self::OutputWrite(d)
            | Self::TempSpace(d)
            | Self::TempFile(d)
            | Self::Option(_, d)
            | Self::Interrupted(d)
            | Self::Internal(d) => d,
        }
    }

    /// What was found, as a clause without a closing stop.
    pub fn cause(&self) -> &str {
        &self.detail().cause
    }

    /// What to do about it, as a clause without a closing stop.
    pub fn fix(&self) -> &'static str {
        match self {
            Self::NotFound(_) => "Check the path and the permissions",
            Self::Magic(_) => "Give a LAS or LAZ file",
            Self::Truncated(_) => {
                "Get the whole file again: its writer, the copy or the download stopped early"
            }
            Self::Corrupt(_) => {
                "Get the file again from its source, or repair it with the software that wrote it"
            }
            Self::Checksum(_) => "Copy or download the file again, or convert the scan again",
            Self::Empty(_) => "Give a file that holds points",
            Self::Format(_) => "Write the file as LAS 1.0 to 1.4 with a point format from 0 to 10",
            Self::Mixed(_) => "Convert the files one by one, or bring them to one form first",
            Self::OutputExists(_) => "Choose another name or pass --overwrite",
            Self::OutputInput(_) => "Choose another name for the output",
            Self::OutputName(_) => "Give the output a name that ends in .copc.laz",
            Self::OutputWrite(_) => "Check that the folder is there, writable and has room",
            Self::TempSpace(_) => "Make room, choose another folder with --temp-dir, or allow more --memory",
            Self::TempFile(_) => "Check the folder for scratch files, or choose another with --temp-dir",
            Self::Option("MEMORY", _) => "Give --memory a larger size, such as 512MB or 2GB",
            Self::Option(..) => "See groma convert --help",
            Self::Interrupted(_) => "Run the command again",
            Self::Internal(_) => "Report it with the input: it is a fault of this program",
        }
    }

    /// The four fields as the command line's JSON lines carry them.
    pub fn wire(&self) -> Wire {
        let Detail { file, cause } = self.detail().clone();
        Wire { event: "error", code: self.code(), file, cause, fix: self.fix() }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Detail { file, cause } = self.detail();
        write!(f, "{}: {}: {}. {}.", self.code(), shown(file), shown(cause), self.fix())
    }
}

/// Text of a file or a name as a terminal may show it: what would steer it or turn the direction of writing is
/// escaped, such as `\u{1b}`.
pub fn shown(text: &str) -> String {
    let escape = |character: char| {
        if steers(character) { character.escape_unicode().to_string() } else { character.to_string() }
    };
    text.chars().map(escape).collect()
}

/// Whether a character is a control (line breaks among them) or an invisible mark that says in which direction to write.
pub fn steers(character: char) -> bool {
    let marks = ['\u{61c}', '\u{200b}', '\u{feff}'];
    character.is_control()
        || marks.contains(&character)
        || ('\u{200e}'..='\u{200f}').contains(&character)
        || ('\u{2028}'..='\u{202e}').contains(&character)
        || ('\u{2060}'..='\u{206f}').contains(&character)
}

/// An error as a JSON line.
#[derive(Debug, Serialize)]
pub struct Wire {
    event: &'static str,
    code: String,
    file: String,
    cause: String,
    fix: &'static str,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn message_holds_code_file_cause_and_fix() {
        let error = Error::empty(Path::new("a.las"), "the header announces 0 points");
        assert_eq!(
            error.to_string(),
            "INPUT_EMPTY: a.las: the header announces 0 points. Give a file that holds points."
        );
    }

    #[test]
    fn foreign_text_cannot_steer_a_terminal() {
        let error = Error::corrupt(Path::new("a\u{1b}[2J\n.las"), "the name \u{202e}sal\u{9b}m");
        let text = error.to_string();
        assert!(
            text.starts_with("INPUT_CORRUPT: a\\u{1b}[2J\\u{a}.las: the name \\u{202e}sal\\u{9b}m. Get"),
            "{text}"
        );
        assert_eq!(shown("Höhe, 高度, \u{1f600}, العربية"), "Höhe, 高度, \u{1f600}, العربية");
    }

    #[test]
    fn an_option_names_itself() {
        let error = Error::option("TEMP_DIR", "no such folder");
        assert_eq!(error.code(), "OPTION_TEMP_DIR");
        assert!(error.to_string().contains("--temp-dir"));
    }
}
