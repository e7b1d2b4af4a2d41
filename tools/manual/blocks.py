"""Every fenced block of the manual is compiled, run or read; what becomes of each is decided by its language and by a
marker in the line before it:

    <!-- manual: from FILE -->        an excerpt: these lines stand together in FILE, which the build compiles
    <!-- manual: within FILE -->      compiled in the place of FILE's line `@BLOCK@`
    <!-- manual: run by FILE -->      commands that stand in FILE, a script that runs elsewhere
    <!-- manual: in the repository --> commands that need the checkout itself; what they install is caught by DESTDIR
    <!-- manual: output -->           what the commands, or the program, before print, exactly
    <!-- manual: measured -->         commands that measure on the data sets: run on their first frames, in a copy of what
                                      they write to; skipped where there is no data
    <!-- manual: not run: REASON -->  counted as skipped

Without a marker, programs are compiled and run, commands run in a directory with a few small files, TOML is read by the
library, JSON parsed, equations turned into MathML, CMake's lines built as a project. A language that is not known here,
or none, is an error.
"""
import itertools
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import textwrap
import tomllib

import latex2mathml.converter
import own_venv
import shortened

STRICT = ["-Wall", "-Wextra", "-Werror"]
LIMIT = 300


class Wrong(Exception):
    """A block is not what it should be."""


class Skipped(Exception):
    """A block that is not run, and why."""


def shown(done):
    return "\n".join(filter(None, [done.stdout.strip(), done.stderr.strip()]))[-1500:]


