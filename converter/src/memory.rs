//! How much memory a run may take, and who gets it.

use crate::error::{Error, Result};
#[cfg(not(target_family = "wasm"))]
use mimalloc::MiMalloc as SmallBlocks;
#[cfg(target_family = "wasm")]
use std::alloc::System as SmallBlocks;
use std::alloc::{GlobalAlloc, Layout, System};
use std::fs;

const MIB: u64 = 1 << 20;

/// The least that a run may be given; enough for any input.
pub const FLOOR: u64 = 256 * MIB;

/// What the process takes whatever it does: code, stacks, tables.
const BASE: u64 = 48 * MIB;

/// One part in so many is what the allocator does not give back.
const KEPT: u64 = 10;

/// The share of the available memory that a run takes where it is not told.
const SHARE: f64 = 0.75;

/// The largest block that is small, bytes: more than the tables of a LAZ model, less than any block of points.
const SMALL: usize = 2 << 10;

/// The program's allocator: small blocks come from mimalloc, all others from the system, which knows best how to give
/// them back.
///
/// Compressing a node makes some three thousand tables of up to 1 KiB and frees them again. glibc looks for each of them
/// among the holes that points have left, which of 100 million points in 256 MiB took a tenth of the processor time; and
/// mimalloc, given the points too, keeps more memory than a run may have. In WebAssembly there is one allocator for all.
pub struct Allocator;

impl Allocator {
    fn of(size: usize) -> &'static dyn GlobalAlloc {
        if size <= SMALL { &SmallBlocks } else { &System }
    }
}

// SAFETY: a block is taken from, changed by and given back to one and the same allocator, found by the size in its
// layout; one that changes sides is a new block.
unsafe impl GlobalAlloc for Allocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        unsafe { Self::of(layout.size()).alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        unsafe { Self::of(layout.size()).alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        unsafe { Self::of(layout.size()).dealloc(block, layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if (layout.size() <= SMALL) == (size <= SMALL) {
            return unsafe { Self::of(size).realloc(block, layout, size) };
        }
        unsafe {
            let other = self.alloc(Layout::from_size_align_unchecked(size, layout.align()));
            if !other.is_null() {
                block.copy_to_nonoverlapping(other, layout.size().min(size));
                self.dealloc(block, layout);
            }
            other
        }
    }
}

/// How much memory a run may take, and how it is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget(u64);

/// Workers of a stage, and the bytes that are left for points to wait in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Division {
    pub workers: usize,
    /// Bytes that all workers together may use.
    pub work: u64,
    pub store: u64,
}

impl Budget {
    /// Bytes as asked for, or what is available.
    pub fn new(asked: Option<u64>) -> Self {
        let found = || available().map_or(u64::MAX / 2, |bytes| (bytes as f64 * SHARE) as u64).max(FLOOR);
        Self(asked.unwrap_or_else(found))
    }

    pub fn bytes(self) -> u64 {
        self.0
    }

    /// What a run takes whose stages take so many bytes, no more than it may.
    pub fn needed(self, bytes: u64) -> u64 {
        let free = BASE.saturating_add(bytes);
        free.saturating_add(free / (KEPT - 1)).min(self.0)
    }

    /// Divides the memory among at most `threads` workers of `each` bytes and a store. Workers together get half
    /// at most, but one works in any case.
    pub fn divide(self, threads: usize, each: u64) -> Division {
        let free = (self.0 - self.0 / KEPT).saturating_sub(BASE);
        let fitting = usize::try_from(free / 2 / each.max(1)).unwrap_or(usize::MAX);
        let workers = fitting.clamp(1, threads.max(1));
        let work = (workers as u64).saturating_mul(each);
        Division { workers, work, store: free.saturating_sub(work) }
    }
}

/// Gives memory that is freed back to the system, for the rest of the process: a run whose points have no room frees
/// and takes so much that glibc, left alone, keeps a fifth and more of the budget beside it (100 million points in 512
/// MiB: peak 613 MiB without this). Costs a few hundredths of the time, so it is for such runs alone.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn return_freed() {
    // Larger than the blocks of points in waiting, which come and go all the time; smaller than what a node takes.
    const LARGE: libc::c_int = 512 << 10;
    const TRIM: libc::c_int = 4 << 20;
    // SAFETY: mallopt takes two numbers, and may be called at any time. It says 0 where it refuses: nothing changes.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE);
        libc::mallopt(libc::M_TRIM_THRESHOLD, TRIM);
    }
}

/// Other allocators than glibc's are left as they are.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub fn return_freed() {}

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
        _ => return Err(Error::option("MEMORY", format!("`{text}` is not a size"))),
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
    fn a_block_keeps_its_bytes_on_whichever_side_it_comes_to_lie() {
        let layout = |size| Layout::from_size_align(size, align_of::<u128>()).unwrap();
        // SAFETY: every block has the layout that it was given last, and no byte is read beyond it.
        unsafe {
            let mut block = Allocator.alloc_zeroed(layout(16));
            assert_eq!(*block.cast::<u128>(), 0);
            let mut size = 16;
            for (number, next) in
                [40, SMALL, SMALL + 1, 1 << 20, 3 << 20, SMALL + 9, SMALL, 16].into_iter().enumerate()
            {
                *block.add(number) = 7 + number as u8;
                block = Allocator.realloc(block, layout(size), next);
                size = next;
                assert!((0..=number).all(|i| *block.add(i) == 7 + i as u8), "{next}");
            }
            Allocator.dealloc(block, layout(size));
        }
    }

    #[test]
    fn a_run_needs_what_its_stages_take_and_no_more_than_it_may() {
        let budget = Budget::new(Some(1000 * MIB));
        assert_eq!(budget.needed(6 * MIB), 60 * MIB);
        assert_eq!(budget.needed(900 * MIB), 1000 * MIB);
        assert_eq!(budget.needed(u64::MAX), 1000 * MIB);
    }

    #[test]
    fn workers_get_half_at_most() {
        let budget = Budget::new(Some((BASE + 100) * KEPT / (KEPT - 1)));
        assert_eq!(budget.divide(4, 10), Division { workers: 4, work: 40, store: 60 });
        assert_eq!(budget.divide(40, 10), Division { workers: 5, work: 50, store: 50 });
        assert_eq!(budget.divide(4, 1000), Division { workers: 1, work: 1000, store: 0 });
        assert!(Budget::new(None).bytes() >= FLOOR);
    }
}
