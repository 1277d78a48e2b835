#!/usr/bin/env bash
# Fuzzes every target, or the ones named, for so many seconds each: fuzz/run.sh SECONDS [TARGET...]
#
# Prints what was executed, what is covered (cov: edges of the code, ft: features, how often they were taken included), how
# many inputs that takes, and every failure; goes on after a failure, and fails in the end. What a failing input means is
# shown by the replay on a stable compiler:
#   SHADOWFIT_INPUT=$PWD/fuzz/artifacts/fit/crash-… cargo test --all-features --test fuzz_corpus fit
# Inputs that reach something new are kept in fuzz/target/corpus; fuzz/keep.sh puts the best of them into fuzz/corpus.
#
# Needs a nightly compiler, cargo-fuzz and a C++ compiler.
set -euo pipefail
cd "$(dirname "$0")"

seconds=${1:?fuzz/run.sh SECONDS [TARGET...]}
shift
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
    mapfile -t targets < <(cargo +nightly fuzz list)
fi

# Without a sanitizer: the crate has no unsafe code, and runs several times as fast.
cargo +nightly fuzz build --sanitizer none

host=$(rustc +nightly -vV | sed -n 's/^host: //p')
failed=0
for target in "${targets[@]}"; do
    log=target/$target.log
    mkdir -p "target/corpus/$target" "corpus/$target" "artifacts/$target"
    touch target/started
    cargo +nightly fuzz run --sanitizer none "$target" "target/corpus/$target" "corpus/$target" -- \
        -fork=1 -ignore_crashes=1 -ignore_timeouts=1 -ignore_ooms=1 -timeout=20 -max_len=4096 \
        -max_total_time="$seconds" >"$log" 2>&1 || failed=1
    last=$(grep -aE '^#[0-9]+: cov: ' "$log" | tail -1)
    number() { sed -E "s|.*$1:? ([0-9]+).*|\1|" <<<"$last"; }
    printf '%-16s %10s executions, cov %s, ft %s, %s inputs\n' \
        "$target" "$(sed -E 's|^#([0-9]+):.*|\1|' <<<"$last")" "$(number cov)" "$(number ft)" "$(number corp)"
    found=$(find "artifacts/$target" -type f -newer target/started)
    if [ -n "$found" ]; then
        failed=1
        printf '%s\n' "$found"
        # The place of each failure and what it says, once.
        for input in $found; do
            { RUST_BACKTRACE=0 "target/$host/release/$target" "$input" 2>&1 |
                grep -aA 1 'panicked at' || echo 'no panic: a timeout or out of memory'; } |
                sed -E 's/^thread .* panicked at //' | tr '\n' ' ' | cut -c 1-300
            echo
        done | sort | uniq -c | sort -rn | sed -n 1,20p
    fi
done
exit "$failed"
