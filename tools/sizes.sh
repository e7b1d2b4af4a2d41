#!/bin/sh
# Prints a table of the library's size with several sets of cargo features, for docs/embedded.md: the stripped shared
# library, and a stripped program that follows one object with every tracker there is, linked with the static one.
#
#   usage: tools/sizes.sh DIRECTORY-FOR-FILES [aarch64]
set -eu
cd "$(dirname "$0")/.."

mkdir -p "$1"
files=$(cd "$1" && pwd)
machine=${2:-}
prefix=
out=$files/target
if [ -n "$machine" ]; then
    environment=$(tools/arm-rust.sh "$machine" "$files/rust")
    eval "$(echo "$environment" | sed 's/^/export /')"
    prefix=$machine-linux-gnu-
    out=$out/$CARGO_BUILD_TARGET
fi

# row PROFILE [FEATURES]
row() {
    if [ $# -gt 1 ]; then options="--no-default-features --features $2"; else options=; fi
    # shellcheck disable=SC2086 # several words
    cargo build --quiet --lib --locked --profile "$1" --target-dir "$files/target" $options
    "${prefix}strip" -o "$files/stripped.so" "$out/$1/libgentrack2.so"
    "${prefix}gcc" -std=c11 -Os -s -Iinclude -Wl,--gc-sections ctest/consumers/c11_static/main.c "$out/$1/libgentrack2.a" \
        -lutil -lrt -lpthread -lm -ldl -lc -o "$files/program"
    kib() { echo $((($(wc -c <"$1") + 512) / 1024)); }
    echo "| $1 | ${2:-all} | $(kib "$files/stripped.so") KiB | $(kib "$files/program") KiB |"
}

echo "| profile | features | shared library | static program |"
echo "|---|---|---|---|"
row release
row embedded
row embedded gentrack2,sort,deepsort,bytetrack,ocsort,botsort,smiletrack,conftrack
row embedded gentrack2
row embedded bytetrack
row embedded sort
