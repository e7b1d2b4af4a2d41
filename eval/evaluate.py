#!/usr/bin/env python3
"""Runs trackers over all set-ups and prints one table of their accuracy; see eval/README.md."""
import argparse
import concurrent.futures
import dataclasses
import heapq
import importlib.metadata
import itertools
import json
import multiprocessing
import os
import re
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
sys.path[:0] = [HERE, os.path.join(ROOT, "examples_cpp", "tests")]
import entries as entries_module  # noqa: E402
import own_venv  # noqa: E402
import setups as setups_module  # noqa: E402
import store  # noqa: E402
import work  # noqa: E402

# One core per process is what the parallel work is planned for.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# Scores with whether more is better; the last two only where asked for.
SCORES = {"ATA": True, "IDF1": True, "HOTA": True, "MOTA": True, "IDSW": False, "FP": False, "FN": False}
COUNTS = ("IDSW", "FP", "FN")
ALL = "COMBINED_SEQ"


def enter_python():
    """Starts the program again in a Python that has TrackEval, if this one has not."""
    try:
        importlib.metadata.version("trackeval")
    except importlib.metadata.PackageNotFoundError:
        own_venv.enter(os.environ.get("GENTRACK2_TRACKEVAL_VENV") or f"{ROOT}/build/trackeval-venv", "trackeval")


def common_options(parser):
    parser.add_argument("--program", default=f"{ROOT}/build/examples_cpp/gt2_mot", help="the built gt2_mot")
    parser.add_argument("--data", default=os.environ.get("GENTRACK2_SHARED"),
                        help="directory of the data and the judge; default: what GENTRACK2_SHARED names")
    parser.add_argument("--cache", default=f"{ROOT}/out/eval-cache", help="where results are kept")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings",
                        help="a parameter of all entries that are gentrack2; may be given again")
    parser.add_argument("--degrade-seed", type=int, default=1, metavar="N", help="seed of set-up R's worse detector")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="default: all cores")


def prepare(options):
    """Ends the program where something is missing; sees to TrackEval."""
    if not options.data:
        own_venv.skip("GENTRACK2_SHARED does not name the measurement data, nor does --data")
    if not os.path.isfile(f"{options.data}/tools/eval_mot.py"):
        own_venv.skip(f"{options.data} has no tools/eval_mot.py: it is not the measurement data")
    if not os.access(options.program, os.X_OK):
        sys.exit(f"{options.program} is not there: run `make build` or give --program")
    options.program = os.path.abspath(options.program)
    enter_python()


def program_identity(program):
    """A hash of the program and the library that it loads."""
    loads = subprocess.run(["ldd", program], capture_output=True, text=True).stdout
    libraries = re.findall(r"libgentrack2\S* => (\S+)", loads)
    return store.key(*[store.content(os.path.realpath(path)) for path in [program, *libraries]])


@dataclasses.dataclass(order=True)
class Task:
    # Most expensive first, so that no long one is left at the end.
    priority: float
    number: int
    function: object = dataclasses.field(compare=False)
    arguments: tuple = dataclasses.field(compare=False)
    out: str = dataclasses.field(compare=False)
    then: object = dataclasses.field(compare=False, default=None)


class Scheduler:
    """Does tasks in parallel, those whose output file exists not at all, and none twice."""

    def __init__(self, jobs):
        self.jobs = jobs
        self.numbers = itertools.count()
        self.ready, self.known = [], {}
        self.done = {"track": 0, "judge_into": 0}
        self.left = 0

    def add(self, cost, function, arguments, out, then):
        """`then` is called when the file is there: at once, if it is."""
        if os.path.exists(out):
            then()
        elif out in self.known:
            self.known[out].append(then)
        else:
            self.known[out] = [then]
            self.left += 1
            heapq.heappush(self.ready, Task(-cost, next(self.numbers), function, arguments, out))

    def progress(self):
        if sys.stderr.isatty():
            print(f"\r\033[K{self.done['track']} runs and {self.done['judge_into']} scores done, {self.left} in view",
                  end="", file=sys.stderr, flush=True)

    def run(self):
        if not self.ready:
            return
        context = multiprocessing.get_context("fork")
        with concurrent.futures.ProcessPoolExecutor(self.jobs, mp_context=context) as pool:
            running = {}
            try:
                while self.ready or running:
                    while self.ready and len(running) < self.jobs:
                        task = heapq.heappop(self.ready)
                        running[pool.submit(task.function, *task.arguments)] = task
                    self.progress()
                    finished, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                    for future in finished:
                        task = running.pop(future)
                        future.result()
                        self.left -= 1
                        self.done[task.function.__name__] += 1
                        for then in self.known.pop(task.out):
                            then()
            finally:
                if sys.stderr.isatty():
                    print("\r\033[K", end="", file=sys.stderr, flush=True)


