"""Scores of many entries, and which of them are best."""
import itertools
import json

from evaluation import ALL
from judge import mean

# Scores with whether more is better; the last two only where asked for.
SCORES = {"ATA": True, "IDF1": True, "HOTA": True, "MOTA": True, "IDSW": False, "FP": False, "FN": False}
COUNTS = ("IDSW", "FP", "FN")


class Table:
    """The scores of all set-ups and entries."""

    def __init__(self, evaluation, per_sequence):
        self.evaluation, self.per_sequence = evaluation, per_sequence
        self.setups, self.entries = evaluation.setups, evaluation.entries
        self.spread = len(evaluation.seed_list) > 1
        # By set-up, entry and seed: scores per sequence, and of all together.
        self.scores = {(setup.name, entry.name, seed):
                       {name: evaluation.scores(setup, entry, seed, name)
                        for name in [*(sequence.name for sequence in setup.sequences), ALL]}
                       for setup, entry in itertools.product(self.setups, self.entries)
                       for seed in evaluation.seeds(entry)}

    def values(self, setup, entry, sequence, score):
        return [self.scores[setup.name, entry.name, seed][sequence][score] for seed in self.evaluation.seeds(entry)]


def deviation(values):
    middle = mean(values)
    return (sum((value - middle) ** 2 for value in values) / (len(values) - 1)) ** 0.5


def shown(score, values, spread):
    digits = (1 if spread else 0) if score in COUNTS else 2
    text = f"{mean(values):.{digits}f}"
    if spread and len(values) > 1:
        text += f" ±{deviation(values):.{digits}f}"
    return text


def best_of(values, more_is_better):
    """Which of the values are best, none if there is only one."""
    ranked = [round(value, 6) * (1 if more_is_better else -1) for value in values]
    return [len(values) > 1 and rank == max(ranked) for rank in ranked]


def rows_of(table, setup, sequence, scores):
    """Rows of a block of the table: a name and, per score, a text and whether it is the best."""
    columns = []
    for score in scores:
        values = [table.values(setup, entry, sequence, score) for entry in table.entries]
        texts = [shown(score, each, table.spread) for each in values]
        columns.append(list(zip(texts, best_of([mean(each) for each in values], SCORES[score]))))
    return [(entry.name, [column[i] for column in columns]) for i, entry in enumerate(table.entries)]


def blocks(table, scores):
    """All blocks of the table: a title and rows."""
    for setup in table.setups:
        yield f"{setup.name}: {setup.title}", rows_of(table, setup, ALL, scores)
        if table.per_sequence and len(setup.sequences) > 1:
            for sequence in setup.sequences:
                yield f"{setup.name} {sequence.name}", rows_of(table, setup, sequence.name, scores)


def print_table(table, scores):
    width = max(9, *(len(entry.name) for entry in table.entries)) + 2
    cell = 16 if table.spread else 9
    for title, rows in blocks(table, scores):
        print(f"\n{title}")
        print(" " * width + "".join(f"{score:>{cell - 1}} " for score in scores))
        for name, cells in rows:
            print(f"{name:<{width}}" + "".join(f"{text:>{cell - 1}}{'*' if best else ' '}" for text, best in cells))


def as_json(table):
    result = {}
    for setup, entry in itertools.product(table.setups, table.entries):
        runs = [{"seed": seed, "scores": table.scores[setup.name, entry.name, seed]}
                for seed in table.evaluation.seeds(entry)]
        row = {"tracker": entry.tracker, "settings": entry.all_settings(), "runs": runs}
        result.setdefault(setup.name, {})[entry.name] = row
    return json.dumps(result, indent=1) + "\n"
