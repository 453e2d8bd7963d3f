#!/usr/bin/env python3
"""Mean information of occupancy maps, in one file to read and to start from. Needs Python 3.8 and no package.

    I(p) = 1 - H(p),  H(p) = -p log2 p - (1-p) log2 (1-p)          Eqs. 1, 3: one cell, in bits
    mean information = sum of I / number of cells with p != 1/2    Eqs. 2, 4: a map
    p(rho) = exp(-((rho - z) / sigma)^2 / 2) up to z + sigma sqrt(ln 4), 1/2 beyond      Eq. 5: a range reading z

The equations are those of Blanco, "Derivation of an Expression for the Mean Information Maximum Value". Every function
takes and returns Python floats; `fmt` says which floats these are, F64 or F32. Results are the floats nearest to the
exact ones, because every formula is evaluated in decimals until its error no longer matters (`correctly_rounded`).
Limits are exact to 25 digits before they are rounded.

As a program, `python3 port.py` serves the port protocol on standard input and output.
"""

import json
import math
import sys
from collections import Counter, namedtuple
from decimal import Context, Decimal, getcontext, localcontext
from fractions import Fraction
from functools import lru_cache

# Bits of a significand; the smallest positive float and the least number above all floats, as exponents of 2.
Format = namedtuple("Format", "bits lowest beyond")
F64 = Format(53, -1074, 1024)
F32 = Format(24, -149, 128)


class DomainError(ValueError):
    """An argument is outside of what the formula is defined for."""


class TooLarge(ValueError):
    """The answer would take too long."""


# ---------------------------------------------------------------------------------------------------- rounding

def nearest(x, fmt):
    """The float nearest to a rational number x >= 0 (int, Fraction or Decimal), ties to even."""
    n, d = x.as_integer_ratio()
    if n <= 0:
        return 0.0
    exponent = n.bit_length() - d.bit_length()
    if n << max(-exponent, 0) < d << max(exponent, 0):
        exponent -= 1  # now 2^exponent <= x < 2^(exponent + 1)
    exponent = max(exponent - fmt.bits + 1, fmt.lowest)
    quotient, rest = divmod(n << max(-exponent, 0), d << max(exponent, 0))
    rest -= (d << max(exponent, 0)) - rest  # twice the rest, less the divisor
    if rest > 0 or rest == 0 and quotient % 2 == 1:
        quotient += 1
    return math.ldexp(quotient, exponent) if quotient.bit_length() + exponent <= fmt.beyond else math.inf


def correctly_rounded(formula, fmt, lost=8, digits=40):
    """The float nearest to the real number that `formula()` computes in the decimal context it finds.

    With n digits its error must be below 10^(lost - n). If the numbers within that error of the result do not all
    round to the same float, once more with more digits (Ziv's loop). It ends because none of the exact results is
    half-way between two floats.
    """
    while True:
        with localcontext(Context(prec=digits)):
            value, error = formula(), Decimal((0, (1,), lost - digits))
            low, high = nearest(value - error, fmt), nearest(value + error, fmt)
        if low == high:
            return low
        leading = min(-value.adjusted(), 330) if value else 0  # zeros; 330 are below all floats
        digits = max(2 * digits, leading + 30)


@lru_cache(maxsize=None)
def ln2(digits):
    with localcontext(Context(prec=digits)):
        return Decimal(2).ln()


def bits(nats):
    """An amount in nats as bits, in the current decimal context."""
    return nats / ln2(getcontext().prec)


def decimal(x):
    """A rational number in the current decimal context."""
    n, d = x.as_integer_ratio()
    return Decimal(n) / Decimal(d)


# ---------------------------------------------------------------------------------------------------- one cell

def check_occupancy(p):
    if not 0 <= p <= 1:
        raise DomainError("an occupancy must be 0 to 1")


def check_log_odds(l):
    if math.isnan(l):
        raise DomainError("log-odds must not be NaN")


