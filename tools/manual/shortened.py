"""The measurement data, cut to its first frames: enough to run the manual's measurements in seconds."""
import re

FRAMES = 20
# Set-ups are made of these.
COLLECTIONS = ("mot17", "mot15", "dancetrack")
# Sequences that no page asks for by name, of a set-up that takes what there is.
LEFT_OUT = {f"dancetrack{number:04}" for number in (5, 7, 10, 14, 18, 19)}


def first_lines(text, last, offset):
    """The rows of frames up to the last, whose number is the first field, counted from `offset`."""
    rows = text.splitlines(keepends=True)
    return "".join(row for row in rows if row.strip() and float(re.split(r"[,\s]", row.strip())[0]) - offset < last)


def sequence(source, place):
    """One sequence; its video stays as long as it is, and nobody reads on."""
    place.mkdir(parents=True)
    for path in source.iterdir():
        if path.name == "seqinfo.ini":
            (place / path.name).write_text(re.sub(r"(?m)^seqLength\s*=.*$", f"seqLength={FRAMES}", path.read_text()))
        elif path.suffix == ".txt":
            # Camera motion counts frames from 0.
            (place / path.name).write_text(first_lines(path.read_text(), FRAMES, int(path.name != "gmc.txt")))
        elif path.suffix == ".mp4":
            (place / path.name).symlink_to(path)


def copy(data, place):
    """Makes the directory `place` of what there is of the data."""
    place.mkdir()
    for collection in COLLECTIONS:
        for source in sorted(data.glob(f"{collection}/*/")):
            if source.is_dir() and source.name not in LEFT_OUT:
                sequence(source, place / collection / source.name)
