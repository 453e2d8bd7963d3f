"""The command `meaninfo`: `python -m mean_information map maps/room.yaml`."""

import signal
import sys

from ._native import command


def main() -> int:
    """Run the command with the arguments of the process; return its exit status."""
    # The command is one call: Ctrl-C ends it as it ends the program, not when Python is back.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.stdout.flush()
    return command(["meaninfo", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
