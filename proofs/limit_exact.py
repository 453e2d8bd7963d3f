"""The two limits and their Taylor series in Arb's ball arithmetic (python-flint): rigorous, to any precision.

Notation of docs/limit.md and docs/closed_form.md: `A(a)` is the integral of H(e^(-t^2/2)) from 0 to a, `C(a)` that of
A, b = sqrt(ln 4), and

    1 - radial = (A(b) + A(a)) / (a + b),    1 - area = 2 (a A(b) + B + C(a)) / (a + b)^2,    a = z / sigma.

A and C have two expansions each, a power series about 0 and one in complementary error functions and dilogarithms,
which share nothing; limit_certify.py compares them. Needs python-flint.
"""

from functools import cache

from flint import arb, arb_series, ctx

ctx.prec = 320
TERMS = 150  # of the power series: s <= 1/2 leaves 3.6 bits a term
MEETING = 1  # from here on the other expansion


def error(bound):
    """The ball about 0 with this radius."""
    return arb(0, bound)


def ln2():
    return arb.const_log2()


def edge():
    """`b`: where the Gaussian is 1/2."""
    return (2 * ln2()).sqrt()


@cache
def coefficients():
    """Of phi(s) = (1 - e^-s) / s, and of u(s) = e^-s - phi ln phi."""
    ctx.cap = TERMS
    s = arb_series([0, 1], prec=TERMS)
    power = (-s).exp()
    phi = arb_series([-c for c in power.coeffs()[1:]], prec=TERMS - 1)
    u = power - phi * phi.log()
    return u.coeffs()[: TERMS - 1], phi.coeffs()[: TERMS - 1]


def small(a):
    """A and C by power series in s = a^2/2 <= 1/2: lemma "series" of docs/closed_form.md bounds what is cut off."""
    s, a = a * a / 2, arb(a)
    log_s = s.log()
    first, second, power = arb(0), arb(0), arb(1)
    for k, (u, phi) in enumerate(zip(*coefficients())):
        m, n = 2 * k + 3, 2 * k + 4
        inner = u + 2 * phi / m - phi * log_s
        first += power * inner / m
        second += power * (inner + 2 * phi / n) / (m * n)
        power *= s
    # |u_k| <= 876 (2 pi)^-k, |phi_k| <= 86 (2 pi)^-k.
    ratio = s / (2 * arb.pi())
    rest = ratio ** (TERMS - 1) / (1 - ratio) * (876 + 86 * (2 + abs(log_s)))
    scale = a**3 / (2 * ln2())
    rest = error(rest.upper())
    return scale * (first + rest), scale * a * (second + rest)


@cache
def zeta_sum():
    """S = sum of 1 / (k^(3/2) (k - 1)) over k >= 2, as the sum of zeta(j + 5/2) - 1."""
    count = ctx.prec + 8
    total = sum((arb(2 * j + 5) / 2).zeta() - 1 for j in range(count))
    # zeta(x) - 1 <= 2^(1-x) for x >= 3.
    return total + error(arb(2) ** -(count - 4))


def gaussian_tail(k, a):
    """erfc(a sqrt(k/2)) / (k^(3/2) (k - 1))."""
    k = arb(k)
    return (a * (k / 2).sqrt()).erfc() / (k * k.sqrt() * (k - 1))


def large(a):
    """A and C for a >= 1: the chapter's closed form."""
    a = arb(a)
    p = (-a * a / 2).exp()
    tails, k = arb(0), 2
    while True:
        term = gaussian_tail(k, a)
        tails += term
        k += 1
        if term < arb(2) ** -(ctx.prec + 8):
            break
    # The terms fall by more than e^(-a^2/2) each, and erfc is not negative.
    tails += error((term * p / (1 - p)).upper())
    root = (arb.pi() / 2).sqrt()
    first_moment = root * (1 - (a / arb(2).sqrt()).erfc())
    # (1/2) of the integral of t^2 e^(-t^2/2), that of e^(-t^2/2), and the series in p^k / (k (k - 1)).
    nats = (first_moment - a * p) / 2 + first_moment - root * (zeta_sum() - tails)
    value = nats / ln2()
    return value, a * value - moment(a)


def moment(a):
    """The integral of t H2(e^(-t^2/2)) from 0 to a."""
    p = (-a * a / 2).exp()
    entropy = p * a * a / 2 - (1 - p) * (1 - p).log()
    return (arb.pi() ** 2 / 6 - entropy - p.polylog(2)) / ln2()


@cache
def constants():
    """A(b), B, kappa = A(b) + A(infinity), M = B - moment(infinity)."""
    b = edge()
    half = ln2() ** 2 / 2
    lower = (arb.pi() ** 2 / 12 + half) / ln2() - 1
    near = large(b)[0]
    root = (arb.pi() / 2).sqrt()
    far = root * (arb(3) / 2 - zeta_sum()) / ln2()
    return near, lower, near + far, lower - arb.pi() ** 2 / 6 / ln2()


def entropy_series(t):
    """H2(e^(-t^2/2)) of a series t."""
    s = t * t / 2
    p = (-s).exp()
    rest = 1 - p
    return (s * p - rest * rest.log()) / ln2()


def limits(a, first, second, one=1):
    """MI_radial and MI_area from a, A(a), C(a), which may be series."""
    near, lower, _, _ = constants()
    width = a + edge()
    return one - (first + near) / width, one - 2 * (second + near * a + lower) / (width * width)


def at(a):
    """MI_radial and MI_area at a number, or at a ball of positive numbers."""
    a = arb(a)
    if a == 0:
        return within(a)
    first, second = small(a) if a < MEETING else large(a)
    return limits(a, first, second)


def line(place, order):
    """The variable, as a series of so many terms about a point or a ball."""
    ctx.cap = order
    return arb_series([place, 1], prec=order)


def one(order):
    return arb_series([1], prec=order)


def taylor(centre, order, ball=None):
    """The Taylor series of both limits about a point; with a ball, their coefficients about all points in it."""
    first, second = small(centre) if centre < MEETING else large(centre)
    t = line(centre if ball is None else ball, order)
    entropy = entropy_series(t)
    if ball is not None:
        # The mean value theorem.
        first += entropy[0] * (ball - centre)
        second += first * (ball - centre)
    first = entropy.integral() + first
    return limits(t, first, first.integral() + second, one(order))


def beyond(v, one=1):
    """Both limits from v = 1/a, as if A were A(infinity) and C its asymptote from a on."""
    _, _, kappa, offset = constants()
    width = one + edge() * v
    return one - kappa * v / width, one - 2 * (kappa * v + offset * v * v) / (width * width)


def within(a, one=1):
    """Both limits as if A and C were 0."""
    return limits(a, 0 * one, 0 * one, one)
