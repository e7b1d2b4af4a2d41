"""Names that the manual mentions exist: functions, types and constants of the headers, parameters with their defaults
and ranges, source files and what is in them."""
import re
import subprocess

PREFIXED = re.compile(r"\b(gt2_\w+|GT2_\w+)(\.\.\.)?")
QUALIFIED = re.compile(r"\bgentrack2::(\w+)")
SNAKE = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)+")
SETTING = re.compile(r"([a-z][a-z0-9_]*) ?= ?([^ ={}\"]+)")
PATH = re.compile(r"(?!build/|out/|target/)[\w.-]+(?:/[\w.-]+)+\.(?:rs|md|c|cpp|py|sh|h|hpp|txt|toml|cmake)")
DEFINED = r"(?:\bfn|\bstruct|\benum|\btrait|\bconst|\bdef|\bclass|\bstatic) +{0}\b|^\s*(?:pub )?{0}: "
# What other programs' names stand in: the first column of a table of docs/migration.
FOREIGN = "docs/migration/"


def tracked_words(root):
    """All words of the files that git knows, but for the pages themselves."""
    listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=True).stdout.split("\n")
    kinds = (".rs", ".h", ".hpp", ".c", ".cpp", ".py", ".sh", ".toml", ".cmake", ".txt", "Makefile", "Doxyfile")
    skip = ("tests/fixtures/", "tools/manual/prove.py")
    files = [name for name in listed if name.endswith(kinds) and not name.startswith(skip)]
    words = set()
    for name in files:
        words |= set(re.findall(r"\w+", (root / name).read_text(errors="replace")))
        words |= set(re.findall(r"\w+", name))
    return words


class Names:
    def __init__(self, root, library):
        self.root, self.library = root, library
        self.header = set(re.findall(r"\b(?:gt2|GT2)_\w+", (root / "include/gentrack2.h").read_text()))
        headers = [path.read_text() for path in sorted((root / "include").glob("*.hpp"))]
        self.wrapper = set(re.findall(r"\w+", "\n".join(headers)))
        self.crate = set(re.findall(r"\w+", (root / "src/lib.rs").read_text()))
        self.words = tracked_words(root) | library.keys() | library.values
        # Programs and tests share the prefix of the C interface.
        self.programs = {word for word in self.words if word.startswith("gt2_mot")}

    def check(self, page):
        for number, line in enumerate(page.source.split("\n"), 1):
            for trouble in self._line(line):
                yield f"{page.name}:{number}: {trouble}"
        foreign = page.name.startswith(FOREIGN)
        for span in page.spans:
            if foreign and span.column == 0:
                continue
            for trouble in self._span(span.text):
                yield f"{page.name}:{span.line}: {trouble}"
        for table in page.tables:
            for trouble in self._defaults(table):
                yield f"{page.name}:{table.line}: {trouble}"
        for line, href, text in page.links:
            for trouble in self._place(page, href, text):
                yield f"{page.name}:{line}: {trouble}"

    def _line(self, line):
        for name, dots in PREFIXED.findall(line):
            whole = name in self.header or name in self.programs
            # "gt2_config_..." and "GT2_ERR_..." stand for all that begin so.
            begins = (dots or name.endswith("_")) and any(known.startswith(name) for known in self.header)
            if not whole and not begins:
                yield f"{name} is not in gentrack2.h"
        for name in QUALIFIED.findall(line):
            if name not in self.wrapper | self.crate | {"gentrack2", "static"}:
                yield f"gentrack2::{name} is not in the headers"

    def _span(self, text):
        setting = SETTING.fullmatch(text)
        # "key = value" stands for any.
        if setting and setting[1] not in ("algorithm", "key"):
            if trouble := self.library.accepts(setting[1], setting[2]):
                yield f"`{text}`: {trouble}"
        elif SNAKE.fullmatch(text) and text not in self.words:
            yield f"`{text}` is found nowhere in the sources"
        elif PATH.fullmatch(text) and not (self.root / text).exists():
            yield f"`{text}`: there is no such file"

    def _defaults(self, table):
        """Tables of parameters of gentrack2 with their defaults say what the library says."""
        key = next((i for i, head in enumerate(table.head) if head.split()[:1] == ["parameter"]), None)
        if key is None or "default" not in table.head:
            return
        default = table.head.index("default")
        known = self.library.defaults["gentrack2"]
        for row in table.rows:
            keys, told = row[key][0], [value.strip() for value in row[default][1].split(",")]
            if len(keys) != len(told):
                yield f"{keys}: {len(told)} defaults for {len(keys)} parameters"
                continue
            for name, value in zip(keys, told):
                if name not in known:
                    yield f"gentrack2 has no parameter {name}"
                elif not same(value, known[name]):
                    yield f"{name}: the default is {known[name]}, not {value}"

    def _place(self, page, href, text):
        """`[file::name](path/file.rs)`: the file defines that name."""
        if "::" not in text or href is None or not href.endswith((".rs", ".py", ".hpp")):
            return
        path, name = page.path.parent / href, text.split("::")[-1]
        if path.exists() and not re.search(DEFINED.format(re.escape(name)), path.read_text(), re.MULTILINE):
            yield f"{text}: {href} defines no {name}"


def same(a, b):
    try:
        return float(a) == float(b)
    except ValueError:
        return a == b
