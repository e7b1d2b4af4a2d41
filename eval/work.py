"""The two kinds of work that are done in parallel: to run a tracker and to judge its tracks."""
import contextlib
import functools
import io
import json
import os
import subprocess
import sys
import tempfile

import store


class Failed(Exception):
    """A program said that it could not do its work."""


def track(command, out):
    """Runs gt2_mot; its tracks are in the file `out` afterwards."""
    os.makedirs(os.path.dirname(out), exist_ok=True)
    handle, part = tempfile.mkstemp(dir=os.path.dirname(out), suffix=".part")
    os.close(handle)
    try:
        done = subprocess.run([*command, "--out", part], capture_output=True, text=True)
        if done.returncode:
            raise Failed(f"{' '.join(command)}\n{done.stderr.strip() or f'ended with {done.returncode}'}")
        os.replace(part, out)
    finally:
        if os.path.exists(part):
            os.remove(part)


@functools.lru_cache(maxsize=None)
def script(path):
    with open(path) as file:
        return compile(file.read(), path, "exec")


def judge(path, ground_truth, tracks, options):
    """The judge's table: a dictionary per sequence and for all together. The script is executed in this process, where
    TrackEval is imported only once; files are given by sequence."""
    with tempfile.TemporaryDirectory() as work:
        for kind, files in (("gt", ground_truth), ("res", tracks)):
            os.mkdir(f"{work}/{kind}")
            for name, file in files.items():
                os.symlink(os.path.abspath(file), f"{work}/{kind}/{name}.txt")
        arguments, output = sys.argv, io.StringIO()
        sys.argv = [path, "--gt", f"{work}/gt", "--res", f"{work}/res", "--json", *options]
        try:
            with contextlib.redirect_stdout(output):
                exec(script(path), {"__name__": "__main__", "__file__": path})
        except SystemExit as end:
            if end.code:
                raise Failed(f"{path}: {end.code}") from None
        finally:
            sys.argv = arguments
    return json.loads(output.getvalue().strip().splitlines()[-1])


def judge_into(out, *arguments):
    store.write(out, json.dumps(judge(*arguments)))