class Evaluation:
    def __init__(self, options, setups, entries):
        self.options, self.setups, self.entries = options, setups, entries
        self.program = program_identity(options.program)
        self.judge = f"{options.data}/tools/eval_mot.py"
        self.judge_identity = store.key(store.content(self.judge), importlib.metadata.version("trackeval"))
        self.scheduler = Scheduler(options.jobs)
        # By set-up, entry and seed: the judge's table.
        self.tables = {}

    def command(self, entry, sequence, seed):
        """gt2_mot's command, and the file of its tracks."""
        command, parts = [self.options.program, "--tracker", entry.tracker], [self.program, entry.tracker]
        for option, value in sequence.arguments():
            command += [option, value]
            parts += [option, store.content(value) if option in setups_module.FILES else value]
        for setting in entry.all_settings():
            command += ["--set", setting]
        if seed is not None:
            command += ["--seed", str(seed)]
        parts += command[command.index("--set"):] if "--set" in command else []
        parts += ["--seed", seed]
        return command, f"{self.options.cache}/tracks/{store.key('tracks', *parts)}.txt"

    def seeds(self, entry):
        return self.options.seed_list if entry.tracker == entries_module.RANDOM else [None]

    def plan(self, setup, entry, seed, then=None):
        """Runs all sequences, then judges them."""
        tracks = {}
        missing = len(setup.sequences)

        def tracked():
            nonlocal missing
            missing -= 1
            if not missing:
                (then or self.plan_score)(setup, entry, seed, tracks)

        for sequence in setup.sequences:
            command, out = self.command(entry, sequence, seed)
            tracks[sequence.name] = out
            # All runs before all judging, which then has a free choice of the order; videos take longest.
            cost = 1e9 + (sequence.frames or 1000) * (100 if sequence.video else 1)
            self.scheduler.add(cost, work.track, (command, out), out, tracked)

    def plan_score(self, setup, entry, seed, tracks):
        truth = {sequence.name: sequence.gt for sequence in setup.sequences}
        contents = [store.content(path) for files in (tracks, truth) for path in files.values()]
        options = setup.judge_options()
        out = f"{self.options.cache}/scores/{store.key('scores', self.judge_identity, *options, *contents)}.json"

        def scored():
            with open(out) as file:
                self.tables[setup.name, entry.name, seed] = json.load(file)

        cost = sum(sequence.frames or 1000 for sequence in setup.sequences)
        self.scheduler.add(cost, work.judge_into, (out, self.judge, truth, tracks, options), out, scored)

    def run(self):
        for setup, entry in itertools.product(self.setups, self.entries):
            for seed in self.seeds(entry):
                self.plan(setup, entry, seed)
        self.scheduler.run()

    def values(self, setup, entry, sequence, score):
        return [self.tables[setup.name, entry.name, seed][sequence][score] for seed in self.seeds(entry)]


def mean(values):
    return sum(values) / len(values)


def deviation(values):
    middle = mean(values)
    return (sum((value - middle) ** 2 for value in values) / (len(values) - 1)) ** 0.5


def shown(score, values, spread):
    digits = (1 if spread else 0) if score in COUNTS else 2
    text = f"{mean(values):.{digits}f}"
    if spread and len(values) > 1:
        text += f" ±{deviation(values):.{digits}f}"
    return text


def rows_of(evaluation, setup, sequence, scores):
    """Rows of a block of the table: a name and, per score, a text and whether it is the best."""
    spread = len(evaluation.options.seed_list) > 1
    entries = evaluation.entries
    columns = []
    for score in scores:
        values = [evaluation.values(setup, entry, sequence, score) for entry in entries]
        texts = [shown(score, each, spread) for each in values]
        ranked = [round(mean(each), 6) * (1 if SCORES[score] else -1) for each in values]
        columns.append([(text, len(entries) > 1 and rank == max(ranked)) for text, rank in zip(texts, ranked)])
    return [(entry.name, [column[i] for column in columns]) for i, entry in enumerate(entries)]


