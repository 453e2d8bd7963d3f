//! Logs of particle filters: each is read or refused, and what is read keeps its promises.

use super::formats::kept;
use mean_information_files::particles::FilterLog;
use mean_information_files::scans::ScanOptions;

/// The most steps and particles that all are followed of.
const MAX_FOLLOWED: usize = 1 << 6;

/// Reads a log: weights lie from 0 to 1, the greatest is 1, times ascend, and every particle has an ancestor at each step.
pub fn filter_log(bytes: &[u8]) {
    let Some(log) = kept(FilterLog::read(bytes, &ScanOptions::default())) else { return };
    assert!(log.warnings.iter().all(|warning| !warning.to_string().is_empty()));
    let particles = log.particles();
    assert!(particles > 0 && 8 * particles * log.steps.len() <= bytes.len());
    assert!(log.steps.is_sorted_by(|before, after| before.scan.time() < after.scan.time()));
    for (step, weights) in log.steps.iter().zip((0..).map(|step| log.weights(step))) {
        assert_eq!([step.poses.len(), step.log_weights.len(), weights.len()], [particles; 3]);
        assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)) && weights.contains(&1.0));
        let effective = step.effective(log.gain);
        assert!(effective > 0.999 && effective < 1.001 * particles as f64, "{effective}");
    }
    let last = log.steps.len() - 1;
    for particle in 0..particles.min(MAX_FOLLOWED) {
        let lineage = log.lineage(last.min(MAX_FOLLOWED), particle);
        assert!(lineage.iter().all(|&ancestor| ancestor < particles));
        assert_eq!(lineage.last(), Some(&particle));
        assert_eq!(log.trajectory(last.min(MAX_FOLLOWED), particle).count(), lineage.len());
    }
}
