#!/usr/bin/env python3
"""The notices of what is compiled into the library: whoever hands the library on must hand them on, too.

    tools/notices.py write    writes LICENSE-THIRD-PARTY anew, after a change of the dependencies
    tools/notices.py check    sees that it is what the crates in Cargo.lock ask for (run by `make test`)

Each crate's licence is copied from the crate itself, MIT where it gives the choice.
"""

import json
import re
import subprocess
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FILE = ROOT / "LICENSE-THIRD-PARTY"
MACHINES = ("x86_64-unknown-linux-gnu", "aarch64-unknown-linux-gnu", "armv7-unknown-linux-gnueabihf")
RULE = "-" * 80 + "\n"

HEAD = """\
What libgentrack2 is made of besides its own code. The crates are named with their version and the licences that they
offer, and followed by the text of the one that is taken.

Rust's standard library, of the compiler that made this copy, is Copyright (c) The Rust Project Contributors and
licensed under MIT or Apache-2.0, whose texts are below; the notices of the crates within it come with Rust as
COPYRIGHT-library.html.

"""


def cargo(*arguments):
    command = ["cargo", *arguments, "--locked"]
    return subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout


def linked_crates():
    """Name, version, licences and directory of each crate that may become a part of the library."""
    linked, packages = set(), {}
    for machine in MACHINES:
        tree = cargo("tree", "--edges", "normal,no-proc-macro", "--prefix", "none", "--format", "{p}", "--target", machine)
        linked |= set(re.findall(r"^(\S+) v(\S+)", tree, re.M))
        for package in json.loads(cargo("metadata", "--format-version", "1", "--filter-platform", machine))["packages"]:
            packages[package["name"], package["version"]] = package
    for name, version in sorted(linked):
        package = packages[name, version]
        if package["source"] is not None:
            yield name, version, package["license"], Path(package["manifest_path"]).parent


def licence_files(directory, licences):
    """The one licence that is taken, and what Apache-2.0 wants to have handed on with it."""
    files = sorted(f for f in directory.iterdir() if re.match("licen[cs]e|copying", f.name, re.I))
    if "MIT" in licences:
        files = [f for f in files if "mit" in f.name.lower()] or files
    if len(files) != 1:
        sys.exit(f"{directory.name}: which is its licence ({licences})? {[f.name for f in files]}")
    return files + sorted(f for f in directory.iterdir() if f.name.upper().startswith("NOTICE"))


def notices():
    crates_of = {}
    for name, version, licences, directory in linked_crates():
        for file in licence_files(directory, licences):
            lines = file.read_text(encoding="utf-8").strip().splitlines()
            text = "\n".join(textwrap.fill(line, 120) if len(line) > 120 else line.rstrip() for line in lines)
            crates_of.setdefault(text, []).append(f"{name} {version} ({licences})")
    if len(crates_of) < 10:
        sys.exit(f"only {len(crates_of)} licences found")
    return HEAD + "\n".join(RULE + "\n".join(crates) + f"\n\n{text}\n" for text, crates in crates_of.items())


if __name__ == "__main__":
    if sys.argv[1:] == ["write"]:
        FILE.write_text(notices(), encoding="utf-8")
    elif sys.argv[1:] == ["check"]:
        if FILE.read_text(encoding="utf-8") != notices():
            sys.exit(f"{FILE.name} is not what the crates ask for: tools/notices.py write")
        print(f"{FILE.name} has the notices of {len(list(linked_crates()))} crates")
    else:
        sys.exit(__doc__)
