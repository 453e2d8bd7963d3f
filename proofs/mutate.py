#!/usr/bin/env python3
"""Breaks the source or a proof, one change at a time, in a copy, and shows that proofs/check.sh notices.

    proofs/mutate.py           every change
    proofs/mutate.py lanes     those whose names contain this

A change "in both" is made in the source and in the script that quotes it, so that only the proof itself can fail; a change of
one file must be noticed as a difference. Prints the table of proofs/README.md; ends with status 1 if a change survives.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FIXED, APPROXIMATE, GAUSSIAN, SHORT, LOG_ODDS = (
    f"src/rounded/{name}.rs" for name in ("fixed", "approximate", "gaussian", "short_gaussian", "log_odds"))


def error_constant(name, exponent, smaller, *where):
    """The constant `1 << exponent` made `1 << smaller` in the source and wherever a script states or assumes it."""
    edits = [(FIXED, f"{name}: u128 = 1 << {exponent};", f"{name}: u128 = 1 << {smaller};")]
    for script in where:
        edits.append((f"proofs/{script}.gappa", f"{name} = 1b{exponent};", f"{name} = 1b{smaller};"))
    for path in sorted((ROOT / "proofs").glob("*.gappa")):
        for line in path.read_text().splitlines():
            if line.endswith(f"# {name}"):
                edits.append((f"proofs/{path.name}", line, line.replace(f"<= 1b{exponent}", f"<= 1b{smaller}")))
    return edits


def both(file, script, quotation, definition):
    """A statement and its translation, each as (old, new)."""
    return [(file, *quotation), (f"proofs/{script}.gappa", *quotation), (f"proofs/{script}.gappa", *definition)]


REGIONS = ["lanes.sollya", "log_odds_regions.sollya"]
# The vector kernels, and the two scripts of each: in steps, and fused.
DOUBLE, SINGLE, LOG_ODDS_DOUBLE, LOG_ODDS_SINGLE, FAR = (
    f"src/rounded/lanes/{name}.rs" for name in ("double", "single", "log_odds/double", "log_odds/single", "log_odds/far"))
SCRIPTS = {
    file: [f"proofs/{kernel}.gappa", f"proofs/{kernel}_fused.gappa"]
    for file, kernel in ((DOUBLE, "lanes_f64"), (SINGLE, "lanes_f32"), (LOG_ODDS_DOUBLE, "log_odds_f64"),
                         (LOG_ODDS_SINGLE, "log_odds_f32"))
}


def kernel(file, quotation, in_steps=(), fused=()):
    """A line of a vector kernel in both its scripts, and its translation in either, each as (old, new)."""
    edits = [(file, *quotation)]
    for script, translation in zip(SCRIPTS[file], (in_steps, fused)):
        edits.append((script, *quotation))
        if translation:
            edits.append((script, *translation))
    return edits


def shared(quotation, in_steps=(), fused=()):
    """The same of a line of `leading` or `complements` in `f64`, which the kernels of log-odds run, too."""
    return kernel(DOUBLE, quotation, in_steps, fused) + kernel(LOG_ODDS_DOUBLE, quotation, in_steps, fused)[1:]


# (what is changed, what must fail, edits as (file, old, new)).
MUTATIONS = [
    ("LOG_ERROR halved, in both", "log2.gappa",
     error_constant("LOG_ERROR", 43, 42, "log2", "minus_log2", "with_two_logarithms", "with_small_occupancy",
                    "with_large_odds", "ln_by_log2", "magnitude_with_two_logarithms", "magnitude_with_small_occupancy")),
    ("LOG_1P_OVER_ERROR halved, in both", "log2_1p_over.gappa",
     error_constant("LOG_1P_OVER_ERROR", 42, 41, "log2_1p_over", "with_small_occupancy", "with_small_odds",
                    "ln_near_one", "magnitude_near_unknown")),
    ("EXP_ERROR halved, in both", "exp2_neg.gappa", error_constant("EXP_ERROR", 48, 47, "exp2_neg", "occupancy", "exp")),
    ("SERIES_ERROR halved, in both", "information_series.gappa",
     error_constant("SERIES_ERROR", 55, 54, "information_series", "information_series_log_odds", "from_series")
     + [("proofs/from_series.gappa", f"<= {2**55 + 1} # SERIES_ERROR + 1", f"<= {2**54 + 1} # SERIES_ERROR + 1")]),
    ("log2_1p: z_q >> 62, in both", "log2.gappa",
     both(FIXED, "log2", ("&LOG_Q, z, 71))) >> 63", "&LOG_Q, z, 71))) >> 62"),
          ("z * horner_LOG_Q * 1b-63", "z * horner_LOG_Q * 1b-62"))),
    ("log2_1p: the low half of 1 / ln 2 dropped, in both", "log2.gappa",
     both(FIXED, "log2", ("z * high + ((z * low) >> 64) + ((z * z_q) >> 8)", "z * high + ((z * z_q) >> 8)"),
          ("z * high + floor(z * low * 1b-64) + floor(z * z_q * 1b-8)", "z * high + floor(z * z_q * 1b-8)"))),
    ("minus_log2_112: log2 >> 9, in both", "minus_log2.gappa",
     both(FIXED, "minus_log2", ("(log2(m, 52) >> 8)", "(log2(m, 52) >> 9)"),
          ("floor(log2_m * 1b-8);", "floor(log2_m * 1b-9);"))),
    ("exp2_neg: Horner's rule at scale 70, in both", "exp2_neg.gappa",
     both(FIXED, "exp2_neg", ("&EXP_R, g_71, 71)", "&EXP_R, g_71, 70)"), ("g_71 * 1b-71", "g_71 * 1b-70"))),
    ("exp2_neg: g << 11, in both", "exp2_neg.gappa",
     both(FIXED, "exp2_neg", ("mul_high(g << 12, slope)", "mul_high(g << 11, slope)"),
          ("floor(g * 1b12 * slope", "floor(g * 1b11 * slope"))),
    ("exp2_neg: g cut to 60 bits, in both", "exp2_neg.gappa",
     both(FIXED, "exp2_neg", ("let g_71 = (g >> 45) as i64", "let g_71 = (g >> 48 << 3) as i64"),
          ("g_71 = floor(g * 1b-45);", "g_71 = floor(g * 1b-48) * 1b3;"))),
    ("information_series: u V >> 11, in both", "information_series.gappa",
     both(FIXED, "information_series", ("&INFO_V, u, 71))) >> 10", "&INFO_V, u, 71))) >> 11"),
          ("floor(u * horner_INFO_V * 1b-10)", "floor(u * horner_INFO_V * 1b-11)"))),
    ("information_series_log_odds: + u W, in both", "information_series_log_odds.gappa",
     both(FIXED, "information_series_log_odds", ("EIGHTH_INV_LN2 - ((", "EIGHTH_INV_LN2 + (("),
          ("EIGHTH_INV_LN2 - floor", "EIGHTH_INV_LN2 + floor"))),
    ("reciprocal: 8 bits of the correction's factor cut, in both", "reciprocal.gappa",
     both(FIXED, "reciprocal", ("((first >> 2) as i128 * residual) >> 61", "((first >> 8) as i128 * residual) >> 55"),
          ("correction = floor(floor(first * 1b-2) * residual * 1b-61)",
           "correction = floor(floor(first * 1b-8) * residual * 1b-55)"))
     + [("proofs/reciprocal.gappa", "    (correction - floor(first * 1b-2) * residual * 1b-61)\n    + (floor(first * 1b-2) - first * 1b-2) * residual * 1b-61",
         "    (correction - floor(first * 1b-8) * residual * 1b-55)\n    + (floor(first * 1b-8) - first * 1b-8) * residual * 1b-55")]),
    ("with_two_logarithms: + 1 for two floors, in both", "with_two_logarithms.gappa",
     both(APPROXIMATE, "with_two_logarithms", ("complements(entropy, LOG_ERROR + 2)", "complements(entropy, LOG_ERROR + 1)"),
          ("error = LOG_ERROR + 2;", "error = LOG_ERROR + 1;"))),
    ("from_series: + 1 for two floors, in both", "from_series.gappa",
     both(APPROXIMATE, "from_series", ("-120 - exponent) + 2;", "-120 - exponent) + 1;"),
          ("two_to_exponent) + 2;", "two_to_exponent) + 1;"))),
    ("with_small_occupancy: the factor 1 - q dropped, in both", "with_small_occupancy.gappa",
     both(APPROXIMATE, "with_small_occupancy",
          ("let of_rest = slope - shift_right(mul_high(significand, slope), n - 53);", "let of_rest = slope + 0;"),
          ("of_rest = slope - floor(floor(significand * slope * 1b-128) * two_to_minus_n * 1b53);", "of_rest = slope + 0;"))),
    ("with_small_occupancy: LOG_ERROR left out, in both", "with_small_occupancy.gappa",
     both(APPROXIMATE, "with_small_occupancy", ("LOG_1P_OVER_ERROR + (LOG_ERROR >> 8) + 8", "LOG_1P_OVER_ERROR + 8"),
          ("LOG_1P_OVER_ERROR + floor(LOG_ERROR * 1b-8) + 8", "LOG_1P_OVER_ERROR + 8"))),
    ("from_product: + 1 for two floors, in both", "from_product.gappa",
     both(APPROXIMATE, "from_product", ("at_120(error) + 2", "at_120(error) + 1"),
          ("information_error = at_120_error + 2;", "information_error = at_120_error + 1;"))),
    ("with_large_odds: the correction dropped, in both", "with_large_odds.gappa",
     both(APPROXIMATE, "with_large_odds", ("let log2_w = (log2(n, 60) + correction as i128) as u128;", "let log2_w = (log2(n, 60) + 0) as u128;"),
          ("log2_w = log2_n + correction;", "log2_w = log2_n + 0;"))),
    ("with_large_odds: the error LOG_ERROR, in both", "with_large_odds.gappa",
     both(APPROXIMATE, "with_large_odds", ("complements(log2_w + product, 2 * LOG_ERROR)", "complements(log2_w + product, 1 * LOG_ERROR)"),
          ("error = 2 * LOG_ERROR;", "error = 1 * LOG_ERROR;"))),
    ("with_small_odds: value >> 80, in both", "with_small_odds.gappa",
     both(APPROXIMATE, "with_small_odds", ("(value >> 76)", "(value >> 80)"), ("floor(value * 1b-76);\n\n", "floor(value * 1b-80);\n\n"))
     + [("proofs/with_small_odds.gappa", "1b-76", "1b-80")]),
    ("occupancy: the error EXP_ERROR, in both", "occupancy.gappa",
     [(file, "2 * EXP_ERROR", "1 * EXP_ERROR") for file in (APPROXIMATE, "proofs/occupancy.gappa")]),
    ("exp_neg: only the high half of 1 / ln 2, in both", "exp_neg.gappa",
     both(FIXED, "exp_neg", ("let t = mul_high(l, INV_LN2);", "let t = mul_high(l, INV_LN2 >> 64 << 64);"),
          ("t = floor(l * INV_LN2 * 1b-128);", "t = floor(l * (floor(INV_LN2 * 1b-64) * 1b64) * 1b-128);"))),
    ("exp: 1 - f short by 2^10 units, in both", "exp.gappa",
     both(APPROXIMATE, "exp", ("let rest = (1 << 116) - 1 - fraction;", "let rest = (1 << 116) - 1024 - fraction;"),
          ("rest = 1b116 - 1 - fraction;", "rest = 1b116 - 1024 - fraction;"))),
    ("ln_near_one: the error LOG_1P_OVER_ERROR << 13, in both", "ln_near_one.gappa",
     both(APPROXIMATE, "ln_near_one", ("LOG_1P_OVER_ERROR << 14", "LOG_1P_OVER_ERROR << 13"),
          ("LOG_1P_OVER_ERROR * 1b14", "LOG_1P_OVER_ERROR * 1b13"))),
    ("ln_near_one: log2_slope << 14, in both", "ln_near_one.gappa",
     both(APPROXIMATE, "ln_near_one", ("mul_high(log2_slope << 15, LN2)", "mul_high(log2_slope << 14, LN2)"),
          ("floor(log2_slope * 1b15 * LN2", "floor(log2_slope * 1b14 * LN2"))),
    ("ln_by_log2: the error LOG_ERROR >> 5, in both", "ln_by_log2.gappa",
     both(APPROXIMATE, "ln_by_log2", ("LOG_ERROR >> 4", "LOG_ERROR >> 5"), ("floor(LOG_ERROR * 1b-4)", "floor(LOG_ERROR * 1b-5)"))),
    ("log_odds near unknown: the sum of slopes << 13, in both", "magnitude_near_unknown.gappa",
     both(LOG_ODDS, "magnitude_near_unknown", ("mul_high((above + below) << 14, LN2)", "mul_high((above + below) << 13, LN2)"),
          ("floor((above + below) * 1b14 * LN2", "floor((above + below) * 1b13 * LN2"))),
    ("log_odds near unknown: the error LOG_1P_OVER_ERROR << 13, in both", "magnitude_near_unknown.gappa",
     both(LOG_ODDS, "magnitude_near_unknown", ("LOG_1P_OVER_ERROR << 14", "LOG_1P_OVER_ERROR << 13"),
          ("LOG_1P_OVER_ERROR * 1b14", "LOG_1P_OVER_ERROR * 1b13"))),
    ("log_odds by two logarithms: the error LOG_ERROR, in both", "magnitude_with_two_logarithms.gappa",
     [(file, "2 * LOG_ERROR", "1 * LOG_ERROR") for file in (LOG_ODDS, "proofs/magnitude_with_two_logarithms.gappa")]),
    ("log_odds of a small occupancy: twice q times its slope, in both", "magnitude_with_small_occupancy.gappa",
     both(LOG_ODDS, "magnitude_with_small_occupancy", ("u128::from(m) << 75, slope), n - 53);", "u128::from(m) << 75, slope), n - 54);"),
          ("two_to_minus_n * 1b53", "two_to_minus_n * 1b54"))),
    ("log_odds of a small occupancy: the error LOG_ERROR >> 8, in both", "magnitude_with_small_occupancy.gappa",
     both(LOG_ODDS, "magnitude_with_small_occupancy", ("LOG_ERROR >> 6", "LOG_ERROR >> 8"), ("floor(LOG_ERROR * 1b-6)", "floor(LOG_ERROR * 1b-8)"))),
    ("log_odds.rs alone: the logarithms added", "source",
     [(LOG_ODDS, "(minus_log2_q - minus_log2_rest) as u128", "(minus_log2_q + minus_log2_rest) as u128")]),
    ("cut: small << 73, in both", "half_square.gappa",
     both(GAUSSIAN, "half_square", ("u128::from(small) << 74", "u128::from(small) << 73"),
          ("narrow = floor(small * 1b74", "narrow = floor(small * 1b73"))),
    ("cut: both << 75, in both", "half_square.gappa",
     both(GAUSSIAN, "half_square", (") << 74", ") << 75"), ("* 1b74", "* 1b75"))),
    ("half_square: ratio >> 6, in both", "half_square.gappa",
     both(GAUSSIAN, "half_square", ("mul_high(ratio << 1, ratio << 1)", "mul_high(ratio >> 6 << 7, ratio >> 6 << 7)"),
          ("square = floor(ratio * 1b1 * (ratio * 1b1) * 1b-128);",
           "square = floor(floor(ratio * 1b-6) * 1b7 * (floor(ratio * 1b-6) * 1b7) * 1b-128);"))),
    ("half_square: ratio << 2, in both", "half_square.gappa",
     both(GAUSSIAN, "half_square", ("mul_high(ratio << 1, ratio << 1)", "mul_high(ratio << 2, ratio << 2)"),
          ("floor(ratio * 1b1 * (ratio * 1b1) * 1b-128);\n#: let exponent", "floor(ratio * 1b2 * (ratio * 1b2) * 1b-128);\n#: let exponent"))),
    ("SHORT_ERROR 14, in both", "short_gaussian.gappa",
     [(SHORT, "SHORT_ERROR: u128 = 16;", "SHORT_ERROR: u128 = 14;"),
      ("proofs/short_gaussian.gappa", "SHORT_ERROR = 16;", "SHORT_ERROR = 14;")]),
    ("short_gaussian: 1 / m of 62 bits, in both", "short_gaussian.gappa",
     both(SHORT, "short_gaussian", ("let inverse = ((1 << 116) - 1) / u128::from(m);", "let inverse = ((1 << 116) - 1) / u128::from(m) >> 2 << 2;"),
          ("inverse = floor((1b116 - 1) / m);", "inverse = floor(floor((1b116 - 1) / m) * 1b-2) * 1b2;"))),
    ("short_gaussian: g cut to 60 bits, in both", "short_gaussian.gappa",
     both(SHORT, "short_gaussian", ("let g_71 = (g >> 1) as i64;", "let g_71 = (g >> 5 << 4) as i64;"),
          ("g_71 = floor(g * 1b-1);", "g_71 = floor(g * 1b-5) * 1b4;"))),
    ("short_gaussian.rs alone: half of SHORT_ERROR", "source",
     [(SHORT, "around(y, SHORT_ERROR, ", "around(y, SHORT_ERROR / 2, ")]),
    ("gaussian.rs alone: t^2 instead of t^2 / 2", "source", [(GAUSSIAN, "2 * e + 129", "2 * e + 130")]),
    ("gaussian.rs alone: half of EXP_ERROR", "source", [(GAUSSIAN, "around(y, EXP_ERROR, ", "around(y, EXP_ERROR / 2, ")]),
    ("constants.sollya: Q of degree 5 instead of 6", "constants.sollya",
     [("proofs/constants.sollya", "  q_series, 6, 63,", "  q_series, 5, 63,")]),
    ("constants.sollya: no result of supnorm", "constants.sollya",
     [("proofs/constants.sollya", "  e = sup(supnorm(p, f, domain, absolute, 2^(-20)));", "  e = error;")]),
    ("constants.sollya: the bound on V's error 2^-67", "constants.sollya",
     [("proofs/constants.sollya", "[0; 2^(-8)], -66.3);", "[0; 2^(-8)], -67);")]),
    ("constants.rs: a digit of the exponential's table", "constants.sollya",
     [("src/rounded/constants.rs", "168308424877071660585620368034156803842", "168308424877071660585620368034156803843")]),
    ("constants.rs and scripts: a digit of Q", "constants.sollya",
     [(file, "2661302619267600505", "2661302619267600507")
      for file in ("src/rounded/constants.rs", "proofs/log2.gappa", "proofs/log2_1p_over.gappa")]),
    ("fixed.rs alone: log2_1p >> 13", "source", [(FIXED, "((z * z_q) >> 8)) >> 14", "((z * z_q) >> 8)) >> 13")]),
    ("fixed.rs alone: LOG_ERROR halved", "source", [(FIXED, "LOG_ERROR: u128 = 1 << 43", "LOG_ERROR: u128 = 1 << 42")]),
    ("approximate.rs alone: with_large_odds up to k = 8", "source", [(APPROXIMATE, "if k < 8 {", "if k < 9 {")]),
    ("round.rs alone: the width is the error", "source",
     [("src/rounded/round.rs", "width: 2 * error,", "width: error,")]),
    ("log2.gappa alone: the last shift 15", "source", [("proofs/log2.gappa", "1b-8)) * 1b-14);", "1b-8)) * 1b-15);")]),
    ("log2.gappa alone: a smaller error of Q assumed", "source", [("proofs/log2.gappa", "<= 0.43528 # LOG_Q", "<= 0.3 # LOG_Q")]),
    ("with_two_logarithms.gappa alone: half of LOG_ERROR assumed", "source",
     [("proofs/with_two_logarithms.gappa", "exact_minus_log2_q| <= 1b43", "exact_minus_log2_q| <= 1b42")]),
    ("exp_neg.gappa alone: t's error not proved", "source",
     [("proofs/exp_neg.gappa", "    (exact_l - l in [0, 1] -> |t - exact_t| <= 2) /\\\n", "")]),
    ("closed_form/tables.rs: the last bit of a coefficient", "limit_certify.py",
     [("src/limit/closed_form/tables.rs", "34790286437749903", "34790286437749904")]),
    ("limit_certify.py: the polynomials within 2^-68", "limit_certify.py",
     [("proofs/limit_certify.py", "ERROR, DERIVATIVE = arb(2) ** -67", "ERROR, DERIVATIVE = arb(2) ** -68")]),
    ("lanes: ERROR of f64 2e-20, in both", "lanes_f64.gappa",
     kernel(DOUBLE, ("f64 = 6e-20", "f64 = 2e-20"), *[("rnd(6e-20)", "rnd(2e-20)")] * 2)),
    ("lanes: 2 b^2 for 3 b^2 in the series, in both", "lanes_f64_fused.gappa",
     kernel(DOUBLE, ("unit(3.0, 48.0)", "unit(2.0, 48.0)"), *[("bb * unit_3_48", "bb * unit_2_48")] * 2)
     + [(script, "\nunit_3_48 = rnd(wide(wide(3 /", "\nunit_2_48 = rnd(wide(wide(2 /") for script in SCRIPTS[DOUBLE]]),
    ("lanes: y^5 left out, in both", "lanes_f64.gappa",
     kernel(DOUBLE, ("fused(yy, fused(yy, e5, e3), e1)", "fused(yy, e3, e1)"),
            ("odd = rnd(rnd(yy * rnd(rnd(yy * e5) + e3)) + e1);", "odd = rnd(rnd(yy * e3) + e1);"),
            ("odd = rnd(yy * rnd(yy * e5 + e3) + e1);", "odd = rnd(yy * e3 + e1);"))),
    ("lanes: y by the slope, in both", "lanes_f64_fused.gappa",
     kernel(DOUBLE, ("let y = h * inverse;", "let y = h * slope;"), *[("y = rnd(h * inverse);", "y = rnd(h * slope);")] * 2)),
    ("lanes: the rest of the slope's product not negative, in both", "lanes_f64_fused.gappa",
     shared(("f64::fused(slope, h, -first)", "f64::fused(slope, h, first)"),
            fused=("rnd(slope * h - first);", "rnd(slope * h + first);"))),
    ("lanes: the slope not split, in both", "lanes_f64.gappa",
     shared(("(slope.head() * h, ", "(slope * h, "), ("first = rnd(cut(slope) * h);", "first = rnd(slope * h);"))),
    ("lanes: what the first sum loses, of slope's rest, in both", "lanes_f64.gappa",
     shared(("let lost = (value - head) + first;", "let lost = (value - head) + second;"),
            *[("lost = rnd(rnd(value - head) + first);", "lost = rnd(rnd(value - head) + second);")] * 2)),
    ("lanes: the value's rest left out, in both", "lanes_f64_fused.gappa",
     kernel(DOUBLE, ("products + (lost + value_low)", "products + (lost + second)"),
            *[("tail = rnd(products + rnd(lost + value_low));", "tail = rnd(products + rnd(lost + second));")] * 2)),
    ("lanes: the bound added on both sides, in both", "lanes_f64.gappa",
     kernel(DOUBLE, ("(head, -ERROR, tail)", "(head, ERROR, tail)"),
            ("below = rnd(rnd(head * -ERROR) + tail);", "below = rnd(rnd(head * ERROR) + tail);"),
            ("below = rnd(head * -ERROR + tail);", "below = rnd(head * ERROR + tail);"))),
    ("lanes: 1 - V from above on both sides, in both", "lanes_f64_fused.gappa",
     shared(("let lower = rest - (above + tiny);", "let lower = rest - (below + tiny);"),
            *[("lower = rnd(rest - rnd(above + tiny));", "lower = rnd(rest - rnd(below + tiny));")] * 2)),
    ("lanes: what 1 - V loses, without V, in both", "lanes_f64.gappa",
     shared(("let rest = (1.0 - complement) - head;", "let rest = 1.0 - complement;"),
            *[("rest = rnd(rnd(1 - complement) - head);", "rest = rnd(1 - complement);")] * 2)),
    ("lanes in f32: ERROR 4e-12, in both", "lanes_f32.gappa",
     kernel(SINGLE, ("f64 = 8e-12", "f64 = 4e-12"), *[("wide(8e-12)", "wide(4e-12)")] * 2)),
    ("lanes in f32: b of the other sign near 1/2, in both", "lanes_f32_fused.gappa",
     kernel(SINGLE, ("(f32::HALF - square, -c)", "(f32::HALF - square, c)"), *[("\nb_near = -c;", "\nb_near = c;")] * 2)),
    ("lanes in f32: y^2 left out, in both", "lanes_f32.gappa",
     kernel(SINGLE, ("fused(y * y, even, unit(1.0, 2.0))", "unit(1.0, 2.0)"),
            ("rnd(rnd(rnd(y * y) * even) + unit_1_2)", "unit_1_2"), ("rnd(rnd(y * y) * even + unit_1_2)", "unit_1_2"))),
    ("lanes in f32: the rest of the series left out, in both", "lanes_f32_fused.gappa",
     kernel(SINGLE, ("first + f64::from(rest)", "first"), *[("v = wide(first + rest);", "v = first;")] * 2)),
    ("lanes in f32: the bound added on both sides, in both", "lanes_f32.gappa",
     kernel(SINGLE, ("((v * less) as f32, (v * more) as f32)", "((v * more) as f32, (v * more) as f32)"),
            *[("lower = wide(v * less);", "lower = wide(v * more);")] * 2)),
    ("lanes in f32: the margin of 1 - V without its roundings, in both", "lanes_f32_fused.gappa",
     kernel(SINGLE, ("let margin = fused::<f64, FUSED>(v, ERROR, f64::EPSILON);", "let margin = v * ERROR;"),
            ("margin = wide(wide(v * ERROR) + EPSILON);", "margin = wide(v * ERROR);"),
            ("margin = wide(v * ERROR + EPSILON);", "margin = wide(v * ERROR);"))),
    ("lanes: a sum's low origin at the end of its binade, in both", "sum_f32.gappa",
     [(file, "(Self::high_origin() + Self::high_origin()) *", "(Self::high_origin() + T::one()) *")
      for file in ("src/rounded/lanes/sum.rs", "proofs/sum_f32.gappa", "proofs/sum_f64.gappa")]
     + [(f"proofs/{script}.gappa", "rnd(rnd(high_origin + high_origin) *", "rnd(rnd(high_origin + 1) *")
        for script in ("sum_f32", "sum_f64")]),
    ("lanes/double.rs alone: the value's rest subtracted", "source",
     [(DOUBLE, "products + (lost + value_low)", "products + (lost - value_low)")]),
    ("lanes/double.rs alone: (10.0, 480.0) made (11.0, 480.0)", "source", [(DOUBLE, "unit(10.0, 480.0)", "unit(11.0, 480.0)")]),
    ("lanes/double.rs alone: a smaller ERROR", "source", [(DOUBLE, "f64 = 6e-20", "f64 = 5e-20")]),
    ("lanes/single.rs alone: the curvature of unknown's other side", "source",
     [(SINGLE, "(f32::HALF - square, -c)", "(f32::HALF + square, -c)")]),
    ("lanes_f64.gappa alone: a smaller error of the rows assumed", "source",
     [("proofs/lanes_f64.gappa", "value_low -/ exact_value| <= 1b-72", "value_low -/ exact_value| <= 1b-73")]),
    ("lanes_f32.gappa alone: rounded in f64", "source", [("proofs/lanes_f32.gappa", "@rnd = float<ieee_32,", "@rnd = float<ieee_64,")]),
    ("lanes_f32.gappa alone: 1 - V of no value", "source",
     [("proofs/lanes_f32.gappa", "complement_upper - (1 - exact) >= 0 /\\ # of near, entropy", "complement_upper - (1 - exact) >= 0 /\\ # of occupancy")]),
    ("lanes_f64_fused.gappa alone: a product not rounded", "source",
     [("proofs/lanes_f64_fused.gappa", "y = rnd(h * inverse);", "y = h * inverse;")]),
    ("lanes.sollya: a coefficient 1/41", "lanes_f64.gappa",
     [("proofs/lanes.sollya", "-x * (1 + x^2)/40", "-x * (1 + x^2)/41")]),
    ("lanes of log-odds: ERROR of f64 7e-20, in both", "log_odds_f64.gappa",
     kernel(LOG_ODDS_DOUBLE, ("1.2e-19; // ", "7e-20; // "), ("rnd(1.2e-19)", "rnd(7e-20)"), ("rnd(1.2e-19)", "rnd(7e-20)"))),
    ("lanes of log-odds: ERROR of f32 5e-12, in both", "log_odds_f32.gappa",
     kernel(LOG_ODDS_SINGLE, ("6e-12; // ", "5e-12; // "), ("rnd(6e-12)", "rnd(5e-12)"), ("rnd(6e-12)", "rnd(5e-12)"))),
    ("lanes of log-odds: the value's rest left out, in both", "log_odds_f64_fused.gappa",
     kernel(LOG_ODDS_DOUBLE, ("products + (lost + value_low)", "products + (lost + second)"),
                 *[("tail = rnd(products + rnd(lost + value_low));", "tail = rnd(products + rnd(lost + second));")] * 2)),
    ("lanes of log-odds: a_6 h for a_7 h, in both", "log_odds_f64.gappa",
     kernel(LOG_ODDS_DOUBLE, ("fused(h, a7, a6)", "fused(h, a6, a6)"), ("rnd(rnd(h * a7) + a6)", "rnd(rnd(h * a6) + a6)"),
                 ("rnd(h * a7 + a6)", "rnd(h * a6 + a6)"))),
    ("lanes of log-odds: the numerator of 2^r as its denominator, in both", "log_odds_f32_fused.gappa",
     kernel(LOG_ODDS_SINGLE, ("let over = fused(r, odd, even);", "let over = fused(-r, odd, even);"),
                 ("over = rnd(rnd(r * odd) + even);", "over = rnd(rnd(-r * odd) + even);"),
                 ("over = rnd(r * odd + even);", "over = rnd(-r * odd + even);"))),
    ("lanes of log-odds: the entropy over l in place of that over q, in both", "log_odds_f32.gappa",
     kernel(LOG_ODDS_SINGLE, ("let entropy = q * ", "let entropy = a * "), *[("entropy = rnd(q * ", "entropy = rnd(a * ")] * 2)),
    ("lanes far out: ERROR 9e-21, in both", "far_f64_fused.gappa",
     both(FAR, "far_f64_fused", ("1.1e-20; // ", "9e-21; // "), ("rnd(1.1e-20)", "rnd(9e-21)"))),
    ("lanes far out: the rest of the step left out, in both", "far_f64_fused.gappa",
     both(FAR, "far_f64_fused", ("let reduced = r - r_low;", "let reduced = r;"), ("reduced = rnd(r - r_low);", "reduced = r;"))),
    ("lanes far out: 1 / 7 for 1 / 6, in both", "far_f64_fused.gappa",
     both(FAR, "far_f64_fused", ("-1.0 / 6.0", "-1.0 / 7.0"), ("rnd(-1 / 6)", "rnd(-1 / 7)"))),
    ("lanes far out: the product's rest times 1, in both", "far_f64_fused.gappa",
     both(FAR, "far_f64_fused", ("let low = fused(product_low, -r, product_low);", "let low = product_low;"),
          ("low = rnd(product_low * -r + product_low);", "low = product_low;"))),
    ("lanes/log_odds/far.rs alone: the rest of ln 2 over 128", "source", [(FAR, "LN_2_LOW / 256.0", "LN_2_LOW / 128.0")]),
    ("lanes/log_odds/double.rs alone: a_7 for a_6", "source", [(LOG_ODDS_DOUBLE, "fused(h, a7, a6)", "fused(h, a6, a7)")]),
    ("lanes/log_odds/single.rs alone: a smaller ERROR", "source", [(LOG_ODDS_SINGLE, "f64 = 6e-12", "f64 = 5.9e-12")]),
    ("lanes/log_odds/polynomials.rs alone: a digit", "source",
     [("src/rounded/lanes/log_odds/polynomials.rs", "0.34657359027995049416404071", "0.34657359027995049416404072")]),
    ("log_odds_f64.gappa alone: a smaller error of the rows' coefficients assumed", "source",
     [("proofs/log_odds_f64.gappa", "|ratio_2| <= 1b-66", "|ratio_2| <= 1b-67")]),
    ("log_odds_f32.gappa alone: a smaller error of a polynomial assumed", "source",
     [("proofs/log_odds_f32.gappa", "<= 8.358e-12", "<= 8.3e-12")]),
    ("log_odds_regions.sollya of lanes: t' = 2w / 3", "log_odds_f64.gappa",
     [("proofs/log_odds_regions.sollya", "(1 - x^2) / 2 * diff", "(1 - x^2) / 3 * diff")]),
    ("rows.sollya: the error of values 2^-54", "rows.sollya",
     [("proofs/rows.sollya", 'certify("value", 2^(-53));', 'certify("value", 2^(-54));')]),
    ("rows: the last bit of one value", "rows.sollya", [("rows", "6548180308934448 * 2^(-117)", "6548180308934449 * 2^(-117)")]),
]


def build_test():
    """The path of the compiled tests/proofs."""
    command = ["cargo", "test", "--test", "proofs", "--no-run", "--message-format=json"]
    output = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    messages = [json.loads(line) for line in output.splitlines()]
    return next(m["executable"] for m in messages if m.get("executable") and m["target"]["name"] == "proofs")


def failures(edits, test, rows, regions):
    """The names that proofs/check.sh calls FAILED in a copy with these edits; only those that read an edited file."""
    readers = {Path(file).name for file, _, _ in edits if file.endswith(".gappa")} | {"source"}
    if any(file == "proofs/lanes.sollya" for file, _, _ in edits):
        readers.add("lanes_f64.gappa")
    if any(file == "proofs/log_odds_regions.sollya" for file, _, _ in edits):
        readers.add("log_odds_f64.gappa")
    if any("rows" in file for file, _, _ in edits):
        readers.add("rows.sollya")
    if any("constants" in file for file, _, _ in edits):
        readers.add("constants.sollya")
    if any("limit" in file for file, _, _ in edits):
        readers.add("limit_certify.py")
    with tempfile.TemporaryDirectory() as folder:
        for part in ("src/rounded", "src/limit", "proofs"):
            shutil.copytree(ROOT / part, Path(folder) / part)
        shutil.copy(rows, Path(folder) / "rows")
        for file, old, new in edits:
            path = Path(folder) / file
            text = path.read_text()
            if old not in text:
                sys.exit(f"proofs/mutate.py: {file} no longer contains: {old}")
            path.write_text(text.replace(old, new))
        environment = {**os.environ, "SOURCE_TEST": test, "ROWS": f"{folder}/rows"}
        if not any(Path(file).name in REGIONS for file, _, _ in edits):
            environment["REGIONS"] = regions
        command = [Path(folder) / "proofs/check.sh", *(sorted(readers) if edits else [])]
        result = subprocess.run(command, env=environment, capture_output=True, text=True)
        return [line.removeprefix("FAILED ") for line in result.stdout.splitlines() if line.startswith("FAILED ")]


def main():
    """Makes the changes whose names contain the argument, or all."""
    chosen = [mutation for mutation in MUTATIONS if all(part in mutation[0] for part in sys.argv[1:])]
    if not chosen or {"-h", "--help"} & set(sys.argv[1:]):
        sys.exit("usage: proofs/mutate.py [WORD ...]: makes the changes whose names contain every word, or all changes")
    test = build_test()
    with tempfile.TemporaryDirectory() as folder:
        # What every copy reads, made once.
        rows, regions = f"{folder}/rows", f"{folder}/regions"
        with open(rows, "w") as file:
            command = ["cargo", "test", "--quiet", "--lib", "lanes::tests::rows_for_the_proof", "--", "--ignored", "--nocapture"]
            subprocess.run(command, cwd=ROOT, check=True, stdout=file, stderr=subprocess.DEVNULL)
        with open(regions, "w") as file:
            for name in REGIONS:
                subprocess.run(["sollya", ROOT / "proofs" / name], stdin=subprocess.DEVNULL, stdout=file)
                file.flush()
        sys.exit(run(chosen, lambda edits: failures(edits, test, rows, regions)))


def run(mutations, failures):
    """Prints the table; the status, 1 if a change survives."""
    survivors = failures([]) if len(mutations) == len(MUTATIONS) else []
    if survivors:
        sys.exit(f"proofs/mutate.py: fails before any change: {survivors}")
    with ThreadPoolExecutor(2) as pool:
        found = pool.map(lambda mutation: failures(mutation[2]), mutations)
        noticed = 0
        print("| change | fails |\n|---|---|")
        for (change, expected, _), failed in zip(mutations, found):
            # Changed in both, the script still speaks of the source: it is the proof that fails.
            proper = expected in failed and not (change.endswith("in both") and "source" in failed)
            noticed += proper
            print(f"| {change} | {', '.join(failed) or 'nothing'}{'' if proper else ' (expected ' + expected + ')'} |")
    print(f"\n{noticed} of {len(mutations)} changes noticed")
    return noticed != len(mutations)


if __name__ == "__main__":
    main()
