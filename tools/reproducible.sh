#!/bin/sh
# Builds the present sources again, in another directory, with another home of cargo, locale, umask and time and nothing of
# the first build at hand, and compares libraries and packages bit by bit. Run by `make reproducible`, after `make build`.
#
#   usage: tools/reproducible.sh BUILD-DIRECTORY
set -eu
cd "$(dirname "$0")/.."

build=$(cd "$1" && pwd)
work=$build/reproducible
copy=$work/in-quite-another-place
rm -rf "$work"
mkdir -p "$copy" "$work/cargo-home"
# What was fetched need not be fetched again, and comes from where it came from.
for part in registry config.toml; do ln -s "${CARGO_HOME:-$HOME/.cargo}/$part" "$work/cargo-home/$part"; done
git ls-files -z --cached --others --exclude-standard | tar -c --null -T - | tar -x -C "$copy"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH

# quiet COMMAND... : shows the output only of a failure.
quiet() {
    if ! "$@" >"$work/log" 2>&1; then
        cat "$work/log" >&2
        exit 1
    fi
}

quiet tools/package.sh "$work/first"
(
    umask 027
    CARGO_HOME=$work/cargo-home LC_ALL=C.UTF-8 TZ=Asia/Kathmandu
    export CARGO_HOME LC_ALL TZ
    quiet "$copy/tools/package.sh" "$work/second"
)

same() { # FILE OTHER
    if ! cmp "$1" "$2"; then
        echo "the second build differs: $2" >&2
        exit 1
    fi
}

for generator in DEB TGZ; do
    for library in libgentrack2.so libgentrack2.a; do
        same "$build/lib/$library" "$work/second/package-$generator/lib/$library"
    done
done
count=0
for package in "$work"/first/packages/*; do
    same "$package" "$work/second/packages/$(basename "$package")"
    count=$((count + 1))
done
[ $count = 3 ]

# Nor does it say where it was built.
for library in libgentrack2.so libgentrack2.a; do
    for place in "$(pwd)" "${CARGO_HOME:-$HOME/.cargo}"; do
        if grep -qaF "$place" "$build/lib/$library"; then
            echo "$library names $place" >&2
            exit 1
        fi
    done
done
# That comparing and looking notice what they should.
if ! grep -qaF /cargo/registry "$build/lib/libgentrack2.so"; then
    echo "libgentrack2.so names no crate: what is looked for is not there to be found" >&2
    exit 1
fi
head -c -1 "$build/lib/libgentrack2.so" >"$work/shorter"
if cmp -s "$build/lib/libgentrack2.so" "$work/shorter"; then exit 1; fi
sha256sum "$build/lib/libgentrack2.so" "$build/lib/libgentrack2.a" "$work"/first/packages/* | sed 's|  .*/|  |'
rm -rf "$work"
