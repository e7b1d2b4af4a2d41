#!/bin/sh
# Writes the manual and the references of the C, C++ and Rust interfaces side by side; run by `make docs`.
#
#   usage: tools/docs.sh DIRECTORY       writes DIRECTORY/index.html, manual/, c/ and rust/ there
#          tools/docs.sh --check         only sees that nothing in the headers lacks documentation or is wrong in it
set -eu
cd "$(dirname "$0")/.."

# doxygen_with SETTING... : the settings override those of the file.
doxygen_with() { (cat docs/Doxyfile && printf '%s\n' "$@") | doxygen -; }

scratch=$(mktemp -d "${TMPDIR:-/tmp}/gentrack2-docs.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
doxygen_with "OUTPUT_DIRECTORY = $scratch" "GENERATE_HTML = NO" "GENERATE_XML = YES"
functions=$(grep -c '<memberdef kind="function"' "$scratch"/xml/gentrack2_8h.xml)
members=$(cat "$scratch"/xml/classgentrack2_*.xml "$scratch"/xml/structgentrack2_*.xml "$scratch"/xml/namespacegentrack2.xml |
    grep -c '<memberdef [^>]*prot="public"')
echo "$functions functions of C and $members members of C++ documented, no warnings"
[ "$1" != --check ] || exit 0

out=$1
rm -rf "$out"
mkdir -p "$out"
doxygen_with "OUTPUT_DIRECTORY = $out/c"
RUSTDOCFLAGS="-D warnings" cargo doc --quiet --lib --no-deps --locked
cp -r target/doc "$out/rust"
python3 tools/manual/write_html.py "$(dirname "$out")" "$out/manual"
cat >"$out/index.html" <<HTML
<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>gentrack2</title>
<h1>gentrack2</h1>
<ul>
<li><a href="manual/docs/README.html">The manual</a></li>
<li><a href="c/gentrack2_8h.html">C: gentrack2.h</a></li>
<li><a href="c/namespacegentrack2.html">C++: gentrack2.hpp and its companions</a></li>
<li><a href="rust/gentrack2/index.html">Rust: the crate</a></li>
<li><a href="manual/docs/parameters.html">Parameters of all trackers</a></li>
</ul>
</html>
HTML
echo "$out/index.html"
