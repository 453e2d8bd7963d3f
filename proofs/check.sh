#!/bin/sh
# Checks every machine-checked proof: of src/rounded the constants (Sollya), the bounds (Gappa), and that the scripts speak of
# this source (cargo test --test proofs); of src/limit the tables (Arb, where there is python-flint). Prints one line per proof and, last, "N passed, N failed". See proofs/README.md.
#
#     proofs/check.sh            every proof
#     proofs/check.sh quick      of the vector kernels' intervals every twenty-ninth, as all take some 20 minutes
#     proofs/check.sh NAME...    only these, of the names it prints
#
# SOURCE_TEST replaces the last command, and ROWS is a file of the vector kernels' rows; proofs/mutate.py uses both to build
# the tests once.
set -u
cd "$(dirname "$0")/.." || exit 1

for tool in sollya gappa cargo; do
    command -v "$tool" > /dev/null || { echo "proofs/check.sh: needs $tool, which is not installed" >&2; exit 1; }
done

output=$(mktemp)
input=$(mktemp)
ranges=$(mktemp)
trap 'rm -f "$output" "$input" "$ranges"' EXIT
passed=0
failed=0

chosen=" $* "
every=
[ "$chosen" != " quick " ] || every=--every=29
# wanted NAME: whether to check it.
wanted() {
    case "$chosen" in
        "  " | " quick " | *" $1 "*) return 0 ;;
        *) return 1 ;;
    esac
}

# verdict NAME STATUS: counts, and prints the output of a proof that failed.
verdict() {
    if [ "$2" -eq 0 ]; then
        passed=$((passed + 1))
        echo "passed $1"
    else
        failed=$((failed + 1))
        echo "FAILED $1"
        head -n 20 "$output" | sed 's/^/    /'
    fi
}

# The ranges of the vector kernels' scripts, in the background: they take longest, and the proofs until there need one core.
making=
for script in proofs/lanes_*.gappa proofs/log_odds_*.gappa; do
    wanted "$(basename "$script")" && [ -z "${REGIONS:-}" ] || continue
    for certificate in lanes log_odds_regions; do sollya "proofs/$certificate.sollya" < /dev/null; done > "$ranges" 2>&1 &
    making=$!
    export REGIONS="$ranges"
done

# Sollya ends with status 3 even if all is well; what it writes must be what is committed, byte for byte.
if wanted constants.sollya; then
    sollya proofs/constants.sollya < /dev/null 2>&1 | diff - src/rounded/constants.rs > "$output"
    verdict constants.sollya $?
fi

if wanted log_odds.sollya; then
    sollya proofs/log_odds.sollya < /dev/null 2>&1 | diff - src/rounded/lanes/log_odds/polynomials.rs > "$output"
    verdict log_odds.sollya $?
fi

# Internal precision: integers here have up to 256 bits. A denominator is 1 plus something that is not negative.
for script in proofs/*.gappa; do
    case "$script" in proofs/lanes_* | proofs/log_odds_*) continue ;; esac
    wanted "$(basename "$script")" || continue
    timeout 60 gappa -Eprecision=300 -Eno-auto-dichotomy -Wno-null-denominator "$script" > "$output" 2>&1
    status=$?
    [ -s "$output" ] && status=1 # a warning
    verdict "$(basename "$script")" "$status"
done

# rows SCRIPT FILE TEST NUMBERS: whether each number of the rows, from FILE or printed by a unit test, is as the script says.
rows() {
    wanted "$1" || return 0
    {
        cat "proofs/$1"
        { cat "${2:-/dev/null}"; [ -n "$2" ] || cargo test --quiet --lib "$3" -- --ignored --nocapture; } | grep '^row('
        echo 'print(numbers, "numbers");'
    } > "$input" 2> /dev/null
    sollya "$input" < /dev/null > "$output" 2>&1
    [ "$(cat "$output")" = "$4 numbers" ]
    verdict "$1" $?
}

# The vector kernels: each row of their tables, then their scripts for each value and binade of distances, or interval of log-odds.
rows rows.sollya "${ROWS:-}" lanes::tests::rows_for_the_proof 59535
rows log_odds_rows.sollya "" log_odds::tests::rows_for_the_proof 179894
for script in proofs/lanes_*.gappa proofs/log_odds_*.gappa; do
    wanted "$(basename "$script")" || continue
    [ -z "$making" ] || { wait "$making"; making=; }
    proofs/regions.py $every "$script" > "$output" 2>&1
    verdict "$(basename "$script")" $?
done

# Arb, through python-flint, is not everywhere; the tables that it proved have a digest in src/limit/closed_form/tests.rs.
if wanted limit_certify.py; then
    if python3 -c 'import flint' 2> /dev/null; then
        { proofs/limit_tables.py | diff - src/limit/closed_form/tables.rs && proofs/limit_certify.py; } > "$output" 2>&1
        verdict limit_certify.py $?
    else
        echo "skipped limit_certify.py: needs python-flint"
    fi
fi

if wanted decimals.py; then
    if python3 -c 'import flint' 2> /dev/null; then
        proofs/decimals.py | diff - proofs/decimals.txt > "$output" 2>&1
        verdict decimals.py $?
    else
        echo "skipped decimals.py: needs python-flint"
    fi
fi

if wanted source; then
    ${SOURCE_TEST:-cargo test --quiet --test proofs} > "$output" 2>&1
    verdict source $?
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
