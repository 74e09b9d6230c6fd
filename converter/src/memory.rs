//! How much memory a run may take.

use crate::error::{Error, Result};
use std::fs;

const MIB: u64 = 1 << 20;

/// Bytes per point besides its record: the sort entry (16) and its place in a node (4).
const INDEX_BYTES: u64 = 20;

/// What is held besides the points: chunks on their way in and out, code, stacks.
const OVERHEAD: u64 = 128 * MIB;

/// Parses a size such as `512MB`, `2GiB` or `1073741824`. Decimal and binary units both mean powers of 1024,
/// as in the options of most memory-bounded tools.
pub fn parse_size(text: &str) -> Result<u64> {
    let text = text.trim();
    let split = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    let factor = match unit.trim().to_ascii_lowercase().as_str() {
        "" | "b" => 1,
        "k" | "kb" | "kib" => 1 << 10,
        "m" | "mb" | "mib" => MIB,
        "g" | "gb" | "gib" => 1 << 30,
        "t" | "tb" | "tib" => 1u64 << 40,
        _ => return Err(Error::option("MEMORY", format!("`{text}` has an unknown unit"))),
    };
    match number.parse::<f64>() {
        Ok(value) if value > 0.0 && value * (factor as f64) < u64::MAX as f64 => {
            Ok((value * factor as f64) as u64)
        }
        _ => Err(Error::option("MEMORY", format!("`{text}` is not a size"))),
    }
}

/// The memory that this process can still get: the smaller of what the machine has free and what its control
/// group leaves, or `None` where neither can be read.
pub fn available() -> Option<u64> {
    let machine = fs::read_to_string("/proc/meminfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("MemAvailable:"))?;
        Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? * 1024)
    });
    let number = |path: &str| fs::read_to_string(path).ok()?.trim().parse::<u64>().ok();
    let group = number("/sys/fs/cgroup/memory.max")
        .map(|limit| limit.saturating_sub(number("/sys/fs/cgroup/memory.current").unwrap_or(0)))
        .or_else(|| {
            let limit = number("/sys/fs/cgroup/memory/memory.limit_in_bytes")?;
            let used = number("/sys/fs/cgroup/memory/memory.usage_in_bytes").unwrap_or(0);
            Some(limit.saturating_sub(used))
        });
    match (machine, group) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

/// Refuses a run that would need more than `limit` bytes (default: what is available), before work starts.
pub fn check(points: u64, record_length: u64, limit: Option<u64>) -> Result<()> {
    let needed = points.saturating_mul(record_length + INDEX_BYTES).saturating_add(OVERHEAD);
    let allowed = limit.or_else(available).unwrap_or(u64::MAX);
    if needed > allowed || points > u64::from(u32::MAX) {
        let cause =
            format!("{points} points need about {} MiB, {} MiB may be used", needed / MIB, allowed / MIB);
        return Err(Error::option("MEMORY", cause));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(parse_size("512MB"), Ok(512 * MIB));
        assert_eq!(parse_size("1.5 GiB"), Ok(1536 * MIB));
        assert_eq!(parse_size("4096"), Ok(4096));
        for bad in ["", "MB", "-1", "12 parsecs", "0", "1e99GB"] {
            assert_eq!(parse_size(bad).unwrap_err().code(), "OPTION_MEMORY", "{bad}");
        }
    }

    #[test]
    fn refuses_what_does_not_fit() {
        assert!(check(1000, 36, Some(256 * MIB)).is_ok());
        assert_eq!(check(10_000_000, 36, Some(256 * MIB)).unwrap_err().code(), "OPTION_MEMORY");
        assert_eq!(check(u64::MAX, 36, None).unwrap_err().code(), "OPTION_MEMORY");
    }
}
