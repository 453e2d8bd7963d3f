"""The maps of a bag, read by `rosbags` without ROS: `python rosbag.py BAG [TOPIC]`.

`mi.read_bag` and `meaninfo bag` do so by themselves, and apply updates of maps, too; this is for who reads a bag's other
topics, too.
"""

import sys
from pathlib import Path

import mean_information as mi
import numpy as np
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore


def series(bag: Path, topic: str = "/map") -> list[tuple[float, mi.Tally]]:
    """Return the time in seconds and the tally of each map of a topic."""
    measured = []
    with AnyReader([bag], default_typestore=get_typestore(Stores.LATEST)) as reader:
        connections = [connection for connection in reader.connections if connection.topic == topic]
        for connection, time, raw in reader.messages(connections=connections):
            grid = reader.deserialize(raw, connection.msgtype)
            cells = np.reshape(grid.data, (grid.info.height, grid.info.width))
            measured.append((time / 1e9, mi.tally(cells, encoding="percent")))
    return measured


def main() -> None:
    """Print the series."""
    for time, tally in series(Path(sys.argv[1]), *sys.argv[2:3]):
        print(f"{time:.3f}\t{tally.mean_information:.6f}\t{tally.observed}")


if __name__ == "__main__":
    main()
