"""Python packages for a program, in a virtual environment of its own."""
import fcntl
import hashlib
import os
import subprocess
import sys
import venv

# What ctest takes as "skipped".
SKIPPED = 77


def skip(*reason):
    """Ends the program as skipped."""
    print("SKIPPED:", *reason)
    sys.exit(SKIPPED)


def stamp_of(requirements):
    """What a virtual environment with these is marked with: they, or, of those that are files, the contents."""
    digest = hashlib.sha256(repr(sys.version_info[:2]).encode())
    for each in requirements:
        if os.path.isfile(each):
            with open(each, "rb") as file:
                digest.update(file.read())
        else:
            digest.update(repr(each).encode())
    return digest.hexdigest()


def make(directory, requirements):
    """Makes the virtual environment, unless it is there with just these requirements."""
    mark, stamp = os.path.join(directory, "requirements.sha256"), stamp_of(requirements)
    os.makedirs(os.path.dirname(os.path.abspath(directory)), exist_ok=True)
    # Two programs may want it at the same time.
    with open(f"{directory}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if os.path.exists(mark):
            with open(mark) as file:
                if file.read() == stamp:
                    return
        print(f"installing Python packages into {directory}, once", file=sys.stderr, flush=True)
        venv.create(directory, with_pip=True, clear=True)
        install = [os.path.join(directory, "bin", "python"), "-m", "pip", "install", "--quiet",
                   "--disable-pip-version-check", *requirements]
        subprocess.run(install, check=True, capture_output=True, text=True)
        with open(mark, "w") as file:
            file.write(stamp)


def enter(directory, *requirements):
    """Runs this program again with the Python of a virtual environment in `directory` that has what pip is told to
    install; ends it as skipped if that cannot be installed."""
    if os.path.realpath(sys.prefix) == os.path.realpath(directory):
        return
    try:
        make(directory, requirements)
    except (OSError, subprocess.CalledProcessError) as error:
        reason = (getattr(error, "stderr", "") or str(error)).strip().splitlines()[-1:]
        what = " ".join(os.path.basename(each) for each in requirements if not each.startswith("-"))
        skip(f"Python's packages, {what}, cannot be installed:", *reason)
    python = os.path.join(directory, "bin", "python")
    sys.stdout.flush()
    os.execv(python, [python] + sys.argv)
