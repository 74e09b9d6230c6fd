"""Runs a command and tells what it took: `measure.py FOLDER COMMAND...`; what the folder holds at most is its scratch.

Standard output: { code, seconds, cpu (seconds of all threads), peak (bytes resident), scratch (bytes on disk) }.
"""

import json
import os
import subprocess
import sys
import threading
import time


def held(folder):
    """Bytes that the files of a folder take on disk."""
    total = 0
    for place, _, names in os.walk(folder):
        for name in names:
            try:
                total += os.lstat(os.path.join(place, name)).st_blocks * 512
            except FileNotFoundError:
                pass
    return total


def main(folder, command):
    most, over = 0, threading.Event()

    def watch():
        nonlocal most
        while not over.wait(0.1):
            most = max(most, held(folder))

    watcher = threading.Thread(target=watch)
    watcher.start()
    began = time.monotonic()
    with open(os.path.join(folder, "..", "measure.log"), "w") as log:
        child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        _, status, used = os.wait4(child.pid, 0)
    seconds = time.monotonic() - began
    over.set()
    watcher.join()
    report = {
        "code": os.waitstatus_to_exitcode(status),
        "seconds": seconds,
        "cpu": used.ru_utime + used.ru_stime,
        "peak": used.ru_maxrss * 1024,
        "scratch": most,
    }
    json.dump(report, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
