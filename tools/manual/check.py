#!/usr/bin/env python3
"""Checks the manual: its links and anchors, the names it mentions, times it quotes, and every block of code, which is
compiled, run or read; see blocks.py for how each is treated.

    check.py BUILD [PAGE...]     BUILD is CMake's build directory, with the library and the examples in it
"""
import os
import pathlib
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "examples_cpp/tests")]
import own_venv  # noqa: E402


def enter(build):
    """Starts this script again in a Python that has the parser of Markdown and the one of equations."""
    own_venv.enter(os.environ.get("GENTRACK2_MANUAL_VENV") or f"{build}/manual-venv", "--no-deps", "-r",
                   f"{ROOT}/tools/manual/requirements.txt")


def check(root, build, only=()):
    """Prints what is wrong and what was skipped; returns the numbers of both and of the blocks."""
    import blocks
    import figures
    import library
    import links
    import names
    import pages

    all_pages = pages.manual(root)
    chosen = [page for page in all_pages if not only or page.name in only]
    linked = all_pages + pages.beside(root)
    wrong = list(links.check(linked))
    wrong += [f"{name}: no link leads here from README.md" for name in links.unreachable(linked, all_pages[0])
              if name.startswith("docs/")]
    built = library.Library(build / "lib/libgentrack2.so")
    known = names.Names(root, built)
    for page in chosen:
        wrong += known.check(page)
        wrong += [f"{page.name}:{line}: an indented block of code; fence it, with its language" for line in page.unfenced]
    if (root / figures.SOURCE).exists():
        wrong += figures.check(chosen, (root / figures.SOURCE).read_text())
    skipped, count = [], 0
    with tempfile.TemporaryDirectory(prefix="gentrack2-manual-") as scratch:
        scratch = pathlib.Path(scratch)
        blocks.prepare(scratch, root, build, all_pages)
        runner = blocks.Runner(root, build, scratch, built)
        for block in (block for page in chosen for block in page.blocks):
            count += 1
            start = time.monotonic()
            try:
                runner.run(block)
            except blocks.Skipped as reason:
                skipped.append(f"{block}: {reason}")
            except blocks.Wrong as error:
                wrong.append(f"{block}: {error}")
            took = time.monotonic() - start
            if took > 5:
                print(f"{block}: took {took:.0f} s")
    for line in skipped:
        print(f"not run: {line}")
    for line in wrong:
        print(f"WRONG: {line}")
    return len(wrong), len(skipped), count, sum(len(page.links) for page in linked)


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    enter(build)
    start = time.monotonic()
    wrong, skipped, count, followed = check(ROOT, build, sys.argv[2:])
    print(f"{count} blocks, {skipped} of them not run; {followed} links; {wrong} mistakes; "
          f"{time.monotonic() - start:.0f} s")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
