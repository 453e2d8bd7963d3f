//! Logs of a particle filter: GMapping's, and the ways to break one.

use mean_information_files::particles::FilterLog;
use mean_information_files::scans::ScanOptions;
use mean_information_files::{ErrorKind, Place, Warning, read_filter_log};
use mean_information_test_support::formats::{Folder, shared_data as data};
use std::collections::BTreeSet;

fn scan(time: f64) -> String {
    format!("LASER_READING 180{} 0.5 0.25 -0.5 {time}\n", " 2.5".repeat(180))
}

/// Three particles, three scans; after the second, particle 2 is continued twice, particle 0 once.
fn small() -> String {
    [
        "PARAM ogain 2\nPARAM maxrange 7.5\nODOM 0 0 0 1\nODO_UPDATE 3 0 0 0 0 0 0 0 0 0 0 0 0 1\nFRAME 1 0 0\n",
        &scan(1.5),
        "SM_UPDATE 3 0 0 0 -6 1 0 0 -9 2 0 0 -12 \n",
        &scan(2.5),
        "SM_UPDATE 3 0 1 0 -20 1 1 0 -14 2 1 0 -8 \nRESAMPLE 3 2 0 2 \n",
        &scan(3.5),
        "SM_UPDATE 3 0 2 0 -3 1 2 0 -3 2 2 0 -3 \nNEFF 3.000000\n",
    ]
    .concat()
}

fn read(text: &str) -> FilterLog {
    FilterLog::read(text.as_bytes(), &ScanOptions::default()).unwrap()
}

#[test]
fn a_log_has_its_particles_weights_and_ancestry() {
    let folder = Folder::new();
    let path = folder.write("log.gfs", small());
    let log = read_filter_log(&path, &ScanOptions::default()).unwrap();
    assert_eq!((log.steps.len(), log.particles(), log.gain, &log.files), (3, 3, 2.0, &vec![path]));
    assert_eq!(log.warnings, []);
    let step = &log.steps[0];
    assert_eq!((step.scan.time(), step.scan.ranges().len(), step.scan.limits()), (1.5, 180, [0.0, 7.5]));
    assert_eq!(step.scan.odometry().unwrap().position(), [0.5, 0.25]);
    // exp(0), exp(-3/6), exp(-6/6)
    let expected = [1.0, libm::exp(-0.5), libm::exp(-1.0)];
    for (found, expected) in log.weights(0).iter().zip(expected) {
        assert!((found - expected).abs() < 1e-15);
    }
    let [sum, squares] = [expected.iter().sum::<f64>(), expected.iter().map(|w| w * w).sum()];
    assert!((step.effective(2.0) - sum * sum / squares).abs() < 1e-14);
    assert_eq!(log.weights(2), [1.0; 3]);
    // Particle k of the last step continues 2, 0 and 2.
    let lineages: Vec<_> = (0..3).map(|particle| log.lineage(2, particle)).collect();
    assert_eq!(lineages, [vec![2, 2, 0], vec![0, 0, 1], vec![2, 2, 2]]);
    let x: Vec<_> = log.trajectory(2, 1).map(|pose| pose.position()).collect();
    assert_eq!(x, [[0.0, 0.0], [0.0, 1.0], [1.0, 2.0]]);
    assert_eq!(log.trajectory(1, 1).count(), 2);
}

#[test]
fn what_a_log_leaves_open_is_said() {
    let cut = small() + &scan(4.5) + "SM_UPDATE 3 0 3 0 -3 1";
    let log = read(&cut);
    assert_eq!(log.steps.len(), 3);
    let cut = [Warning::CutInLine { line: 15 }, Warning::ScanWithoutParticles { line: 14 }];
    assert_eq!(log.warnings, cut);
    let other = small().replace("NEFF 3.000000", "NEFF 2.900000") + "MARK here\n# a comment\n";
    let log = read(&other);
    let words = vec![("MARK".to_owned(), 1)];
    let said = [
        Warning::LinesNotUnderstood { lines: 1, words },
        Warning::OtherWeightsStated { steps: 1, gain: 2.0 },
    ];
    assert_eq!(log.warnings, said);
    let log = read(&small().replace("1 0 0 -9", "1 0 0 -9999"));
    assert_eq!(log.weights(0)[1], 0.0);
    assert_eq!(log.warnings, [Warning::WeightsUnderflow { weights: 1 }]);
    assert_eq!(read(&small().replace("PARAM ogain 2\n", "").replace("NEFF", "#")).gain, FilterLog::GAIN);
}

