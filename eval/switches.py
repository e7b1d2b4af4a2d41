#!/usr/bin/env python3
"""Lists where one tracker's identities are lost: identity switches and fragmentations; see eval/README.md.

Boxes are matched as the judge matches them, on the judge's own data, and the number of switches is compared with its.
TrackEval, and what comes with it, is imported where it is used: the right Python is running only then.
"""
import argparse
import collections
import dataclasses
import sys
import typing

import derive
import evaluate
import setups as setups_module
import work

# Frames since the last match, the last of a group.
GAPS = (("1", 1), ("2-10", 10), ("11-30", 30), (">30", None))
CAUSES = ("swap", "live track", "new id", "same id")


@dataclasses.dataclass
class Event:
    """A person matched again, after a gap or by another track."""
    frame: int
    person: int
    # What had the person before and what has it now; the same in a fragmentation.
    before: int
    now: int
    gap: int
    # swap: the track followed somebody else until now; live track: it was there, but matched with nobody; new id: it
    # began after the person was lost; same id: no switch.
    cause: str
    # Whom the new track was matched with last.
    came_from: typing.Optional[int]
    # What became of the old track: the person that it has in this frame, "alone" if none, "ended" if it is never
    # reported again.
    went_to: object
    box: list


def judged_sequences(judge, truth, tracks, options):
    """The data that the judge scores, per sequence, with the identities of the files, and its numbers of switches."""
    import trackeval
    dataset, collected = trackeval.datasets.MotChallenge2DBox, {}
    original = dataset.get_preprocessed_seq_data

    def recording(self, raw, class_name):
        data = original(self, raw, class_name)
        names = {}
        for kind, boxes in (("gt_ids", "gt_dets"), ("tracker_ids", "tracker_dets")):
            names[kind] = original_ids(raw[kind], raw[boxes], data[kind], data[boxes])
        collected[raw["seq"]] = data, names, [list(map(int, ids)) for ids in raw["tracker_ids"]]
        return data

    dataset.get_preprocessed_seq_data = recording
    try:
        table = work.judge(judge, truth, tracks, options)
    finally:
        dataset.get_preprocessed_seq_data = original
    return collected, table


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
            rows, columns = linear_sum_assignment(-worth)
            for row, column in zip(rows, columns):
                if worth[row, column] > 0:
                    matched[int(ids[row])] = int(tracks[column])
            last_frame = matched
        yield matched


def events_of(data, names, shown_ids, first):
    """All events of a sequence; frames are counted from `first` on."""
    people, tracks = names["gt_ids"], names["tracker_ids"]
    born = {}
    for frame, ids in enumerate(shown_ids):
        for identity in ids:
            born.setdefault(identity, frame)
    last_seen = {identity: frame for frame, ids in enumerate(shown_ids) for identity in ids}
    # Per person the last match; per track whom it had last.
    last, had = {}, {}
    for frame, matched in enumerate(matches_of(data)):
        owner = {tracks[track]: people[person] for person, track in matched.items()}
        for person, track in matched.items():
            person_name, now = people[person], tracks[track]
            if person_name in last:
                before, then = last[person_name]
                if before != now or frame - then > 1:
                    came_from = had.get(now) if had.get(now) != person_name else None
                    cause = ("same id" if before == now else "new id" if born[now] > then
                             else "live track" if came_from is None else "swap")
                    went_to = owner.get(before, "ended" if last_seen[before] < frame else "alone")
                    index = list(data["gt_ids"][frame]).index(person)
                    box = [float(value) for value in data["gt_dets"][frame][index]]
                    yield Event(first + frame, person_name, before, now, frame - then, cause, came_from, went_to, box)
        for person, track in matched.items():
            last[people[person]] = tracks[track], frame
        had.update(owner)


def group_of(gap):
    return next(name for name, end in GAPS if end is None or gap <= end)