def decimal_entropy(p):
    """Eq. 1 for an exact rational p, in bits, in the current decimal context."""
    if p == 0 or p == 1:
        return Decimal(0)
    n, d = p.as_integer_ratio()
    occupied, free = Decimal(n) / Decimal(d), Decimal(d - n) / Decimal(d)
    return bits(-occupied * occupied.ln() - free * free.ln())


def decimal_entropy_from_log_odds(l):
    """The same for p = 1 / (1 + e^-l), without forming p: ln(1 + e^-|l|) + |l| / (1 + e^|l|) nats."""
    if math.isinf(l):
        return Decimal(0)
    if l == 0:
        return Decimal(1)
    odds = (-abs(Decimal(l))).exp()
    return bits((1 + odds).ln() + abs(Decimal(l)) * odds / (1 + odds))


def entropy(p, fmt):
    """Eq. 1, in bits."""
    check_occupancy(p)
    return correctly_rounded(lambda: decimal_entropy(p), fmt)


def information(p, fmt):
    """Eq. 3, in bits. Near p = 1/2 most digits of 1 - H cancel: the loop takes more."""
    check_occupancy(p)
    return correctly_rounded(lambda: 1 - decimal_entropy(p), fmt)


def entropy_from_log_odds(l, fmt):
    """Eq. 1 from l = ln(p / (1-p))."""
    check_log_odds(l)
    return correctly_rounded(lambda: decimal_entropy_from_log_odds(l), fmt)


def information_from_log_odds(l, fmt):
    """Eq. 3 from l = ln(p / (1-p))."""
    check_log_odds(l)
    return correctly_rounded(lambda: 1 - decimal_entropy_from_log_odds(l), fmt)


def occupancy_from_log_odds(l, fmt):
    """p = 1 / (1 + e^-l), and e^l / (1 + e^l) for negative l, so that no exponential overflows."""
    check_log_odds(l)
    if l == 0 or math.isinf(l):
        return {-math.inf: 0.0, 0.0: 0.5, math.inf: 1.0}[l]

    def formula():
        odds = (-abs(Decimal(l))).exp()
        return (odds if l < 0 else 1) / (1 + odds)

    return correctly_rounded(formula, fmt)


# ---------------------------------------------------------------------------------------------------- a map

def sum_over(function, counts, start=0):
    """The sum of a function over counted values, in the current decimal context."""
    return sum((count * function(value) for value, count in counts.items()), Decimal(start))


def check_cells(cells):
    for p in cells:
        check_occupancy(p)


def lost_by(cells):
    """The digits that a sum over cells may lose."""
    return 8 + len(str(len(cells)))


def map_entropy(cells, fmt):
    """Eq. 2, in bits: an unknown cell counts 1."""
    check_cells(cells)
    return correctly_rounded(lambda: sum_over(decimal_entropy, Counter(cells)), fmt, lost_by(cells))


def map_information(cells, fmt):
    """The sum of Eq. 3 over the cells, in bits."""
    check_cells(cells)
    return correctly_rounded(lambda: sum_over(lambda p: 1 - decimal_entropy(p), Counter(cells)), fmt, lost_by(cells))


def map_observed(cells, fmt):
    """The number of cells with p != 1/2."""
    check_cells(cells)
    return sum(p != 0.5 for p in cells)


def map_mean_information(cells, fmt):
    """Eq. 4: information per observed cell; 0 if nothing was observed."""
    check_cells(cells)
    return mean_information([p for p in cells if p != 0.5], fmt)


def mean_information(observed, fmt):
    """The mean of Eq. 3 over cells of exact occupancy that are all observed."""
    if not observed:
        return 0.0
    counts = Counter(observed)
    return correctly_rounded(lambda: sum_over(lambda p: 1 - decimal_entropy(p), counts) / len(observed), fmt)


# ---------------------------------------------------------------------------------------------------- a sensor

def check_positive(*values):
    for value in values:
        if not 0 < value < math.inf:
            raise DomainError("range, sigma and resolution must be positive and finite")


