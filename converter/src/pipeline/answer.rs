//! The records that are made while the conversion runs. Who places the points needs their bounds, which only the
//! points themselves tell: a header may lie.

use super::options::read_records;
use crate::copc::records::Additions;
use crate::error::{Error, Result};
use serde::Deserialize;
use std::io::BufRead;
use std::path::{Path, PathBuf};

/// One line of JSON: `{"record":"…","transformation":"…"}`, each a path, each may be left out.
#[derive(Debug, Deserialize)]
struct Answer {
    record: Option<PathBuf>,
    transformation: Option<PathBuf>,
}

/// Waits for the line and reads the files that it names. Errors: `INTERRUPTED` when the input ends without a line,
/// `OPTION_WAIT_FOR_RECORD` when it is no answer, `OPTION_RECORD`, `OPTION_TRANSFORMATION`.
pub fn read(mut input: impl BufRead, output: &Path, additions: &mut Additions) -> Result<()> {
    let mut line = String::new();
    let wrong = |cause: String| Error::option("WAIT_FOR_RECORD", cause);
    let bytes = input.read_line(&mut line).map_err(|e| wrong(format!("the answer cannot be read ({e})")))?;
    if bytes == 0 {
        return Err(Error::interrupted(output, "whoever was to make the georeference record has gone"));
    }
    let Answer { record, transformation } = serde_json::from_str(&line)
        .map_err(|e| wrong(format!("the answer is not what was asked for ({e})")))?;
    read_records(record.as_deref(), transformation.as_deref(), additions)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(line: &str) -> String {
        let mut additions = Additions::default();
        read(line.as_bytes(), Path::new("out.laz"), &mut additions).unwrap_err().code()
    }

    #[test]
    fn an_answer_may_name_nothing() {
        let mut additions = Additions::default();
        read(&b"{}\n"[..], Path::new("out.laz"), &mut additions).unwrap();
        assert!(additions.georeference.is_none() && additions.transformation.is_none());
    }

    #[test]
    fn no_answer_or_another_is_an_error() {
        assert_eq!(code(""), "INTERRUPTED");
        assert_eq!(code("go on\n"), "OPTION_WAIT_FOR_RECORD");
        assert_eq!(code("{\"record\":\"/nowhere/at/all\"}\n"), "OPTION_RECORD");
        assert_eq!(code("{\"transformation\":\"/nowhere/at/all\"}\n"), "OPTION_TRANSFORMATION");
    }
}
