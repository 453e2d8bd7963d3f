"""The cells of the circular room, exactly: how far they are, whether they are observed, their information.

A grid's program rounds the distance of a cell and then its occupancy. `Room.judge` says of a cell whether it is observed by
the convention (both correctly rounded), whether another rounding would decide otherwise, its exact information, and by how
much one correct rounding of each of the two can change that.
"""

import math
from fractions import Fraction

import mpmath
from flint import arb, ctx

import exact
from enclosures import ball, bounds, number
from exact import FORMATS, rounded
from sensor import occupancy

BITS = 288
# Roundings of the distance and of p that are thought of where it is asked whether they decide: in ulp.
DOUBT = 4


def polar(z, sigma, h):
    """Squared distances of the cells up to a little beyond the edge, with how many are at each."""
    reach = z + sigma * Fraction(1178, 1000)
    return {(h * (2 * k + 1) / 2) ** 2: 1 for k in range(math.floor(reach / h + Fraction(1, 2)))}


def cartesian(z, sigma, h, x, y):
    """The same of the Cartesian grid; offsets of whole cells change nothing."""
    reach = z + sigma * Fraction(1178, 1000)
    parts = [math.lcm(x.denominator, y.denominator)] * 2
    unit = parts[0]
    dx, dy = (int(o * unit) % unit for o in (x, y))
    radius = (reach / h * unit) ** 2
    limit = radius.numerator // radius.denominator
    widest = math.isqrt(limit)
    found = {}
    for i in range(-(widest + dx) // unit, widest // unit + 1):
        across = (i * unit + dx) ** 2
        if across > limit:
            continue
        along = math.isqrt(limit - across)
        for j in range(-(along + dy) // unit, along // unit + 1):
            squared = across + (j * unit + dy) ** 2
            if squared <= limit:
                found[squared] = found.get(squared, 0) + 1
    return {h * h * Fraction(squared, unit * unit): count for squared, count in found.items()}


def root(squared):
    """The exact root of a fraction, or None."""
    roots = [math.isqrt(n) for n in (squared.numerator, squared.denominator)]
    return Fraction(*roots) if roots[0] ** 2 == squared.numerator and roots[1] ** 2 == squared.denominator else None


def rounded_root(squared, format):
    whole = root(squared)
    if whole is not None:
        return rounded(whole, format)
    with ctx.workprec(BITS):
        ends = {rounded(end, format) for end in bounds(ball(squared).sqrt())}
    assert len(ends) == 1
    return ends.pop()


class Room:
    def __init__(self, z, sigma, format):
        self.z, self.sigma, self.format = Fraction(z), Fraction(sigma), format
        self.bits, self.lowest = FORMATS[format]
        with ctx.workprec(BITS):
            self.range, self.inverse = ball(self.z), 1 / ball(self.sigma)
            self.edge = (2 * arb.const_log2()).sqrt()
            self.half = arb(1) / 2
            self.eps = arb(2) ** -self.bits

    def ulp(self, rho):
        """Of a distance, a ball or 0."""
        m, e = arb(rho).upper().man_exp()
        return arb(2) ** max(int(m).bit_length() + int(e) - self.bits, self.lowest) if m != 0 else arb(2) ** self.lowest

    def gaussian(self, t):
        return (-t * t / 2).exp()

    def information(self, p):
        if not 0 < p < 1:
            # Within 2^-280 of 0 or 1.
            return arb(1, arb(2) ** -260)
        return 1 - exact.entropy(p)

    def judge(self, squared):
        """(observed, doubtful, information of the exact cell, its change by roundings)."""
        with ctx.workprec(BITS):
            rho = ball(squared).sqrt()
            t = (rho - self.range) * self.inverse
            step = self.ulp(rho)
            inside = bool(t < self.edge)
            p = self.gaussian(t) if inside else self.half
            wide = DOUBT * step * self.inverse
            doubtful = self.is_doubtful(t, wide)
            observed = inside
            if doubtful:
                distance = Fraction(rounded_root(squared, self.format))
                ends = occupancy(distance, self.z, self.sigma)
                observed = rounded(ends[0], self.format) != 0.5
            if not inside:
                return observed, doubtful, arb(0), arb(0)
            value = self.information(p)
            narrow = step / 2 * self.inverse
            values = [self.gaussian(t - narrow), self.gaussian(t + narrow)]
            values += [arb(1)] if abs(t) <= narrow else []
            change = arb(0)
            for q in values:
                slack = q * self.eps + arb(2) ** (self.lowest - 1)
                for end in (q - slack, q + slack):
                    end = self.half if t > 0 and end < self.half else end
                    change = max((change, abs(self.information(end) - value).upper()), key=float)
            return observed, doubtful, value, change

    def is_doubtful(self, t, wide):
        """Whether distances within some ulp have occupancies within some ulp of 1/2, on either side."""
        slack = DOUBT * 2 * self.eps
        for side in (-1, 1):
            nearest = abs(t - side * self.edge) - wide
            if nearest <= 0:
                return True
            if nearest < arb(1) / 100 and abs(self.gaussian(side * self.edge + nearest) - self.half) <= slack * 2:
                return True
        return False


def defined(kind, z, sigma, h, x=0, y=0):
    """Sum and number of cells inside the edge, by mpmath from the definition with loops of its own."""
    with mpmath.workprec(200):
        z, sigma, h, x, y = (number(Fraction(v)) for v in (z, sigma, h, x, y))
        edge = z + sigma * mpmath.sqrt(mpmath.log(4))
        total, count = mpmath.mpf(0), 0

        def add(rho):
            s = ((rho - z) / (sigma * mpmath.sqrt(2))) ** 2
            rest = -mpmath.expm1(-s)
            entropy = (s * mpmath.exp(-s) - (rest * mpmath.log(rest) if rest else 0)) / mpmath.log(2)
            return 1 - entropy

        if kind == "polar":
            k = 0
            while (rho := (k + mpmath.mpf(1) / 2) * h) <= edge:
                total, count, k = total + add(rho), count + 1, k + 1
            return total, count
        x, y = x - mpmath.floor(x), y - mpmath.floor(y)
        n = int(edge / h) + 2
        known = {}
        for i in range(-n, n + 1):
            for j in range(-n, n + 1):
                squared = (i + x) ** 2 + (j + y) ** 2
                if squared not in known:
                    rho = h * mpmath.sqrt(squared)
                    known[squared] = add(rho) if rho <= edge else None
                if known[squared] is not None:
                    total, count = total + known[squared], count + 1
        return total, count
