"""Known mistakes: the value that each gives for a test, so that an answer equal to it names its cause.

Every trap has its note in trap_notes.py. Values are of 23 or 24 bits, as answers are compared to 20; a value that is too close to a right one is
left out, and so is one below the normal floats. Those of rooms and limits are in room_traps.py and limit_traps.py.
"""

import math
from fractions import Fraction

import numpy as np
from flint import arb, ctx

from enclosures import ball
from exact import FORMATS, entropy as arb_entropy, fraction_of, rounded
from text import hex_float
from trap_notes import NOTES

APART = Fraction(1, 2**16)
TINY = arb(2) ** -1100
NAN = math.nan



def wants(test):
    return [test["want"], *test.get("also", [])]


def apart(value, want, format, scale=APART):
    """Whether a fraction is no right answer by far."""
    if "error" in want:
        return True
    if "count" in want:
        return value != want["count"]
    lo, hi = Fraction(want["lo"]), Fraction(want["hi"])
    if value == 0 and rounded(lo, format) == 0:
        return False
    return value < lo - scale * abs(lo) or value > hi + scale * abs(hi)


def cut(value, format):
    """To 23 or 24 bits: a float that either format holds; None if it is not among its normal numbers."""
    if isinstance(value, float) and not math.isfinite(value):
        return value
    if isinstance(value, arb):
        if not value.is_finite() or (value != 0 and abs(value) < TINY):
            return None
        # A zero that is not known to be one says nothing.
        value = fraction_of(value.mid()) if value.rel_accuracy_bits() > 30 or value.is_zero() else None
    else:
        value = Fraction(value)
    if not value:
        return 0.0 if value == 0 else None
    shift = 23 - (abs(value.numerator).bit_length() - value.denominator.bit_length())
    value = Fraction(round(value * Fraction(2) ** shift)) / Fraction(2) ** shift
    precision, lowest = FORMATS[format]
    if not Fraction(2) ** (lowest + precision - 1) <= abs(value) < Fraction(2) ** (2 - precision - lowest):
        return None
    return float(value)


def attach(test, found):
    """Adds to a test the traps that are apart from all of its right answers. NaN may stand for a refusal."""
    kept = {}
    for name, value in found.items():
        assert name in NOTES, name
        if value is None:
            continue
        if isinstance(value, int):  # of an operation that counts; of a float there would be a float
            if value != test["want"].get("count"):
                kept[name] = value
            continue
        value = cut(value, test["format"])
        if value is None or (math.isnan(value) and "error" in test["want"]):
            continue
        if not math.isfinite(value) or all(apart(Fraction(value), want, test["format"]) for want in wants(test)):
            kept[name] = hex_float(value)
    if kept:
        test["traps"] = kept
    return test


def ln2():
    return arb.const_log2()


def entropy(p):
    return arb_entropy(p)


def xlog2(p):
    return p * p.log() / ln2() if p != 0 else arb(0)


ENTROPY = {
    "Nats": lambda p: entropy(p) * ln2(),
    "Hartleys": lambda p: entropy(p) * ln2() / arb(10).log(),
    "Gini": lambda p: 4 * p * (1 - p),
    "OneTerm": lambda p: -xlog2(p),
    "OtherTerm": lambda p: -xlog2(1 - p),
    "SignOfTerm": lambda p: xlog2(1 - p) - xlog2(p),
    "MissingSign": lambda p: -entropy(p),
}
INFORMATION = {
    "Nats": lambda p: (1 - entropy(p)) * ln2(),
    "OneMinusNats": lambda p: 1 - entropy(p) * ln2(),
    "OneMinusHartleys": lambda p: 1 - entropy(p) * ln2() / arb(10).log(),
    "Gini": lambda p: (2 * p - 1) ** 2,
    "AbsoluteDeviation": lambda p: abs(2 * p - 1),
    "OneTerm": lambda p: 1 + xlog2(p),
    "OtherTerm": lambda p: 1 + xlog2(1 - p),
    "MissingSign": lambda p: 1 + entropy(p),
}
WRONG = {"entropy": ENTROPY, "information": INFORMATION}
RIGHT = {"entropy": entropy, "information": lambda p: 1 - entropy(p)}


