#!/bin/sh
# Runs the coverage-guided fuzzers one after the other, each for so many seconds. What they find is in fuzz/artifacts,
# what they learnt in fuzz/corpus, from where the next run goes on.
#
#   usage: tools/fuzz.sh SECONDS [c_abi|toml|snapshot|mot_reader]...
set -eu
cd "$(dirname "$0")/.."
seconds=$1
shift
[ $# -gt 0 ] || set -- c_abi toml snapshot mot_reader

# gt2_mot's reader is C++: clang's own fuzzer, and the library as it is.
mot_reader() {
    cargo build --quiet --release --locked
    mkdir -p fuzz/target fuzz/artifacts/mot_reader
    # shellcheck disable=SC2046 # word splitting is meant
    clang++ -std=c++17 -O1 -g -fsanitize=fuzzer,address,undefined,float-cast-overflow -fno-sanitize-recover=all \
        -Iinclude -Iexamples_cpp/common -Ifuzz/mot_reader $(pkg-config --cflags opencv4) \
        fuzz/mot_reader/*.cpp examples_cpp/common/ground_truth.cpp examples_cpp/common/mot_io.cpp \
        examples_cpp/common/mot_rows.cpp examples_cpp/common/text.cpp target/release/libgentrack2.a \
        -lm -lpthread -ldl -o fuzz/target/mot_reader
    fuzz/target/mot_reader -artifact_prefix=fuzz/artifacts/mot_reader/ -max_total_time="$seconds" -print_final_stats=1 \
        fuzz/corpus/mot_reader fuzz/seeds/mot_reader
}

for target in "$@"; do
    mkdir -p "fuzz/corpus/$target"
    echo "fuzz: $target for $seconds s"
    if [ "$target" = mot_reader ]; then
        mot_reader
    else
        (cd fuzz && cargo +nightly fuzz run "$target" "corpus/$target" "seeds/$target" -- \
            -max_total_time="$seconds" -print_final_stats=1)
    fi
done