def sensor_occupancy(rho, range_, sigma, fmt):
    """Eq. 5, with an exact exponent. It falls to 1/2 at z + sigma sqrt(ln 4): there the observed ends."""
    check_positive(range_, sigma)
    if math.isnan(rho):
        raise DomainError("rho must not be NaN")
    if math.isinf(rho):
        return 0.5 if rho > 0 else 0.0
    if rho == range_:
        return 1.0
    t = (Fraction(rho) - Fraction(range_)) / Fraction(sigma)
    p = correctly_rounded(lambda: decimal(-t * t / 2).exp(), fmt)
    return max(p, 0.5) if t > 0 else p


# ---------------------------------------------------------------------------------------------------- fusion

def fuse_log_odds(cells, fmt):
    """Independent observations of one place: log-odds add, so that odds multiply. Exact, then rounded once."""
    check_cells(cells)
    if 0 in cells and 1 in cells:
        raise DomainError("certainly free and certainly occupied: 0/0")
    occupied = free = 1
    for p in cells:
        n, d = p.as_integer_ratio()
        occupied *= n
        free *= d - n
    return nearest(Fraction(occupied, occupied + free), fmt)


def expected_mean_information(weights, particles, fmt):
    """Eq. 4 of the expected map, the mean of the particles' occupancies by weight. The means are exact: a cell that
    no particle has seen stays 1/2, whatever the weights."""
    if len(weights) != len(particles) or len({len(cells) for cells in particles}) > 1:
        raise DomainError("one weight for each particle, and particles of one length")
    if not all(0 <= w < math.inf for w in weights) or not any(weights):
        raise DomainError("weights must be 0 or more, finite, and not all 0")
    for cells in particles:
        check_cells(cells)
    weights = [Fraction(w) for w in weights]
    total = sum(weights)
    expected = [sum(w * Fraction(p) for w, p in zip(weights, place)) / total for place in zip(*particles)]
    return mean_information([p for p in expected if p != Fraction(1, 2)], fmt)


# ---------------------------------------------------------------------------------------------------- grids

EDGE = Fraction(1.1775)  # beyond sqrt(ln 4), where the observed ends, in sigmas from the reading
CERTAIN = 22  # this many sigmas before the reading, I is 1 to 100 digits
MAX_CELLS = 4_000_000


def grid_polar(range_, sigma, resolution, fmt):
    """One beam through the circular room, in cells of one width, sampled at their centres (k + 1/2) h."""
    check_positive(range_, sigma, resolution)
    z, s, h = Fraction(range_), Fraction(sigma), Fraction(resolution)
    certain = max(0, math.floor((z - CERTAIN * s) / h))
    end = math.floor((z + EDGE * s) / h) + 1
    if end - certain > MAX_CELLS:
        raise TooLarge("the beam has more than 4 million cells")
    distances = {Fraction(2 * k + 1, 2) ** 2: 1 for k in range(certain, end)}
    return room_mean_information(distances, range_, sigma, resolution, fmt, certain)


def grid_cartesian(range_, sigma, resolution, offset_x, offset_y, fmt):
    """The circular room about a robot at the origin, sampled at ((i + offset_x) h, (j + offset_y) h)."""
    check_positive(range_, sigma, resolution)
    if not (math.isfinite(offset_x) and math.isfinite(offset_y)):
        raise DomainError("offsets must be finite")
    z, s, h = Fraction(range_), Fraction(sigma), Fraction(resolution)
    reach = (z + EDGE * s) / h
    if 4 * reach * reach > MAX_CELLS:
        raise TooLarge("the room has more than 4 million cells")
    # Whole cells do not matter. From here on in units of 1 / scale of a cell, in which all places are integers.
    x, y = Fraction(offset_x) % 1, Fraction(offset_y) % 1
    scale = max(x.denominator, y.denominator)
    x, y = int(x * scale), int(y * scale)
    # The squares of two radii: cells up to `near` are certain, those beyond `far` unknown.
    near = math.ceil((max(z - CERTAIN * s, 0) / h * scale) ** 2) - 1
    far = math.floor((reach * scale) ** 2)
    certain, squares = 0, Counter()
    for row in places(y, math.isqrt(far), scale):
        columns = places(x, half_chord(far, row), scale)
        inside = places(x, half_chord(near, row), scale)
        certain += len(inside)
        squares.update(row * row + column * column for column in columns if column not in inside)
    distances = {Fraction(square, scale * scale): count for square, count in squares.items()}
    return room_mean_information(distances, range_, sigma, resolution, fmt, certain)


