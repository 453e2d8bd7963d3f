//! Particles and weights that are refused, with the reason; nothing is written.

use super::*;

#[test]
fn what_cannot_be_read_is_refused_and_nothing_written() {
    let folder = Folder::new();
    let output = folder.text_path("result.json");
    let refused = |particles: Vec<u8>, weights: Vec<u8>, more: &[&str]| {
        fs::write(folder.path("p.npy"), particles).unwrap();
        fs::write(folder.path("w.npy"), weights).unwrap();
        let [p, w] = ["p.npy", "w.npy"].map(|name| folder.text_path(name));
        let arguments = ["emmi", "--particles", &p, "--weights", &w, "--output", &output];
        let line = refusal(&[&arguments[..], more].concat());
        assert_eq!(folder.names(), ["p.npy", "w.npy"]);
        line
    };
    let stack = || npy("<f8", false, &[3, 2, 4], &doubles(&PARTICLES.concat()));
    let weights = |w: &[f64]| npy("<f8", false, &[w.len()], &doubles(w));
    let says =
        |line: String, words: &[&str]| words.iter().for_each(|word| assert!(line.contains(word), "{line}"));

    says(refused(stack(), weights(&[0.5, 0.5]), &[]), &["w.npy: has 2 weights", "p.npy has 3 particles"]);
    says(refused(stack(), weights(&[0.5, -0.5, 1.0]), &[]), &["w.npy", "weight 1 is -0.5"]);
    says(refused(stack(), weights(&[0.5, f64::NAN, 1.0]), &[]), &["w.npy", "weight 1 is NaN"]);
    says(refused(stack(), weights(&[0.0; 3]), &[]), &["w.npy", "sum of the weights is 0"]);
    says(
        refused(stack(), npy("<f8", false, &[1, 3], &doubles(&WEIGHTS)), &[]),
        &["2 dimensions (1 x 3)", "the weights"],
    );
    for (descr, bytes) in [("<f2", 2), ("|b1", 1), ("<c16", 16), ("<i16", 16), ("|i8", 8), ("", 8), ("é8", 8)]
    {
        let line = refused(stack(), npy(descr, false, &[3], &vec![1; 3 * bytes]), &[]);
        says(line, &["w.npy", "for weights are float32 (f4), float64 (f8) and integers"]);
    }
    let integers = |w: [i64; 3]| npy("<i8", false, &[3], &w.map(i64::to_le_bytes).concat());
    says(refused(stack(), integers([3, -1, 2]), &[]), &["w.npy", "weight 1 is -1"]);
    says(refused(stack(), integers([0; 3]), &[]), &["w.npy", "sum of the weights is 0"]);
    for (large, words) in [
        ((1 << 53) + 1, "weight 2 is 9007199254740993, allowed are integers up to 2^53 = 9007199254740992"),
        (i64::MIN, "weight 2 is -9223372036854775808"),
    ] {
        says(refused(stack(), integers([1 << 53, 1, large]), &[]), &["w.npy", words]);
    }
    let unsigned = npy("<u8", false, &[3], &[u64::MAX; 3].map(u64::to_le_bytes).concat());
    says(refused(stack(), unsigned, &[]), &["weight 0 is 18446744073709551615"]);
    let line = refused(stack(), weights(&WEIGHTS), &["--max-cells", "2"]);
    says(line, &["w.npy: claims 3 weights, more than the limit of 2;"]);
    says(refused(stack(), npy("<f8", false, &[4], &doubles(&WEIGHTS)), &[]), &["w.npy", "its header claims"]);

    let flat = npy("<f8", false, &[3, 8], &doubles(&PARTICLES.concat()));
    says(
        refused(flat, weights(&WEIGHTS), &[]),
        &["p.npy", "2 dimensions (3 x 8)", "particles, rows and columns"],
    );
    let short = npy("<f8", false, &[3, 2, 5], &doubles(&PARTICLES.concat()));
    says(refused(short, weights(&WEIGHTS), &[]), &["p.npy", "its header claims"]);
    says(refused(npy("<f8", false, &[0, 2, 4], &[]), weights(&[]), &[]), &["p.npy", "no particles"]);
    says(refused(npy("<f8", false, &[1 << 40, 0, 4], &[]), weights(&WEIGHTS), &[]), &["without cells"]);
    let mut bad = PARTICLES.concat();
    bad[8 + 4 + 3] = 1.5;
    let bad = npy("<f8", false, &[3, 2, 4], &doubles(&bad));
    says(refused(bad, weights(&WEIGHTS), &[]), &["p.npy", "particle 1: cell at row 1, column 3 is 1.5"]);
    says(refused(stack(), weights(&WEIGHTS), &["--encoding", "mrpt"]), &["p.npy", "mrpt needs integers"]);
    says(
        refused(stack(), weights(&WEIGHTS), &["--max-cells", "23"]),
        &["p.npy: claims 3 particles of 4 x 2 cells, together more than the limit of 23; raise it"],
    );
    for resolution in ["0", "-1"] {
        says(refused(stack(), weights(&WEIGHTS), &["--resolution", resolution]), &[resolution, "positive"]);
    }
    let huge = npy("<f8", false, &[usize::MAX, usize::MAX, 4], &[]);
    says(refused(huge, weights(&WEIGHTS), &[]), &["p.npy", "its header claims"]);
    // An output that is an input.
    let arguments = small(&folder, &WEIGHTS);
    let weights = folder.text_path("w.npy");
    says(refusal(&with(&arguments, &["--output", &weights])), &["w.npy", "is an input"]);
}
