//! Finds the integers `t` of a block for which a polynomial `G(t)` lies nearest to an integer; see README.md.
//!
//! Lefèvre's method: on an interval short enough, `G` is a line up to a known error, and the multiples of its slope that fall
//! into a window modulo 1 are found by Euclid's algorithm, without looking at the others.
//!
//! `near_ties BITS` reads blocks, one a line, of 2^30 integers: eight coefficients of `G(2^30 s)`, scale 64, lowest first. For each
//! `t` with `G(t)` within `2^-BITS` of an integer it writes the number of the block and `t`.

use std::error::Error;
use std::io::{BufRead, Write, stdin, stdout};

const BLOCK: u32 = 30;
const DEGREE: usize = 7;

/// Positions modulo 1 have scale 63.
const WHOLE: u64 = 1 << 63;

/// The least `x` with `b x mod m` in `[low, high]`, for `b < m`, `low <= high < m`.
fn first(b: u64, m: u64, low: u64, high: u64) -> Option<u64> {
    if low == 0 {
        return Some(0);
    }
    if b == 0 {
        return None;
    }
    let (b, low, high) = if b > m / 2 { (m - b, m - high, m - low) } else { (b, low, high) };
    let steps = low.div_ceil(b);
    if steps * b <= high {
        return Some(steps);
    }
    // The window lies between two multiples of b: b x - m y is in it, so m y mod b is in the mirrored window.
    let y = first(m % b, b, b - high % b, b - low % b)?;
    let x = (u128::from(low) + u128::from(m) * u128::from(y)).div_ceil(u128::from(b));
    u64::try_from(x).ok()
}

/// `a + b t + c t^2` modulo 1 near an interval's start, scale 64; `c` of scale 124.
struct Parabola {
    a: u64,
    b: u64,
    c: i128,
}

impl Parabola {
    /// About `t0`; the error, some units of `2^-64` in `a` and `b`, is far below every distance of interest.
    fn about(coefficients: &[i128; DEGREE + 1], t0: i128) -> Self {
        let [a, b, c] = [0, 1, 2].map(|order| {
            (order..=DEGREE).rev().fold(0, |sum: i128, k| {
                let binomial = (0..order).map(|j| k - j).product::<usize>() / (1..=order).product::<usize>();
                ((sum * t0) >> BLOCK) + coefficients[k] * binomial as i128
            })
        });
        Self { a: a as u64, b: (b >> BLOCK) as u64, c }
    }

    /// Calls `hit` for each `t < 2^length` at which the parabola is within `2^-bits` of an integer.
    fn near_integers(&self, length: u32, bits: u32, mut hit: impl FnMut(u64)) {
        // The line that is nearest: off by c 4^length / 8 at most, scale 63.
        let bend = self.c << (2 * length);
        let error = (bend.unsigned_abs() >> 64) as u64 + (WHOLE >> bits) + 1;
        let b = self.b.wrapping_add((self.c << length >> 60) as u64) >> 1;
        let mut a = self.a.wrapping_sub((bend >> 63) as u64) >> 1;
        let mut t = 0;
        loop {
            let low = WHOLE.wrapping_sub(error + a) % WHOLE;
            let high = (WHOLE + error - a) % WHOLE;
            let Some(step) = (if low > high { Some(0) } else { first(b, WHOLE, low, high) }) else { return };
            t += step;
            if t >> length != 0 {
                return;
            }
            let square = ((self.c * i128::from(t * t)) >> 60) as u64;
            let position = self.a.wrapping_add(self.b.wrapping_mul(t)).wrapping_add(square) as i64;
            if position.unsigned_abs() < 1 << (64 - bits) {
                hit(t);
            }
            a = a.wrapping_add(b.wrapping_mul(step + 1)) % WHOLE;
            t += 1;
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let bits: u32 = std::env::args().nth(1).ok_or("usage: near_ties BITS")?.parse()?;
    let mut output = stdout().lock();
    for (number, line) in stdin().lock().lines().enumerate() {
        let coefficients: Vec<i128> = line?.split(' ').map(str::parse).collect::<Result<_, _>>()?;
        let coefficients: [i128; DEGREE + 1] = coefficients.try_into().map_err(|_| "eight coefficients")?;
        // About half a false hit an interval: c length^3 = 2, with c = coefficient 2^(-64-60).
        let bend = 128 - coefficients[2].unsigned_abs().max(1).leading_zeros();
        let length = ((125 - bend) / 3).min(24);
        for t0 in (0..1 << BLOCK).step_by(1 << length) {
            let mut found = Vec::new();
            Parabola::about(&coefficients, t0).near_integers(length, bits, |t| found.push(t));
            for t in found {
                writeln!(output, "{number} {}", t0 + i128::from(t))?;
            }
        }
    }
    Ok(())
}
