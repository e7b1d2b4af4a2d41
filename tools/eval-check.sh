#!/bin/sh
# Writes reports of synthetic sequences and, where GENTRACK2_SHARED names it, of the measurement data, and looks at all of
# them in headless Chromium. Pages and screenshots are in out/eval-check.
#
#   usage: tools/eval-check.sh BUILD-DIRECTORY
set -eu

out=out/eval-check
program=$1/examples_cpp/gt2_mot
rm -rf "$out/data"
pages=""

# report NAME FOLDER [OPTION...]
report() {
    name=$1
    folder=$2
    shift 2
    started=$(date +%s)
    python3 eval/report.py "$folder" --program "$program" --title "$name" --out "$out/$name" "$@"
    echo "$name: a report in $(($(date +%s) - started)) s"
    pages="$pages $out/$name/index.html"
}

python3 eval/synthetic.py "$out/data/synthetic"
report synthetic "$out/data/synthetic"
for name in mot17 mot15 dancetrack; do
    # The detector of mot17 was trained on the first halves.
    split=$([ "$name" = mot17 ] && echo half || echo full)
    if [ -d "${GENTRACK2_SHARED:-}/$name" ]; then
        report "$name" "$GENTRACK2_SHARED/$name" --split "$split"
    else
        echo "SKIPPED: no report of $name, as GENTRACK2_SHARED does not name the measurement data"
    fi
done
# shellcheck disable=SC2086 # word splitting is meant
python3 eval/check_page.py --screenshots "$out/screenshots" $pages
