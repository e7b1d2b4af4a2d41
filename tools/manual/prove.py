#!/usr/bin/env python3
"""Shows that check.py notices mistakes: each is made in a small manual of its own.

    prove.py BUILD
"""
import contextlib
import io
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import check as manual

GOOD = {
    "README.md": "# One\n\n[two](docs/two.md#a-heading)\n\n```c\nint main(void) { return 0; }\n```\n",
    "PERFORMANCE.md": "# Speed\n\n### MOT17-04\n\n| | x |\n|---|---|\n| sort | 10.2 | 3 |\n\n### Growth\n\n"
                      "| sort: 21.7, 45, 121, 266, 579 | 1 |\n\n| sort: bytes per live track | 822 B |\n",
    "docs/two.md": "## A heading\n\n| parameter | default |\n|---|---|\n| `coast` | 18 |\n\n`coast=0`, `gt2_tracker_step`\n",
}

# What is added to docs/two.md, and what the check must say of it.
MISTAKES = {
    "a link to no file": ("[x](three.md)", "there is no such file"),
    "a link to no heading": ("[x](../README.md#three)", "no such heading"),
    "a link out of the repository": ("[x](../../x)", "leads out"),
    "a function that is not there": ("`gt2_tracker_walk`", "not in gentrack2.h"),
    "a constant that is not there": ("GT2_ERR_WEATHER", "not in gentrack2.h"),
    "a class that is not there": ("`gentrack2::Detektor`", "not in the headers"),
    "a parameter that is not there": ("`coastal_length`", "found nowhere"),
    "a setting that is not there": ("`cost_gates=0.3`", "no parameter"),
    "a value out of range": ("`birth_score=7`", "birth_score"),
    "a wrong default": ("| parameter | default |\n|---|---|\n| `coast` | 19 |", "the default is"),
    "a wrong one of two": ("| parameter of `x` | default |\n|---|---|\n| `coast`, `birth_iou` | 18, 1 |", "the default is"),
    "a default too few": ("| parameter | default |\n|---|---|\n| `coast`, `birth_iou` | 18 |", "1 defaults for 2"),
    "a time that was not measured": ("| name | µs/frame |\n|---|---|\n| `sort` | 9 |", "takes 10 µs"),
    "another time of many objects": ("| objects | `sort` |\n|---|---|\n| 1000 | 167 |", "takes 266 µs"),
    "a quoted size of nobody": ("| case | numbers |\n|---|---|\n| hardly any memory | 822 and 620 |", "620 is nobody's"),
    "a file that is not there": ("`tests/nothing.rs`", "no such file"),
    "a source file without that function": ("[`ageing::grow_old`](../src/trackers/gentrack2/ageing.rs)", "defines no"),
    "a block without a language": ("```\nx\n```", "nobody knows"),
    "a block of an unknown language": ("```cobol\nx\n```", "nobody knows"),
    "an indented block": ("text\n\n    make test", "fence it"),
    "C that does not compile": ("```c\nint main(void) { return nothing; }\n```", "ended with"),
    "C that warns": ("```c\nint main(void) { int unused; return 0; }\n```", "ended with"),
    "C that fails": ("```c\nint main(void) { return 1; }\n```", "ended with 1"),
    "a fragment of nowhere": ("```c\nint x;\n```", "neither a whole program"),
    "an excerpt of no file": ("<!-- manual: from examples_cpp/x.c -->\n```c\nint z;\n```", "there is no examples_cpp/x.c"),
    "an excerpt that is none": ("<!-- manual: from examples_cpp/plain_c.c -->\n```c\nint z;\n```", "do not stand so"),
    "C++ that does not compile in its place": (
        "<!-- manual: within tools/manual/frames/opencv.cpp -->\n```cpp\nnothing();\n```", "ended with"),
    "Rust that nobody tests": ("```rust\nlet x = 1;\n```", "documentation tests"),
    "a command that fails": ("```sh\nfalse\ntrue\n```", "ended with"),
    "a command that is not there": ("```sh\ngt2_mott --help\n```", "ended with"),
    "an option that is not there": ("```sh\ngt2_mot --trakker sort\n```", "ended with"),
    "output that is another": (
        "```sh\necho 1\n```\n\n<!-- manual: output -->\n```text\n2\n```", "the commands before print"),
    "commands that the script does not run": ("<!-- manual: run by .ci/run -->\n```sh\nmake tea\n```", "does not run"),
    "a measurement that is not there": (
        "<!-- manual: measured -->\n```sh\npython3 eval/nothing.py\n```", "ended with"),
    "a measurement of no set-up": (
        "<!-- manual: measured -->\n```sh\npython3 eval/evaluate.py --setups H,Z\n```", "unknown set-up"),
    "a marker that means nothing": ("<!-- manual: perhaps -->\n```sh\ntrue\n```", "means nothing"),
    "TOML that is none": ("```toml\n= 1\n```", "Invalid"),
    "TOML of no parameter": ("```toml\ncoastal = 1\n```", "coastal"),
    "JSON that is none": ("```json\n{1}\n```", "Expecting"),
    "no equation": ("```math\n\\frac{1}{\n```", "no equation"),
    "CMake that does not configure": ("```cmake\nfind_package(gentrack3 REQUIRED)\n```", "ended with"),
    "Python that fails": ("```python\nraise SystemExit(1)\n```", "ended with 1"),
}


def copy_of_repository(root):
    """What the checks look at, without the pages."""
    for name in ("include", "src", "tests/fixtures/oracles/synthetic", "examples_cpp", "tools", "eval", ".ci", "ctest"):
        shutil.copytree(manual.ROOT / name, root / name, symlinks=True, ignore=shutil.ignore_patterns("*.md", "*-venv"))
    shutil.copy(manual.ROOT / "Cargo.toml", root)
    os.mkdir(root / "docs")
    subprocess.run(["git", "init", "-q", root], check=True)
    subprocess.run(["git", "add", "-A"], cwd=root, check=True, capture_output=True)


def said(root, build):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        manual.check(root, build)
    return [message.strip() for message in out.getvalue().split("WRONG: ")[1:]]


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    manual.enter(build)
    with tempfile.TemporaryDirectory() as place:
        root = pathlib.Path(place)
        copy_of_repository(root)
        for name, text in GOOD.items():
            (root / name).write_text(text)
        if messages := said(root, build):
            sys.exit(f"a manual without mistakes is found wrong: {messages}")
        pages = {f"mistake{number}.md": mistake for number, (mistake, _) in enumerate(MISTAKES.values())}
        for name, mistake in pages.items():
            (root / "docs" / name).write_text(mistake + "\n")
        (root / "docs/stray.md").write_text("# Nobody links here\n")
        index = "".join(f"[mistake]({name})\n" for name in pages)
        (root / "docs/two.md").write_text(f"{GOOD['docs/two.md']}\n{index}")
        messages = said(root, build)
    expected = {f"docs/mistake{number}.md:": (title, words) for number, (title, (_, words)) in enumerate(MISTAKES.items())}
    expected["docs/stray.md:"] = ("a page that nobody finds", "no link leads here")
    unnoticed = [title for page, (title, words) in expected.items()
                 if not any(message.startswith(page) and words in message for message in messages)]
    strange = [message for message in messages if not message.startswith(tuple(expected))]
    print(f"{len(expected)} mistakes, {len(unnoticed)} of them not noticed")
    if unnoticed or strange:
        print("not noticed:", *unnoticed, "found wrong, and is not:", *strange, "all that was said:", *messages, sep="\n")
    sys.exit(bool(unnoticed or strange))


if __name__ == "__main__":
    main()
