#!/bin/sh
# Runs the C and C++ tests, and the examples that go without OpenCV, under checkers. Each must first find faults made
# for it, which without it go unnoticed (ctest/faults.c). Run by `make sanitize`, after `make build`.
#
#   usage: tools/sanitize.sh BUILD-DIRECTORY [CHECKER...]
#
#   memcheck   valgrind: memory errors and leaks, in the library, too
#   helgrind   valgrind: data races, in the library, too
#   address    AddressSanitizer, its leak detector and UndefinedBehaviorSanitizer, in what is C or C++
#   thread     ThreadSanitizer, in what is C or C++, and where the library calls the C library
set -eu
cd "$(dirname "$0")/.."

out=$1/sanitize
shift
[ $# -gt 0 ] || set -- memcheck helgrind address thread
jobs=$(nproc 2>/dev/null || echo 2)

say() { printf '%s\n' "$*"; }

die() {
    printf '%s\n' "$*" >&2
    exit 1
}

# quiet COMMAND... : shows the output only of a failure.
quiet() {
    if ! "$@" >"$out/log" 2>&1; then
        cat "$out/log" >&2
        die "failed: $*"
    fi
}

# configure DIRECTORY FLAGS EMULATOR : builds tests and examples; the library is that of `make build`.
configure() {
    quiet cmake -S . -B "$1" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS="$2" -DCMAKE_CXX_FLAGS="$2" \
        -DCMAKE_CROSSCOMPILING_EMULATOR="$3" -DGENTRACK2_INSTALL=OFF -DCMAKE_DISABLE_FIND_PACKAGE_OpenCV=ON \
        -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON
    quiet cmake --build "$1" --parallel "$jobs"
    quiet cmake --build "$1" --target faults
}

# finds DIRECTORY RUNNER FAULT TEXT : that program without a checker survives, and does not here.
finds() {
    quiet "$out/plain/ctest/faults" "$3"
    # shellcheck disable=SC2086 # the runner is several words
    if $2 "$1/ctest/faults" "$3" >"$out/log" 2>&1; then die "$checker: does not notice $3"; fi
    if ! grep -q "$4" "$out/log"; then
        cat "$out/log" >&2
        die "$checker: does not say of $3: $4"
    fi
}

tests() {
    quiet ctest --test-dir "$1" --label-regex '^program$' --no-tests=error --parallel "$jobs" --output-on-failure
}

count() { sed -n 's/^100% tests passed, 0 tests failed out of //p' "$out/log"; }

# What uses threads; tables that are made once are made before by one of them, see ctest/threads.c.
threaded() { # DIRECTORY RUNNER...
    directory=$1
    shift
    quiet "$@" "$directory/ctest/threads_static" warm
    quiet "$@" "$directory/ctest/threads_shared" warm
    quiet "$@" "$directory/examples_cpp/many_streams" 4 20
}

# Sanitizers' runtimes of older compilers do not start where newer kernels spread addresses wider.
fixed=""
if setarch "$(uname -m)" -R true 2>/dev/null; then fixed="setarch $(uname -m) -R"; fi

mkdir -p "$out"
configure "$out/plain" "" ""

for checker in "$@"; do
    case $checker in
    memcheck)
        run="valgrind --quiet --error-exitcode=86 --num-callers=50 --leak-check=full --show-leak-kinds=all
            --errors-for-leak-kinds=all --suppressions=$(pwd)/tools/checkers.supp"
        run=$(echo $run)
        finds "$out/plain" "$run" read_after_free 'Invalid read'
        finds "$out/plain" "$run" read_beyond_end 'Invalid read'
        finds "$out/plain" "$run" leak 'definitely lost'
        finds "$out/plain" "$run" kept 'still reachable'
        finds "$out/plain" "$run" read_beyond_end_in_library 'Invalid read'
        finds "$out/plain" "$run" use_after_free_in_library 'Invalid read'
        finds "$out/plain" "$run" uninitialised_in_library 'depends on uninitialised'
        configure "$out/memcheck" "" "$(echo "$run" | tr ' ' ';')"
        tests "$out/memcheck"
        say "memcheck: 7 faults found, $(count) tests clean"
        ;;
    helgrind)
        run="valgrind --quiet --error-exitcode=86 --tool=helgrind"
        for fault in race race_in_library; do finds "$out/plain" "$run" $fault 'Possible data race'; done
        # shellcheck disable=SC2086 # the runner is several words
        threaded "$out/plain" $run
        say "helgrind: 2 faults found, 3 programs clean"
        ;;
    address)
        flags="-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer"
        configure "$out/address" "$flags" "$(echo "$fixed" | tr ' ' ';')"
        finds "$out/address" "$fixed" read_after_free heap-use-after-free
        finds "$out/address" "$fixed" read_beyond_end heap-buffer-overflow
        finds "$out/address" "$fixed" leak 'LeakSanitizer: detected memory leaks'
        finds "$out/address" "$fixed" overflow 'runtime error: signed integer overflow'
        finds "$out/address" "$fixed" misaligned 'runtime error: load of misaligned address'
        tests "$out/address"
        say "address: 5 faults found, $(count) tests clean"
        ;;
    thread)
        configure "$out/thread" -fsanitize=thread ""
        for fault in race race_in_library; do finds "$out/thread" "$fixed" $fault 'ThreadSanitizer: data race'; done
        # shellcheck disable=SC2086 # the runner is several words
        threaded "$out/thread" $fixed
        say "thread: 2 faults found, 3 programs clean"
        ;;
    *) die "no such checker: $checker" ;;
    esac
done
