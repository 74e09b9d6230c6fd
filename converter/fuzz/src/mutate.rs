//! Fuzzing where there is no libFuzzer: `mutate TARGET SECONDS SEED FOLDER` changes files of a folder at random, the
//! same way for the same seed, and hands them to a target. What a file was made of stands in `FOLDER.last` while it is
//! run, so that it can be run again after a crash: `mutate TARGET FILE`.

use std::path::Path;
use std::time::{Duration, Instant};

type Target = fn(&[u8]);

/// A run that takes longer counts as hung.
const SLOWEST: Duration = Duration::from_secs(20);

/// Values that lengths, counts and offsets are set to.
const TELLING: [u64; 8] = [0, 1, 0x7f, 0xff, 0xffff, 0x7fff_ffff, 0xffff_ffff, u64::MAX];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    groma_fuzz::abort_on_panic();
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
    match arguments.as_slice() {
        [target, file] => target_of(target)?(&std::fs::read(file)?),
        [target, seconds, seed, folder] => {
            let limit = Duration::from_secs(seconds.parse()?);
            let runs = mutate(target_of(target)?, limit, seed.parse()?, Path::new(folder))?;
            println!("{target}: {runs} runs, no fault");
        }
        _ => return Err("usage: mutate scan|convert|chunk (FILE | SECONDS SEED FOLDER)".into()),
    }
    Ok(())
}

fn target_of(name: &str) -> Result<Target, String> {
    match name {
        "scan" => Ok(groma_fuzz::scan),
        "convert" => Ok(groma_fuzz::convert),
        "chunk" => Ok(groma_fuzz::chunk),
        _ => Err(format!("there is no target {name}")),
    }
}

fn mutate(target: Target, limit: Duration, seed: u64, folder: &Path) -> std::io::Result<u64> {
    let mut names: Vec<_> =
        std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<_>>()?;
    names.sort();
    let files = names.iter().map(std::fs::read).collect::<std::io::Result<Vec<_>>>()?;
    let last = folder.with_extension("last");
    let mut random = Random(seed | 1);
    let start = Instant::now();
    let mut runs = 0;
    while start.elapsed() < limit {
        let data = change(&files, &mut random);
        std::fs::write(&last, &data)?;
        let began = Instant::now();
        target(&data);
        assert!(began.elapsed() < SLOWEST, "{:?} for one file, see {}", began.elapsed(), last.display());
        runs += 1;
    }
    std::fs::remove_file(last)?;
    Ok(runs)
}

/// A file with up to eight changes.
fn change(files: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut data = files[random.below(files.len())].clone();
    for _ in 0..=random.below(8) {
        if data.is_empty() {
            break;
        }
        // Half of the changes go where each byte means something.
        let end = if random.below(2) == 0 { data.len().min(700) } else { data.len() };
        let at = random.below(end);
        match random.below(6) {
            0 => data[at] ^= 1 << random.below(8),
            1 => data[at] = random.below(256) as u8,
            2 => data.truncate(at),
            3 => {
                let part = data[at..data.len().min(at + 64)].to_vec();
                data.splice(at..at, part);
            }
            4 => {
                let other = &files[random.below(files.len())];
                let from = random.below(other.len().max(1)).min(other.len());
                let part = &other[from..other.len().min(from + 200)];
                let end = data.len().min(at + part.len());
                data[at..end].copy_from_slice(&part[..end - at]);
            }
            _ => {
                let value = TELLING[random.below(TELLING.len())].to_le_bytes();
                let end = data.len().min(at + [1, 2, 4, 8][random.below(4)]);
                data[at..end].copy_from_slice(&value[..end - at]);
            }
        }
    }
    data
}

/// xorshift64*.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize % limit.max(1)
    }
}
