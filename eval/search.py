"""The search for better parameters, by optuna."""
import dataclasses
import json
import logging
import os
import sys
import time

import optuna
import tqdm

import evaluation as evaluation_module
import judge
import store
import work

optuna.logging.set_verbosity(logging.WARNING)


class Trials:
    """Scores of parameter sets on sequences; every run is done once and then known."""

    def __init__(self, evaluation, setup, base, metric, library):
        self.evaluation, self.setup, self.base, self.metric, self.library = evaluation, setup, base, metric, library
        self.metrics = (judge.SOURCES[metric],)
        # Processes that are made later have it already.
        judge.library()

    def identity(self):
        """Changes with all that a score depends on beside parameters and sequences."""
        return store.key(evaluation_module.program_identity(self.evaluation.program), self.evaluation.judge_identity,
                         self.setup.rules, self.metric, self.base.all_settings())

    def command(self, sequence, values):
        """gt2_mot's command with these parameters, and the key of its tracks."""
        settings = [f"{key}={value}" for key, value in sorted(values.items())]
        entry = dataclasses.replace(self.base, settings=self.base.settings + settings)
        command, tracks = self.evaluation.command(entry, sequence, None)
        return command, os.path.basename(tracks)

    def inputs(self, sequence):
        """What changes with anything of the sequence that a score depends on."""
        truth = self.evaluation.truths[self.setup.name, sequence.name]
        return self.command(sequence, {})[1], store.content(truth.path), truth.skipped, truth.frames

    def score(self, sequences, values):
        """The metric in percent over the sequences together."""
        evaluation, files = self.evaluation, []
        for sequence in sequences:
            truth, rules = evaluation.truths[self.setup.name, sequence.name], evaluation.rules(self.setup, sequence)
            command, tracks = self.command(sequence, values)
            key = store.key("score", self.identity(), tracks, store.content(truth.path), truth.skipped, truth.frames)
            out = f"{evaluation.cache}/tune/{key}.json"
            files.append(out)
            evaluation.scheduler.add(sequence.frames, work.score, (out, command, truth, rules, self.metrics), out,
                                     lambda: None)
        evaluation.scheduler.run()
        results = []
        for path in files:
            with open(path) as file:
                results.append(json.load(file))
        return judge.score(judge.combined(results), self.metric)

    def fingerprints(self, sequence, all_values):
        """What tells whether tracks differ, for each of these parameter sets."""
        files = []
        for values in all_values:
            command, tracks = self.command(sequence, values)
            out = f"{self.evaluation.cache}/tune/{store.key('fingerprint', tracks)}.txt"
            files.append(out)
            self.evaluation.scheduler.add(sequence.frames, work.fingerprint, (out, command), out, lambda: None)
        self.evaluation.scheduler.run("which parameters have an effect")
        return [store.content(path) for path in files]

    def effective(self, dimensions):
        """Those that change any track when they are at an end of their range."""
        found = set()
        for sequence in sorted(self.setup.sequences, key=lambda sequence: sequence.frames):
            left = [(each, end) for each in dimensions if each.key not in found for end in each.ends()
                    if not self.library.complaint(self.base.tracker, {each.key: end})]
            usual, *changed = self.fingerprints(sequence, [{}] + [{each.key: end} for each, end in left])
            found |= {each.key for (each, _), tracks in zip(left, changed) if tracks != usual}
        return [each for each in dimensions if each.key in found]


class Searcher:
    """Searches the same space on several sets of sequences, one after the other."""

    def __init__(self, trials, dimensions, count, end, seed, path):
        self.trials, self.dimensions, self.count, self.end, self.seed = trials, dimensions, count, end, seed
        os.makedirs(os.path.dirname(path), exist_ok=True)
        self.storage = optuna.storages.JournalStorage(optuna.storages.journal.JournalFileBackend(path))
        self.searches_left = 1
        self.bar = None

    def __enter__(self):
        self.bar = tqdm.tqdm(desc="tune", total=self.count * self.searches_left, file=sys.stderr, disable=None)
        return self

    def __exit__(self, *_):
        self.bar.close()

    def plan(self, searches):
        self.searches_left = searches
        return self

    def study(self, sequences):
        """The study of these sequences, as far as it has come."""
        # Beside the detections, scores depend on images, camera motion, frame rate: on the whole command.
        contents = [part for sequence in sequences for part in self.trials.inputs(sequence)]
        name = store.key("study", self.trials.identity(), self.dimensions, self.seed, *contents)
        study = optuna.create_study(study_name=name, storage=self.storage, direction="maximize", load_if_exists=True)
        known = study.get_trials(deepcopy=False)
        # One that goes on must not draw again what it drew at first.
        study.sampler = optuna.samplers.TPESampler(seed=self.seed + len(known), multivariate=True)
        if not known:
            # What is there must be among what is compared.
            study.enqueue_trial({each.key: each.default() for each in self.dimensions})
        return study

    def search(self, sequences):
        """The best values found, by key as text, and their score; the defaults, if nothing is better."""
        study = self.study(sequences)
        state = optuna.trial.TrialState
        done = len(study.get_trials(deepcopy=False, states=(state.COMPLETE, state.PRUNED)))
        self.bar.update(min(done, self.count))
        end = None if self.end is None else time.monotonic() + (self.end - time.monotonic()) / self.searches_left
        while done < self.count and (done == 0 or end is None or time.monotonic() < end):
            trial = study.ask()
            values = {each.key: each.suggest(trial) for each in self.dimensions}
            if self.trials.library.complaint(self.trials.base.tracker, values):
                study.tell(trial, state=state.PRUNED)
            else:
                trial.set_user_attr("values", values)
                study.tell(trial, self.trials.score(sequences, values))
            done += 1
            self.bar.update()
            self.bar.set_postfix_str(f"{self.trials.metric} {study.best_value:.2f}")
        self.searches_left -= 1
        default = self.trials.score(sequences, {})
        if study.best_value <= default:
            return {}, default
        return dict(study.best_trial.user_attrs["values"]), study.best_value
