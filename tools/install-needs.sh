#!/bin/sh
# Installs the Debian packages that a task needs and this machine lacks; does nothing where all is there.
#
#   usage: tools/install-needs.sh build|test|demo|package|docs|arm|bench|bench-instructions
set -eu

say() { printf '%s\n' "$*" >&2; }

task=${1:-build}
missing=""

# need PACKAGE... : what follows in the condition before it was not met.
need() { missing="$missing $*"; }

has() { command -v "$1" >/dev/null 2>&1; }

# A compiler can be there without the library's headers, so OpenCV is asked for where CMake looks for it.
has_opencv() {
    pkg-config --exists opencv4 2>/dev/null || [ -n "${OpenCV_DIR:-}" ] ||
        [ -n "$(find /usr/lib /usr/local/lib -name OpenCVConfig.cmake -print 2>/dev/null | head -n 1)" ]
}

if ! has cargo; then
    say "cargo is missing: install Rust 1.89 or newer, for example from https://rustup.rs, and run this again"
    exit 1
fi

has cc && has c++ || need gcc g++ libc6-dev
has cmake || need cmake
has make || need make
has pkg-config || need pkg-config
has_opencv || need libopencv-dev

if [ "$task" = test ]; then
    has clang || need clang
    has nm || need binutils
    has python3 || need python3
    python3 -c 'import ensurepip' 2>/dev/null || need python3-venv
    has meson || need meson
    has ninja || need ninja-build
    has abidiff || need abigail-tools
    has doxygen || need doxygen
fi

if [ "$task" = package ] || [ "$task" = test ]; then
    has dpkg-shlibdeps || need dpkg-dev
fi

if [ "$task" = docs ]; then
    has doxygen || need doxygen
fi

if [ "$task" = demo ] || [ "$task" = bench ]; then
    has dpkg-deb || need dpkg
fi

if [ "$task" = bench ]; then
    has strip && has readelf || need binutils
    # One of the peers binds to Python.
    has python3 || need python3
fi

if [ "$task" = bench-instructions ]; then
    has valgrind || need valgrind
fi

if [ "$task" = arm ]; then
    has aarch64-linux-gnu-gcc || need gcc-aarch64-linux-gnu libc6-dev-arm64-cross
    has aarch64-linux-gnu-g++ || need g++-aarch64-linux-gnu
    has qemu-aarch64 || need qemu-user
    # A Rust that can compile for ARM by itself needs no other.
    [ -n "$(find "$(rustc --print target-libdir --target aarch64-unknown-linux-gnu)" -name 'libstd-*' 2>/dev/null)" ] ||
        [ -x /usr/bin/rustc ] || need rustc-web
fi

[ -n "$missing" ] || exit 0

if ! has apt-get; then
    say "missing here, and there is no apt-get to install it:$missing"
    exit 1
fi
if [ "$(id -u)" = 0 ]; then
    as_root=""
elif has sudo; then
    as_root=sudo
else
    say "missing here:$missing"
    say "run as root, or:  apt-get install --no-install-recommends$missing"
    exit 1
fi

say "installing:$missing"
# Fresh images come without package lists; old lists name files that are gone.
$as_root apt-get update -qq
# shellcheck disable=SC2086 # word splitting is meant
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
