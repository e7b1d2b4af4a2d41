#!/usr/bin/env python3
"""Keeps the binary interface: what programs were compiled against must go on working.

    tools/abi.py check    the header against the recorded interface of its GT2_ABI_VERSION (run by `make test`)
    tools/abi.py record   records the interface anew, after additions and before a release
    tools/abi.py prove    shows that the check notices mistakes, and lets additions pass (run by `make test`)

The record is ctest/abi/VERSION/: `interface.abi`, an abidw dump of a shared object compiled from the header with an empty
body for each function, and `constants.txt`, the values of all constants. Functions and constants may be added, and fields
at the end of structs, all of which come with their size or stride; whatever else changes needs a new GT2_ABI_VERSION, which is in the
SONAME. CONTRIBUTING says how to add what without that.
"""

import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADER = ROOT / "include" / "gentrack2.h"
RECORDS = ROOT / "ctest" / "abi"
COMPILER = "gcc"


def run(*command, **options):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True, **options).stdout


def version_of(header):
    return int(re.search(r"^#define GT2_ABI_VERSION (\d+)$", header.read_text(), re.M)[1])


def witness(header, folder):
    """The dump of a shared object with the header's types and functions."""
    folder = Path(folder)
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", header.read_text(), flags=re.S)
    text = re.sub(r"^#(?:.*\\\n)*.*$", "", text, flags=re.M)
    functions = re.findall(r"^(?!static)(\w[\w *]*\bgt2_\w+\([^;{}]*\));", text, flags=re.M)
    if len(functions) < 30:
        sys.exit(f"{header}: only {len(functions)} functions found")
    source = folder / "witness.c"
    bodies = "\n".join(f"{f} {{ __builtin_trap(); }}" for f in functions)
    source.write_text(f'#include "{header}"\n{bodies}\n')
    library = folder / "witness.so"
    run(COMPILER, "-std=c99", "-g", "-O0", "-shared", "-fPIC", source, "-o", library,
        f"-Wl,-soname,libgentrack2.so.{version_of(header)}")
    dump = folder / "interface.abi"
    run("abidw", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", library, "--out-file", dump)
    return dump


# They say which version it is, and are meant to change.
OWN_VERSION = ("GT2_VERSION", "GT2_VERSION_MAJOR", "GT2_VERSION_MINOR", "GT2_VERSION_PATCH")


def constants(header):
    macros = run(COMPILER, "-std=c99", "-dM", "-E", header)
    found = dict(re.findall(r"^#define (GT2_\w+) (\S.*)$", macros, re.M))
    return {k: v for k, v in found.items() if k not in OWN_VERSION and not k.endswith("_INIT")}


def recorded_constants(record):
    return dict(line.split(" ", 1) for line in (record / "constants.txt").read_text().splitlines())


def layouts(dump):
    """By name of a struct its size and the names of its fields."""
    structs = {}
    for struct in xml.parse(dump).iter("class-decl"):
        if struct.get("size-in-bits"):
            fields = [field.get("name") for field in struct.findall("data-member/var-decl")]
            structs[struct.get("name")] = (int(struct.get("size-in-bits")), fields)
    return structs


def without_additions(header, record, folder):
    """The header less the fields at the end of structs that the record does not have, and what is wrong with those."""
    was, now = layouts(record / "interface.abi"), layouts(witness(header, folder))
    text, wrong = header.read_text(), []
    for name, (size, fields) in was.items():
        new_size, new_fields = now.get(name, (size, fields))
        added = new_fields[len(fields):]
        if not added or new_fields[:len(fields)] != fields:
            continue
        if new_size == size:
            # Programs of either header would give the same struct_size.
            wrong.append(f"{name}: {added[0]} lies where the struct was padded; add a field that makes it larger")
        start = text.index(f"typedef struct {name} {{")
        end = text.index(f"}} {name};", start)
        body = text[start:end]
        for field in added:
            body = re.sub(rf"^[^/\n]*\b{field}(\[\w+\])*;$", "", body, flags=re.M)
        text = text[:start] + body + text[end:]
    reduced = Path(folder) / "reduced.h"
    reduced.write_text(text)
    return reduced, wrong


def differences(header, record):
    """What a program compiled before would stumble over, as text; empty if there is nothing."""
    now = constants(header)
    found = [f"{name} was {value} and is {now.get(name, 'gone')}"
             for name, value in recorded_constants(record).items() if now.get(name) != value]
    with tempfile.TemporaryDirectory() as folder:
        reduced, wrong = without_additions(header, record, folder)
        result = subprocess.run(["abidiff", "--no-added-syms", record / "interface.abi", witness(reduced, folder)],
                                capture_output=True, text=True)
        if result.returncode != 0:
            wrong.append(result.stdout + result.stderr)
    return "\n".join(found + wrong)


def check():
    version = version_of(HEADER)
    record = RECORDS / str(version)
    if not record.is_dir():
        sys.exit(f"no record of ABI {version}: tools/abi.py record")
    wrong = differences(HEADER, record)
    if wrong:
        sys.exit(f"{wrong}\nThe interface has changed for programs compiled before. Undo that, or raise GT2_ABI_VERSION "
                 "(CONTRIBUTING, \"Keep the ABI\").")
    print(f"ABI {version}: all that was recorded is as it was, {len(constants(HEADER))} constants")


def write_record(header, record):
    record.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        (record / "interface.abi").write_text(witness(header, folder).read_text())
    lines = (f"{name} {value}\n" for name, value in sorted(constants(header).items()))
    (record / "constants.txt").write_text("".join(lines))


def record():
    record = RECORDS / str(version_of(HEADER))
    wrong = (record / "interface.abi").exists() and differences(HEADER, record)
    if wrong:
        sys.exit(f"{wrong}\nnot recorded: the interface has changed")
    write_record(HEADER, record)


# Edits of the header: what is replaced, by what, and whether programs compiled before could live with it.
EDITS = {
    "a function is added": ("uint32_t gt2_abi_version(void);", "uint32_t gt2_abi_version(void);\nint gt2_new(void);", True),
    "a constant is added": ("#define GT2_OK 0", "#define GT2_OK 0\n#define GT2_ERR_NEW -99", True),
    "a field at the end": ("    int32_t detector_skipped;\n", "    int32_t detector_skipped;\n    double added;\n", True),
    "a field at the end of a track": ("    uint32_t reserved;\n} gt2_track;", "    uint32_t reserved;\n    double added;\n} gt2_track;", True),
    "an array at the end": (
        "    int32_t detector_skipped;\n", "    int32_t detector_skipped;\n    double added[2][3];\n", True),
    "a function is gone": ("uint32_t gt2_abi_version(void);", "", False),
    "a status has another number": ("#define GT2_ERR_PANIC -7", "#define GT2_ERR_PANIC -77", False),
    "a constant is gone": ("#define GT2_PIXEL_NV12 5", "", False),
    "a field in the middle": ("    size_t detection_count;\n", "    double added;\n    size_t detection_count;\n", False),
    "a field of another type": ("    int32_t detector_skipped;", "    float detector_skipped;", False),
    "a field of another size": ("    int64_t timestamp_ns;", "    int32_t timestamp_ns;", False),
    "another type and a field at the end": (
        "    int32_t detector_skipped;\n", "    uint8_t detector_skipped;\n    double added;\n", False),
    "fields change places": ("    double velocity_u;", "    int64_t velocity_u;", False),
    "an argument is added": ("gt2_config_parameter_count(const struct gt2_config *config)",
                             "gt2_config_parameter_count(const struct gt2_config *config, int more)", False),
    "an argument of another type": ("gt2_status_str(gt2_status status)", "gt2_status_str(int64_t status)", False),
    "another result": ("uint32_t gt2_abi_version(void);", "uint64_t gt2_abi_version(void);", False),
    "a field at the end of a particle": ("    double fitness;\n", "    double fitness;\n    double added;\n", True),
    "a field is gone": ("    int32_t reserved;\n} gt2_image;", "} gt2_image;", False),
}


def prove():
    original = HEADER.read_text()
    record = RECORDS / str(version_of(HEADER))
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        edited = Path(folder) / "gentrack2.h"
        for what, (old, new, harmless) in EDITS.items():
            if old not in original:
                sys.exit(f"{what}: \"{old.strip()}\" is not in the header any more")
            edited.write_text(original.replace(old, new, 1))
            found = differences(edited, record)
            if (found == "") != harmless:
                wrong.append(f"{what}: {found or 'not noticed'}")
        # A struct that ends in padding, which then becomes a field.
        edited.write_text(original.replace("    int32_t reserved;\n} gt2_image;", "} gt2_image;"))
        write_record(edited, Path(folder) / "padded")
        if "was padded" not in differences(HEADER, Path(folder) / "padded"):
            wrong.append("a field where a struct was padded: not noticed")
    print(*wrong, f"{len(EDITS) + 1 - len(wrong)} of {len(EDITS) + 1} edits of the header judged rightly", sep="\n")
    sys.exit(len(wrong) != 0)


if __name__ == "__main__":
    commands = {"check": check, "record": record, "prove": prove}
    if len(sys.argv) != 2 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]]()
