"""The pages of the manual: their blocks, links, headings and code spans, read by a CommonMark parser."""
import dataclasses
import pathlib
import re
import typing

import markdown_it

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Pages that the manual links to, without being part of it.
BESIDE = ["CHANGELOG.md", "CONTRIBUTING.md", "PERFORMANCE.md", "SECURITY.md", "eval/README.md"]
MARKER = re.compile(r"<!-- manual: (.*?) -->")


@dataclasses.dataclass
class Block:
    """A fenced block, with what the marker in the line before it says."""
    page: "Page"
    line: int
    language: str
    text: str
    marker: typing.Optional[str]

    def __str__(self):
        return f"{self.page.name}:{self.line}"


@dataclasses.dataclass
class Span:
    """An inline piece of code; `column` counts a table's columns, None is prose."""
    line: int
    text: str
    column: typing.Optional[int]


@dataclasses.dataclass
class Table:
    """Rows of cells; a cell is the list of its pieces of code, and its text."""
    line: int
    head: list
    rows: list


class Page:
    def __init__(self, root, name):
        self.root, self.name = root, name
        self.path = root / name
        self.source = self.path.read_text()
        self.tokens = markdown_it.MarkdownIt("commonmark").enable("table").parse(self.source)
        self.blocks, self.unfenced, self.links, self.spans, self.tables, self.anchors = [], [], [], [], [], set()
        self._read()

    def _read(self):
        marker, line, column, seen = None, 1, None, {}
        for i, token in enumerate(self.tokens):
            line = token.map[0] + 1 if token.map else line
            if token.type == "fence":
                language = token.info.split()[0] if token.info.split() else ""
                self.blocks.append(Block(self, line, language, token.content, marker))
            elif token.type == "code_block":
                self.unfenced.append(line)
            elif token.type == "heading_open":
                self.anchors.add(self.anchor(plain(self.tokens[i + 1]), seen))
            elif token.type == "table_open":
                self.tables.append(Table(line, [], []))
            elif token.type == "tr_open":
                column = -1
                self.tables[-1].rows.append([])
            elif token.type in ("th_open", "td_open"):
                column += 1
            elif token.type == "tr_close":
                column = None
                table = self.tables[-1]
                if not table.head:
                    table.head = [text for _, text in table.rows.pop()]
            elif token.type == "inline":
                codes = [child.content for child in token.children if child.type == "code_inline"]
                self.spans += [Span(line, code, column) for code in codes]
                if column is not None:
                    self.tables[-1].rows[-1].append((codes, plain(token)))
                self._read_links(token, line)
            marker = None
            if token.type == "html_block":
                found = MARKER.fullmatch(token.content.strip())
                marker = found and found[1]

    def _read_links(self, token, line):
        for i, child in enumerate(token.children):
            if child.type == "link_open":
                text = "".join(c.content for c in token.children[i + 1:i + 2])
                self.links.append((line, child.attrGet("href"), text))
            elif child.type == "image":
                self.links.append((line, child.attrGet("src"), child.content))

    @staticmethod
    def anchor(text, seen):
        anchor = slug(text)
        seen[anchor] = seen.get(anchor, -1) + 1
        return f"{anchor}-{seen[anchor]}" if seen[anchor] else anchor


def plain(token):
    """The text of an inline token, code included, without its mark-up."""
    return "".join(c.content for c in token.children if c.type in ("text", "code_inline", "softbreak"))


def slug(text):
    """The anchor that forges give a heading."""
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def manual(root=ROOT):
    """README and everything in docs/."""
    names = ["README.md", *sorted(str(p.relative_to(root)) for p in (root / "docs").rglob("*.md"))]
    return [Page(root, name) for name in names]


def beside(root=ROOT):
    return [Page(root, name) for name in BESIDE if (root / name).exists()]