#[test]
fn what_cannot_be_meant_is_refused_with_its_line() {
    use ErrorKind::{Format, OutOfRange};
    let cases = [
        (
            "RESAMPLE 3 2 0 2",
            "RESAMPLE 3 2 0 3",
            OutOfRange,
            10,
            "resampled particle in line 10 is 3, allowed is a particle, from 0 to 2",
        ),
        ("RESAMPLE 3 2 0 2", "RESAMPLE 2 1 0", OutOfRange, 10, "the number of particles in line 10 is 2"),
        ("RESAMPLE 3 2 0 2", "RESAMPLE 3 2 0", Format, 10, "line 10 ends before a resampled particle"),
        ("RESAMPLE 3 2 0 2", "RESAMPLE 3 2 0 2 1", Format, 10, "goes on after 3 particles"),
        ("RESAMPLE 3 2 0 2", "RESAMPLE 3 2 0 2\nRESAMPLE 3 2 0 2", Format, 11, "resamples a second time"),
        (
            "SM_UPDATE 3 0 0 0 -6",
            "SM_UPDATE 2 0 0 0 -6",
            OutOfRange,
            7,
            "the number of particles in line 7 is 2",
        ),
        ("ODO_UPDATE 3", "ODO_UPDATE 0", OutOfRange, 4, "the number of particles in line 4 is 0"),
        ("0 0 0 -6", "0 0 0 nan", OutOfRange, 7, "the logarithm of a weight in line 7 is NaN"),
        ("0 0 0 -6", "0 0 0 -inf", OutOfRange, 7, "the logarithm of a weight in line 7 is -inf"),
        ("0 0 0 -6", "0 x 0 -6", Format, 7, "y in line 7 is `x`"),
        ("0.25 -0.5 1.5", "0.25 -0.5", Format, 6, "line 6 ends before time"),
        ("0.25 -0.5 2.5", "0.25 -0.5 1.5", OutOfRange, 8, "times ascend"),
        ("LASER_READING 180 2.5", "LASER_READING 179", OutOfRange, 6, "the number of beams is 179"),
        ("FRAME 1 0 0", "SM_UPDATE 3 0 0 0 -6 1 0 0 -9 2 0 0 -12", Format, 5, "without a LASER_READING"),
        ("FRAME 1 0 0", "RESAMPLE 3 2 0 2", Format, 5, "comes before the SM_UPDATE"),
        ("FRAME 1 0 0", "NEFF 2", Format, 5, "comes before the SM_UPDATE"),
        ("RESAMPLE 3 2 0 2 \n", &*scan(3.0), Format, 11, "has a scan, but that of line 10 has no SM_UPDATE"),
        ("PARAM ogain 2", "PARAM ogain 0", OutOfRange, 1, "is 0"),
    ];
    for (from, to, kind, line, words) in cases {
        assert!(small().contains(from), "{from}");
        let text = small().replacen(from, to, 1);
        let refused = FilterLog::read(text.as_bytes(), &ScanOptions::default()).unwrap_err();
        assert!(refused.to_string().contains(words), "{refused}: {words}");
        assert_eq!((refused.kind(), refused.place()), (kind, Some(&Place::Line(line))), "{refused}");
    }
    let refused = FilterLog::read(&b"PARAM ogain 3\n"[..], &ScanOptions::default()).unwrap_err();
    assert!(refused.to_string().starts_with("holds no scan with its particles"), "{refused}");
}

/// Cut at any byte of its last lines a log is read, and what is read of it is what was written.
#[test]
fn a_cut_log_is_read_to_its_last_whole_line() {
    let last = scan(4.5) + "SM_UPDATE 3 0 3 0 -3 1 3 0 -13 2 3 0 -23 \nNEFF 1.372145\nRESAMPLE 3 0 0 12 \n";
    // Twelve particles could be meant of fewer.
    let last = last.replace(" 12 ", " 2 ");
    let whole = read(&(small() + &last));
    for cut in 0..last.len() {
        let log = read(&(small() + &last[..cut]));
        let (known, new) = (&whole.steps[..log.steps.len()], &log.steps);
        assert!(new.len() >= 3, "{cut}");
        for (known, new) in known.iter().zip(new) {
            assert_eq!(
                (&known.scan, &known.poses, &known.log_weights),
                (&new.scan, &new.poses, &new.log_weights),
                "{cut}"
            );
            assert!(
                new.stated_effective.is_none() || new.stated_effective == known.stated_effective,
                "{cut}"
            );
            assert!(new.resampled.is_none() || new.resampled == known.resampled, "{cut}");
        }
        let is_whole = last[..cut].ends_with('\n') || cut == 0;
        let said = log.warnings.iter().any(|warning| matches!(warning, Warning::CutInLine { .. }));
        // But for the space that ends a line.
        assert!(said != is_whole || last[cut..].starts_with('\n'), "{cut}: {:?}", log.warnings);
    }
    // A number that is cut to one that cannot be meant: of 30 particles 3, an earlier time.
    for cut in ["ODO_UPDATE 1", "LASER_READING 18", "RESAMPLE 3 2 0 4"] {
        assert_eq!(read(&(small() + cut)).warnings, [Warning::CutInLine { line: 14 }], "{cut}");
    }
}