def logistic(l):
    """Of a float or a ball; to within 2^-5000 beyond 4096."""
    l = arb(max(-4096.0, min(float(l), 4096.0))) if abs(arb(l)) > 4096 else arb(l)
    x = (-abs(l)).exp()
    return x / (1 + x) if l < 0 else 1 / (1 + x)


def log_odds(p):
    """Of a ball in [0, 1]; infinite as floats are."""
    if p == 0 or p == 1:
        return math.inf if p == 1 else -math.inf
    return p.log() - (-p).log1p()


def clamped(x, lo, hi):
    return lo if x < lo else hi if x > hi else x


def mrpt_byte(p):
    l = log_odds(p)
    n = clamped(16 * (l if isinstance(l, float) else float(l)), -127, 127)
    return logistic(arb(round(n)) / 16)


# How occupancies are stored.
STORED = {
    "ClampedMillionth": lambda p: clamped(p, arb(1) / 10**6, 1 - arb(1) / 10**6),
    "ClampedThousandth": lambda p: clamped(p, arb(1) / 1000, 1 - arb(1) / 1000),
    "ClampedOctoMap": lambda p: clamped(p, logistic(-2), logistic(3.5)),
    "Percent": lambda p: arb(round(float(100 * p))) / 100,
    "PercentCut": lambda p: arb(math.floor(float(100 * p))) / 100,
    "Byte": lambda p: arb(round(float(255 * p))) / 255,
    "MrptByte": mrpt_byte,
    "SinglePrecision": lambda p: arb(float(np.float32(float(p)))),
    "HalfPrecision": lambda p: arb(float(np.float16(float(p)))),
}


def nearest(x, format):
    """A ball rounded to a format; its sign may be negative."""
    x = fraction_of(x.mid())
    return math.copysign(rounded(abs(x), format), x)


def float_entropy(p, format):
    """-(p log2 p + (1-p) log2 (1-p)), each step rounded once."""
    def term(q):
        return nearest(arb(q) * nearest(arb(q).log() / ln2(), format), format) if q > 0 else 0.0

    rest = nearest(1 - arb(p), format)
    return nearest(-(arb(term(p)) + term(rest)), format)


def flushed(x, format):
    precision, lowest = FORMATS[format]
    return 0.0 if abs(x) < 2.0 ** (lowest + precision - 1) else None


def of_occupancy(kind, p, format, result):
    """Wrong values of H or I at a float p in its domain; `result` is the right one, as a float."""
    with ctx.workprec(400):
        x = arb(p)
        right = RIGHT[kind]
        found = {name: wrong(x) for name, wrong in WRONG[kind].items()}
        found["Complement"] = 1 - right(x)
        found |= {name: right(store(x)) for name, store in STORED.items()}
        if p in (0, 1):
            found["ZeroTimesInfinity"] = NAN
        flat = float_entropy(p, format)
        if kind == "entropy":
            found["Log1pMissing"] = arb(flat)
        elif abs(p - 0.5) < 2.0**-8:
            found["Cancelled"] = arb(nearest(1 - arb(flat), format))
        found["FlushedToZero"] = right(arb(0)) if flushed(p, format) is not None else flushed(result, format)
        return found


