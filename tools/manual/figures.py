"""Times and sizes that pages take from PERFORMANCE.md are those of its last run."""
import re

SOURCE = "PERFORMANCE.md"
# The columns of its table of growth.
OBJECTS = ("100", "200", "500", "1000", "2000")
# Cells of prose that quote it, by how their row begins, and what they quote.
QUOTES = {"hardly any time": "step", "hardly any memory": "memory"}


def measured(text):
    """Microseconds of a step on MOT17-04 and by number of objects, and bytes per live track, by tracker, as text."""
    section = re.search(r"^### MOT17-04.*?(?=^##|\Z)", text, re.M | re.S)
    steps = re.findall(r"^\| (\w+)[^|]*\| ([\d.]+) \|", section[0] if section else "", re.M)
    growth = re.findall(r"^\| (\w+): ([\d.]+(?:, [\d.]+)+) \|", text, re.M)
    return {"step": {name: f"{float(value):.0f}" for name, value in steps},
            "growth": {name: dict(zip(OBJECTS, (f"{float(each):.0f}" for each in values.split(", "))))
                       for name, values in growth},
            "memory": dict(re.findall(r"^\| (\w+: bytes per live track[^|]*) \| (\d+) B", text, re.M))}


def check(pages, text):
    known = measured(text)
    for page in pages:
        for table in page.tables:
            for trouble in of_table(table, known):
                yield f"{page.name}:{table.line}: {trouble}, says {SOURCE}"


def of_table(table, known):
    for row in table.rows:
        name, cells = row[0][1], dict(zip(table.head, (text for _, text in row)))
        if "µs/frame" in cells and cells["µs/frame"] != known["step"].get(name):
            yield f"a step of {name} takes {known['step'].get(name)} µs"
        if table.head[0] == "objects":
            for tracker, value in list(cells.items())[1:]:
                right = known["growth"].get(tracker, {}).get(name)
                if value != right:
                    yield f"a step of {tracker} with {name} objects takes {right} µs"
        for begin, what in QUOTES.items():
            if name.startswith(begin):
                for number in re.findall(r"\b\d+\b", row[-1][1]):
                    if number not in known[what].values():
                        yield f"{number} is nobody's {what}"
