"""The work that is done in parallel: to run a tracker, to judge its tracks, or both."""
import json
import os
import re
import subprocess
import tempfile

import judge as judge_module
import store


class Failed(Exception):
    """A program said that it could not do its work."""


def time_of(out):
    """The file beside a file of tracks that tells how long the tracker took."""
    return f"{out}.time"


def track(command, out):
    """Runs gt2_mot; its tracks are in the file `out` afterwards, and the time of its steps in time_of(out)."""
    os.makedirs(os.path.dirname(out), exist_ok=True)
    handle, part = tempfile.mkstemp(dir=os.path.dirname(out), suffix=".part")
    os.close(handle)
    try:
        done = subprocess.run([*command, "--time", "--out", part], capture_output=True, text=True)
        times = re.search(r"steps (\d+), .*median ([\d.]+) us", done.stderr)
        if done.returncode or not times:
            raise Failed(f"{' '.join(command)}\n{done.stderr.strip() or f'ended with {done.returncode}'}")
        store.write(time_of(out), json.dumps({"steps": int(times[1]), "median": float(times[2])}))
        os.replace(part, out)
    finally:
        if os.path.exists(part):
            os.remove(part)


def judge(out, *arguments):
    """Has a sequence judged; the result is in the file `out` afterwards."""
    store.write(out, json.dumps(judge_module.judge(*arguments)))


def score(out, command, truth, rules, metrics):
    """Runs gt2_mot and has its tracks judged, of which only the result is kept, in the file `out`."""
    with tempfile.TemporaryDirectory() as directory:
        tracks = f"{directory}/tracks.txt"
        track(command, tracks)
        store.write(out, json.dumps(judge_module.judge(truth, tracks, rules, metrics)))


def fingerprint(out, command):
    """Runs gt2_mot and keeps the hash of its tracks in the file `out`."""
    with tempfile.TemporaryDirectory() as directory:
        tracks = f"{directory}/tracks.txt"
        track(command, tracks)
        store.write(out, store.content(tracks))
