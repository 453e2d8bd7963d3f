#!/usr/bin/env python3
"""Times `meaninfo bag` on a bag of a gigabyte beside what the crate `mcap` takes to read it bare, and checks the counts.

    python3 -m venv VENV && VENV/bin/pip install rosbags==0.11.9
    cargo build --release -p mean-information-cli
    cargo build --release --manifest-path benches/bags/Cargo.toml --target-dir target/bags
    VENV/bin/python benches/bags.py target/release/meaninfo target/bags/release/mean-information-bags

The bag is made in a temporary folder and deleted: 256 maps of 2000 x 2000 cells, each with another wall than the one
before, as MCAP without compression and by zstd. Each row is a process of its own; the least processor time of three runs.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

SIDE, MAPS, RUNS, KIND = 2000, 256, 3, "nav_msgs/msg/OccupancyGrid"


def cells(index):
    """A map: unknown outside, free inside, walls of graded percentages, one of which is the map's own."""
    data = np.full((SIDE, SIDE), -1, np.int8)
    data[100:-100, 100:-100] = 0
    graded = (np.arange(SIDE) * 37 % 50 + 51).astype(np.int8)
    for wall in range(120, SIDE - 120, 90):
        data[wall : wall + 3] = graded
    data[200 + index : 203 + index, 200:-200] = 100
    return data.ravel()


def make(folder, compress):
    """Writes the bag; returns its file."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    types = store.types
    writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
    if compress:
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer as bag:
        connection = bag.add_connection("/map", KIND, typestore=store)
        for index in range(MAPS):
            stamp = types["builtin_interfaces/msg/Time"](index, 0)
            pose = types["geometry_msgs/msg/Pose"](
                types["geometry_msgs/msg/Point"](0.0, 0.0, 0.0), types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0))
            info = types["nav_msgs/msg/MapMetaData"](stamp, 0.05, SIDE, SIDE, pose)
            header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="map")
            message = types[KIND](header, info, cells(index))
            bag.write(connection, index * 10**9, bytes(store.serialize_cdr(message, KIND)))
    return next(Path(folder).glob("*.mcap"))


def measured(command):
    """Runs a command; returns its processor time and wall time in seconds, its peak memory in MiB, and its output."""
    best = None
    for _ in range(RUNS):
        started = time.perf_counter()
        timed = ["/usr/bin/time", "-f", "%U %S %M", *command]
        process = subprocess.run(timed, capture_output=True, check=True)
        user, system, peak = map(float, process.stderr.split()[-3:])
        row = user + system, time.perf_counter() - started, peak / 1024, process.stdout
        best = min(best or row, row)
    return best


def main():
    meaninfo, bare = sys.argv[1:]
    megabytes = MAPS * SIDE * SIDE / 1e6
    print("| bag | how | processor time (s) | MB of cells a second | wall (s) | peak memory |\n|---|---|---|---|---|---|")
    for compress in [False, True]:
        with tempfile.TemporaryDirectory() as folder:
            path = str(make(os.path.join(folder, "maps"), compress))
            size = os.path.getsize(path) / 1e6
            name = f"{'zstd' if compress else 'no compression'}, {size:.0f} MB"
            for how, command in [
                ("`meaninfo bag`", [meaninfo, "bag", path, "--format", "json"]),
                ("`meaninfo bag --topic /map`", [meaninfo, "bag", path, "--topic", "/map", "--format", "json"]),
                ("crate `mcap` 0.26, bare", [bare, path]),
            ]:
                seconds, wall, peak, output = measured(command)
                if "json" in command:
                    rows = json.loads(output)
                    assert len(rows) == MAPS
                    for index in (0, MAPS - 1):
                        data = cells(index)
                        assert rows[index]["observed"] == int(((data >= 0) & (data != 50)).sum()), index
                else:
                    assert output.startswith(f"{MAPS} messages".encode()), output
                print(f"| {name} | {how} | {seconds:.2f} | {megabytes / seconds:.0f} | {wall:.2f} | {peak:.0f} MiB |")
                sys.stdout.flush()


if __name__ == "__main__":
    main()
