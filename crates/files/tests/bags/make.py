#!/usr/bin/env python3
"""Makes the bags of this folder, by a writer that shares nothing with the readers under test: PyPI `rosbags` 0.11.

    python3 -m venv VENV && VENV/bin/pip install rosbags==0.11.9 && VENV/bin/python crates/files/tests/bags/make.py

Each holds the same: maps of 13 x 7 cells of 0.05 m on /map, whose values a small generator gives, the third as the
second again, every sixth of 5 x 9 cells; an update of 3 x 2 cells at column 4 and row 1 after the second map, so that 50
maps are shown; a costmap beside the first six; and a text on /talk, of which nobody knows the type. `expected.json` has
what NumPy counts of each map.
"""
import json
import shutil
import struct
import sys
import zlib
from pathlib import Path

import lz4.frame
import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

FOLDER = Path(__file__).resolve().parent
UPDATE = """
std_msgs/Header header
int32 x
int32 y
uint32 width
uint32 height
int8[] data
"""
START = 1_700_000_000_250_000_000
MAP, GRID_UPDATE, TEXT = "nav_msgs/msg/OccupancyGrid", "map_msgs/msg/OccupancyGridUpdate", "std_msgs/msg/String"


def cells(seed, count):
    """Values from -1 to 100: most of them -1, 0 and 100, as in real maps."""
    state, values = seed, []
    for _ in range(count):
        state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
        kind, value = state >> 62, (state >> 33) % 102 - 1
        values.append([-1, 0, 100, value][kind])
    return np.array(values, dtype=np.int8)


def messages(store, ros1):
    """(time, topic, type, message), and the map as it then stands."""
    types = store.types

    def header(time):
        stamp = types["builtin_interfaces/msg/Time"](time // 10**9, time % 10**9)
        more = {"seq": 9} if ros1 else {}
        return types["std_msgs/msg/Header"](stamp=stamp, frame_id="map", **more)

    def grid(time, width, height, data):
        point = types["geometry_msgs/msg/Point"](-1.5, 2.25, 0.0)
        turn = types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.6, 0.8)
        info = types["nav_msgs/msg/MapMetaData"](
            map_load_time=types["builtin_interfaces/msg/Time"](1, 2), resolution=0.05, width=width, height=height,
            origin=types["geometry_msgs/msg/Pose"](point, turn))
        return types[MAP](header(time), info, data)

    sizes = ([(13, 7)] * 5 + [(5, 9)]) * 8 + [(5, 9)]
    for index, (width, height) in enumerate(sizes):
        time = START + index * 2_000_000_000
        data = cells(7 + min(index, 1) if index < 3 else 7 + index, width * height)
        if index == 2:
            data[:] = now
        now = data.copy()
        yield time, "/map", MAP, grid(time, width, height, data), (width, height, now)
        if index > 5:
            continue
        yield time + 1, "/talk", TEXT, types[TEXT]("hällo"), None
        yield time + 2, "/global_costmap/costmap", MAP, grid(time, 2, 1, np.array([99, 0], np.int8)), None
        if index == 1:
            new = cells(99, 6)
            now.reshape(height, width)[1:3, 4:7] = new.reshape(2, 3)
            update = types[GRID_UPDATE](header(time), 4, 1, 3, 2, new)
            yield time + 1_000_000_000, "/map_updates", GRID_UPDATE, update, (width, height, now.copy())


def expected(rows):
    found = []
    for time, _, _, _, shown in rows:
        if shown:
            width, height, data = shown
            values, counts = np.unique(data, return_counts=True)
            found.append({"time_ns": time, "width": width, "height": height,
                          "values": [[int(v), int(n)] for v, n in zip(values, counts)]})
    return found


def rows(maps):
    """A line of JSON for each map."""
    return "[\n" + ",\n".join(json.dumps(row) for row in maps) + "\n]\n"


def write(writer, store, ros1):
    with writer as bag:
        connections = {}
        for time, topic, kind, message, _ in messages(store, ros1):
            if topic not in connections:
                connections[topic] = bag.add_connection(topic, kind, typestore=store)
            serialise = store.serialize_ros1 if ros1 else store.serialize_cdr
            bag.write(connections[topic], time, bytes(serialise(message, kind)))


def lz4_chunks(source, target):
    """Writes the chunks of an MCAP file again, with their records as an LZ4 frame, and none of its summary."""
    data, at, out = source.read_bytes(), 8, [source.read_bytes()[:8]]
    while at < len(data) - 8:
        kind, length = struct.unpack_from("<BQ", data, at)
        record = data[at + 9 : at + 9 + length]
        at += 9 + length
        if kind == 6:
            size, checksum, name = struct.unpack_from("<QII", record, 16)
            packed = lz4.frame.compress(record[32 + name + 8 :])
            record = record[:16] + struct.pack("<QII", size, zlib.crc32(record[32 + name + 8 :]), 3) + b"lz4"
            record += struct.pack("<Q", len(packed)) + packed
        out.append(struct.pack("<BQ", kind, len(record)) + record)
        if kind == 15:
            break
    target.write_bytes(b"".join(out) + struct.pack("<BQ20x", 2, 20) + data[:8])


def main():
    ros1, ros2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_HUMBLE)
    for store in (ros1, ros2):
        if GRID_UPDATE not in store.types:
            store.register(get_types_from_msg(UPDATE, GRID_UPDATE))
    for name, compression in [("none", None), ("bz2", Writer1.CompressionFormat.BZ2), ("lz4", Writer1.CompressionFormat.LZ4)]:
        path = FOLDER / f"maps_{name}.bag"
        path.unlink(missing_ok=True)
        writer = Writer1(path)
        if compression:
            writer.set_compression(compression)
        write(writer, ros1, True)
    for name, storage, compress in [
        ("mcap", StoragePlugin.MCAP, False), ("mcap_zstd", StoragePlugin.MCAP, True), ("db3", StoragePlugin.SQLITE3, False),
    ]:
        path = FOLDER / f"maps_{name}"
        shutil.rmtree(path, ignore_errors=True)
        writer = Writer2(path, version=9, storage_plugin=storage)
        if compress:
            writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        write(writer, ros2, False)
    lz4_chunks(FOLDER / "maps_mcap/maps_mcap.mcap", FOLDER / "maps_mcap_lz4.mcap")
    (FOLDER / "expected.json").write_text(rows(expected(messages(ros2, False))))


if __name__ == "__main__":
    sys.exit(main())
