"""A Python package for a test, in a virtual environment of its own."""
import os
import subprocess
import sys
import venv

# What ctest takes as "skipped".
SKIPPED = 77


def skip(*reason):
    """Ends the test as skipped."""
    print("SKIPPED:", *reason)
    sys.exit(SKIPPED)


def enter(directory, package):
    """Runs this script again with the Python of a virtual environment in `directory` that has the package; skips the
    test if it cannot be installed."""
    python = os.path.join(directory, "bin", "python")
    if os.path.realpath(sys.prefix) == os.path.realpath(directory):
        return
    has_package = [python, "-c", f"import {package}"]
    if not os.path.exists(python) or subprocess.run(has_package, capture_output=True).returncode:
        try:
            venv.create(directory, with_pip=True, clear=True)
            install = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", package]
            subprocess.run(install, check=True, capture_output=True, text=True)
        except (OSError, subprocess.CalledProcessError) as error:
            reason = (getattr(error, "stderr", "") or str(error)).strip().splitlines()[-1:]
            skip(f"Python's {package} package cannot be installed:", *reason)
    os.execv(python, [python] + sys.argv)