class Runner:
    """Takes the blocks of all pages in their order."""

    def __init__(self, root, build, scratch, library):
        self.root, self.build, self.scratch, self.library = root, build, scratch, library
        self.numbers = itertools.count()
        self.printed = None
        self.has_rustdoc = set(re.findall(r'include_str!\("\.\./([^"]+)"\)', (root / "src/lib.rs").read_text()))
        self.environment = {**os.environ, "PATH": f"{build}/examples_cpp:{os.environ['PATH']}",
                            "LD_LIBRARY_PATH": f"{build}/lib", "DESTDIR": str(scratch / "stage"),
                            "CARGO_TARGET_DIR": str(root / "target")}

    def run(self, block):
        """Raises Wrong or Skipped."""
        languages = {"c": self.compiled, "cpp": self.compiled, "rust": self.rust, "sh": self.commands,
                     "python": self.python, "toml": self.toml, "json": self.json, "cmake": self.cmake,
                     "math": self.math, "text": self.text}
        if block.language not in languages:
            raise Wrong(f"nobody knows what to do with a block of language '{block.language}'")
        kind, _, rest = (block.marker or "").partition(": ")
        if kind == "not run":
            raise Skipped(rest)
        verb, _, name = (block.marker or "").rpartition(" ")
        if verb == "from":
            self.excerpt(block, name)
        elif verb == "run by":
            self.run_by(block, name)
        else:
            languages[block.language](block)

    def only(self, block, *markers):
        if block.marker is not None and block.marker not in markers:
            raise Wrong(f"a marker that means nothing here: {block.marker}")

    def call(self, command, **options):
        options = {"cwd": self.scratch, "env": self.environment, **options}
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True,
                              start_new_session=True, **options) as process:
            try:
                out, errors = process.communicate(timeout=LIMIT)
            except subprocess.TimeoutExpired:
                # What it started goes with it.
                os.killpg(process.pid, signal.SIGKILL)
                raise Wrong(f"took longer than {LIMIT} seconds: {command}") from None
        return subprocess.CompletedProcess(command, process.returncode, out, errors)

    def demand(self, command, **options):
        done = self.call(command, **options)
        if done.returncode:
            raise Wrong(f"{shlex.join(map(str, command))} ended with {done.returncode}\n{shown(done)}")
        return done

    def read(self, name):
        if not (self.root / name).is_file():
            raise Wrong(f"there is no {name}")
        return (self.root / name).read_text()

    # --- excerpts ------------------------------------------------------------------------------------------------

    def excerpt(self, block, name):
        """All lines stand together in the file, however far they are indented there."""
        wanted = lines_of(block.text)
        source = self.read(name).split("\n")
        for start in range(len(source) - len(wanted) + 1):
            if lines_of("\n".join(source[start:start + len(wanted)])) == wanted:
                return
        raise Wrong(f"these lines do not stand so in {name}")

    def run_by(self, block, name):
        script = [words(command) for command in commands(self.read(name))]
        for command in commands(block.text):
            if words(command) not in script:
                raise Wrong(f"{name} does not run: {command}")

    # --- languages -----------------------------------------------------------------------------------------------

    def compiled(self, block):
        text, suffix = block.text, block.language
        compiler, standard = (["cc"], "-std=c99") if suffix == "c" else (["c++"], "-std=c++17")
        within = (block.marker or "").removeprefix("within ")
        if block.marker is not None and block.marker == f"within {within}":
            frame = self.read(within)
            if "@BLOCK@" not in frame:
                raise Wrong(f"{within} has no line @BLOCK@")
            text = frame.replace("@BLOCK@", text)
        else:
            self.only(block)
            if not re.search(r"\bint main\(", text):
                raise Wrong("neither a whole program nor marked as from or within a file")
        source = self.scratch / f"block{next(self.numbers)}.{suffix}"
        source.write_text(text)
        command = [*compiler, standard, *STRICT, f"-I{self.root}/include", *self.opencv(text), str(source)]
        if within:
            self.demand([*command, "-fsyntax-only"])
            return
        self.demand([*command, f"-L{self.build}/lib", "-lgentrack2", "-o", str(source.with_suffix(""))])
        self.printed = self.demand([str(source.with_suffix(""))]).stdout

    def opencv(self, text):
        if "opencv" not in text:
            return []
        flags = self.demand(["pkg-config", "--cflags", "opencv4"]).stdout.split()
        return ["-isystem" + flag[2:] if flag.startswith("-I") else flag for flag in flags]

    def rust(self, block):
        self.only(block)
        if block.page.name not in self.has_rustdoc:
            raise Wrong(f"src/lib.rs does not include {block.page.name} in its documentation tests")

    def commands(self, block):
        if block.marker == "measured":
            return self.measured(block)
        self.only(block, "in the repository")
        where = self.root if block.marker else self.scratch
        done = self.demand(["sh", "-euc", block.text], cwd=where)
        self.printed = done.stdout

    def measured(self, block):
        """Each command for itself: without data they end as skipped, once they have read their options."""
        place, environment = self.scratch / "measuring", dict(self.environment)
        if not place.exists():
            copy_of_scripts(self.root, self.build, place)
        if data := environment.get("GENTRACK2_SHARED"):
            environment["GENTRACK2_SHARED"] = str(self.scratch / "shortened")
            if not (self.scratch / "shortened").exists():
                shortened.copy(pathlib.Path(data), self.scratch / "shortened")
        skipped = []
        for command in commands(block.text):
            done = self.call(["sh", "-euc", command], cwd=place, env=environment)
            if done.returncode not in (0, own_venv.SKIPPED):
                raise Wrong(f"{command} ended with {done.returncode}\n{shown(done)}")
            said = (done.stdout + done.stderr).splitlines()
            skipped += [line for line in said if "SKIPPED" in line or "is left out" in line]
        if skipped:
            raise Skipped("; ".join(dict.fromkeys(skipped)))
        if "--write" in block.text and not any(differs(page, self.root) for page in (place / "docs").iterdir()):
            raise Wrong("nothing was written")

    def python(self, block):
        self.only(block)
        self.demand(["python3", "-c", block.text])

    def toml(self, block):
        self.only(block)
        try:
            tomllib.loads(block.text)
            self.library.load_toml(block.text)
        except (tomllib.TOMLDecodeError, ValueError) as error:
            raise Wrong(str(error)) from None

    def json(self, block):
        self.only(block)
        try:
            json.loads(block.text)
        except json.JSONDecodeError as error:
            raise Wrong(str(error)) from None

    def cmake(self, block):
        """A project of these lines and a program `mine`, against the installed tree."""
        self.only(block)
        project = self.scratch / f"project{next(self.numbers)}"
        project.mkdir()
        (project / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(mine C)\n"
                                                f"add_executable(mine {self.scratch}/mine.c)\n{block.text}")
        prefix = self.scratch / "prefix"
        if not prefix.exists():
            environment = {key: value for key, value in self.environment.items() if key != "DESTDIR"}
            self.demand(["cmake", "--install", self.build, "--prefix", prefix], env=environment)
        self.demand(["cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={prefix}"])
        self.demand(["cmake", "--build", project / "build"])
        self.demand([project / "build/mine"])

    def math(self, block):
        self.only(block)
        try:
            latex2mathml.converter.convert(block.text, display="block")
        except Exception as error:  # the package raises many kinds
            raise Wrong(f"no equation: {type(error).__name__} {error}") from None

    def text(self, block):
        self.only(block, "output")
        if block.marker == "output" and self.printed != block.text:
            raise Wrong(f"the commands before print\n{self.printed}")


