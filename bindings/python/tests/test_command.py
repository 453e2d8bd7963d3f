"""The command within the wheel is the command; the wheel is a port; Ctrl-C; memory; threads."""

import os
import signal
import subprocess
import sys
import threading
import time

import mean_information as mi
import numpy as np
import pytest


def run(*arguments, **options):
    return subprocess.run(arguments, capture_output=True, check=False, **options)


@pytest.mark.parametrize(
    "arguments",
    [
        ["map", "room.yaml"],
        ["map", "room.yaml", "--format", "json"],
        ["map", "none.yaml"],
        ["limit", "--range", "2", "--sigma", "0.2", "--format", "csv"],
        ["limit", "--range", "2"],
        ["--version"],
        ["--help"],
        ["nonsense"],
        [],
    ],
)
def test_the_command_is_that_of_the_binary(arguments, maps, meaninfo, python):
    binary = run(meaninfo, *arguments, cwd=maps)
    module = run(python, "-m", "mean_information", *arguments, cwd=maps)
    assert (module.returncode, module.stdout, module.stderr) == (binary.returncode, binary.stdout, binary.stderr)
    script = run(os.path.join(os.path.dirname(python), "meaninfo"), *arguments, cwd=maps)
    assert (script.returncode, script.stdout, script.stderr) == (binary.returncode, binary.stdout, binary.stderr)


def test_the_wheel_is_a_port_of_all_operations(python):
    check = run(python, "-m", "mean_information", "check", "--", python, "-m", "mean_information.port")
    assert check.returncode == 0, check.stdout.decode() + check.stderr.decode()


def interrupted(work, python):
    """Return what Ctrl-C half a second into the work leaves on standard error."""
    # Python leaves the signal ignored where it began so, as in a shell's background.
    listen = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    code = f"{listen}import mean_information as mi, numpy as np\nprint('begun', flush=True)\n{work}"
    process = subprocess.Popen([python, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert process.stdout.readline().strip() == b"begun"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    try:
        return process.communicate(timeout=60)[1]
    finally:
        process.kill()


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize(
    "work",
    [
        "mi.tally(np.broadcast_to(np.array([0.3]), (400_000, 1_000_000)))",
        "mi.mean_information(np.broadcast_to(np.array([0.3]), (400_000, 1_000_000)), axis=0)",
        "mi.tally(np.broadcast_to(np.array([7], np.int8), (4_000_000, 1_000_000)), encoding='percent')",
    ],
)
def test_long_work_answers_ctrl_c(work, python):
    assert b"KeyboardInterrupt" in interrupted(work, python)


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_reading_a_long_bag_answers_ctrl_c(python, tmp_path):
    # A record that is passed over: zeros that take no room on the disk, and minutes to read.
    size = 1 << 40
    with open(tmp_path / "long.mcap", "wb") as file:
        file.write(b"\x89MCAP0\r\n\xff" + size.to_bytes(8, "little"))
        file.truncate(size)
    assert b"KeyboardInterrupt" in interrupted(f"mi.read_map({str(tmp_path / 'long.mcap')!r})", python)


def resident() -> int:
    """Return the bytes of memory in use."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="Linux only")
def test_memory_does_not_grow():
    cells, data = np.full(20, 0.3), mi.tally([0.3]).to_bytes()
    nothing = np.array([np.nan])

    def calls(count):
        for _ in range(count):
            mi.information(cells)
            mi.information(0.3)
            mi.mean_information(cells)
            tally = mi.Tally.from_bytes(data)
            tally + tally
            try:
                mi.tally(nothing)
            except ValueError:
                pass
            try:
                mi.information(1)
            except TypeError:
                pass

    calls(5_000)
    before = resident()
    calls(int(os.environ.get("MEANINFO_CALLS", "20000")))
    assert resident() - before < 1 << 20


def test_two_threads_at_once():
    cells = np.random.default_rng(5).random(300_000)
    expected, values = mi.tally(cells), mi.information(cells)
    failures = []

    def work():
        for _ in range(5):
            if mi.tally(cells) != expected or not np.array_equal(mi.information(cells), values):
                failures.append("other bits")

    threads = [threading.Thread(target=work) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures


def test_an_array_that_changes_meanwhile_crashes_nothing():
    cells, stop = np.full(400_000, 0.3), threading.Event()

    def change():
        while not stop.is_set():
            cells[::7] = np.nan
            cells[::7] = 0.7

    thread = threading.Thread(target=change)
    thread.start()
    try:
        for _ in range(20):
            mi.information(cells)
            try:
                assert mi.tally(cells).cells == cells.size
            except ValueError:
                pass
    finally:
        stop.set()
        thread.join()
