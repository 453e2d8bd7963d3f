#!/bin/sh
# Every f32: the five functions of a cell over all occupancies and all log-odds, the same cells in blocks, and 10 million random
# f64 in blocks of log-odds; and lines for proofs/RESULTS.md.
# Some ten minutes on two processors. Lines "near-tie FUNCTION BITS" go to vectors/generate/near_ties_f32.txt.
set -eu
cd "$(dirname "$0")/.."
output=$(mktemp)
trap 'rm -f "$output"' EXIT
started=$(date +%s)
cargo test --release --package mean-information --lib single_precision -- --ignored --nocapture --test-threads 1 >"$output"
cargo test --release --package mean-information --lib lanes -- --ignored --nocapture >>"$output"
grep -o 'near-tie .*' "$output" | sort >vectors/generate/near_ties_f32.txt
echo "$(date -u +%F), commit $(git describe --always --dirty), $(($(date +%s) - started)) s:"
grep 'results' "$output"
