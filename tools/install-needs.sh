#!/bin/sh
# Installs the Debian packages that a task needs and this machine lacks; does nothing where all is there.
#
#   usage: tools/install-needs.sh
#       build|test|demo|package|docs|eval|eval-check|arm|bench|bench-instructions|sanitize|deny|fuzz
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

if [ "$task" = test ] || [ "$task" = eval ] || [ "$task" = eval-check ]; then
    has python3 || need python3
    python3 -c 'import ensurepip' 2>/dev/null || need python3-venv
fi

if [ "$task" = eval-check ]; then
    has chromium || need chromium
    has chromedriver || need chromium-driver
fi

if [ "$task" = test ]; then
    has clang || need clang
    has nm || need binutils
    has meson || need meson
    has ninja || need ninja-build
    has abidiff || need abigail-tools
    has doxygen || need doxygen
    # The GStreamer example and what it needs to play files: containers and pictures, and FFmpeg's decoders.
    pkg-config --exists gstreamer-app-1.0 gstreamer-video-1.0 2>/dev/null ||
        need libgstreamer1.0-dev libgstreamer-plugins-base1.0-dev
    has gst-inspect-1.0 || need gstreamer1.0-tools
    gst-inspect-1.0 --exists uridecodebin 2>/dev/null || need gstreamer1.0-plugins-base
    gst-inspect-1.0 --exists avidemux 2>/dev/null || need gstreamer1.0-plugins-good
    gst-inspect-1.0 --exists avdec_msmpeg4 2>/dev/null || need gstreamer1.0-libav
    has dpkg-deb || need dpkg
fi

if [ "$task" = package ] || [ "$task" = test ]; then
    has dpkg-shlibdeps || need dpkg-dev
fi

if [ "$task" = docs ]; then
    has doxygen || need doxygen
    has python3 || need python3
    python3 -c 'import ensurepip' 2>/dev/null || need python3-venv
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

if [ "$task" = sanitize ]; then
    has valgrind || need valgrind
    # Without them helgrind does not know the C library's own locks. GCC brings the sanitizers' runtimes.
    [ -d /usr/lib/debug/.build-id ] || need libc6-dbg
fi

if [ "$task" = deny ]; then
    python3 -c 'import ensurepip' 2>/dev/null || need python3-venv
fi

if [ "$task" = fuzz ]; then
    # clang can be there without its fuzzer and sanitizers.
    has clang++ && [ -e "$(clang++ --print-file-name=libclang_rt.fuzzer-"$(uname -m)".a)" ] || need clang libclang-rt-dev
fi

if [ "$task" = arm ]; then
    has aarch64-linux-gnu-gcc || need gcc-aarch64-linux-gnu libc6-dev-arm64-cross
    has aarch64-linux-gnu-g++ || need g++-aarch64-linux-gnu
    has qemu-aarch64 || need qemu-user
    # A Rust that can compile for ARM by itself needs no other.
    can_compile_for() { [ -n "$(find "$(rustc --print target-libdir --target "$1")" -name 'libstd-*' 2>/dev/null)" ]; }
    can_compile_for aarch64-unknown-linux-gnu || [ -x /usr/bin/rustc ] || need rustc-web
    # Debian 12 has no Rust for 32 bits that is new enough; where rustup has none either, that part is left out.
    can_compile_for armv7-unknown-linux-gnueabihf || { has rustup && rustup target add armv7-unknown-linux-gnueabihf; } ||
        say "no Rust standard library for armv7-unknown-linux-gnueabihf: 32-bit ARM is left out"
    if can_compile_for armv7-unknown-linux-gnueabihf; then
        has arm-linux-gnueabihf-gcc || need gcc-arm-linux-gnueabihf libc6-dev-armhf-cross
        has arm-linux-gnueabihf-g++ || need g++-arm-linux-gnueabihf
    fi
fi

# Rust's fuzzer is no Debian package.
if [ "$task" = fuzz ]; then
    if ! cargo +nightly --version >/dev/null 2>&1; then
        say "installing: a nightly Rust, which cargo-fuzz needs"
        rustup toolchain install nightly --profile minimal
    fi
    cargo fuzz --version >/dev/null 2>&1 || cargo install --quiet --locked cargo-fuzz
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
