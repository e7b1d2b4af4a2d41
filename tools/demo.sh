#!/bin/sh
# Tracks the people of OpenCV's sample video and says what came out; run by `make demo`.
set -eu

out=out
program=build/examples_cpp/gt2_mot
detections=$out/demo-det.txt

mkdir -p "$out"
video=$(tools/sample-video.sh "$out")

# Detection is the slow part and the same every time, so a result younger than the program is used again.
if [ -s "$detections" ] && [ -n "$(find "$detections" -newer "$program")" ]; then
    echo "using the detections of the last run: $detections"
    source="--det $detections"
else
    echo "detecting people in $video (about two minutes on two idle cores)"
    # Nobody in this view is taller than 140 pixels; the detector also sees giants in the shapes of two people.
    source="--detector hog --max-height 160 --save-det $detections.part"
fi

# DEMO_LAYERS='--particles --neighbours' draws these, too.
# shellcheck disable=SC2086 # both are several words, or none
"$program" --tracker gentrack2 $source --video "$video" --out "$out/demo.txt" --annotate "$out/demo.mp4" \
    ${DEMO_LAYERS:-} --sheet "$out/demo.png" --sheet-frames "${DEMO_FRAMES:-268,280,292,304,316,328}"
if [ -e "$detections.part" ]; then mv "$detections.part" "$detections"; fi

# time_of OPTIONS... : the line of --time for the tracker alone, on the stored detections.
time_of() { "$program" --tracker gentrack2 --det "$detections" --out /dev/null --time "$@" 2>&1 >/dev/null; }

# The video's size and rate are those of the run with images; 10 frames per second and 768x576 are vtest.avi's.
with_hog=$(time_of --video "$video")
without_hog=$(time_of --size 768x576 --fps 10)
microseconds() { printf '%s\n' "$1" | sed 's/.*mean \([0-9.]*\) us.*/\1/'; }

frames=$(printf '%s\n' "$with_hog" | sed 's/.*steps \([0-9]*\).*/\1/')
tracks=$(cut -d, -f2 "$out/demo.txt" | sort -u | wc -l)
rows=$(wc -l <"$out/demo.txt")

cat <<SUMMARY

frames                     $frames
tracks                     $tracks, in $rows boxes
mean step with HOG         $(microseconds "$with_hog") us
mean step without HOG      $(microseconds "$without_hog") us
video                      $out/demo.mp4
six frames of it           $out/demo.png
tracks (MOTChallenge)      $out/demo.txt
detections                 $detections
SUMMARY