def places(offset, half_width, step):
    """The integers from -half_width to half_width that are `offset` and whole steps."""
    return range(-half_width + (offset + half_width) % step, half_width + 1, step)


def half_chord(square, row):
    """How far a disc reaches along a row; -1 if it does not reach the row. `square` is that of its radius."""
    return math.isqrt(square - row * row) if row * row <= square else -1


def room_mean_information(distances, range_, sigma, resolution, fmt, certain=0):
    """Eq. 4 over counted cells, given the squares of their distances from the robot in cells.

    A cell is observed if the float of its occupancy is not 1/2, at the float of its distance. That is in doubt only
    about the two places where Eq. 5 is 1/2.
    """
    z, s, h = Fraction(range_), Fraction(sigma), Fraction(resolution)
    alpha = z / s
    doubt = 16 * (alpha + 2) / 2**fmt.bits  # how far the roundings of distance and occupancy move t^2 / 2, and more
    lost = 10 + len(str(int(alpha)))

    def formula():
        half = ln2(getcontext().prec)  # t^2 / 2 where p = 1/2
        doubtful, total, observed = decimal(doubt), Decimal(certain), certain
        for square, count in distances.items():
            rho = decimal(square * h * h).sqrt()
            t = (rho - decimal(z)) / decimal(s)
            exponent = t * t / 2
            if abs(exponent - half) < doubtful:
                is_observed = sensor_occupancy(nearest(rho, fmt), range_, sigma, fmt) != 0.5
            else:
                is_observed = t < 0 or exponent < half
            if is_observed:
                observed += count
                total += count * (1 - decimal_model_entropy(exponent))
        return total / observed if observed else Decimal(0)

    return correctly_rounded(formula, fmt, lost)


def decimal_model_entropy(exponent):
    """Eq. 1 of p = e^-exponent, in bits, in the current decimal context."""
    p = (-exponent).exp()
    free = 1 - p
    return bits(p * exponent - (free * free.ln() if free > 0 else 0))


# ---------------------------------------------------------------------------------------------------- limits
#
# With alpha = z / sigma, b = sqrt(ln 4), h(t) = H(e^(-t^2 / 2)), K = int h dt and M = int t h dt from -alpha to b,
#
#     radial = 1 - K / (alpha + b),    area = 1 - 2 (alpha K + M) / (alpha + b)^2.
#
# h is smooth but for t^2 ln t at 0, where the integrals are cut, and below 1e-40 from 14 on.

LIMIT = Context(prec=32)


def limit_radial(range_, sigma, fmt):
    """Eq. 7: what the mean information of polar grids tends to as their cells shrink."""
    alpha, b, k, _ = limit_integrals(range_, sigma)
    with localcontext(LIMIT):
        return nearest(1 - k / (alpha + b), fmt)


def limit_area(range_, sigma, fmt):
    """The same for Cartesian grids, whose cells have equal areas rho drho dtheta."""
    alpha, b, k, m = limit_integrals(range_, sigma)
    with localcontext(LIMIT):
        return nearest(1 - 2 * (alpha * k + m) / (alpha + b) ** 2, fmt)


