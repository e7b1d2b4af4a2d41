"""Tracks MOT17's detections with the default parameters and has TrackEval judge the result.

usage: mot17_accuracy_test.py PROGRAM VENV-DIRECTORY

The sequences are not part of the project; GENTRACK2_SHARED names the directory that has mot17/ and tools/eval_mot.py.
Exit status 77 (skipped) where it is not set or TrackEval cannot be installed.
"""
import configparser
import json
import os
import subprocess
import sys
import tempfile

import own_venv

# The least that the defaults must reach. Half: the second halves of all sequences, with camera motion. Humans:
# MOT17-04 in the paper's set-up, static persons counting too.
HALF = {"HOTA": 70.5, "IDF1": 82.5}
HUMANS = {"HOTA": 80.5, "IDF1": 90.5}


def track(program, sequence, out, *more):
    """Runs the program on a sequence's directory; returns its line about times."""
    info = configparser.ConfigParser()
    info.read(os.path.join(sequence, "seqinfo.ini"))
    info = info["Sequence"]
    command = [program, "--tracker", "gentrack2", "--det", f"{sequence}/det.txt", "--out", out, "--time",
               "--size", f"{info['imWidth']}x{info['imHeight']}", "--fps", info["frameRate"],
               "--frames", info["seqLength"], *more]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stderr.strip()


def score(shared, ground_truth, results, *options):
    command = [sys.executable, f"{shared}/tools/eval_mot.py", "--gt", ground_truth, "--res", results, "--json", *options]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)["COMBINED_SEQ"]


def main():
    program, directory = sys.argv[1:3]
    shared = os.environ.get("GENTRACK2_SHARED")
    if not shared:
        own_venv.skip("GENTRACK2_SHARED does not name the measurement data")
    own_venv.enter(directory, "trackeval")
    names = sorted(name for name in os.listdir(f"{shared}/mot17") if name.startswith("MOT17-"))
    assert len(names) == 5, names
    with tempfile.TemporaryDirectory() as work:
        for kind in ("gt", "with", "without"):
            os.mkdir(f"{work}/{kind}")
        for name in names:
            sequence = f"{shared}/mot17/{name}"
            os.symlink(f"{sequence}/gt.txt", f"{work}/gt/{name}.txt")
            track(program, sequence, f"{work}/with/{name}.txt", "--gmc", f"{sequence}/gmc.txt")
            times = track(program, sequence, f"{work}/without/{name}.txt")
            if name == "MOT17-04":
                print("MOT17-04:", times)
        half = score(shared, f"{work}/gt", f"{work}/with", "--split", "half")
        still = score(shared, f"{work}/gt", f"{work}/without", "--split", "half")
        humans = score(shared, f"{work}/gt", f"{work}/without", "--split", "full", "--humans", "--seq", "MOT17-04")
    for what, got in (("half", half), ("half without camera motion", still), ("humans", humans)):
        print(what + ":", ", ".join(f"{key} {got[key]:.2f}" for key in ("ATA", "IDF1", "HOTA", "MOTA", "IDSW")))
    for got, least in ((half, HALF), (humans, HUMANS)):
        assert all(got[key] >= bound for key, bound in least.items()), (got, least)


if __name__ == "__main__":
    main()
