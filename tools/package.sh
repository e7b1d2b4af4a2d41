#!/bin/sh
# Makes the Debian packages and the .tar.gz; run by `make package`.
#
#   usage: tools/package.sh BUILD-DIRECTORY
set -eu

mkdir -p "$1"
build=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."

# Permissions and times are the same wherever packages are made: those that Debian asks for, and the commit's.
umask 022
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}
export SOURCE_DATE_EPOCH

# pack GENERATOR PREFIX : Debian's directories follow from the prefix /usr; an archive has plain lib/ and include/.
pack() {
    directory=$build/package-$1
    cmake -S . -B "$directory" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$2" -DGENTRACK2_BUILD_TESTS=OFF \
        -DGENTRACK2_BUILD_EXAMPLES=OFF >"$directory.log"
    cmake --build "$directory" >>"$directory.log" 2>&1
    (cd "$directory" && cpack -G "$1" -B ../packages) >>"$directory.log"
}

rm -rf "$build/packages"
for generator in DEB TGZ; do
    if [ $generator = DEB ]; then prefix=/usr; else prefix=/usr/local; fi
    if ! pack $generator $prefix; then
        cat "$build/package-$generator.log" >&2
        exit 1
    fi
done
rm -rf "$build/packages/_CPack_Packages"
ls -l "$build"/packages
