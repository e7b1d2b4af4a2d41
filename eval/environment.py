"""The Python that has what these programs need; see requirements.txt."""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
sys.path[:0] = [HERE, os.path.join(ROOT, "examples_cpp", "tests")]
import own_venv  # noqa: E402

skip = own_venv.skip

# One core per process is what the parallel work is planned for.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def enter(what="eval"):
    """Starts the program again in the virtual environment, if it does not run there: that of the evaluation, or
    "check", that of what looks at its page."""
    directory = os.environ.get(f"GENTRACK2_{what.upper()}_VENV") or f"{ROOT}/build/{what}-venv"
    requirements = {"eval": "requirements.txt", "check": "requirements-check.txt"}[what]
    own_venv.enter(directory, "--no-deps", "-r", f"{HERE}/{requirements}")
