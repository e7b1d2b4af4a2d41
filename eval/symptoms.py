#!/usr/bin/env python3
"""What a parameter changes on a real sequence: the tables of docs/tuning.md, before and after.

    symptoms.py [CASE...]        prints the tables of these cases, or of all
    symptoms.py --write          writes all of them into docs/tuning.md
    symptoms.py --commands CASE  prints gt2_mot's commands
"""
import argparse
import concurrent.futures
import dataclasses
import itertools
import json
import math
import os
import re
import shlex
import sys
import time

import environment
import judge
import setups as setups_module
import store
import work
from environment import ROOT

PAGE = f"{ROOT}/docs/tuning.md"

# What the judge tells, with digits and heading; and what is counted here.
COLUMNS = {"HOTA": (1, "HOTA"), "DetA": (1, "DetA"), "AssA": (1, "AssA"), "IDF1": (1, "IDF1"), "MOTA": (1, "MOTA"),
           "IDSW": (0, "ID switches"), "FP": (0, "false positives"), "FN": (0, "misses"), "tracks": (0, "tracks")}
TREMBLE = {"tremble": (2, "trembling, % of height")}


@dataclasses.dataclass
class Row:
    """One run: a sequence of a set-up, settings, and what gt2_mot is told about the sequence other than usual."""
    title: str
    setup: str
    sequence: str
    settings: tuple = ()
    given: dict = dataclasses.field(default_factory=dict)
    # Factor on the scores of the detections.
    scores: float = 1.0


def rows(setup, sequence, *settings, **other):
    """The same sequence with several lists of settings."""
    title = lambda text: ", ".join(f"`{setting}`" for setting in text.split()) or "defaults"  # noqa: E731
    return [Row(title(text), setup, sequence, tuple(text.split()), **other) for text in settings]


LONG = "max_missed=80 lost_cost=0.002"
CASES = {
    "crossing": [Row("without images", "I0", "PETS09-S2L1"), Row("with images", "I", "PETS09-S2L1")],
    "occlusion": rows("R", "MOT17-04", "", LONG) + rows("Wf", "MOT17-04", "", LONG) + rows("P", "MOT17-04", "", LONG),
    "ghosts": rows("I", "ADL-Rundle-6", "", "birth_score=0.85", "confirm_hits=6")
    + rows("I", "TUD-Stadtmitte", "", "birth_score=0.85", "confirm_hits=6"),
    "late": rows("I", "PETS09-S2L1", "", "confirm_hits=1 confirm_evidence=0"),
    "leaving": rows("I", "ADL-Rundle-6", "recognition_time=0", "", "recognition_time=300"),
    "doubles": rows("P", "MOT17-04", "birth_iou=1", "", "birth_iou=0.3"),
    "boxes": rows("R", "MOT17-04", "strong_update=replace", "", "blend_centre=0.4 blend_size=0.3")
    + rows("D", "dancetrack0025", "", "blend_centre=1 blend_size=1 blend_adaptation=0"),
    "coasting": rows("D", "dancetrack0025", "", "coast=0", "coast=0 report_missed=0"),
    "border": rows("P", "MOT17-04", "", "border_report_share=0", "border_report_share=0 border_birth_factor=1"),
    "camera": [Row("without its motion", "H", "MOT17-05", given={"gmc": None}), Row("with it", "H", "MOT17-05")],
    "rate": [row for name, rate in (("MOT17-09", "7.5"), ("MOT17-05", "3.5"))
             for row in (Row("`frame_rate` left at 30", "L4", name, given={"fps": 30.0}),
                         Row(f"`frame_rate` = {rate}", "L4", name))],
    "scores": rows("H", "MOT17-09", "", "low_score=0.41 doubt_score=0.3 evidence_score=0.27 birth_score=0.41 "
                   "confirm_evidence=0.53", scores=0.6),
    "fast": rows("D", "dancetrack0025", "", "min_iou=0", "min_iou=0 distance_scale_max=2")
    + rows("I0", "TUD-Stadtmitte", "", "min_iou=0", "min_iou=0 distance_scale_max=2"),
}
COLUMNS_OF = {"boxes": COLUMNS | TREMBLE}


def tremble(path):
    """How far boxes are from the middle of the ones before and after, in per cent of their height: the mean over all
    tracks and frames."""
    tracks = {}
    with open(path) as file:
        for line in file:
            frame, identity, left, top, width, height = line.split(",")[:6]
            centre = float(left) + float(width) / 2, float(top) + float(height) / 2
            tracks.setdefault(identity, {})[int(frame)] = (*centre, float(height))
    total = count = 0
    for boxes in tracks.values():
        for frame, (x, y, height) in boxes.items():
            if frame - 1 in boxes and frame + 1 in boxes:
                before, after = boxes[frame - 1], boxes[frame + 1]
                total += math.hypot(x - (before[0] + after[0]) / 2, y - (before[1] + after[1]) / 2) / height
                count += 1
    return 100 * total / max(count, 1)


def scaled(builder, sequence, factor):
    """The sequence with all scores of its detections times a factor."""
    def make(directory):
        with open(sequence.det) as source, open(f"{directory}/det.txt", "w") as file:
            for line in source:
                row = line.strip().split(",")
                row[6] = f"{float(row[6]) * factor:.6f}"
                file.write(",".join(row) + "\n")

    directory = builder.derived([sequence.det], f"scores/{factor}", make)
    return dataclasses.replace(sequence, det=f"{directory}/det.txt")


