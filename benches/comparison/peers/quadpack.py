#!/usr/bin/env python3
"""QUADPACK by SciPy, for a partner that evaluates the integrand: the protocol of peers.cpp."""

import struct
import sys
import warnings

from scipy.integrate import quad

warnings.simplefilter("ignore")
source, sink = sys.stdin.buffer, sys.stdout.buffer


def evaluate(x):
    sink.write(b"v" + struct.pack("d", x))
    sink.flush()
    return struct.unpack("d", source.read(8))[0]


for line in iter(source.readline, b""):
    tolerance, limit, _, *points = map(float, line.split())
    a, *breaks, b = points
    try:
        value, claim, _, *message = quad(
            evaluate, a, b, points=breaks or None, epsabs=0, epsrel=tolerance, limit=int(limit / 42), full_output=1
        )
    except (OverflowError, ValueError, ZeroDivisionError):
        value, claim, message = float("nan"), 0.0, ["no value"]
    sink.write(b"r" + struct.pack("dd", value, claim) + bytes([not message]))
    sink.flush()