#[test]
fn lines_that_gmapping_reads_are_known() {
    let more = "SIMULATOR_POS 1 2 0.5 3\nENTROPY 1 2 3 4\nCOMMENT a b\n#COMMENT c\n";
    assert_eq!(read(&(more.to_owned() + &small())).warnings, []);
}

#[test]
fn a_gain_that_is_not_stated_is_said_unless_the_log_confirms_it() {
    let bare = small().replace("PARAM ogain 2\n", "");
    assert_eq!(read(&bare).warnings, []); // three equal weights count as 3 by any gain
    let open = read(&bare.replace("NEFF", "#"));
    assert_eq!(open.warnings, [Warning::GainNotStated { gain: 3.0 }]);
    assert!(open.warnings[0].to_string().contains("by a gain of 3"), "{}", open.warnings[0]);
}

/// GMapping writes six decimals: of the logarithms, and of how many count.
#[test]
fn the_particles_that_count_are_the_stated_ones_within_their_decimals() {
    let stated = |neff: &str| read(&small().replace("-12 \n", &format!("-12 \nNEFF {neff}\n"))).warnings;
    // 1, exp(-1/2), exp(-1): 2.600213...
    let log = read(&small());
    let effective = log.steps[0].effective(2.0);
    assert_eq!(stated(&format!("{effective:.6}")), []);
    assert_eq!(stated(&format!("{:.6}", effective + 1e-6)), []); // what the logarithms' decimals move: 4 / (2 * 3) units times 2.6
    assert_eq!(
        stated(&format!("{:.6}", effective + 4e-6)),
        [Warning::OtherWeightsStated { steps: 1, gain: 2.0 }]
    );
}

#[test]
fn weights_are_numbers_whatever_the_gain() {
    for gain in ["1e308", "1.7e308", "5e-324", "1e-308"] {
        let far = small()
            .replace("ogain 2", &format!("ogain {gain}"))
            .replace("-6 1", "-1.7e308 1")
            .replace("-9 2", "1.7e308 2");
        let log = read(&far.replace("NEFF", "#"));
        for step in 0..3 {
            let weights = log.weights(step);
            assert!(
                weights.iter().all(|w| (0.0..=1.0).contains(w)) && weights.contains(&1.0),
                "{gain}: {weights:?}"
            );
        }
    }
}

/// GMapping's own log: what docs/expected.md says of it.
#[test]
fn gmapping_s_own_log_is_read_as_it_weighs() {
    let Some(path) = data().map(|data| data.join("slam/csail.gfs")).filter(|path| path.exists()) else {
        return println!("skipped: no csail.gfs");
    };
    let log = read_filter_log(&path, &ScanOptions::default()).unwrap();
    assert_eq!((log.steps.len(), log.particles(), log.gain), (406, 30, 3.0));
    assert_eq!(log.warnings, []);
    // The particles that count are those that the log states, to its six decimals.
    for step in &log.steps {
        let stated = step.stated_effective.unwrap();
        assert!((step.effective(log.gain) - stated).abs() < 1e-5, "{stated}");
    }
    let kept = |resampled: &Vec<usize>| resampled.iter().collect::<BTreeSet<_>>().len();
    let kept: Vec<usize> = log.steps.iter().filter_map(|step| step.resampled.as_ref()).map(kept).collect();
    let of = |count| kept.iter().filter(|&&kept| kept == count).count();
    assert_eq!((kept.len(), of(1), of(3)), (47, 1, 2));
    // The ancestors of the last particles.
    let ancestors = |at: usize| {
        let at_step = |particle| log.lineage(405, particle)[at];
        (0..30).map(at_step).collect::<BTreeSet<_>>().len()
    };
    assert_eq!([0, 204, 205, 400, 401, 404].map(ancestors), [1, 1, 2, 2, 3, 30]);
}