def blocks(evaluation, scores):
    """All blocks of the table: a title and rows."""
    for setup in evaluation.setups:
        yield f"{setup.name}: {setup.title}", rows_of(evaluation, setup, ALL, scores)
        if evaluation.options.per_sequence and len(setup.sequences) > 1:
            for sequence in setup.sequences:
                yield f"{setup.name} {sequence.name}", rows_of(evaluation, setup, sequence.name, scores)


def print_table(evaluation, scores):
    width = max(9, *(len(entry.name) for entry in evaluation.entries)) + 2
    cell = 16 if len(evaluation.options.seed_list) > 1 else 9
    for title, rows in blocks(evaluation, scores):
        print(f"\n{title}")
        print(" " * width + "".join(f"{score:>{cell - 1}} " for score in scores))
        for name, cells in rows:
            print(f"{name:<{width}}" + "".join(f"{text:>{cell - 1}}{'*' if best else ' '}" for text, best in cells))


def markdown(evaluation, scores):
    lines = []
    for title, rows in blocks(evaluation, scores):
        lines += [f"### {title}", "", "| | " + " | ".join(scores) + " |", "|---|" + "---|" * len(scores)]
        for name, cells in rows:
            lines.append(f"| {name} | " + " | ".join(f"**{text}**" if best else text for text, best in cells) + " |")
        lines.append("")
    return "\n".join(lines)


def as_json(evaluation):
    result = {}
    for setup, entry in itertools.product(evaluation.setups, evaluation.entries):
        runs = [{"seed": seed, "scores": evaluation.tables[setup.name, entry.name, seed]}
                for seed in evaluation.seeds(entry)]
        row = {"tracker": entry.tracker, "settings": entry.all_settings(), "runs": runs}
        result.setdefault(setup.name, {})[entry.name] = row
    return json.dumps(result, indent=1) + "\n"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--setups", default="all", help=f"of {' '.join(setups_module.NAMES)}, with commas; W and L "
                        "stand for both of theirs; default: all")
    parser.add_argument("--entries", action="append", default=[],
                        help="rows, with commas: a tracker, `paper` (gentrack2 with that preset) or "
                        "NAME=TRACKER:KEY=VALUE,KEY=VALUE; may be given again; default: all trackers and paper")
    common_options(parser)
    seeds = parser.add_mutually_exclusive_group()
    seeds.add_argument("--seed", type=int, help="seed of gentrack2; default: its own default")
    seeds.add_argument("--seeds", type=int, metavar="N", help="seeds 1 to N: mean and standard deviation")
    parser.add_argument("--per-sequence", action="store_true", help="scores of each sequence, too")
    parser.add_argument("--counts", action="store_true", help="false positives and negatives, too")
    parser.add_argument("--json", metavar="FILE", help="also write everything as JSON")
    parser.add_argument("--markdown", metavar="FILE", help="also write the table as Markdown")
    options = parser.parse_args()
    options.seed_list = list(range(1, options.seeds + 1)) if options.seeds else [options.seed]
    try:
        options.setup_names = setups_module.expand(options.setups)
        options.entry_list = parse_entries(options.entries or [",".join(entries_module.DEFAULT)], options.settings)
    except ValueError as error:
        parser.error(str(error))
    return options


def parse_entries(texts, settings):
    entries = [entry for text in texts for entry in entries_module.parse(text)]
    names = [entry.name for entry in entries]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"two entries are named {name}")
    for entry in entries:
        if entry.tracker == "gentrack2":
            entry.settings += settings
    return entries


def build_setups(options, names):
    builder = setups_module.Builder(os.path.abspath(options.data), os.path.abspath(options.cache),
                                    options.degrade_seed)
    built = []
    for name in names:
        try:
            built.append(builder.build(name))
        except setups_module.Missing as error:
            print(f"set-up {name} is left out: {error}", file=sys.stderr)
    if not built:
        own_venv.skip("no set-up has its data")
    return built


def main():
    start = time.monotonic()
    options = arguments()
    prepare(options)
    evaluation = Evaluation(options, build_setups(options, options.setup_names), options.entry_list)
    try:
        evaluation.run()
    except work.Failed as error:
        sys.exit(str(error))
    scores = [score for score in SCORES if options.counts or score not in ("FP", "FN")]
    print_table(evaluation, scores)
    if options.json:
        store.write(os.path.abspath(options.json), as_json(evaluation))
    if options.markdown:
        store.write(os.path.abspath(options.markdown), markdown(evaluation, scores))
    done = evaluation.scheduler.done
    print(f"\n* best of its column. {done['track']} runs and {done['judge_into']} scores were new; "
          f"{time.monotonic() - start:.1f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
