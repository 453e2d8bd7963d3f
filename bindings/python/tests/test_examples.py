"""The examples run, and fleets have the bits of one pass."""

import copy
import json
import os
import pickle
import runpy
import signal
import subprocess
import sys
import time
from pathlib import Path

import mean_information as mi
import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
sys.path.insert(0, str(EXAMPLES))
MAPS, TILES, SIDE = 100, 40, 32


def run(name, *arguments, monkeypatch):
    monkeypatch.setattr(sys, "argv", [name, *map(str, arguments)])
    runpy.run_path(str(EXAMPLES / name), run_name="__main__")


def test_a_map_and_a_particle_filter(maps, monkeypatch, capsys):
    run("measure_map.py", maps / "room.yaml", monkeypatch=monkeypatch)
    tally = mi.read_map(maps / "room.yaml").tally
    printed = capsys.readouterr().out
    assert f"{tally.mean_information:.4f} bits per observed cell" in printed
    assert f"```text\n{printed}```" in (maps.parent / "README.md").read_text(encoding="utf-8")
    run("particle_filter.py", monkeypatch=monkeypatch)
    lines = capsys.readouterr().out.splitlines()[1:]
    emmi = [float(line.split("EMMI ")[1].split(",")[0]) for line in lines]
    assert emmi[0] > max(emmi[1:])


def test_trajectories(maps, monkeypatch, capsys, tmp_path):
    pytest.importorskip("matplotlib")
    files = sorted(maps.glob("*.tum"))
    run("trajectories.py", maps / "room.log", *files, "--picture", tmp_path / "maps.png", monkeypatch=monkeypatch)
    rows = dict(line.split("\t")[:2] for line in capsys.readouterr().out.splitlines())
    assert set(path.name for path in files) <= set(rows)
    assert (tmp_path / "maps.png").read_bytes().startswith(b"\x89PNG")


def test_a_bag_without_ros(tmp_path, monkeypatch, capsys, python):
    rosbags = pytest.importorskip("rosbags.rosbag2")
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.LATEST)
    types = store.types
    cells = [np.random.default_rng(k).integers(-1, 101, 12).astype(np.int8) for k in range(3)]
    others = [np.full(12, 7, np.int8), np.full(12, 7, np.int8)]
    stamp = types["builtin_interfaces/msg/Time"](sec=0, nanosec=0)
    header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="map")
    point = types["geometry_msgs/msg/Point"](x=0.0, y=0.0, z=0.0)
    turn = types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0)
    origin = types["geometry_msgs/msg/Pose"](position=point, orientation=turn)
    info = types["nav_msgs/msg/MapMetaData"](map_load_time=stamp, resolution=0.05, width=4, height=3, origin=origin)
    kind = types["nav_msgs/msg/OccupancyGrid"]
    with rosbags.Writer(tmp_path / "bag", version=9) as writer:
        connection = writer.add_connection("/map", kind.__msgtype__, typestore=store)
        for k, data in enumerate(cells):
            raw = store.serialize_cdr(kind(header=header, info=info, data=data), kind.__msgtype__)
            writer.write(connection, k * 10**9, raw)
        connection = writer.add_connection("/other", kind.__msgtype__, typestore=store)
        for k, data in enumerate(others):
            raw = store.serialize_cdr(kind(header=header, info=info, data=data), kind.__msgtype__)
            writer.write(connection, k * 10**9 + 5 * 10**8, raw)
    run("rosbag.py", tmp_path / "bag", monkeypatch=monkeypatch)
    rows = [line.split("\t") for line in capsys.readouterr().out.splitlines()]
    assert [row[0] for row in rows] == ["0.000", "1.000", "2.000"]
    expected = [mi.tally(data, encoding="percent") for data in cells]
    assert [int(row[2]) for row in rows] == [tally.observed for tally in expected]
    # The same by the library's own reader, and the last map.
    series = mi.read_bag(tmp_path / "bag", topic="/map")
    assert [row.tally for row in series] == expected and [row.time for row in series] == [0.0, 1.0, 2.0]
    changed = [np.count_nonzero(cells[k] != cells[k + 1]) for k in range(2)]
    assert [row.changed_cells for row in series] == [None, *changed]
    places = {(row.topic, row.shape, row.resolution, row.origin) for row in series}
    assert places == {("/map", (3, 4), series[0].resolution, (0.0, 0.0))}
    assert series[0].resolution == pytest.approx(0.05) and series[1].mean_information == expected[1].mean_information
    seen = mi.read_bag(tmp_path / "bag", topic="/other")
    assert [(row.time_ns, row.changed_cells) for row in seen] == [(500_000_000, None), (1_500_000_000, 0)]
    for travel in (lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy):
        assert repr(travel(series)) == repr(series) and travel(series[0]).tally == expected[0]
    assert mi.read_map(tmp_path / "bag", topic="/map").tally == expected[-1]
    assert mi.read_map(tmp_path / "bag", topic="/other").tally == mi.tally(others[0], encoding="percent")
    for read in (mi.read_bag, mi.read_map):
        with pytest.raises(ValueError, match="/map.*/other"):
            read(tmp_path / "bag")
        with pytest.raises(ValueError, match="/map.*/other"):
            read(tmp_path / "bag", topic="/none")
    # As the command prints it.
    printed = subprocess.run(
        [python, "-m", "mean_information", "bag", str(tmp_path / "bag"), "--topic", "/map", "--format", "json"],
        capture_output=True,
        check=True,
    )
    rows = json.loads(printed.stdout)
    assert [row["mean_information"] for row in rows] == [row.mean_information for row in series]
    assert [(row["time_s"], row["changed_cells"], row["free"]) for row in rows] == [
        (row.time, row.changed_cells, row.tally.free) for row in series
    ]


