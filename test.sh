#!/usr/bin/env bash
# Everything that must hold: formatting, lints, docs, and the tests under every feature set and both ends of glam's range.
# Installs a software Vulkan driver where there is none: render-check's tests need a graphics adapter, and fail without.
set -euo pipefail
cd "$(dirname "$0")"

# Mesa's choice of device asks for a desktop and complains where there is none; the tests need no choice.
export NODEVICE_SELECT=1

step() {
    printf '\n== %s\n' "$*"
}

# Runs the tests of some modules (arguments that end in ::), and fails where one of them has none.
test_modules() {
    local argument listed
    listed=$(cargo test "$@" --list)
    for argument in "$@"; do
        if [[ $argument == *:: ]] && ! grep --quiet --fixed-strings "$argument" <<<"$listed"; then
            echo "no test in $argument"
            return 1
        fi
    done
    cargo test "$@"
}

step 'a Vulkan driver'
./driver.sh

# All features, but for the report's peers from Bevy, which bring two hundred crates along.
all=(--workspace --features shadowfit/libm,shadowfit/parry3d,shadowfit/serde,shadowfit/spade,shadowfit/wgsl)

step formatting
cargo fmt --all --check

step lints
cargo clippy "${all[@]}" --all-targets -- -D warnings

step documentation
RUSTDOCFLAGS="-D warnings" cargo doc "${all[@]}" --no-deps

step 'tests, all features'
cargo test "${all[@]}"

# Everything ran above. Here each set of features builds on its own, and gives the same results to the bit.
same=(conventions:: errors:: properties:: snapshots::)
for features in std libm libm,alloc; do
    step "tests, features: $features"
    only=(--package shadowfit --no-default-features --features "$features")
    cargo check "${only[@]}" --lib --tests
    cargo test "${only[@]}" --lib --test bits
    test_modules "${only[@]}" --test fit --test input -- "${same[@]}"
done

# What each of the other features adds: its own tests pass with that feature alone. All targets built with none of them above,
# and with all.
for of_feature in "parry3d focus parry::" "serde input serde::" "spade mesh tessellation::" "wgsl omni paraboloid::"; do
    read -r feature binary tests <<<"$of_feature"
    step "tests, features: std,$feature"
    test_modules --package shadowfit --no-default-features --features "std,$feature" --test "$binary" -- "$tests"
done

step 'each feature alone, and each pair'
cargo hack --version >/dev/null 2>&1 || cargo install --locked cargo-hack
cargo hack clippy --package shadowfit --lib --feature-powerset --depth 2 --at-least-one-of std,libm --exclude-features default \
    -- -D warnings

step 'the same bits: unoptimised, with fused multiplication at hand, and on WebAssembly where that target is installed'
CARGO_PROFILE_DEV_OPT_LEVEL=0 cargo test --package shadowfit --all-features --test bits
RUSTFLAGS='-C target-cpu=native' CARGO_TARGET_DIR=target/native tests/bits/target.sh "$(rustc --print host-tuple)"
if [ -d "$(rustc --print target-libdir --target wasm32-wasip1)" ]; then
    tests/bits/target.sh wasm32-wasip1
fi

step 'tests, the lower end of the glam range'
# In a copy, so that the lock file here stays as it is.
copy=target/lower-glam
mkdir -p "$copy"
tar --create --exclude=./target --exclude=./fuzz/target --exclude=./.git --exclude=./out . | tar --extract --directory "$copy"
(
    cd "$copy"
    lowest=0.33.12
    for version in $(cargo metadata --format-version 1 | grep --only-matching '"[^"]*#glam@0\.34[^"]*"' | tr -d '"' | sed 's/.*#//' | sort --unique); do
        cargo update --package "$version" --precise "$lowest"
    done
    cargo tree --package shadowfit --depth 1 --prefix none | grep --quiet "^glam v$lowest"
    export CARGO_TARGET_DIR=../../target
    cargo check --package shadowfit --all-features --all-targets
    cargo test --package shadowfit --all-features --lib --test bits
    test_modules --package shadowfit --all-features --test fit --test focus --test input -- \
        "${same[@]}" parry:: serde::
)