def of_log_odds(kind, l, format, result):
    """Wrong values of p, H or I at log-odds l."""
    with ctx.workprec(400):
        right = {**RIGHT, "occupancy": lambda p: p}[kind]
        p = logistic(l)
        x = arb(clamped(l, -4096.0, 4096.0))
        occupancies = {
            "LogOddsBase2": logistic(x * ln2()),
            "LogOddsBase10": logistic(x * arb(10).log()),
            "LogOddsSixteenths": logistic(x / 16),
            "LogOddsTwice": logistic(2 * x),
            "LogOddsSign": logistic(-x) if kind == "occupancy" else None,
            "LogOfOccupancy": x.exp() if l < 0 else None,
            "OddsOfOccupancy": x / (1 + x) if 0 < l < math.inf else None,
            "ThroughOccupancy": arb(nearest(p, format)) if kind != "occupancy" else None,
            "ClampedOctoMap": logistic(clamped(x, arb(-2), arb(3.5))),
            "MrptByte": logistic(arb(round(clamped(16 * l, -127, 127))) / 16),
            "ComplementOfLogistic": arb(nearest(1 - arb(nearest(1 - p, format)), format)) if l < 0 else None,
        }
        found = {name: None if q is None else right(q) for name, q in occupancies.items()}
        if kind != "occupancy":
            found |= {name: wrong(p) for name, wrong in WRONG[kind].items()}
            found["Complement"] = 1 - right(p)
            if kind == "information" and abs(l) < 2.0**-6:
                found["Cancelled"] = arb(nearest(1 - arb(float_entropy(nearest(p, format), format)), format))
            log_term = (-abs(x)).exp().log1p() / ln2()
            found["LogTermOnly"] = log_term if kind == "entropy" else 1 - log_term
        if l > {"f64": 709.8, "f32": 88.8}[format]:
            found["OddsOverflow"] = NAN
        if math.isinf(l) and kind != "occupancy":
            found["ZeroTimesInfinity"] = NAN
        found["FlushedToZero"] = flushed(result, format)
        return found


def single_sum(values):
    total = np.float32(0)
    for value in values:
        total = np.float32(total + np.float32(float(value)))
    return arb(float(total))


def ratio(a, b):
    return a / b if b else NAN


def of_map(op, cells, format):
    """Wrong values of an operation of a map; the cells are fractions in [0, 1]."""
    with ctx.workprec(400):
        found = map_values(op, [ball(p) for p in cells])
        if op == "map.entropy":
            found["FlushedToZero"] = flushed_sum(cells, format)
        return found


def flushed_sum(cells, format):
    """The entropy where cells, and then their entropies, are flushed to zero."""
    precision, lowest = FORMATS[format]
    normal = Fraction(2) ** (lowest + precision - 1)
    values = [entropy(ball(p)) for p in cells if p >= normal]
    return sum((h for h in values if h >= ball(normal)), arb(0))


