//! What a run leaves in its folders, however it ends.

use crate::bench::{Bench, Las, cloud};
use std::process::Stdio;
use std::time::{Duration, Instant};

#[cfg(unix)]
#[test]
fn a_killed_run_leaves_a_folder_that_the_next_one_removes() {
    let bench = Bench::new();
    bench.put("in.las", &Las::at(7, 0, &cloud(400_000, [90_000, 90_000, 3000])).las());
    bench.put("out.copc.laz", b"old");
    std::fs::create_dir(bench.path("scratch")).unwrap();
    for delay in [0, 20, 90, 250] {
        let mut command = bench.command();
        command.args(["convert", "in.las", "out.copc.laz", "--overwrite", "--temp-dir", "scratch"]);
        let mut child = command.stdout(Stdio::null()).spawn().unwrap();
        let start = Instant::now();
        while bench.names().len() == 3 && start.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(Duration::from_millis(delay));
        child.kill().unwrap();
        child.wait().unwrap();
        let names = bench.names();
        assert!(
            names
                .iter()
                .all(|n| n.starts_with(".groma-")
                    || ["in.las", "out.copc.laz", "scratch"].contains(&n.as_str()))
        );
        let output = std::fs::read(bench.path("out.copc.laz")).unwrap();
        assert!(output == b"old" || output.starts_with(b"LASF"));
    }
    bench.convert(&["in.las", "out.copc.laz", "--overwrite", "--temp-dir", "scratch"]);
    assert_eq!(bench.names(), ["in.las", "out.copc.laz", "scratch"]);
    assert_eq!(std::fs::read_dir(bench.path("scratch")).unwrap().count(), 0);
}

#[test]
fn an_error_while_reading_leaves_nothing() {
    let bench = Bench::new();
    let mut laz = Las::at(7, 0, &cloud(60_000, [9000, 9000, 3000])).laz();
    let middle = laz.len() / 2;
    laz[middle..middle + 4000].iter_mut().for_each(|byte| *byte ^= 0xa5);
    bench.put("in.laz", &laz);
    std::fs::create_dir(bench.path("scratch")).unwrap();
    let before = bench.names();
    let (done, _) = bench.run(&["convert", "in.laz", "out.copc.laz", "--temp-dir", "scratch"]);
    let expected =
        if done { vec!["in.laz".to_string(), "out.copc.laz".into(), "scratch".into()] } else { before };
    assert_eq!(bench.names(), expected);
    assert_eq!(std::fs::read_dir(bench.path("scratch")).unwrap().count(), 0);
}