def lines_of(text):
    return [line.rstrip() for line in textwrap.dedent(text).strip("\n").split("\n")]


def words(text):
    return " ".join(text.split())


def commands(text):
    """The commands of a block, comments left out, continued lines joined."""
    joined = re.sub(r"\\\n\s*", "", text)
    return [line for line in (re.sub(r"(^|\s)#.*", "", line).strip() for line in joined.split("\n")) if line]


def prepare(scratch, root, build, pages):
    """A directory in which the commands of the pages find what they name: the repository's directories, the built
    programs, and small files under the names that the examples have."""
    for entry in root.iterdir():
        if entry.name not in ("out", "build", "target", ".git", "Cargo.toml", "Makefile"):
            (scratch / entry.name).symlink_to(entry)
    (scratch / "build").symlink_to(build)
    (scratch / "out").mkdir()
    programs = (b.text for page in pages for b in page.blocks if b.language == "c" and "int main(" in b.text)
    (scratch / "mine.c").write_text(next(programs, ""))
    draw_frames(scratch / "frames")
    rows = "".join(f"{t + 1},-1,{10 + 6 * t},60,40,100,0.9\n" for t in range(24))
    for name in ("det.txt", "out/demo-det.txt"):
        (scratch / name).write_text(rows)
    (scratch / "gt.txt").write_text(rows.replace(",-1,", ",1,").replace(",0.9\n", ",1,1,1\n"))
    film = [f"{build}/examples_cpp/gt2_mot", "--tracker", "sort", "--det", "det.txt", "--images", "frames",
            "--out", "film.txt", "--annotate", "walk.mp4", "--fps", "25"]
    subprocess.run(film, cwd=scratch, check=True, capture_output=True, env={**os.environ, "LD_LIBRARY_PATH": f"{build}/lib"})
    (scratch / "out/vtest.avi").write_bytes((scratch / "walk.mp4").read_bytes())


def differs(page, root):
    """Whether the copy of a page differs from the one that it was made from."""
    return page.is_file() and page.read_bytes() != (root / "docs" / page.name).read_bytes()


def copy_of_scripts(root, build, place):
    """The scripts that measure, and the pages that they write; they take where they are for the repository."""
    for name in ("eval", "docs"):
        shutil.copytree(root / name, place / name)
    for name in ("tools", "examples_cpp"):
        (place / name).symlink_to(root / name)
    (place / "build").symlink_to(build)
    # The sample video, if it has been fetched.
    (place / "out").mkdir()
    if (root / "out/vtest.avi").exists():
        (place / "out/vtest.avi").symlink_to(root / "out/vtest.avi")


def draw_frames(directory, count=24, width=320, height=240):
    """Grey pictures, of a bright box that walks to the right."""
    directory.mkdir()
    for t in range(count):
        left = 10 + 6 * t
        row = bytes([60] * left + [220] * 40 + [60] * (width - left - 40))
        dark = bytes([60] * width)
        pixels = b"".join(row if 60 <= y < 160 else dark for y in range(height))
        (directory / f"{t:03}.pgm").write_bytes(b"P5 %d %d 255\n" % (width, height) + pixels)