def line(event):
    left, top, width, height = event.box
    what = f"{event.before} kept" if event.cause == "same id" else f"{event.before} -> {event.now}"
    more = "" if event.came_from is None else f", which had {event.came_from}"
    if event.cause != "same id":
        where = event.went_to if isinstance(event.went_to, str) else f"has {event.went_to}"
        more += f"; {event.before} {where}"
    return (f"  frame {event.frame:5}  person {event.person:4}  gap {event.gap:4}  {event.cause:10}  {what}{more}  "
            f"at {left:.0f},{top:.0f} {width:.0f}x{height:.0f}")


def print_counts(events):
    print(f"  {'gap':<8}" + "".join(f"{cause:>12}" for cause in CAUSES) + f"{'switches':>12}")
    for name in [group for group, _ in GAPS] + ["all"]:
        counts = [sum(event.cause == cause and name in ("all", group_of(event.gap)) for event in events)
                  for cause in CAUSES]
        print(f"  {name:<8}" + "".join(f"{count:12}" for count in counts) + f"{sum(counts[:-1]):12}")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--setup", default="H", help=f"one of {' '.join(setups_module.NAMES)}; default: H")
    parser.add_argument("--entry", default="gentrack2", help="as one of evaluate.py's entries")
    parser.add_argument("--sequence", help="only this one; default: all of the set-up")
    parser.add_argument("--seed", type=int, help="seed of gentrack2")
    parser.add_argument("--fragments", action="store_true", help="list those that kept their identity, too")
    parser.add_argument("--counts-only", action="store_true", help="only the numbers")
    evaluate.common_options(parser)
    options = parser.parse_args()
    options.seed_list = [options.seed]
    try:
        options.setup_names = setups_module.expand(options.setup)
        options.entry_list = evaluate.parse_entries([options.entry], options.settings)
        if len(options.setup_names) != 1 or len(options.entry_list) != 1:
            raise ValueError("one set-up and one entry, please")
    except ValueError as error:
        parser.error(str(error))
    return options


def main():
    options = arguments()
    evaluate.prepare(options)
    setup, = evaluate.build_setups(options, options.setup_names)
    entry, = options.entry_list
    if options.sequence:
        setup.sequences = [each for each in setup.sequences if each.name == options.sequence]
        if not setup.sequences:
            sys.exit(f"set-up {setup.name} has no sequence {options.sequence}")
    evaluation = evaluate.Evaluation(options, [setup], [entry])
    tracks = {}
    evaluation.plan(setup, entry, options.seed, lambda _setup, _entry, _seed, files: tracks.update(files))
    try:
        evaluation.scheduler.run()
        truth = {sequence.name: sequence.gt for sequence in setup.sequences}
        collected, table = judged_sequences(evaluation.judge, truth, tracks, setup.judge_options())
    except work.Failed as error:
        sys.exit(str(error))
    everything, differ = [], False
    for sequence in setup.sequences:
        data, names, shown_ids = collected[sequence.name]
        half = setup.split == "half"
        first = last_frame(sequence.gt) // 2 + 2 if half else 1
        events = list(events_of(data, names, shown_ids, first))
        everything += events
        switches, judged = sum(event.cause != "same id" for event in events), table[sequence.name]["IDSW"]
        differ |= switches != judged
        print(f"{setup.name} {sequence.name}, {entry.name}: {switches} switches (judge: {judged}), "
              f"{sum(event.gap > 1 for event in events)} fragmentations")
        if not options.counts_only:
            for group, _ in GAPS:
                for event in events:
                    if group_of(event.gap) == group and (options.fragments or event.cause != "same id"):
                        print(line(event))
        print_counts(events)
    if len(setup.sequences) > 1:
        print(f"{setup.name}, all sequences, {entry.name}")
        print_counts(everything)
    if differ:
        sys.exit("the judge counts other switches: this program does not match as it does")


def last_frame(path):
    return max(derive.frame_of(row) for row in derive.read_rows(path))


if __name__ == "__main__":
    main()
