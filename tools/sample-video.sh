#!/bin/sh
# Prints the path of OpenCV's sample video vtest.avi, fetching Debian's opencv-doc if need be.
# The package is unpacked, not installed: many machines drop /usr/share/doc on installation.
#
#   usage: tools/sample-video.sh DIRECTORY-FOR-A-COPY
set -eu

copy=$1/vtest.avi
inside=usr/share/doc/opencv-doc/examples/data/vtest.avi

for video in "${GENTRACK2_SAMPLE_VIDEO:-}" "/$inside" "$copy"; do
    if [ -n "$video" ] && [ -s "$video" ]; then
        printf '%s\n' "$video"
        exit 0
    fi
done

mkdir -p "$1"
scratch=$(mktemp -d "${TMPDIR:-/tmp}/opencv-doc.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
# apt drops its rights to the user _apt for downloads, who must be able to write here.
chmod 755 "$scratch"

fetch() { (cd "$scratch" && apt-get -qq -o APT::Sandbox::User="$(id -un)" download opencv-doc) >&2; }

if ! command -v apt-get >/dev/null 2>&1; then
    echo "vtest.avi not found, and no apt-get to fetch Debian's opencv-doc with;" \
        "put the file of OpenCV's samples at $copy" >&2
    exit 1
fi
if ! fetch 2>/dev/null; then
    # No package lists, or old ones.
    if [ "$(id -u)" = 0 ]; then apt-get update -qq >&2; else sudo apt-get update -qq >&2; fi
    fetch
fi
dpkg-deb -x "$scratch"/opencv-doc_*.deb "$scratch/files"
# Some versions ship it compressed.
if [ -s "$scratch/files/$inside.gz" ]; then gunzip "$scratch/files/$inside.gz"; fi
cp "$scratch/files/$inside" "$copy.$$"
mv "$copy.$$" "$copy"
printf '%s\n' "$copy"
