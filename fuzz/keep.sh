#!/usr/bin/env bash
# Puts the smallest inputs that reach all that fuzzing has reached into fuzz/corpus, at most 200 a target: what the tests
# replay on a stable compiler, and where the next run begins.
set -euo pipefail
cd "$(dirname "$0")"

for target in $(cargo +nightly fuzz list); do
    rm -rf "target/merged/$target"
    mkdir -p "target/merged/$target" "target/corpus/$target" "corpus/$target"
    cargo +nightly fuzz run --sanitizer none "$target" \
        "target/merged/$target" "target/corpus/$target" "corpus/$target" -- -merge=1 -timeout=20 2>"target/$target.merge.log"
    rm -f "corpus/$target"/*
    find "target/merged/$target" -type f -printf '%s %p\n' | sort -n | sed -n 1,200p | cut -d ' ' -f 2 |
        xargs --no-run-if-empty cp -t "corpus/$target"
    printf '%-16s %s inputs, %s\n' "$target" "$(ls "corpus/$target" | wc -l)" "$(du -sh --apparent-size "corpus/$target" | cut -f 1)"
done
