"""Trackers run on sequences and judged, in parallel; what has been done before is taken from the cache."""
import dataclasses
import functools
import itertools
import json
import os
import re
import subprocess

import entries as entries_module
import judge
import scheduler as scheduler_module
import store
import work

# All sequences together.
ALL = "COMBINED_SEQ"


@dataclasses.dataclass
class Setup:
    """Sequences, and the rules by which the tracks of all of them are judged."""
    name: str
    title: str
    sequences: list
    rules: judge.Rules


class NothingCounts(Exception):
    """A sequence has no box that the judge's rules count; the message names it."""


@functools.lru_cache(maxsize=None)
def program_identity(program):
    """A hash of the program and the library that it loads."""
    loads = subprocess.run(["ldd", program], capture_output=True, text=True).stdout
    libraries = re.findall(r"libgentrack2\S* => (\S+)", loads)
    return store.key(*[store.content(os.path.realpath(path)) for path in [program, *libraries]])


class Evaluation:
    """`seeds` are those of entries that draw random numbers; None is their default."""

    def __init__(self, program, cache, jobs, setups, entries, seeds=(None,), metrics=judge.METRICS):
        self.program, self.cache = os.path.abspath(program), os.path.abspath(cache)
        self.setups, self.entries, self.seed_list, self.metrics = setups, entries, list(seeds), metrics
        self.judge_identity = judge.identity()
        self.scheduler = scheduler_module.Scheduler(jobs)
        # By set-up, entry, seed and sequence: the judge's result, and the file of tracks.
        self.results, self.tracks = {}, {}
        self.truths = {(setup.name, sequence.name): self.truth(setup, sequence)
                       for setup in setups for sequence in setup.sequences}

    def truth(self, setup, sequence):
        prepared = judge.prepare(sequence.gt, self.rules(setup, sequence), f"{self.cache}/truth")
        if prepared is None:
            wanted = "class 1" if setup.rules.classes is None else "classes " + ", ".join(map(str, setup.rules.classes))
            half = " in the second half of the frames" if setup.rules.split == "half" else ""
            raise NothingCounts(f"{sequence.gt}: no box counts: none of {wanted}{half}, or all are flagged 0")
        return prepared

    @staticmethod
    def rules(setup, sequence):
        return dataclasses.replace(setup.rules, benchmark=judge.benchmark_of(sequence.name))

    def seeds(self, entry):
        return self.seed_list if entry.tracker == entries_module.RANDOM else [None]

    def command(self, entry, sequence, seed):
        """gt2_mot's command, and the file of its tracks."""
        command, parts = [self.program, "--tracker", entry.tracker], [program_identity(self.program), entry.tracker]
        for option, value, is_file in sequence.arguments(entry.tracker in entries_module.LOOKS):
            command += [option, value] if value else [option]
            parts += [option, store.content(value) if is_file else value]
        more = [word for setting in entry.all_settings() for word in ("--set", setting)]
        more += [] if seed is None else ["--seed", str(seed)]
        return command + more, f"{self.cache}/tracks/{store.key('tracks and median times', *parts, *more)}.txt"

    def plan(self, setup, entry, seed, sequence):
        """Runs the tracker, then judges its tracks."""
        place = setup.name, entry.name, seed, sequence.name
        command, tracks = self.command(entry, sequence, seed)
        self.tracks[place] = tracks
        frames = sequence.frames or 1000
        # All runs before all judging, which then has a free choice of the order; images take longest.
        cost = 1e9 + frames * (100 if "--video" in command or "--images" in command else 1)
        self.scheduler.add(cost, work.track, (command, tracks), tracks,
                           lambda: self.plan_judging(setup, sequence, tracks, place))

    def plan_judging(self, setup, sequence, tracks, place):
        truth, rules = self.truths[setup.name, sequence.name], self.rules(setup, sequence)
        key = store.key("judged", self.judge_identity, truth.skipped, truth.frames, rules, self.metrics,
                        store.content(truth.path), store.content(tracks))
        out = f"{self.cache}/judged/{key}.json"

        def judged():
            with open(out) as file:
                self.results[place] = json.load(file)

        self.scheduler.add(sequence.frames or 1000, work.judge, (out, truth, tracks, rules, self.metrics), out, judged)

    def run(self, what="runs and judgements"):
        for setup, entry in itertools.product(self.setups, self.entries):
            for seed, sequence in itertools.product(self.seeds(entry), setup.sequences):
                self.plan(setup, entry, seed, sequence)
        self.scheduler.run(what)

    def result(self, setup, entry, seed=None, sequence=ALL):
        """The judge's result for a sequence, or for all together."""
        if sequence != ALL:
            return self.results[setup.name, entry.name, seed, sequence]
        return judge.combined([self.results[setup.name, entry.name, seed, each.name] for each in setup.sequences])

    def scores(self, setup, entry, seed=None, sequence=ALL):
        return judge.scores(self.result(setup, entry, seed, sequence))

    def time(self, setup, entry, seed=None):
        """Microseconds per step: the median of each sequence, which what else the machine does moves least, and their
        mean, weighted by frames."""
        steps = microseconds = 0
        for sequence in setup.sequences:
            with open(work.time_of(self.tracks[setup.name, entry.name, seed, sequence.name])) as file:
                times = json.load(file)
            steps, microseconds = steps + times["steps"], microseconds + times["steps"] * times["median"]
        return microseconds / max(steps, 1)
