#!/bin/sh
# Prints what the environment of cargo must be to compile for a Linux on ARM, as lines for `export`. If the Rust at hand
# cannot, Debian's compiler and Debian's standard library for that machine are taken, which must be of one version; the
# library is unpacked, not installed, and the machine's list of architectures stays as it is. For 32 bits Debian 12 has
# none that is new enough.
#
#   usage: tools/arm-rust.sh aarch64|armhf DIRECTORY-FOR-FILES
set -eu

case $1 in
aarch64) target=aarch64-unknown-linux-gnu debian=arm64 prefix=aarch64-linux-gnu ;;
armhf) target=armv7-unknown-linux-gnueabihf debian="" prefix=arm-linux-gnueabihf ;;
*) echo "no such machine: $1" >&2 && exit 2 ;;
esac
files=$2
upper=$(echo "$target" | tr 'a-z-' 'A-Z_')

echo "CARGO_BUILD_TARGET=$target"
echo "CARGO_TARGET_${upper}_LINKER=$prefix-gcc"
echo "CARGO_TARGET_${upper}_RUNNER='qemu-${prefix%%-*} -L /usr/$prefix'"

has_std() { [ -n "$(find "$1" -name 'libstd-*.rlib' 2>/dev/null)" ]; }

if has_std "$(rustc --print target-libdir --target "$target")"; then exit 0; fi
if [ -z "$debian" ]; then
    echo "no Rust standard library for $target is here (rustup target add $target)" >&2
    exit 1
fi

installed() { dpkg-query -W -f '${Version}' rustc-web; }
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }

version=$(installed)
system=$(/usr/bin/rustc --print sysroot)/lib/rustlib
host=$(/usr/bin/rustc --version --verbose | sed -n 's/^host: //p')
sysroot=$files/rust-$version
if ! has_std "$sysroot/lib/rustlib/$target" && ! has_std "$system/$target"; then
    mkdir -p "$files/apt/partial" "$files/cache/archives/partial"
    chmod 755 "$files" "$files/apt"
    # Lists of our own, for an architecture that need not be the machine's business.
    apt="apt-get -qq -o Dir::State::lists=$files/apt -o Dir::Cache=$files/cache -o APT::Architectures::=$(dpkg --print-architecture)
        -o APT::Architectures::=$debian -o Acquire::Languages=none -o APT::Sandbox::User=$(id -un)"
    fetch() { (cd "$files" && $apt download "libstd-rust-web-dev:$debian=$version") >&2; }
    $apt update >&2
    if ! fetch; then
        # Debian has moved on since the compiler was installed.
        as_root apt-get -qq update >&2
        as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends rustc-web >&2
        version=$(installed)
        sysroot=$files/rust-$version
        fetch
    fi
    rm -rf "$files/unpacked"
    dpkg-deb -x "$files"/libstd-rust-web-dev_*_"$debian".deb "$files/unpacked"
    mkdir -p "$sysroot/lib/rustlib"
    mv "$files/unpacked/usr/lib/rustlib/$target" "$sysroot/lib/rustlib/"
    ln -sfn "$system/$host" "$sysroot/lib/rustlib/$host"
    rm -rf "$files/apt" "$files/cache" "$files/unpacked" "$files"/libstd-rust-web-dev_*.deb
fi
echo "RUSTC=/usr/bin/rustc"
if has_std "$sysroot/lib/rustlib/$target"; then echo "CARGO_TARGET_${upper}_RUSTFLAGS=--sysroot=$sysroot"; fi
