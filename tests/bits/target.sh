#!/usr/bin/env bash
# Makes the table of bits on another target and compares it with the stored one:
#
#     rustup target add wasm32-wasip1
#     tests/bits/target.sh wasm32-wasip1
#
# A WebAssembly target runs under Node (20 or later), which brings WASI along. Any other needs a linker and something to run it
# with, as Cargo's own variables name them:
#
#     LINKER=s390x-linux-gnu-gcc RUNNER='qemu-s390x -L /usr/s390x-linux-gnu' \
#         tests/bits/target.sh s390x-unknown-linux-gnu
#
# FEATURES are `libm` without `std` where nothing else is said. The crate and glam are all that is built for the target: what
# the tests need besides, not all of which exists for every target, is not.
set -euo pipefail
cd "$(dirname "$0")/../.."

target=$1
features=${FEATURES:-libm}
name=bits
runner=${RUNNER:-}
if [[ $target == wasm32-* ]]; then
    name=bits.wasm
    runner=${RUNNER:-node --no-warnings tests/bits/wasi.mjs}
fi

folder=${CARGO_TARGET_DIR:-target}/$target/release
cargo build --package bits --release --target "$target" --no-default-features --features "$features" \
    ${LINKER:+--config "target.$target.linker='$LINKER'"}

$runner "$folder/$name" >"$folder/bits.txt"
cmp tests/bits/table.txt "$folder/bits.txt"
echo "$target: $(wc -l <tests/bits/table.txt) lines, the same bits"
