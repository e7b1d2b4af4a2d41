#!/bin/sh
# Cross-builds the library and the C and C++ tests for a Linux on ARM and runs them under qemu, the oracle tests too, and
# compares the bits of all results with this machine's. Run by `make arm`, after `make build`.
#
#   usage: tools/arm.sh BUILD-DIRECTORY aarch64|armhf
set -eu
cd "$(dirname "$0")/.."

mkdir -p "$1"
build=$(cd "$1" && pwd)
machine=$2
out=$build/arm

case $machine in
aarch64) toolchain=aarch64-linux-gnu ;;
armhf) toolchain=arm-linux-gnueabihf ;;
*) echo "no such machine: $machine" >&2 && exit 2 ;;
esac

# The environment is for what follows only: `make build` is this machine's.
mkdir -p "$out"
environment=$(tools/arm-rust.sh "$machine" "$out/rust")
eval "$(echo "$environment" | sed 's/^/export /')"

# In a copy of the sources: where this machine's things are built, cargo would build what runs at build time anew whenever
# the compiler changes.
copy=$out/sources
mkdir -p "$copy"
find "$copy" -mindepth 1 -maxdepth 1 ! -name target ! -name build -exec rm -rf {} +
tar -cf "$out/sources.tar" --exclude=./.git --exclude=./target --exclude='./*/target' --exclude=./build --exclude=./out \
    --exclude="./${build#"$(pwd)/"}" .
tar -xf "$out/sources.tar" -C "$copy"
rm "$out/sources.tar"
cd "$copy"

if [ "$machine" = aarch64 ]; then
    # What docs/embedded.md tells a user.
    cmake -S . -B build/arm64 -DCMAKE_TOOLCHAIN_FILE=cmake/aarch64-linux-gnu.cmake -DCMAKE_BUILD_TYPE=Release \
        -DGENTRACK2_BUILD_TESTS=OFF -DGENTRACK2_BUILD_EXAMPLES=OFF
    cmake --build build/arm64
    DESTDIR=build/stage cmake --install build/arm64
    readelf -h build/stage/usr/local/lib/libgentrack2.so | grep -q AArch64
fi

cmake -S . -B "$out/$machine" -DCMAKE_TOOLCHAIN_FILE="$(pwd)/cmake/$toolchain.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DGENTRACK2_BUILD_EXAMPLES=OFF
cmake --build "$out/$machine"
ctest --test-dir "$out/$machine" --output-on-failure

# Without the measurement data, with which it would take long. What the tests need besides the library may be slow, and
# is compiled sooner so.
env -u GENTRACK2_SHARED cargo test --locked --test conformance \
    --config 'profile.dev.package."*".opt-level=0'

bits() { (cd tests/fixtures/oracles/synthetic && "$@" ./syn_a1 ./syn_a2 ./syn_a3 ./syn_a4 ./syn_b2 ./syn_b3 ./syn_b1); }
bits "$build/ctest/bits" >"$out/bits-here.txt"
# shellcheck disable=SC2086 # the runner is several words
eval "runner=\$CARGO_TARGET_$(echo "$CARGO_BUILD_TARGET" | tr 'a-z-' 'A-Z_')_RUNNER"
bits $runner "$out/$machine/ctest/bits" >"$out/bits-$machine.txt"
cmp "$out/bits-here.txt" "$out/bits-$machine.txt"
echo "$machine: $(wc -l <"$out/bits-$machine.txt") results have the bits of $(uname -m)"
