"""The set-ups: which sequences with which detections, and how they are judged."""
import configparser
import dataclasses
import os
import shutil
import subprocess
import typing

import derive
import store

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MOT17 = ["MOT17-02", "MOT17-04", "MOT17-05", "MOT17-09", "MOT17-11"]
# The paper's set-up is one sequence.
PAPERS = "MOT17-04"
MOT15 = ["ADL-Rundle-6", "ETH-Sunnyday", "PETS09-S2L1", "TUD-Campus", "TUD-Stadtmitte"]
# This sequence has no video of its own: its frames are those of OpenCV's sample video.
SAMPLE_VIDEO = "PETS09-S2L1"


class Missing(Exception):
    """Data that a set-up needs is not there."""


@dataclasses.dataclass
class Sequence:
    name: str
    det: str
    gt: str
    frames: typing.Optional[int] = None
    size: typing.Optional[str] = None
    fps: typing.Optional[float] = None
    gmc: typing.Optional[str] = None
    video: typing.Optional[str] = None

    def arguments(self):
        """What gt2_mot is told about the sequence, as option and value; values of FILES are paths."""
        given = [("--det", self.det), ("--gmc", self.gmc), ("--video", self.video)]
        # A video says itself how large it is.
        given += [("--size", None if self.video else self.size), ("--frames", self.frames)]
        given += [("--fps", None if self.fps is None else f"{self.fps:g}")]
        return [(option, str(value)) for option, value in given if value is not None]


# The options whose values are files.
FILES = ("--det", "--gmc", "--video")


@dataclasses.dataclass
class Setup:
    name: str
    title: str
    sequences: list
    # How the judge counts: "full" or "half", and whether all people count.
    split: str
    humans: bool

    def judge_options(self):
        options = ["--split", self.split] + (["--humans"] if self.humans else [])
        return options + ["--seq"] + [sequence.name for sequence in self.sequences]


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
# Letters that stand for several.
GROUPS = {"W": ["Ws", "Wf"], "L": ["L2", "L4"], "all": NAMES}


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
        self.sample = None

    def path(self, *parts):
        path = os.path.join(self.data, *parts)
        if not os.path.exists(path):
            raise Missing(f"{path} is not there")
        return path

    def sequence(self, collection, name, det="det.txt", gmc=False):
        sequence = Sequence(name, self.path(collection, name, det), self.path(collection, name, "gt.txt"))
        ini = os.path.join(self.data, collection, name, "seqinfo.ini")
        if os.path.exists(ini):
            info = configparser.ConfigParser()
            info.read(ini)
            info = info["Sequence"]
            sequence.frames = int(info["seqLength"])
            sequence.size = f"{info['imWidth']}x{info['imHeight']}"
            sequence.fps = float(info["frameRate"])
        if gmc:
            sequence.gmc = self.path(collection, name, "gmc.txt")
        return sequence

    def derived(self, sources, recipe, make):
        """A directory of files made once from the sources by make(directory); any change of sources, recipe or
        derive.py makes a new one."""
        key = store.key("derived", recipe, *[store.content(path) for path in [derive.__file__, *sources]])
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
            rows = derive.degrade(derive.read_rows(sequence.det), derive.read_rows(sequence.gt), width, height,
                                  sequence.frames, self.seed)
            derive.write_rows(f"{directory}/det.txt", rows)

        directory = self.derived([sequence.det, sequence.gt], f"degraded/{self.seed}", make)
        return dataclasses.replace(sequence, det=f"{directory}/det.txt")

    def slower(self, sequence, step):
        def make(directory):
            for name, source in (("det.txt", sequence.det), ("gt.txt", sequence.gt)):
                derive.write_rows(f"{directory}/{name}", derive.subsample(derive.read_rows(source), step))
            motion = derive.compose_motion(sequence.gmc, step)
            with open(f"{directory}/gmc.txt", "w") as file:
                file.writelines(" ".join(row) + "\n" for row in motion)

        directory = self.derived([sequence.det, sequence.gt, sequence.gmc], f"slower/{step}", make)
        return dataclasses.replace(sequence, det=f"{directory}/det.txt", gt=f"{directory}/gt.txt",
                                   gmc=f"{directory}/gmc.txt", fps=sequence.fps / step,
                                   frames=derive.subsampled_length(sequence.frames, step))

    def video(self, name):
        if name != SAMPLE_VIDEO:
            return self.path("mot15", name, "video.mp4")
        if self.sample is None:
            done = subprocess.run(["tools/sample-video.sh", "out"], cwd=ROOT, capture_output=True, text=True)
            if done.returncode:
                raise Missing("vtest.avi, the images of PETS09-S2L1: " + done.stderr.strip()[-300:])
            self.sample = os.path.join(ROOT, done.stdout.strip())
        return self.sample

    def mot15(self, images):
        sequences = [self.sequence("mot15", name, "det-frcnn.txt") for name in MOT15]
        if images:
            for sequence in sequences:
                sequence.video = self.video(sequence.name)
        return sequences

    def dancetrack(self):
        names = sorted(os.listdir(self.path("dancetrack")))
        return [self.sequence("dancetrack", name, gmc=True) for name in names if name.startswith("dancetrack")]

    def build(self, name):
        """The set-up of that name; raises Missing."""
        humans = name in ("P", "Ws", "Wf", "R")
        split = "half" if name in ("H", "L2", "L4") else "full"
        if name in ("H", "L2", "L4"):
            sequences = [self.sequence("mot17", each, gmc=True) for each in MOT17]
            if name != "H":
                sequences = [self.slower(each, int(name[1:])) for each in sequences]
        elif humans:
            det = {"Ws": "det-sdp.txt", "Wf": "det-frcnn.txt"}.get(name, "det.txt")
            sequences = [self.sequence("mot17", PAPERS, det)]
            if name == "R":
                sequences = [self.degraded(sequences[0])]
        elif name == "D":
            sequences = self.dancetrack()
        else:
            sequences = self.mot15(images=name == "I")
        return Setup(name, TITLES[name], sequences, split, humans)