@pytest.fixture(scope="module")
def fleet(tmp_path_factory):
    """Write tiles of two days; return their folder, and the tally of each map by one pass."""
    tiles = pytest.importorskip("tiles")
    folder, random = tmp_path_factory.mktemp("fleet"), np.random.default_rng(22)
    whole = {}
    kinds = [("percent", np.int8), ("mrpt", np.int8), ("probability", np.float32), ("log-odds", np.float64)]
    for number in range(MAPS):
        encoding, dtype = kinds[number % 4]
        shape = (5 * SIDE, 8 * SIDE)
        if dtype is np.int8:
            cells = random.integers(-1, 101, shape).astype(dtype)
        else:
            cells = (random.random(shape) if encoding == "probability" else random.normal(0, 3, shape)).astype(dtype)
        name = f"map-{number:03}"
        whole[name] = mi.tally(cells, encoding=encoding)
        rows = list(tiles.tiles_of(name, cells, encoding, 0.05, SIDE))
        assert len(rows) == TILES
        for day, part in (("2026-11-29", rows[::2]), ("2026-11-30", rows[1::2])):
            tiles.write(folder / f"day={day}" / f"{name}.parquet", part)
    return folder, whole


def test_the_program_writes_tiles(maps, tmp_path, monkeypatch, capsys):
    parquet = pytest.importorskip("pyarrow.parquet")
    tiles = pytest.importorskip("tiles")
    run("tiles.py", tmp_path, maps / "room.yaml", "--tile", 64, "--day", "2026-11-30", monkeypatch=monkeypatch)
    table = parquet.read_table(tmp_path / "day=2026-11-30" / "room.parquet").to_pylist()
    total = sum(tiles.tally_of(row["encoding"], row["cells"]) for row in table)
    assert total == mi.read_map(maps / "room.yaml").tally and len(table) > 1


@pytest.mark.parametrize("view", [False, True])
def test_datafusion(fleet, view):
    datafusion = pytest.importorskip("datafusion")
    import fleet_datafusion
    import pyarrow as pa

    folder, whole = fleet
    options = datafusion.SessionConfig().with_target_partitions(4)
    options = options.set("datafusion.execution.parquet.schema_force_view_types", str(view).lower())
    context = datafusion.SessionContext(options)
    context.register_parquet("tiles", str(folder), table_partition_cols=[("day", pa.string())])
    assert context.table("tiles").schema().field("cells").type == (pa.binary_view() if view else pa.binary())
    fleet_datafusion.register(context, pa.binary_view() if view else pa.binary())

    plan = "".join(row["plan"] for row in context.sql(f"EXPLAIN {fleet_datafusion.BY_MAP}").to_pylist())
    assert "mode=Partial" in plan and "mode=FinalPartitioned" in plan
    rows = context.sql(fleet_datafusion.BY_MAP).to_pylist()
    assert {row["map_id"]: mi.Tally.from_bytes(row["tally"]) for row in rows} == whole
    count = context.sql("SELECT count(*) AS n FROM tiles").to_pylist()[0]["n"]
    assert count == MAPS * TILES

    # Yesterday's tallies with today's.
    by_day = "SELECT map_id, tally(encoding, cells) AS tally FROM tiles WHERE day = '{}' GROUP BY map_id"
    yesterday = context.sql(by_day.format("2026-11-29")).to_arrow_table()
    context.register_record_batches("totals", [yesterday.to_batches()])
    merged = context.sql(
        "SELECT map_id, merge_tallies(tally) AS tally FROM (SELECT map_id, tally FROM totals UNION ALL "
        f"{by_day.format('2026-11-30')}) GROUP BY map_id"
    ).to_pylist()
    assert {row["map_id"]: mi.Tally.from_bytes(row["tally"]) for row in merged} == whole
    percent = [name for k, name in enumerate(sorted(whole)) if k % 4 == 0]
    days = context.sql(fleet_datafusion.BY_DAY.replace("GROUP", "WHERE encoding = 'percent' GROUP")).to_pylist()
    assert len(days) == 2 and all(0 < day["bits"] < 1 for day in days) and percent


def test_dask_with_a_worker_that_is_killed(fleet):
    distributed = pytest.importorskip("distributed")
    import fleet_dask

    folder, whole = fleet
    # The parent is small: workers are processes of their own, which import the examples.
    environment = {"PYTHONPATH": str(EXAMPLES)}
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, env=environment) as cluster,
        distributed.Client(cluster) as client,
    ):
        pids = client.run(os.getpid)
        result = fleet_dask.tallies_of(client, folder)
        deadline = time.monotonic() + 60
        # Half way: some parts are done, and wait on a worker to be merged.
        while time.monotonic() < deadline and sum(map(len, client.has_what().values())) < 8:
            time.sleep(0.01)
        os.kill(next(iter(pids.values())), signal.SIGKILL)
        assert result.result(timeout=300) == whole


def test_spark(fleet, monkeypatch, capsys):
    pytest.importorskip("pyspark")
    folder, whole = fleet
    # Its workers are the interpreter of the test.
    monkeypatch.setenv("PYSPARK_PYTHON", sys.executable)
    run("fleet_spark.py", folder, monkeypatch=monkeypatch)
    printed = dict(line.split("\t") for line in capsys.readouterr().out.splitlines())
    assert printed == {name: str(tally.mean_information) for name, tally in whole.items()}
