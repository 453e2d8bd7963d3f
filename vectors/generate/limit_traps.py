"""Known mistakes with the limits, in Arb: K and J are the integrals of H and of (a + t) H, t from -a to b."""

from flint import arb

from limit_exact import at, constants, edge, large, ln2, small


def gini(a, b):
    """The integrals of 4 p (1-p) and of t times that."""
    def power(k):
        root = (arb(k) / 2).sqrt()
        plain = (arb.pi() / (2 * k)).sqrt() * ((b * root).erf() + (a * root).erf())
        return plain, ((-k * a * a / 2).exp() - (-k * b * b / 2).exp()) / k

    (first, first_t), (second, second_t) = power(1), power(2)
    return 4 * (first - second), 4 * (first_t - second_t)


def known_mistakes(a):
    """Wrong values of the radial and of the area limit at a = range / sigma, a ball: two dictionaries."""
    b = edge()
    radial, area = at(a)
    near, lower, kappa, _ = constants()
    width = a + b
    k, j = (1 - radial) * width, (1 - area) * width**2 / 2
    before, before_area = k - near, j - a * near - lower
    g, g_t = gini(a, b)

    def means(entropy, entropy_area, width):
        return 1 - entropy / width, 1 - 2 * entropy_area / width**2

    def until(edge):
        """Eq. 5's Gaussian up to this edge."""
        first, second = small(edge) if edge < 1 else large(edge)
        return means(before + first, before_area + a * first + edge * first - second, a + edge)

    pairs = {
        "Nats": (radial * ln2(), area * ln2()),
        "OneMinusNats": means(k * ln2(), j * ln2(), width),
        "Complement": (1 - radial, 1 - area),
        "Gini": means(g, a * g + g_t, width),
        "NormalisedByRange": ((width - k) / a, (width**2 - 2 * j) / a**2),
        "IntegratedToRange": means(before, before_area, a),
        "IntegratedTwice": means(2 * before, 2 * before_area, width),
        "EdgeAtOneSigma": until(arb(1)),
        "EdgeWithoutTwo": until(ln2().sqrt()),
        "EdgeAtThreeSigma": until(arb(3)),
        "SymmetricEdges": (1 - near / b,) * 2 if a > b else (None, None),
        "MissedPeak": (arb(1), arb(1)),
        "RangeSigmaSwapped": at(1 / a),
        "Diameter": at(a / 2),
        "FullWidth": at(a * (8 * ln2()).sqrt()),
        "ConstantForLargeAlpha": (1 - kappa / width, 1 - 2 * kappa * a / width**2),
    }
    found = [{name: pair[n] for name, pair in pairs.items()} for n in (0, 1)]
    found[0]["AreaForRadial"], found[1]["RadialForArea"] = area, radial
    return found
