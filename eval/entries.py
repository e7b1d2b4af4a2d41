"""The rows of the table: a tracker with settings."""
import dataclasses

TRACKERS = ["gentrack2", "sort", "deepsort", "bytetrack", "ocsort", "botsort", "smiletrack", "conftrack"]
# The only one that draws random numbers.
RANDOM = "gentrack2"
# Those that have a use for images.
LOOKS = ("gentrack2",)
DEFAULT = ["gentrack2", "paper", *TRACKERS[1:]]
# These leave it to their user to drop weak detections; 0.6 is where the others have their border between high and low
# scores. One frame of memory is for higher frame rates than any here.
SETTINGS = {"sort": ["min_score=0.6", "max_age=30"], "deepsort": ["min_score=0.6"]}


@dataclasses.dataclass
class Entry:
    name: str
    tracker: str
    settings: list

    def all_settings(self):
        """Later ones win."""
        return SETTINGS.get(self.tracker, []) + self.settings


def parse(text):
    """Entries of a list: a tracker, `paper`, or NAME=TRACKER:KEY=VALUE,KEY=VALUE."""
    entries = []
    for piece in filter(None, text.split(",")):
        name, equals, rest = piece.partition("=")
        tracker, colon, setting = rest.partition(":")
        if not equals and piece in TRACKERS:
            entries.append(Entry(piece, piece, []))
        elif piece == "paper":
            entries.append(Entry("paper", "gentrack2", ["preset=paper"]))
        elif equals and tracker in TRACKERS:
            entries.append(Entry(name, tracker, [setting] if setting else []))
        elif equals and entries and entries[-1].name not in DEFAULT:
            entries[-1].settings.append(piece)
        else:
            raise ValueError(f"unknown entry {piece}; an entry is one of {' '.join(DEFAULT)} or "
                             "NAME=TRACKER:KEY=VALUE,KEY=VALUE")
    return entries


def parse_all(texts, settings):
    """The entries of several lists, with settings for all that are gentrack2."""
    entries = [entry for text in texts for entry in parse(text)]
    names = [entry.name for entry in entries]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"two entries are named {name}")
    for entry in entries:
        if entry.tracker == "gentrack2":
            entry.settings += settings
    return entries
