"""What became of identities in one sequence: who was tracked as whom, and every change of it.

Boxes are matched as CLEAR matches them, on the judge's own data.
"""
import collections
import dataclasses
import typing

# swap: the track followed somebody else until now; live track: it was there, but matched with nobody; new id: it began
# after the person was lost; same id: no switch, only an interruption.
CAUSES = ("swap", "live track", "new id", "same id")


@dataclasses.dataclass
class Event:
    """A person matched again, after a gap or by another track."""
    frame: int
    person: int
    # What had the person before and what has it now; the same in a fragmentation.
    before: int
    now: int
    # Frames since the last match.
    gap: int
    # One of CAUSES.
    cause: str
    # Whom the new track was matched with last.
    came_from: typing.Optional[int]
    # What became of the old track: the person that it has in this frame, "alone" if none, "ended" if it is never
    # reported again.
    went_to: object
    # Left, top, width, height.
    box: list

    @property
    def is_switch(self):
        return self.cause != "same id"


def original_ids(raw_ids, raw_boxes, ids, boxes):
    """The judge numbers identities anew; this finds the old ones by their boxes."""
    import numpy
    votes = collections.defaultdict(collections.Counter)
    for raw_row, raw_box, row, box in zip(raw_ids, raw_boxes, ids, boxes):
        if not len(row):
            continue
        same = (numpy.asarray(box)[:, None, :] == numpy.asarray(raw_box)[None, :, :]).all(axis=2)
        for new, candidates in zip(row, same):
            votes[int(new)].update(int(raw_row[i]) for i in numpy.flatnonzero(candidates))
    return {new: counter.most_common(1)[0][0] for new, counter in votes.items()}


def matches_of(data):
    """CLEAR's matching, frame by frame: pairs at an IoU of 0.5 or more, those of the frame before first."""
    import numpy
    from scipy.optimize import linear_sum_assignment
    last_frame = {}
    for ids, tracks, similarity in zip(data["gt_ids"], data["tracker_ids"], data["similarity_scores"]):
        matched = {}
        if len(ids) and len(tracks):
            kept = numpy.array([[last_frame.get(int(person)) == int(track) for track in tracks] for person in ids])
            worth = 1000 * kept + similarity
            worth[similarity < 0.5 - numpy.finfo("float").eps] = 0
            at_people, at_tracks = linear_sum_assignment(-worth)
            for row, column in zip(at_people, at_tracks):
                if worth[row, column] > 0:
                    matched[int(ids[row])] = int(tracks[column])
            last_frame = matched
        yield matched


def original_matches(raw, data):
    """The matching, frame by frame, with the identities of the files."""
    people = original_ids(raw["gt_ids"], raw["gt_dets"], data["gt_ids"], data["gt_dets"])
    tracks = original_ids(raw["tracker_ids"], raw["tracker_dets"], data["tracker_ids"], data["tracker_dets"])
    present = [[people[int(person)] for person in ids] for ids in data["gt_ids"]]
    return present, [{people[person]: tracks[track] for person, track in matched.items()}
                     for matched in matches_of(data)]


def events_of(matches, present, boxes, shown_ids, first):
    """All events; frames are counted from `first` on, `shown_ids` are all tracks of each frame."""
    born, last_seen = {}, {}
    for frame, ids in enumerate(shown_ids):
        for identity in ids:
            born.setdefault(identity, frame)
            last_seen[identity] = frame
    # Per person the last match; per track whom it had last.
    last, had = {}, {}
    for frame, matched in enumerate(matches):
        owner = {track: person for person, track in matched.items()}
        for person, now in matched.items():
            if person in last:
                before, then = last[person]
                if before != now or frame - then > 1:
                    came_from = had.get(now) if had.get(now) != person else None
                    cause = ("same id" if before == now else "new id" if born[now] > then
                             else "live track" if came_from is None else "swap")
                    went_to = owner.get(before, "ended" if last_seen[before] < frame else "alone")
                    box = [float(value) for value in boxes[frame][present[frame].index(person)]]
                    yield Event(first + frame, person, before, now, frame - then, cause, came_from, went_to, box)
        for person, track in matched.items():
            last[person] = track, frame
        had.update(owner)


def runs_of(values, first):
    """Stretches of equal values, [first frame, last frame, value], of what is given frame by frame; None is no
    stretch."""
    runs = []
    for frame, value in enumerate(values, first):
        if value is None:
            continue
        if runs and runs[-1][2] == value and runs[-1][1] == frame - 1:
            runs[-1][1] = frame
        else:
            runs.append([frame, frame, value])
    return runs


def history(raw, data, first):
    """Events, and per person when it is there and what tracks it: runs of frames with the track's identity."""
    present, matches = original_matches(raw, data)
    shown = [list(map(int, ids)) for ids in raw["tracker_ids"]]
    people = {}
    for person in sorted({person for ids in present for person in ids}):
        there = [person in ids for ids in present]
        people[person] = {
            "present": [run[:2] for run in runs_of([True if each else None for each in there], first)],
            "tracks": runs_of([matched.get(person) for matched in matches], first),
        }
    events = events_of(matches, present, data["gt_dets"], shown, first)
    return {"people": people, "events": [dataclasses.asdict(event) for event in events]}


def events(result):
    """The events of a judged sequence."""
    return [Event(**each) for each in result["identities"]["events"]]
