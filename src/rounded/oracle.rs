//! Entropy, information and occupancy to 600 bits: interval arithmetic in big integers.
//!
//! An oracle that is slow and simple, for the few inputs that `f64` leaves undecided and for the tests of the fast
//! path.

use num_bigint::BigInt;
use std::sync::LazyLock;

/// The number of fraction bits. Every `f32` is an integer in units of `2^-SCALE`.
pub(crate) const SCALE: usize = 640;

static LN_2: LazyLock<Oracle> = LazyLock::new(|| Oracle::integer(2).ln());

/// An interval: `lo <= exact value <= hi`, in units of `2^-SCALE`; not negative.
#[derive(Clone, Debug)]
pub(crate) struct Oracle {
    lo: BigInt,
    hi: BigInt,
}

impl Oracle {
    fn exact(value: BigInt) -> Self {
        Self { lo: value.clone(), hi: value }
    }

    /// Creates `m 2^e`, a multiple of `2^-SCALE`.
    pub(crate) fn dyadic(m: u64, e: i32) -> Self {
        Self::exact(BigInt::from(m) << (SCALE as i32 + e))
    }

    fn integer(n: u64) -> Self {
        Self::dyadic(n, 0)
    }

    pub(crate) fn bounds(&self) -> [&BigInt; 2] {
        [&self.lo, &self.hi]
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self { lo: &self.lo + &other.lo, hi: &self.hi + &other.hi }
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        Self { lo: &self.lo - &other.hi, hi: &self.hi - &other.lo }
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        Self { lo: (&self.lo * &other.lo) >> SCALE, hi: ((&self.hi * &other.hi) >> SCALE) + 1 }
    }

    pub(crate) fn over(&self, other: &Self) -> Self {
        Self { lo: (&self.lo << SCALE) / &other.hi, hi: (&self.hi << SCALE) / &other.lo + 1 }
    }

    /// Returns `self 2^-k`.
    fn halved(&self, k: usize) -> Self {
        Self { lo: &self.lo >> k, hi: (&self.hi >> k) + 1 }
    }

    /// Computes `ln w = 2 artanh t`, `t = (w-1) / (w+1)`, for `w` in `[1, 2]`: `t <= 1/3`.
    fn ln(&self) -> Self {
        let t = self.minus(&Self::integer(1)).over(&self.plus(&Self::integer(1)));
        let square = t.times(&t);
        let (mut power, mut sum) = (t.plus(&t), Self::integer(0));
        for n in (1..).step_by(2) {
            sum = sum.plus(&power.over(&Self::integer(n)));
            power = power.times(&square);
            if power.hi < BigInt::from(4) {
                break;
            }
        }
        // The rest is below power (1 + 1/9 + 1/81 + ...).
        sum.hi += &power.hi * 2;
        sum
    }

    /// Computes `-ln w` for `w` in `(0, 1]`.
    pub(crate) fn minus_ln(&self) -> Self {
        let k = SCALE + 1 - self.lo.bits() as usize;
        let scaled = Self { lo: &self.lo << k, hi: &self.hi << k };
        Self::integer(k as u64).times(&LN_2).minus(&scaled.ln())
    }

    /// Computes `e^-l`.
    pub(crate) fn exp_neg(&self) -> Self {
        let k = &self.lo / &LN_2.hi;
        let rest = self.minus(&Self { lo: &k * &LN_2.lo, hi: &k * &LN_2.hi });
        let (mut term, mut sum) = (Self::integer(1), Self::integer(1));
        for n in 1.. {
            term = term.times(&rest).over(&Self::integer(n));
            sum = if n % 2 == 0 { sum.plus(&term) } else { sum.minus(&term) };
            if term.hi < BigInt::from(4) {
                break;
            }
        }
        // The terms alternate and fall.
        sum.lo -= &term.hi;
        sum.hi += &term.hi;
        sum.halved(usize::try_from(k).expect("a small exponent"))
    }
}

/// Computes `H(p)` and `I(p)` for `p` in `(0, 1)`.
pub(crate) fn from_occupancy(p: &Oracle) -> [Oracle; 2] {
    let rest = Oracle::integer(1).minus(p);
    let nats = p.times(&p.minus_ln()).plus(&rest.times(&rest.minus_ln()));
    let entropy = nats.over(&LN_2);
    [entropy.clone(), Oracle::integer(1).minus(&entropy)]
}

/// Computes `H`, `I` and the occupancy at log-odds `l`, and the occupancy at `-l`, for `0 < l < 400`.
pub(crate) fn from_log_odds(l: &Oracle) -> [Oracle; 4] {
    let one = Oracle::integer(1);
    let x = l.exp_neg();
    let w = one.plus(&x);
    let smaller = x.over(&w);
    let entropy = w.ln().plus(&l.times(&smaller)).over(&LN_2);
    [entropy.clone(), one.minus(&entropy), one.minus(&smaller), smaller]
}