class Bench:
    """Runs and judges rows, and keeps what it found under a hash of all that it depends on."""

    def __init__(self, options):
        self.options = options
        self.builder = setups_module.Builder(os.path.abspath(options.data), os.path.abspath(options.cache), 1)
        self.built = {}

    def sequence(self, row):
        if row.setup not in self.built:
            self.built[row.setup] = self.builder.build(row.setup)
        sequence = next(s for s in self.built[row.setup].sequences if s.name == row.sequence)
        sequence = dataclasses.replace(sequence, **row.given)
        return scaled(self.builder, sequence, row.scores) if row.scores != 1.0 else sequence

    def command(self, row):
        command = [self.options.program, "--tracker", "gentrack2"]
        for option, value, _ in self.sequence(row).arguments(looks=True):
            command += [option, value] if value else [option]
        return command + [word for setting in row.settings for word in ("--set", setting)]

    def measure(self, row):
        """The judge's scores of a row, and what is counted here."""
        command, sequence = self.command(row), self.sequence(row)
        library = os.path.realpath(f"{os.path.dirname(self.options.program)}/../lib/libgentrack2.so")
        files = [self.options.program, library, sequence.gt, judge.identity()]
        parts = [store.content(word) if os.path.isfile(word) else word for word in [*command, *files]]
        place = f"{self.options.cache}/symptoms/{store.key(row.setup, *parts)}"
        if not os.path.exists(f"{place}.json"):
            work.track(command, f"{place}.txt")
            store.write(f"{place}.json", json.dumps(self.judged(row, sequence, f"{place}.txt")))
        with open(f"{place}.json") as file:
            return json.load(file)

    def judged(self, row, sequence, tracks):
        rules = self.built[row.setup].rules
        truth = judge.prepare(sequence.gt, rules, f"{self.options.cache}/truth")
        scores = judge.scores(judge.judge(truth, tracks, rules))
        with open(tracks) as file:
            scores["tracks"] = len({line.split(",")[1] for line in file})
        return scores | {"tremble": tremble(tracks)}


def table(name, measured):
    """The rows of a case, whose scores are given in their order, as Markdown."""
    lines, columns = [], COLUMNS_OF.get(name, COLUMNS)
    # The same sequence with and without images is one table.
    for place, group in itertools.groupby(zip(CASES[name], measured), lambda m: (m[0].setup.rstrip("0"), m[0].sequence)):
        group = list(group)
        setups = " and ".join(dict.fromkeys(row.setup for row, _ in group))
        head = [f"{place[1]}, set-up {setups}", *(heading for _, heading in columns.values())]
        lines += ["", f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
        for row, scores in group:
            cells = [f"{scores[score]:.{digits}f}" for score, (digits, _) in columns.items()]
            lines.append(f"| {' | '.join([row.title, *cells])} |")
    return "\n".join(lines[1:])


def written(page, name, text):
    """The page with the table of a case between its marks."""
    begin, end = f"<!-- measured: {name} -->", "<!-- end -->"
    pattern = re.compile(f"({re.escape(begin)}\n).*?({end})", re.DOTALL)
    if not pattern.search(page):
        sys.exit(f"{PAGE} has no place for {name}: a line {begin} and a line {end}")
    return pattern.sub(lambda found: f"{found[1]}\n{text}\n\n{found[2]}", page)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=" ".join(CASES))
    parser.add_argument("--write", action="store_true", help="write the tables into docs/tuning.md")
    parser.add_argument("--commands", action="store_true", help="print the commands instead of running them")
    parser.add_argument("--program", default=f"{ROOT}/build/examples_cpp/gt2_mot", help="the built gt2_mot")
    parser.add_argument("--data", default=os.environ.get("GENTRACK2_SHARED"),
                        help="directory of the data; default: what GENTRACK2_SHARED names")
    parser.add_argument("--cache", default=f"{ROOT}/out/eval-cache", help="where results are kept")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="default: all cores")
    options = parser.parse_args()
    for name in options.cases:
        if name not in CASES:
            parser.error(f"no case {name}; there are {' '.join(CASES)}")
    return options


def main():
    start = time.monotonic()
    options = arguments()
    if not options.data:
        environment.skip("neither GENTRACK2_SHARED nor --data names the measurement data")
    environment.enter()
    names = options.cases or list(CASES)
    bench = Bench(options)
    rows_of_all = [(name, row) for name in names for row in CASES[name]]
    try:
        if options.commands:
            for number, (name, row) in enumerate(rows_of_all, 1):
                print(f"{shlex.join(bench.command(row))} --out {name}-{number}.txt")
            return
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            # Derived sequences are made once, before the threads.
            for _, row in rows_of_all:
                bench.sequence(row)
            measured = list(pool.map(bench.measure, [row for _, row in rows_of_all]))
    except setups_module.Missing as error:
        environment.skip(error)
    except work.Failed as error:
        sys.exit(str(error))
    tables = {name: table(name, [scores for (case, _), scores in zip(rows_of_all, measured) if case == name])
              for name in names}
    if options.write:
        with open(PAGE) as file:
            page = file.read()
        for name, text in tables.items():
            page = written(page, name, text)
        store.write(PAGE, page)
    else:
        print("\n\n".join(f"{name}\n\n{text}" for name, text in tables.items()))
    print(f"{time.monotonic() - start:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
