"""The judge: TrackEval on the tracks of one sequence, and its results of several together.

TrackEval, and what comes with it, is imported where it is used: the right Python is running only then.
"""
import contextlib
import dataclasses
import functools
import importlib.metadata
import io
import os
import tempfile
import typing

import identities
import rows
import store

METRICS = ("HOTA", "CLEAR", "Identity", "VACE")
# The metric that each score comes from.
SOURCES = {"ATA": "VACE", "IDF1": "Identity", "HOTA": "HOTA", "MOTA": "CLEAR"}


@dataclasses.dataclass(frozen=True)
class Rules:
    """What counts: all frames ("full") or the second half of them ("half"); people by MOT17's rules, or all boxes of
    some classes, as one class and whatever their flag says."""
    split: str = "full"
    classes: typing.Optional[tuple] = None
    # MOT20's rules forgive tracks of one class more.
    benchmark: str = "MOT17"


# The paper's: pedestrians and those who stand still.
PEOPLE = (1, 7)


@dataclasses.dataclass(frozen=True)
class Truth:
    """Ground truth as the judge takes it; its frames are numbered from 1, after the `skipped` ones."""
    path: str
    skipped: int
    frames: int


def benchmark_of(name):
    return "MOT20" if name.startswith("MOT20") else "MOT17"


def identity():
    """Changes with all that scores depend on beside their inputs."""
    sources = [store.content(module.__file__) for module in (identities, rows)] + [store.content(__file__)]
    return store.key(*sources, *(importlib.metadata.version(name) for name in ("trackeval", "numpy", "scipy")))


def has_places(truth, rules):
    """Whether column 8 does not hold MOT17's classes: MOT15 has places in the world there."""
    def is_class(text):
        value = float(text)
        return value == int(value) and value >= 1 and (value < 14 or rules.classes is not None)

    return any(len(row) > 7 and not is_class(row[7]) for row in truth)


def counted(row, places, rules):
    """The row as the judge takes it, with its columns of flag, class and visibility; None if it does not count."""
    if places:
        row = row[:6] + [row[6], "1", "1"]
    if rules.classes is not None and len(row) > 7:
        if int(float(row[7])) not in rules.classes:
            return None
        row = row[:6] + ["1", "1"] + row[8:]
    if len(row) < 9:
        row = row[:6] + ["1", "1", "1"]
    flag = row[6] if row[6] in ("0", "1") else "0" if float(row[6]) == 0 else "1"
    return row[:6] + [flag, row[7] if float(row[7]) >= 1 else "1"] + row[8:]


def prepare(path, rules, directory):
    """Writes the ground truth for the judge, once, and returns it; None if nothing of it counts."""
    truth = rows.read_rows(path)
    frames = max(map(rows.frame_of, truth))
    skipped = frames // 2 + 1 if rules.split == "half" else 0
    out = f"{directory}/{store.key('truth', store.content(__file__), store.content(path), rules)}.txt"
    if not os.path.exists(out):
        places = has_places(truth, rules)
        kept = [counted(row, places, rules) for row in truth if rows.frame_of(row) > skipped]
        store.write(out, "".join(",".join([str(rows.frame_of(row) - skipped), *row[1:]]) + "\n" for row in kept if row))
    prepared = Truth(out, skipped, frames - skipped)
    with open(out) as file:
        return prepared if any(row[6] != "0" and float(row[7]) == 1 for row in map(rows.split, file)) else None


@functools.lru_cache(maxsize=None)
def library():
    # It prints what it cannot use of itself.
    with contextlib.redirect_stdout(io.StringIO()):
        import trackeval
    return trackeval


def metric(name):
    return getattr(library().metrics, name)({"PRINT_CONFIG": False})


def data_of(truth, tracks, rules):
    """TrackEval's data of a sequence, as read and as judged."""
    with tempfile.TemporaryDirectory() as work:
        os.makedirs(f"{work}/gt/S/gt")
        os.makedirs(f"{work}/tracks/T/data")
        os.symlink(os.path.abspath(truth.path), f"{work}/gt/S/gt/gt.txt")
        last = truth.skipped + truth.frames
        given = [[str(rows.frame_of(row) - truth.skipped), str(int(float(row[1]))), *row[2:6], "1", "-1", "-1", "-1"]
                 for row in rows.read_rows(tracks) if truth.skipped < rows.frame_of(row) <= last]
        rows.write_rows(f"{work}/tracks/T/data/S.txt", given)
        kind = library().datasets.MotChallenge2DBox
        config = kind.get_default_dataset_config()
        config.update(GT_FOLDER=f"{work}/gt", TRACKERS_FOLDER=f"{work}/tracks", TRACKERS_TO_EVAL=["T"],
                      BENCHMARK=rules.benchmark, SKIP_SPLIT_FOL=True, SEQ_INFO={"S": truth.frames}, PRINT_CONFIG=False,
                      DO_PREPROC=rules.classes is None, OUTPUT_FOLDER=work)
        dataset = kind(config)
        raw = dataset.get_raw_seq_data("T", "S")
        return raw, dataset.get_preprocessed_seq_data(raw, "pedestrian")


def plain(value):
    """A number or list of numpy's as Python's."""
    return value.tolist() if hasattr(value, "tolist") else value


def judge(truth, tracks, rules, metrics=METRICS):
    """What the metrics say of a file of tracks, per metric and field, and if all are asked, what became of identities:
    to be stored as JSON."""
    raw, data = data_of(truth, tracks, rules)
    result = {name: {field: plain(value) for field, value in metric(name).eval_sequence(data).items()}
              for name in metrics}
    if metrics == METRICS:
        result["identities"] = identities.history(raw, data, truth.skipped + 1)
    return result


def combined(results):
    """The results of several sequences together, per metric."""
    import numpy
    together = {}
    for name in results[0]:
        if name != "identities":
            fields = {str(i): {field: numpy.asarray(value) for field, value in result[name].items()}
                      for i, result in enumerate(results)}
            together[name] = {field: plain(value) for field, value in metric(name).combine_sequences(fields).items()}
    return together


def mean(values):
    return sum(values) / len(values)


def score(result, name):
    """A score in percent."""
    value = result[SOURCES[name]][name]
    return 100 * (mean(value) if isinstance(value, list) else value)


def scores(result):
    """The scores that tables show; a list is one of localisation thresholds."""
    clear = result["CLEAR"]
    return {**{name: score(result, name) for name in SOURCES}, "IDSW": int(clear["IDSW"]), "FP": int(clear["CLR_FP"]),
            "FN": int(clear["CLR_FN"]), "AssA": 100 * mean(result["HOTA"]["AssA"]),
            "DetA": 100 * mean(result["HOTA"]["DetA"]), "HOTA_alpha": [100 * each for each in result["HOTA"]["HOTA"]]}


def thresholds():
    """The localisation thresholds of HOTA."""
    return plain(metric("HOTA").array_labels)
