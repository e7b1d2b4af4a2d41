"""Tracks MOT17's detections with every tracker's default parameters and has TrackEval judge the results.

usage: mot17_accuracy_test.py PROGRAM VENV-DIRECTORY REQUIREMENTS

GenTrack2 must reach what it promises; the others' numbers are printed (that they are the published algorithms is for
the conformance tests to show). The sequences are not part of the project; GENTRACK2_SHARED names the directory that
has mot17/ and tools/eval_mot.py. Exit status 77 (skipped) where it is not set or TrackEval cannot be installed.
"""
import configparser
import json
import os
import subprocess
import sys
import tempfile

import own_venv

# The least that GenTrack2 must reach, and the most identity switches. Half: the second halves of all sequences, with
# camera motion. Humans: MOT17-04 in the paper's set-up, static persons counting too.
HALF = {"HOTA": 73.2, "IDF1": 86.0, "MOTA": 81.5, "ATA": 62.0}, 90
HUMANS = {"HOTA": 82.0, "IDF1": 92.5, "MOTA": 87.4, "ATA": 82.0}, 12

# Trackers with settings. SORT and DeepSORT leave it to their user to drop weak detections, and SORT's one frame of
# memory is for high frame rates.
TRACKERS = {
    "gentrack2": [],
    "sort": ["--set", "min_score=0.6", "--set", "max_age=30"],
    "deepsort": ["--set", "min_score=0.6"],
    "bytetrack": [],
    "botsort": [],
    "ocsort": [],
    "smiletrack": [],
    "conftrack": [],
}


def track(program, tracker, sequence, out, *more):
    """Runs the program on a sequence's directory; returns its line about times."""
    info = configparser.ConfigParser()
    info.read(os.path.join(sequence, "seqinfo.ini"))
    info = info["Sequence"]
    command = [program, "--tracker", tracker, *TRACKERS[tracker], "--det", f"{sequence}/det.txt", "--out", out, "--time",
               "--size", f"{info['imWidth']}x{info['imHeight']}", "--fps", info["frameRate"],
               "--frames", info["seqLength"], *more]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stderr.strip()


def score(shared, ground_truth, results, *options):
    command = [sys.executable, f"{shared}/tools/eval_mot.py", "--gt", ground_truth, "--res", results, "--json", *options]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    # TrackEval may say before it which of its data sets lack a package.
    return json.loads(done.stdout.splitlines()[-1])["COMBINED_SEQ"]


def measure(program, tracker, shared, names, work):
    """Scores of the second halves with and without camera motion and of MOT17-04; prints them."""
    for kind in ("with", "without"):
        os.makedirs(f"{work}/{tracker}/{kind}")
    with_motion, without = f"{work}/{tracker}/with", f"{work}/{tracker}/without"
    for name in names:
        sequence = f"{shared}/mot17/{name}"
        track(program, tracker, sequence, f"{with_motion}/{name}.txt", "--gmc", f"{sequence}/gmc.txt")
        times = track(program, tracker, sequence, f"{without}/{name}.txt")
        if name == "MOT17-04":
            print(f"{tracker}, MOT17-04:", times)
    half = score(shared, f"{work}/gt", with_motion, "--split", "half")
    still = score(shared, f"{work}/gt", without, "--split", "half")
    humans = score(shared, f"{work}/gt", without, "--split", "full", "--humans", "--seq", "MOT17-04")
    for what, got in (("half", half), ("half without camera motion", still), ("humans", humans)):
        values = ", ".join(f"{key} {got[key]:.2f}" for key in ("ATA", "IDF1", "HOTA", "MOTA", "IDSW"))
        print(f"{tracker}, {what}: {values}", flush=True)
    return half, humans


def main():
    program, directory, requirements = sys.argv[1:4]
    shared = os.environ.get("GENTRACK2_SHARED")
    if not shared:
        own_venv.skip("GENTRACK2_SHARED does not name the measurement data")
    own_venv.enter(directory, "--no-deps", "-r", requirements)
    names = sorted(name for name in os.listdir(f"{shared}/mot17") if name.startswith("MOT17-"))
    assert len(names) == 5, names
    with tempfile.TemporaryDirectory() as work:
        os.mkdir(f"{work}/gt")
        for name in names:
            os.symlink(f"{shared}/mot17/{name}/gt.txt", f"{work}/gt/{name}.txt")
        results = {tracker: measure(program, tracker, shared, names, work) for tracker in TRACKERS}
    for got, (least, switches) in zip(results["gentrack2"], (HALF, HUMANS)):
        assert all(got[key] >= bound for key, bound in least.items()), (got, least)
        assert got["IDSW"] <= switches, (got, switches)


if __name__ == "__main__":
    main()
