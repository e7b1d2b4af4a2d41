"""Rows of MOTChallenge files: read, checked, written. What is wrong with one is said with file and line."""
import math

# The columns that every row has, and those of tracks and detections up to the score.
BOX = ("frame", "id", "left", "top", "width", "height")
SCORED = (*BOX, "score")


class Malformed(Exception):
    """A file is not what it should be; the message names file and line."""


def split(line):
    return (line if "," in line else line.replace(" ", ",")).split(",")


def read_rows(path):
    """The rows of a MOTChallenge file as lists of strings."""
    with open(path, encoding="utf-8-sig") as file:
        lines = (line.strip() for line in file)
        return [split(line) for line in lines if line]


def write_rows(path, rows):
    with open(path, "w") as file:
        file.writelines(",".join(row) + "\n" for row in rows)


def frame_of(row):
    return int(float(row[0]))


def by_frame(rows):
    frames = {}
    for row in rows:
        frames.setdefault(frame_of(row), []).append(row)
    return frames


def box_of(row):
    """Left, top, width, height."""
    return tuple(float(value) for value in row[2:6])


def checked(path, columns):
    """Yields the number of each line, its values of `columns` as numbers, and its fields; raises Malformed."""
    try:
        with open(path, encoding="utf-8-sig") as file:
            lines = file.read().splitlines()
    except UnicodeDecodeError:
        raise Malformed(f"{path}: is no text file") from None
    for number, line in enumerate(lines, 1):
        line = line.strip()
        if not line:
            continue
        fields = split(line)
        if len(fields) < len(columns):
            raise Malformed(f"{path}:{number}: expected {','.join(columns)},..., found {len(fields)} "
                            f"field{'s' if len(fields) > 1 else ''}: {line[:60]}")
        values = []
        for name, text in zip(columns, fields):
            try:
                value = float(text)
            except ValueError:
                value = math.nan
            if not math.isfinite(value):
                raise Malformed(f"{path}:{number}: {name} \"{text}\" is not a finite number")
            values.append(value)
        if values[0] < 1 or values[0] != int(values[0]):
            raise Malformed(f"{path}:{number}: frame \"{fields[0]}\" is not a whole number from 1 on")
        for name, value, text in zip(columns[4:6], values[4:6], fields[4:6]):
            if value < 0:
                raise Malformed(f"{path}:{number}: {name} \"{text}\" is negative")
        yield number, values, fields
