"""The set-ups: which sequences with which detections, and how they are judged."""
import dataclasses
import os
import shutil

import dataset
import derive
import frames
import judge
import rows
import store
from evaluation import Setup

MOT17 = ["MOT17-02", "MOT17-04", "MOT17-05", "MOT17-09", "MOT17-11"]
# The paper's set-up is one sequence.
PAPERS = "MOT17-04"
MOT15 = ["ADL-Rundle-6", "ETH-Sunnyday", "PETS09-S2L1", "TUD-Campus", "TUD-Stadtmitte"]


class Missing(Exception):
    """Data that a set-up needs is not there."""


TITLES = {
    "H": "MOT17, second halves, YOLOX, camera motion",
    "P": "MOT17-04, all people, YOLOX",
    "Ws": "MOT17-04, all people, SDP detections",
    "Wf": "MOT17-04, all people, Faster R-CNN detections",
    "R": "MOT17-04, all people, YOLOX made worse: bursts of misses, noise, clutter",
    "L2": "H at every 2nd frame",
    "L4": "H at every 4th frame",
    "I": "MOT15, five sequences, Faster R-CNN, with images",
    "I0": "the same without images",
    "D": "DanceTrack, eight sequences, YOLOX, camera motion",
}
NAMES = list(TITLES)
# The detector on every k-th frame, the ways to use that: docs/degraded-input.md. Only run where asked for.
STEPS = (2, 3, 5)
TITLES |= {f"S{k}": f"H, the detector on every {k}. frame, the others stepped as rests and judged, too" for k in STEPS}
TITLES |= {f"T{k}": f"H at every {k}. frame, with timestamps" for k in STEPS}
TITLES |= {f"N{k}": f"H at every {k}. frame, which nobody is told" for k in STEPS}
# Letters that stand for several.
GROUPS = {"W": ["Ws", "Wf"], "L": ["L2", "L4"], "all": NAMES}
GROUPS |= {kind: [f"{kind}{k}" for k in STEPS] for kind in "STN"}


def expand(text):
    """The set-ups that a list such as "H,W" names."""
    names = []
    for name in filter(None, text.split(",")):
        group = GROUPS.get(name, [name])
        if group[0] not in TITLES:
            raise ValueError(f"unknown set-up {name}; there are {' '.join(NAMES)}, and {' '.join(GROUPS)} for several")
        names += [each for each in group if each not in names]
    return names


class Builder:
    def __init__(self, data, cache, seed):
        self.data, self.cache, self.seed = data, cache, seed

    def path(self, *parts):
        path = os.path.join(self.data, *parts)
        if not os.path.exists(path):
            raise Missing(f"{path} is not there")
        return path

    def sequence(self, collection, name, det="det.txt", gmc=False):
        sequence = dataset.Sequence(name, self.path(collection, name, det), self.path(collection, name, "gt.txt"))
        ini = os.path.join(self.data, collection, name, "seqinfo.ini")
        if os.path.exists(ini):
            sequence = dataclasses.replace(sequence, **dataset.read_info(ini)[0])
        if gmc:
            sequence.gmc = self.path(collection, name, "gmc.txt")
        return sequence

    def derived(self, sources, recipe, make):
        """A directory of files made once from the sources by make(directory); any change of sources, recipe or
        derive.py makes a new one."""
        key = store.key(
            "derived", recipe, *[store.content(path) for path in [derive.__file__, rows.__file__, *sources]]
        )
        directory = os.path.join(self.cache, "derived", key)
        if not os.path.isdir(directory):
            part = f"{directory}.{os.getpid()}"
            os.makedirs(part)
            make(part)
            try:
                os.rename(part, directory)
            except OSError:  # somebody else was faster
                shutil.rmtree(part)
        return directory

    def degraded(self, sequence):
        def make(directory):
            width, height = (int(value) for value in sequence.size.split("x"))
            worse = derive.degrade(rows.read_rows(sequence.det), rows.read_rows(sequence.gt), width, height,
                                   sequence.frames, self.seed)
            rows.write_rows(f"{directory}/det.txt", worse)

        directory = self.derived([sequence.det, sequence.gt], f"degraded/{self.seed}", make)
        return dataclasses.replace(sequence, det=f"{directory}/det.txt")

    def slower(self, sequence, step):
        def make(directory):
            for name, source in (("det.txt", sequence.det), ("gt.txt", sequence.gt)):
                rows.write_rows(f"{directory}/{name}", derive.subsample(rows.read_rows(source), step))
            motion = derive.compose_motion(sequence.gmc, step)
            with open(f"{directory}/gmc.txt", "w") as file:
                file.writelines(" ".join(row) + "\n" for row in motion)

        directory = self.derived([sequence.det, sequence.gt, sequence.gmc], f"slower/{step}", make)
        return dataclasses.replace(sequence, det=f"{directory}/det.txt", gt=f"{directory}/gt.txt",
                                   gmc=f"{directory}/gmc.txt", fps=sequence.fps / step,
                                   frames=derive.subsampled_length(sequence.frames, step))

    def every(self, sequence, kind, step):
        """The sequence with a detector that only runs on every so many-th frame."""
        if kind == "S":
            return dataclasses.replace(sequence, detect_every=step)
        rate = sequence.fps / step if kind == "T" else None
        return dataclasses.replace(self.slower(sequence, step), fps=sequence.fps, timestamp_rate=rate)

    def video(self, name):
        if name != frames.SAMPLE_SEQUENCE:
            return self.path("mot15", name, "video.mp4")
        try:
            return frames.sample_video()
        except frames.NoVideo as error:
            raise Missing(str(error)) from None

    def mot15(self, images):
        sequences = [self.sequence("mot15", name, "det-frcnn.txt") for name in MOT15]
        if images:
            for sequence in sequences:
                sequence.images = self.video(sequence.name)
        return sequences

    def dancetrack(self):
        names = sorted(os.listdir(self.path("dancetrack")))
        return [self.sequence("dancetrack", name, gmc=True) for name in names if name.startswith("dancetrack")]

    def build(self, name):
        """The set-up of that name; raises Missing."""
        kind = name[0]
        rules = judge.Rules("half" if kind in "HLSTN" else "full",
                            judge.PEOPLE if name in ("P", "Ws", "Wf", "R") else None)
        if rules.split == "half":
            sequences = [self.sequence("mot17", each, gmc=True) for each in MOT17]
            if kind == "L":
                sequences = [self.slower(each, int(name[1:])) for each in sequences]
            elif kind != "H":
                sequences = [self.every(each, kind, int(name[1:])) for each in sequences]
        elif rules.classes:
            det = {"Ws": "det-sdp.txt", "Wf": "det-frcnn.txt"}.get(name, "det.txt")
            sequences = [self.sequence("mot17", PAPERS, det)]
            if name == "R":
                sequences = [self.degraded(sequences[0])]
        elif name == "D":
            sequences = self.dancetrack()
        else:
            sequences = self.mot15(images=name == "I")
        return Setup(name, TITLES[name], sequences, rules)
