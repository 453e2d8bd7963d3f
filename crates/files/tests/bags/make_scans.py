#!/usr/bin/env python3
"""Makes bags of a CARMEN log's scans, by a writer that shares nothing with the readers under test: PyPI `rosbags` 0.11.

    python3 -m venv VENV && VENV/bin/pip install rosbags==0.11.9
    VENV/bin/python crates/files/tests/bags/make_scans.py                 # the bags of this folder, of every second scan of maps/room.log
    VENV/bin/python crates/files/tests/bags/make_scans.py LOG OUT.mcap    # one of another log (FLASER, ROBOTLASER1)

Each holds the scans on /scan (sensor_msgs/LaserScan, frame `laser`), the odometry's poses on /tf (`odom` to
`base_footprint`) and /odom, what corrects them to the log's poses of the laser on /tf (`map` to `odom`), and these poses of
the robot on /slam_pose and /amcl_pose. By /tf_static the laser is 0.25 m ahead and 0.125 m aside of `base_link`, turned by
half a radian, and `base_link` 0.1 m above `base_footprint`; the poses of the log, of the laser, are turned back by that.
A scan, its transforms and its poses have one stamp, the time of the log.
"""
import math
import shutil
import sys
from decimal import Decimal
from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

TF = "geometry_msgs/TransformStamped[] transforms"
FOLDER = Path(__file__).resolve().parent
LOG = FOLDER / "../../../../maps/room.log"
MOUNT = (0.25, 0.125, 0.5)


def scans(lines):
    """(nanoseconds, first bearing, increment, greatest range, ranges, pose of the laser, pose by odometry)."""
    for line in lines:
        words = line.split()
        if words[:1] == ["FLASER"]:
            count = int(words[1])
            at, start, step, greatest = 2 + count, -math.pi / 2, math.radians(180 / count), 50.0
            ranges, poses = words[2:at], words[at : at + 6]
            time = words[at + 6]
        elif words[:1] == ["ROBOTLASER1"]:
            start, _, step, greatest = map(float, words[2:6])
            count = int(words[8])
            at = 9 + count
            ranges = words[9:at]
            at += 1 + int(words[at])
            poses, time = words[at : at + 6], words[at + 11]
        else:
            continue
        poses = [float(word) for word in poses]
        yield int(Decimal(time) * 10**9), start, step, greatest, [float(r) for r in ranges], poses[:3], poses[3:]


def compose(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    return a[0] + b[0] * c - b[1] * s, a[1] + b[0] * s + b[1] * c, a[2] + b[2]


def inverse(a):
    c, s = math.cos(a[2]), math.sin(a[2])
    return -a[0] * c - a[1] * s, a[0] * s - a[1] * c, -a[2]


def messages(lines, store, ros1):
    types = store.types
    if "tf2_msgs/msg/TFMessage" not in types:
        store.register(get_types_from_msg(TF, "tf2_msgs/msg/TFMessage"))
    kind = lambda name: types[f"geometry_msgs/msg/{name}"]

    def header(time, frame):
        stamp = types["builtin_interfaces/msg/Time"](time // 10**9, time % 10**9)
        return types["std_msgs/msg/Header"](stamp=stamp, frame_id=frame, **({"seq": 7} if ros1 else {}))

    def turn(yaw):
        return kind("Quaternion")(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))

    def transform(time, frame, child, pose, z=0.0):
        moved = kind("Transform")(kind("Vector3")(pose[0], pose[1], z), turn(pose[2]))
        return kind("TransformStamped")(header(time, frame), child, moved)

    def pose_of(pose):
        return kind("Pose")(kind("Point")(pose[0], pose[1], 0.0), turn(pose[2]))

    def covered(pose):
        return kind("PoseWithCovariance")(pose_of(pose), np.zeros(36))

    tf, first = "tf2_msgs/msg/TFMessage", True
    for time, start, step, greatest, ranges, laser, odometry in scans(lines):
        robot, odometry = (compose(pose, inverse(MOUNT)) for pose in (laser, odometry))
        if first:
            fixed = [transform(0, "base_footprint", "base_link", (0.0, 0.0, 0.0), 0.1),
                     transform(0, "base_link", "laser", MOUNT, 0.2)]
            yield time, "/tf_static", tf, types[tf](fixed)
            first = False
        correction = compose(robot, inverse(odometry))
        moving = [transform(time, "map", "odom", correction), transform(time, "odom", "base_footprint", odometry)]
        yield time, "/tf", tf, types[tf](moving)
        scan = "sensor_msgs/msg/LaserScan"
        last = start + step * (len(ranges) - 1)
        data = np.array(ranges, dtype=np.float32)
        yield time, "/scan", scan, types[scan](
            header(time, "laser"), start, last, step, 0.0, 0.1, 0.0, greatest, data, np.zeros(0, np.float32))
        speed = kind("TwistWithCovariance")(kind("Twist")(kind("Vector3")(0.0, 0.0, 0.0), kind("Vector3")(0.0, 0.0, 0.0)), np.zeros(36))
        odom = "nav_msgs/msg/Odometry"
        yield time, "/odom", odom, types[odom](header(time, "odom"), "base_footprint", covered(odometry), speed)
        yield time, "/slam_pose", "geometry_msgs/msg/PoseStamped", kind("PoseStamped")(header(time, "map"), pose_of(robot))
        amcl = "geometry_msgs/msg/PoseWithCovarianceStamped"
        yield time, "/amcl_pose", amcl, kind("PoseWithCovarianceStamped")(header(time, "map"), covered(robot))


def write(writer, lines, store, ros1):
    with writer as bag:
        connections = {}
        for time, topic, kind, message in messages(lines, store, ros1):
            if topic not in connections:
                connections[topic] = bag.add_connection(topic, kind, typestore=store)
            serialise = store.serialize_ros1 if ros1 else store.serialize_cdr
            # Recorded a little later than stamped.
            bag.write(connections[topic], time + 1_000_003, bytes(serialise(message, kind)))


def make(lines, path):
    """Writes an MCAP file in zstd, without the folder that rosbag2 has around it."""
    folder = path.with_suffix("")
    shutil.rmtree(folder, ignore_errors=True)
    writer = Writer2(folder, version=9, storage_plugin=StoragePlugin.MCAP)
    writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    write(writer, lines, get_typestore(Stores.ROS2_HUMBLE), False)
    (folder / f"{folder.name}.mcap").replace(path)
    shutil.rmtree(folder)


def main():
    if len(sys.argv) == 3:
        return make(Path(sys.argv[1]).read_text().splitlines(), Path(sys.argv[2]))
    # Every second scan.
    lines = [line for line in LOG.read_text().splitlines() if line.startswith("ROBOTLASER1")][::2]
    make(lines, FOLDER / "room.mcap")
    path = FOLDER / "room.bag"
    path.unlink(missing_ok=True)
    writer = Writer1(path)
    writer.set_compression(Writer1.CompressionFormat.BZ2)
    write(writer, lines, get_typestore(Stores.ROS1_NOETIC), True)


if __name__ == "__main__":
    sys.exit(main())
