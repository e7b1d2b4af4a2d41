"""Runs gstreamer_appsink on a video file.

usage: gstreamer_test.py PROGRAM-DIRECTORY SCRATCH-DIRECTORY made-up|people

made-up: two squares that pass each other, in a file that this test writes.
people:  OpenCV's sample video, with the detections and beside the tracks of gt2_mot, which reads it through OpenCV.
Exit status 77 (skipped) if that video cannot be had, or GStreamer cannot play it.
"""
import os
import struct
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict

from short_examples_test import FRAMES, HEIGHT, SIDE, WIDTH, luma, squares

PEOPLE_FRAMES = 60


def chunk(name, content):
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


def group(name, content):
    return chunk(b"LIST", name + content)


def write_avi(path, rate):
    """Uncompressed I420."""
    size = WIDTH * HEIGHT * 3 // 2
    main = struct.pack("<14I", 1000000 // rate, size * rate, 0, 0, FRAMES, 0, 1, size, WIDTH, HEIGHT, 0, 0, 0, 0)
    stream = b"vidsI420" + struct.pack("<10I4H", 0, 0, 0, 1, rate, 0, FRAMES, size, 0, 0, 0, 0, WIDTH, HEIGHT)
    picture = struct.pack("<IiiHH4sIiiII", 40, WIDTH, HEIGHT, 1, 12, b"I420", size, 0, 0, 0, 0)
    header = group(b"hdrl", chunk(b"avih", main) + group(b"strl", chunk(b"strh", stream) + chunk(b"strf", picture)))
    frames = b"".join(chunk(b"00db", luma(t) + bytes([128]) * (WIDTH * HEIGHT // 2)) for t in range(FRAMES))
    with open(path, "wb") as file:
        file.write(chunk(b"RIFF", b"AVI " + header + group(b"movi", frames)))


def run(program, *arguments):
    path = os.path.join(sys.argv[1], program)
    return subprocess.run([path, *arguments], check=True, stdout=subprocess.PIPE, text=True, timeout=300).stdout


def rows_of(text):
    """frame -> [(identity, (left, top, width, height))]"""
    rows = defaultdict(list)
    for line in text.splitlines():
        frame, identity, *box = [float(x) for x in line.split(",")[:6]]
        rows[int(frame)].append((int(identity), box))
    return rows


def made_up(folder):
    video, det = os.path.join(folder, "squares.avi"), os.path.join(folder, "det.txt")
    write_avi(video, 25)
    with open(det, "w") as file:
        for t in range(FRAMES):
            for left, top, _ in squares(t):
                file.write(f"{t + 1},-1,{left},{top},{SIDE},{SIDE},0.9,-1,-1,-1\n")
    rows = rows_of(run("gstreamer_appsink", video, det))
    assert set(rows) <= set(range(1, FRAMES + 1)), sorted(rows)
    kept = defaultdict(list)
    for frame, tracks in rows.items():
        for k, (left, top, _) in enumerate(squares(frame - 1)):
            kept[k] += [identity for identity, box in tracks if abs(box[0] - left) < 3 and abs(box[1] - top) < 3]
    for k in range(2):
        assert len(set(kept[k])) == 1 and len(kept[k]) > FRAMES - 5, f"square {k} was {kept[k]}"
    assert kept[0][0] != kept[1][0]
    print(f"two squares kept as {kept[0][0]} and {kept[1][0]} in {len(rows)} frames")

    # What is no video is an error, not a hang or an empty success.
    for bad in (det, os.path.join(folder, "gone.avi")):
        command = [os.path.join(sys.argv[1], "gstreamer_appsink"), bad, det]
        done = subprocess.run(command, capture_output=True, timeout=60)
        assert done.returncode == 1 and done.stderr and not done.stdout, (bad, done)


def people(folder):
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
    fetch = [os.path.join(root, "tools", "sample-video.sh"), sys.argv[2]]
    found = subprocess.run(fetch, stdout=subprocess.PIPE, text=True)
    if found.returncode or subprocess.run(["gst-inspect-1.0", "--exists", "avdec_msmpeg4"]).returncode:
        print("skipped: " + ("no sample video" if found.returncode else "no decoder (Debian: gstreamer1.0-libav)"))
        sys.exit(77)
    video, det = found.stdout.strip(), os.path.join(folder, "det.txt")
    expected = rows_of(run("gt2_mot", "--tracker", "gentrack2", "--video", video, "--frames", str(PEOPLE_FRAMES),
                           "--detector", "hog", "--max-height", "160", "--save-det", det, "--out", "-"))
    said = rows_of(run("gstreamer_appsink", video, det))
    said = {frame: tracks for frame, tracks in said.items() if frame <= PEOPLE_FRAMES}

    # Other decoders and conversions of colours move a box by a fraction of a pixel and may tip a decision now and then.
    ours, theirs = sum(map(len, said.values())), sum(map(len, expected.values()))
    pairs = Counter()
    for frame, tracks in said.items():
        for identity, box in tracks:
            pairs.update((identity, other) for other, its in expected[frame]
                         if max(abs(a - b) for a, b in zip(box, its)) < 2)
    partners = {}
    for (identity, other), count in pairs.most_common():
        if identity not in partners and other not in partners.values():
            partners[identity] = other
    same = sum(pairs[pair] for pair in partners.items())
    lasting = [i for i in partners if pairs[i, partners[i]] >= PEOPLE_FRAMES // 3]
    print(f"{ours} boxes, {theirs} through OpenCV, {same} alike in box and identity; "
          f"{len(lasting)} people followed for a third of the time")
    assert min(ours, theirs) > 150 and same > 0.95 * max(ours, theirs)
    assert len(lasting) >= 3


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        {"made-up": made_up, "people": people}[sys.argv[3]](scratch)
