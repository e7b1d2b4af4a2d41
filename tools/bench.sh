#!/bin/sh
# Speed and memory beside others, in a table; run by `make bench`.
#
#   usage: tools/bench.sh BUILD-DIRECTORY
set -eu

build=$1
readings=out/bench
table=out/bench.md
mkdir -p "$readings"

say() { printf '%s\n' "$*" >&2; }

say "building the benchmarks"
(cd benches && cargo build --release --locked --package peers)
library=$(readlink -f "$build/lib/libgentrack2.so")
lib=$(dirname "$library")
opencv_headers=$(pkg-config --cflags-only-I opencv4 | sed 's/-I/-isystem /g')
# shellcheck disable=SC2086 # options are words
c++ -std=c++17 -O3 -Wall -Wextra -Iinclude $opencv_headers benches/hog/hog_bench.cpp -o "$readings/hog_bench" \
    -L"$lib" -Wl,-rpath,"$lib" -lgentrack2 -lopencv_core -lopencv_imgproc -lopencv_objdetect -lopencv_videoio
cc -std=c99 -O2 -Wall -Wextra benches/hog/load_time.c -o "$readings/load_time" -ldl

say "the shared library"
strip -o "$readings/stripped.so" "$library"
{
    echo "stripped_kib $(($(wc -c <"$readings/stripped.so") / 1024))"
    needs=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
    echo "foreign_needs $(printf '%s\n' "$needs" | grep -cvE '^(libc|libm|libgcc_s|ld-linux[^.]*)[.]so' || true)"
    "$readings/load_time" "$library"
} >"$readings/library.txt"

say "many streams"
"$build/examples_cpp/many_streams" 64 300 |
    sed -n 's/.* on \([0-9]*\) threads: \([0-9]*\) frames.*/streams.\1 \2/p' >"$readings/streams.txt"

say "images"
"$readings/hog_bench" "$(tools/sample-video.sh out)" "$readings/vtest-det.txt" >"$readings/hog.txt"

say "memory (200 000 frames for each tracker)"
benches/target/release/memory >"$readings/memory.txt"

say "trackers"
benches/target/release/peers "$table" "$readings/library.txt" "$readings/streams.txt" "$readings/hog.txt" \
    "$readings/memory.txt"
say "written: $table"
