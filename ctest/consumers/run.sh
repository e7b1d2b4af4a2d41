#!/bin/sh
# Builds a project of its own against an installed tree and runs it; what it prints is the result.
#
#   usage: run.sh install BUILD WORK          installs to WORK/prefix, by way of another place
#          run.sh CONSUMER BUILD WORK         builds and runs that folder's project
# CC, CXX: the compilers. VERSION: that of the library. BUILD: CMake's build directory of the library.
set -eu

consumer=$1
build=$2
work=$3
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
prefix=$work/prefix

# quiet COMMAND... : shows the output only of a failure.
quiet() {
    log=$work/$consumer.log
    if ! "$@" >"$log" 2>&1; then
        cat "$log" >&2
        echo "failed: $*" >&2
        exit 1
    fi
}

if [ "$consumer" = install ]; then
    rm -rf "$work"
    mkdir -p "$work"
    # A tree that is moved after the installation must serve all the same.
    quiet cmake --install "$build" --prefix "$work/elsewhere"
    mv "$work/elsewhere" "$prefix"
    (cd "$prefix" && find . ! -type d | sort)
    exit 0
fi

pc=$(find "$prefix" -name gentrack2.pc)
libraries=$(dirname "$(dirname "$pc")")
PKG_CONFIG_PATH=$(dirname "$pc")
export PKG_CONFIG_PATH PREFIX="$prefix" CC CXX
own=$work/$consumer
rm -rf "$own"
if [ -d "$here/$consumer" ]; then cp -r "$here/$consumer" "$own"; fi

# with_library COMMAND... : runs a program that is to find the shared library in the installed tree.
with_library() { LD_LIBRARY_PATH="$libraries" "$@"; }

# crate DIRECTORY : puts the crate there as it would be published.
crate() {
    quiet cargo package --manifest-path "$root/Cargo.toml" --offline --allow-dirty --no-verify --target-dir "$1"
    mv "$1/package/gentrack2-$VERSION.crate" "$1/gentrack2.tar.gz"
}

configure() { quiet cmake -S "$own" -B "$own/build" -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" "$@"; }

case $consumer in
c99_pkgconfig)
    quiet make -C "$own"
    with_library "$own/two_walkers"
    ;;
c11_static)
    quiet make -C "$own"
    for program in every_tracker fully_static from_pc; do "$own/$program"; done
    # A plugin shows its own function and nothing of the library within.
    nm -D --defined-only --format=posix "$own/plugin.so" >"$own/symbols"
    [ "$(cut -d ' ' -f 1 "$own/symbols")" = followed_trackers ]
    echo "a plugin with the library within exports $(cut -d ' ' -f 1 "$own/symbols")"
    ;;
cxx17_find_package)
    configure -DCMAKE_PREFIX_PATH="$prefix" -DVERSION="$VERSION"
    quiet cmake --build "$own/build"
    for kind in gentrack2 static; do "$own/build/wrapper_$kind"; done
    ;;
cxx_subdirectory)
    configure -DGENTRACK2_SOURCE="$root"
    quiet cmake --build "$own/build"
    for program in boxes boxes_static; do "$own/build/$program"; done
    ;;
minimal_features)
    # The crate is an archive like any other.
    crate "$own/crate"
    configure -DARCHIVE="$own/crate/gentrack2.tar.gz"
    quiet cmake --build "$own/build"
    for kind in shared static; do "$own/build/only_sort_$kind"; done
    ;;
meson)
    quiet meson setup "$own/build" "$own"
    with_library meson test -C "$own/build" --verbose >"$work/meson.log" 2>&1 || { cat "$work/meson.log"; exit 1; }
    grep 'from Meson' "$work/meson.log"
    ;;
plugin_host)
    quiet make -C "$own"
    "$own/plugin_host" "$libraries/libgentrack2.so.0"
    ;;
packages)
    quiet "$root/tools/package.sh" "$own"
    mkdir -p "$own/debian" "$own/archive"
    for deb in "$own"/packages/*.deb; do dpkg-deb -x "$deb" "$own/debian"; done
    tar xzf "$own"/packages/*.tar.gz -C "$own/archive" --strip-components 1
    dpkg-deb -f "$own"/packages/libgentrack2-0_*.deb Package Depends
    dpkg-deb -f "$own"/packages/libgentrack2-dev_*.deb Package Depends | tee "$own/fields"
    grep -q "^Depends: libgentrack2-0 (= $VERSION)$" "$own/fields"
    for tree in debian archive; do
        # What they are made of is under licences that want their notices handed on; libm's is one of many.
        for name in libgentrack2-0 libgentrack2-dev; do
            grep -q "Sun Microsystems" "$(find "$own/$tree" -path "*/doc/$name/copyright")"
        done
        pc=$(find "$own/$tree" -name gentrack2.pc)
        cp -r "$here/c99_pkgconfig" "$own/$tree/program"
        PKG_CONFIG_PATH=$(dirname "$pc") quiet make -C "$own/$tree/program"
        LD_LIBRARY_PATH=$(dirname "$(dirname "$pc")") "$own/$tree/program/two_walkers"
    done
    ;;
rust)
    # A new program that adds the crate. Where there is no network, its lock file says which versions are at hand.
    crate "$own/crate"
    tar xzf "$own/crate/gentrack2.tar.gz" -C "$own/crate"
    quiet cargo new --quiet --vcs none --bin --name walkers "$own/program"
    cp "$here/rust/main.rs" "$own/program/src/main.rs"
    cp "$own/crate/gentrack2-$VERSION/Cargo.lock" "$own/program/Cargo.lock"
    cd "$own/program"
    quiet cargo add --quiet --offline --path "$own/crate/gentrack2-$VERSION" gentrack2
    quiet cargo build --quiet --offline --target-dir "$own/target"
    "$own/target/debug/walkers"
    ;;
python)
    python3 "$root/examples_python/track.py" "$libraries/libgentrack2.so.0" >"$work/python.log" 2>&1 ||
        { cat "$work/python.log"; exit 1; }
    tail -n 2 "$work/python.log"
    # Both are followed from the second frame on, with their numbers.
    [ "$(grep -c 'track 1 .*detection 0' "$work/python.log")" -ge 38 ]
    [ "$(grep -c 'track 2 .*detection 1' "$work/python.log")" -ge 38 ]
    ;;
*)
    echo "no such consumer: $consumer" >&2
    exit 2
    ;;
esac
