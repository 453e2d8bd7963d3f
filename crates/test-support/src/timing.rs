//! The time of a call, on a machine that others use, too.

use std::hint::black_box;

/// Measures the least processor time of a call, in seconds, in about `seconds` of calls, at least five.
pub fn least_time<T>(seconds: f64, call: impl Fn() -> T) -> f64 {
    // In runs of a millisecond or more, so that the timer takes no part.
    let run = |calls: u32| {
        let start = now();
        for _ in 0..calls {
            black_box(call());
        }
        (now() - start) / f64::from(calls)
    };
    let calls = (1e-3 / run(3)).clamp(1.0, 1e6).ceil() as u32;
    let once = run(calls);
    let runs = (seconds / once / f64::from(calls)).clamp(5.0, 1e4) as u32;
    (0..runs).map(|_| run(calls)).fold(once, f64::min)
}

/// Processor time of this thread in seconds: unlike the clock, it stands still while others run.
#[cfg(unix)]
fn now() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// Time since the first call in seconds.
#[cfg(not(unix))]
fn now() -> f64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed().as_secs_f64()
}
