"""The radial limit of the room z / sigma = 10 by others: python-flint (Arb), mpmath and SciPy (QUADPACK's qagp).

A child of `cargo bench --bench peers`, which prints what this writes: one line a method, with tabs between name, seconds a
call, value, claimed error or width, evaluations. A package that is not there is skipped, with a line on standard error.
Everyone integrates what both sides of the obstacle share once, as the library does.
"""

import math
import sys
import time

ALPHA = 10


def best(call, rounds):
    """The least processor time of some calls, and the result."""
    times = []
    for _ in range(rounds):
        start = time.thread_time()
        result = call()
        times.append(time.thread_time() - start)
    return min(times), result


def report(name, seconds, value, error, evaluations):
    print(name, repr(seconds), repr(value), repr(error), evaluations, sep="\t", flush=True)


class Deficit:
    """What a reading at `t` standard deviations lacks of 1 bit, in nats, by a module's functions; counts its calls."""

    def __init__(self, module):
        self.module, self.count = module, 0

    def __call__(self, t):
        self.count += 1
        exponent = -t * t / 2
        q = -self.module.expm1(exponent)
        return -(self.module.exp(exponent) * exponent + (q * self.module.log(q) if q else 0))


def arb(bits):
    """Petras' algorithm: Gauss-Legendre with ellipses and bisection; a ball that contains the limit."""
    import flint

    acb, ctx = flint.acb, flint.ctx
    ctx.prec = bits
    count = 0

    def deficit(t, analytic):
        nonlocal count
        count += 1
        exponent = -t * t / 2
        p, q = exponent.exp(), -exponent.expm1()
        if not analytic and q.real.contains(0) and q.imag == 0:
            # -q ln q rises from 0 to 1/e at q = 1/e, which Arb does not know of its logarithm.
            most = q.real.abs_upper()
            half = (-most * most.log() / 2).abs_upper() if most < 0.25 else flint.arb(0.25)
            return -(p * exponent) + acb(flint.arb(half.mid(), half.abs_upper()))
        return -(p * exponent + q * q.log(analytic=analytic))

    def limit():
        nonlocal count
        count = 0
        edge = (2 * flint.arb(2).log()).sqrt()
        options = {"abs_tol": flint.arb(2) ** -58, "rel_tol": flint.arb(2) ** -58}
        common = acb.integral(deficit, acb(0), acb(edge), **options)
        rest = acb.integral(deficit, acb(edge), acb(ALPHA), **options)
        return 1 - ((2 * common + rest) / flint.arb(2).log()).real / (ALPHA + edge)

    seconds, ball = best(limit, 5)
    report(f"Arb (python-flint {flint.__version__})", seconds, float(ball.mid()), 2 * float(ball.rad()), count)


def tanh_sinh():
    """mpmath's own quad at its double precision: an estimate."""
    import mpmath

    deficit = Deficit(mpmath)

    def limit():
        deficit.count = 0
        edge = mpmath.sqrt(2 * mpmath.ln2)
        common, first = mpmath.quad(deficit, [0, edge], error=True)
        rest, second = mpmath.quad(deficit, [edge, ALPHA], error=True)
        whole = (ALPHA + edge) * mpmath.ln2
        return 1 - (2 * common + rest) / whole, (2 * first + second) / whole

    seconds, (value, error) = best(limit, 5)
    report(f"mpmath {mpmath.__version__} quad", seconds, float(value), float(error), deficit.count)


def quadpack():
    """QUADPACK's qagp at a relative 1e-12, without the sharing, as issue trackers and textbooks use it: split at the peak."""
    import scipy
    from scipy.integrate import quad

    deficit = Deficit(math)
    edge = math.sqrt(2 * math.log(2))

    def limit():
        deficit.count = 0
        value, error = quad(deficit, -ALPHA, edge, points=[0], epsabs=0, epsrel=1e-12)[:2]
        whole = (ALPHA + edge) * math.log(2)
        return 1 - value / whole, error / whole

    seconds, (value, error) = best(limit, 20)
    report(f"QUADPACK qagp (SciPy {scipy.__version__})", seconds, value, error, deficit.count)


for method in (lambda: arb(64), tanh_sinh, quadpack):
    try:
        method()
    except ImportError as missing:
        print(f"skipped: {missing}", file=sys.stderr)
