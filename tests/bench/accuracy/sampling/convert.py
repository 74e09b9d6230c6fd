"""Converts a scan several times, all ways in turn: `convert.py groma-core scan.laz folder rounds name=option,… …`
writes folder/name.copc.laz and prints JSON."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path


def convert(command: list[str]) -> dict:
    """Wall and processor time (seconds, all threads) and peak memory (bytes) of one run."""
    began = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - began
    if status != 0:
        raise SystemExit(f"{' '.join(command)} ended with status {status}")
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "peak": usage.ru_maxrss * 1024}


def main(core: str, scan: str, folder: str, rounds: str, *ways: str) -> dict:
    """Per name the least times and the greatest memory of all rounds, and the bytes of the file."""
    result = {}
    for _ in range(int(rounds)):
        for way in ways:
            name, _, options = way.partition("=")
            output = Path(folder) / f"{name}.copc.laz"
            one = convert([core, "convert", "--overwrite", *options.split(","), scan, str(output)])
            best = result.setdefault(name, {**one, "bytes": output.stat().st_size})
            for key in ("wall", "cpu"):
                best[key] = min(best[key], one[key])
            best["peak"] = max(best["peak"], one["peak"])
    return result


if __name__ == "__main__":
    print(json.dumps(main(*sys.argv[1:])))
