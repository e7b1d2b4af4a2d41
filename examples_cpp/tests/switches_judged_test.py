"""The identity switches that compare counts are those that TrackEval counts, on real sequences.

usage: switches_judged_test.py COMPARE GT2_MOT VENV-DIRECTORY REQUIREMENTS

The sequences are not part of the project; GENTRACK2_SHARED names the directory that has mot15/, mot17/ and
tools/eval_mot.py. Exit status 77 (skipped) where it is not set or TrackEval cannot be installed.
"""
import json
import os
import re
import subprocess
import sys
import tempfile

import own_venv

# Sequence, its detections, frames and size. The second has people on vehicles and distractors in its truth, which the
# judge leaves out together with the tracks that are on them.
SEQUENCES = (
    ("mot15/PETS09-S2L1", "det-frcnn.txt", 400, "768x576"),
    ("mot17/MOT17-05", "det-frcnn.txt", 400, "640x480"),
)
TRACKERS = ("gentrack2", "sort")


def run(*command):
    done = subprocess.run([str(x) for x in command], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def judged(shared, work, name):
    judge = (sys.executable, f"{shared}/tools/eval_mot.py")
    out = run(*judge, "--gt", f"{work}/gt", "--res", work, "--seq", name, "--json")
    # TrackEval may say before it which of its data sets lack a package.
    return json.loads(out.splitlines()[-1])[name]["IDSW"]


def main():
    compare, gt2_mot, directory, requirements = sys.argv[1:5]
    shared = os.environ.get("GENTRACK2_SHARED")
    if not shared:
        own_venv.skip("GENTRACK2_SHARED does not name the measurement data")
    own_venv.enter(directory, "--no-deps", "-r", requirements)
    total = 0
    for path, detections, frames, size in SEQUENCES:
        name = os.path.basename(path)
        with tempfile.TemporaryDirectory() as work:
            os.mkdir(f"{work}/gt")
            truth = f"{work}/gt/{name}.txt"
            with open(f"{shared}/{path}/gt.txt") as whole, open(truth, "w") as part:
                part.writelines(line for line in whole if int(line.split(",")[0]) <= frames)
            inputs = ("--det", f"{shared}/{path}/{detections}", "--size", size, "--frames", frames)
            lines = run(compare, "--left", TRACKERS[0], "--right", TRACKERS[1], *inputs, "--truth", truth,
                        "--out", f"{work}/both.avi").splitlines()
            for tracker, line in zip(TRACKERS, lines):
                run(gt2_mot, "--tracker", tracker, *inputs, "--out", f"{work}/{name}.txt")
                counted = int(re.search(r"(\d+) identity switches$", line)[1])
                expected = judged(shared, work, name)
                print(f"{name}, {tracker}: {counted} switches, {expected} by TrackEval", flush=True)
                assert counted == expected
                total += counted
    assert total > 20, "too few switches to say anything"


if __name__ == "__main__":
    main()