def map_values(op, cells):
    known = {}

    def of_cell(name, function):
        """Of each cell, once for equal ones."""
        key = [(name, str(p.mid().man_exp())) for p in cells]
        for k, p in zip(key, cells):
            if k not in known:
                known[k] = function(p)
        return [known[k] for k in key]

    def add(values):
        return sum(values, arb(0))

    half = arb(1) / 2
    n = len(cells)
    h = of_cell("H", entropy)
    i = [1 - x for x in h]
    observed = [p != half for p in cells]
    seen = sum(observed)
    total = {"H": add(h), "I": add(i)}

    def only(keep):
        """The measures over the cells kept: entropy, information, how many."""
        return add([x for x, k in zip(h, keep) if k]), add([x for x, k in zip(i, keep) if k]), sum(keep)

    bound = 1 - arb(1) / 1000 / ln2()
    distance = [abs(p - half) for p in cells]
    subsets = {
        "MrptThreshold": [x < bound for x in h],
        "ThresholdThousandth": [d >= arb(1) / 1000 for d in distance],
        "ThresholdHundredth": [d >= arb(1) / 100 for d in distance],
        "ThresholdMillionth": [d >= arb(1) / 10**6 for d in distance],
        "ThresholdRos": [p < arb("0.196") or p > arb("0.65") for p in cells],
        "OccupiedOnly": [bool(p > half) for p in cells],
        "FreeOnly": [bool(p < half) for p in cells],
        "ZeroSkipped": [k and p != 0 for p, k in zip(cells, observed)],
        "CertainSkipped": [k and p not in (0, 1) for p, k in zip(cells, observed)],
        "FirstCellDropped": [False, *observed[1:]],
        "LastCellDropped": [*observed[:-1], False],
        "UnknownCounted": [True] * n,
        "UnobservedForObserved": [not k for k in observed],
    }
    if op == "map.observed":
        found = {name: sum(keep) for name, keep in subsets.items()}
        for name, store in STORED.items():
            if not name.startswith("Clamped") and name != "Byte":  # whose only effect is that of UnknownCounted
                found[name] = sum(p != half for p in of_cell(name, store))
        return found
    kind = "entropy" if op == "map.entropy" else "information"
    mean = op == "map.mean_information"

    def measure(values, count):
        return ratio(add(values), count) if mean else add(values)

    found = {name: measure(of_cell(name, wrong), seen) for name, wrong in WRONG[kind].items()}
    for name, store in STORED.items():
        stored = of_cell(name, store)
        values = [RIGHT[kind](p) for p in stored] if n < 100 else of_cell("of" + name, lambda p: RIGHT[kind](store(p)))
        found[name] = measure(values, sum(p != half for p in stored))
    if any(p == 0 or p == 1 for p in cells):
        found["ZeroTimesInfinity"] = NAN
    if n > 100:
        # Beside the trap, the flag `LongSum`: most single-precision sums are closer.
        found["SingleSum"] = single_sum(h if kind == "entropy" else i) / (seen if mean and seen else 1)
    if mean:
        found |= {name: ratio(only(keep)[1], sum(keep)) for name, keep in subsets.items() if name != "UnobservedForObserved"}
        del found["UnknownCounted"]
        for name in ("FirstCellDropped", "LastCellDropped"):
            found[name] = found[name] if any(subsets[name]) else arb(0)
        found["DividedByAll"] = ratio(total["I"], n)
        found["UnknownInformative"] = ratio(total["I"] + (n - seen), n)
        found["SumForMean"] = total["I"]
        found["MixedMean"] = ratio(seen - total["H"], seen)
        found["Complement"] = 1 - ratio(total["I"], seen)
        if not seen:
            found = {name: value for name, value in found.items() if not value_is_nan(value)} | {"EmptyMap": NAN}
        return found
    if kind == "information":
        keep = ("MrptThreshold", "ThresholdHundredth", "ThresholdRos", "OccupiedOnly", "FreeOnly", "ZeroSkipped", "CertainSkipped")
        keep += ("FirstCellDropped", "LastCellDropped")
        found |= {name: only(subsets[name])[1] for name in keep}
        found["UnknownInformative"] = total["I"] + (n - seen)
        found["MeanForSum"] = ratio(total["I"], seen) if seen else None
    else:
        found["ObservedOnly"] = only(observed)[0]
        if n:
            whole = add(cells)
            found["Normalised"] = add(of_cell("share", lambda p: -xlog2(p / whole))) if whole != 0 else NAN
            found["NormalisedNats"] = found["Normalised"] * ln2() if whole != 0 else NAN
        found["FirstCellDropped"], found["LastCellDropped"] = add(h[1:]), add(h[:-1])
        found["MeanForSum"] = ratio(total["H"], seen) if seen else None
    found["MeanOverAllForSum"] = ratio(total["H" if kind == "entropy" else "I"], n) if n else NAN
    found["Complement"] = total["I" if kind == "entropy" else "H"]
    return found


def value_is_nan(value):
    return isinstance(value, float) and math.isnan(value)


def of_bad_map(op, cells):
    """What becomes of cells outside the domain if they are not refused."""
    inside = [p for p in cells if 0 <= p <= 1]
    moved = [min(max(p, 0.0), 1.0) for p in cells if not math.isnan(p)]
    found = {"NotRefused": sum(p != 0.5 for p in cells)} if op == "map.observed" else {}
    with ctx.workprec(400):
        for name, cells in (("SkippedOutside", inside), ("ClampedIntoDomain", moved)):
            seen = sum(p != 0.5 for p in cells)
            values = [RIGHT["entropy" if op == "map.entropy" else "information"](arb(p)) for p in cells]
            total = sum(values, arb(0))
            found[name] = seen if op == "map.observed" else ratio(total, seen) if op.endswith("mean_information") else total
    return found