def limit_integrals(range_, sigma):
    """alpha, b, K and M."""
    check_positive(range_, sigma)
    with localcontext(LIMIT):
        alpha = decimal(Fraction(range_) / Fraction(sigma))
        b = (2 * ln2(LIMIT.prec)).sqrt()
        before, beyond = moments(min(alpha, Decimal(14))), moments(b)
        return alpha, b, before[0] + beyond[0], beyond[1] - before[1]


@lru_cache(maxsize=64)
def moments(end):
    """The integrals of h and t h from 0 to `end`, in pieces of at most 2."""
    start = (end / 2).to_integral_value("ROUND_CEILING") * 2 - 2
    k, m = moments(start) if start > 0 else (Decimal(0), Decimal(0))
    width = end - max(start, 0)
    for place, weight in tanh_sinh():
        t = end - width * place
        h = decimal_model_entropy(t * t / 2)
        k += width * weight * h
        m += width * weight * t * h
    return k, m


@lru_cache(maxsize=None)
def tanh_sinh():
    """Places and weights of a rule for the unit interval that does not mind singularities at its ends:
    x = 1 / (1 + e^(pi sinh u)), u = n / 10."""
    pi = Decimal("3.1415926535897932384626433832795029")
    rule = []
    for n in range(-36, 37):
        grow = (Decimal(n) / 10).exp()
        e = (pi * (grow - 1 / grow) / 2).exp()
        rule.append((1 / (1 + e), pi * (grow + 1 / grow) / 2 * e / (1 + e) ** 2 / 10))
    return rule


# ---------------------------------------------------------------------------------------------------- the protocol

OPERATIONS = {
    "cell.entropy": (entropy, ["p"]),
    "cell.information": (information, ["p"]),
    "cell.entropy_from_log_odds": (entropy_from_log_odds, ["l"]),
    "cell.information_from_log_odds": (information_from_log_odds, ["l"]),
    "cell.occupancy_from_log_odds": (occupancy_from_log_odds, ["l"]),
    "sensor.occupancy": (sensor_occupancy, ["rho", "range", "sigma"]),
    "map.entropy": (map_entropy, ["cells"]),
    "map.information": (map_information, ["cells"]),
    "map.mean_information": (map_mean_information, ["cells"]),
    "map.observed": (map_observed, ["cells"]),
    "fuse.log_odds": (fuse_log_odds, ["cells"]),
    "expected.mean_information": (expected_mean_information, ["weights", "particles"]),
    "grid.polar.mean_information": (grid_polar, ["range", "sigma", "resolution"]),
    "grid.cartesian.mean_information": (grid_cartesian, ["range", "sigma", "resolution", "offset_x", "offset_y"]),
    "limit.radial": (limit_radial, ["range", "sigma"]),
    "limit.area": (limit_area, ["range", "sigma"]),
}
FORMATS = {"f64": F64, "f32": F32}


def read(argument):
    """Floats travel as hexadecimal text, since decimals may be rounded on the way."""
    return [read(item) for item in argument] if isinstance(argument, list) else float.fromhex(argument)


def answer(request):
    if request["cmd"] == "start":
        return {"protocol": 1, "name": "port.py", "language": "Python", "version": "1",
                "formats": list(FORMATS), "ops": list(OPERATIONS)}
    if request["op"] not in OPERATIONS or request["format"] not in FORMATS:
        return {"seq": request["seq"], "error": "unknown-operation"}
    function, names = OPERATIONS[request["op"]]
    try:
        arguments = [read(request["args"][name]) for name in names]
        result = function(*arguments, FORMATS[request["format"]])
    except DomainError:
        return {"seq": request["seq"], "error": "domain"}
    except TooLarge as reason:
        return {"seq": request["seq"], "skipped": str(reason)}
    return {"seq": request["seq"], "result": result if isinstance(result, int) else result.hex()}


def serve():
    for line in sys.stdin:
        request = json.loads(line)
        if request["cmd"] == "stop":
            break
        print(json.dumps(answer(request)), flush=True)


if __name__ == "__main__":
    serve()
