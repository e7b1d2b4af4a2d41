"""A folder of sequences in MOTChallenge's layout: what is in it, and what of that is used.

Sequences are folders with gt/gt.txt or gt.txt, in the folder itself or in its train/ or val/. Whatever is decided here
is told to `say`, a sentence each; what makes the folder useless is an `Unusable`.
"""
import configparser
import dataclasses
import fnmatch
import glob
import os
import re
import typing

import frames as frames_module
import rows

# The folders of sequences in a data set, in this order.
PARTS = ("", "train", "val")
TRUTH = ("gt/gt.txt", "gt.txt")
DETECTIONS = ("det/det.txt", "det.txt")
MOTIONS = ("gmc.txt", "gmc/gmc.txt")
EMBEDDINGS = "embeddings.f32"
# MOT17 has each of its videos once per public detector; the last of these finds most.
PUBLIC_DETECTORS = ("-DPM", "-FRCNN", "-SDP")
# The judge makes a list of all numbers up to the largest identity.
LARGEST_IDENTITY = 10_000_000


class Unusable(Exception):
    """The data cannot be evaluated; the message says why."""


@dataclasses.dataclass
class Sequence:
    name: str
    det: str
    gt: str
    frames: typing.Optional[int] = None
    # WIDTHxHEIGHT
    size: typing.Optional[str] = None
    fps: typing.Optional[float] = None
    gmc: typing.Optional[str] = None
    # A video file, or a directory of images.
    images: typing.Optional[str] = None
    embeddings: typing.Optional[str] = None
    dimension: typing.Optional[int] = None
    # Scores of the detections are of any range.
    normalise: bool = False
    estimate_motion: bool = False
    # The detector runs on every so many-th frame; frames get times, so many a second.
    detect_every: typing.Optional[int] = None
    timestamp_rate: typing.Optional[float] = None

    def arguments(self, looks):
        """What gt2_mot is told about the sequence: option, value and whether that is a file. `looks` tells whether the
        tracker has a use for images: to decode them for others would only take time."""
        images = self.images if looks or self.estimate_motion else None
        video = images is not None and not os.path.isdir(images)
        given = [("--det", self.det, True), ("--gmc", self.gmc, True), ("--embeddings", self.embeddings, True),
                 ("--dim", self.dimension, False), ("--video" if video else "--images", images, True),
                 # A video says itself how large it is.
                 ("--size", None if images else self.size, False), ("--frames", self.frames, False),
                 ("--fps", None if self.fps is None else f"{self.fps:g}", False),
                 ("--detect-every", self.detect_every, False), ("--timestamp-rate", self.timestamp_rate, False)]
        given += [("--normalise-scores", "", False)] * self.normalise
        given += [("--estimate-camera-motion", "", False)] * self.estimate_motion
        return [(option, str(value), is_file) for option, value, is_file in given if value is not None]


def read_info(path):
    """Frames, size and frame rate that a seqinfo.ini tells, and the name of the directory of images."""
    info = configparser.ConfigParser(interpolation=None)
    try:
        info.read(path, encoding="utf-8-sig")
        info = info["Sequence"]
        return {"frames": int(info["seqLength"]), "size": f"{int(info['imWidth'])}x{int(info['imHeight'])}",
                "fps": float(info["frameRate"])}, info.get("imDir", "img1")
    except KeyError as error:
        raise Unusable(f"{path}: {error.args[0]} is missing") from None
    except UnicodeDecodeError:
        raise Unusable(f"{path}: is no text file") from None
    except (configparser.Error, ValueError) as error:
        raise Unusable(f"{path}: {' '.join(str(error).split())}") from None


def first_of(folder, names):
    return next((path for path in (os.path.join(folder, name) for name in names) if os.path.isfile(path)), None)


def plural(count, what):
    return f"{count} {what}{'' if count == 1 else 's'}"


def some(names):
    names = list(names)
    return ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")


@dataclasses.dataclass
class Wishes:
    """What the user asked for; None is to be found out."""
    sequences: typing.Optional[str] = None
    det: typing.Optional[str] = None
    # "auto", "none", "estimate"
    gmc: str = "auto"
    # A file in each sequence's folder.
    embeddings: typing.Optional[str] = None
    # "auto", "none"
    images: str = "auto"
    fps: typing.Optional[float] = None
    size: typing.Optional[str] = None


class Finder:
    def __init__(self, root, wishes, say):
        self.root, self.wishes, self.say = os.path.abspath(root), wishes, say

    def find(self):
        """The sequences, in the order of their names."""
        folders = self.chosen(self.folders())
        found = [self.sequence(folder) for folder in folders]
        self.find_detections(found, folders)
        for sequence, folder in zip(found, folders):
            self.complete(sequence, folder)
        self.find_motion(found, folders)
        self.find_embeddings(found, folders)
        self.find_images(found)
        return found

    def folders(self):
        if not os.path.isdir(self.root):
            what = "is a file, not a folder" if os.path.exists(self.root) else "is not there"
            raise Unusable(f"{self.root} {what}: give the folder that holds the sequences")
        if first_of(self.root, TRUTH):
            self.say(f"{self.root} is one sequence by itself")
            return [self.root]
        without = []
        for part in PARTS:
            place = os.path.join(self.root, part) if part else self.root
            below = sorted(filter(os.path.isdir, glob.glob(os.path.join(glob.escape(place), "*"))))
            with_truth = [folder for folder in below if first_of(folder, TRUTH)]
            without += [folder for folder in below if folder not in with_truth and is_sequence(folder)]
            if with_truth:
                missing = [os.path.basename(folder) for folder in without if os.path.dirname(folder) == place]
                if missing:
                    self.say(f"without ground truth, so left out: {some(missing)}")
                if part:
                    self.say(f"sequences are those of {part}/")
                return with_truth
        if without:
            raise Unusable(f"{without[0]} has no ground truth ({' or '.join(TRUTH)}), nor has any other sequence of "
                           f"{self.root}: nothing to compare the trackers with")
        inside = some(sorted(os.listdir(self.root))) or "nothing"
        raise Unusable(f"{self.root} holds no sequences: looked for SEQUENCE/gt/gt.txt and SEQUENCE/gt.txt in it, in "
                       f"train/ and in val/, and found {inside}")

    def chosen(self, folders):
        names = {os.path.basename(folder): folder for folder in folders}
        if self.wishes.sequences:
            patterns = self.wishes.sequences.split(",")
            chosen = [name for name in names if any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)]
            if not chosen:
                raise Unusable(f"no sequence is named {self.wishes.sequences}; there are {', '.join(names)}")
            return [names[name] for name in chosen]
        base = {re.sub("|".join(f"{end}$" for end in PUBLIC_DETECTORS), "", name) for name in names}
        last = [name for name in names if name.endswith(PUBLIC_DETECTORS[-1])]
        if len(names) == len(PUBLIC_DETECTORS) * len(base) and len(last) == len(base):
            self.say("every video is there once per public detector; those of SDP are taken, --sequences '*' takes all")
            return [names[name] for name in last]
        return folders

    def sequence(self, folder):
        sequence = Sequence(os.path.basename(folder), "", first_of(folder, TRUTH))
        ini = first_of(folder, ["seqinfo.ini"])
        directory = "img1"
        if ini:
            info, directory = read_info(ini)
            sequence = dataclasses.replace(sequence, **info)
        if self.wishes.images != "none":
            sequence.images = frames_module.find(folder, directory, sequence)
        if self.wishes.fps:
            sequence.fps = self.wishes.fps
        if self.wishes.size:
            sequence.size = self.wishes.size
        return sequence

    def find_detections(self, found, folders):
        wish = self.wishes.det
        if wish and os.path.isdir(wish):
            for sequence in found:
                sequence.det = os.path.join(os.path.abspath(wish), f"{sequence.name}.txt")
                if not os.path.isfile(sequence.det):
                    raise Unusable(f"{sequence.det} is not there: --det names a folder, which must have SEQUENCE.txt "
                                   "of each sequence")
            return
        names = [wish, f"det/{wish}"] if wish else DETECTIONS
        paths = [first_of(folder, names) for folder in folders]
        if not wish and not any(paths):
            paths = self.other_detections(folders)
        for sequence, path, folder in zip(found, paths, folders):
            if not path:
                raise Unusable(
                    f"{folder} has no detections: looked for {' and '.join(names)}; --det names another file "
                    "of each sequence, or a folder of SEQUENCE.txt with your own detector's"
                )
            sequence.det = path
        inside = sorted({os.path.relpath(path, folder) for path, folder in zip(paths, folders)})
        self.say(f"detections: {', '.join(inside)} of each sequence")

    def other_detections(self, folders):
        """Files of another name that each sequence has; those first whose scores are probabilities."""
        def inside(folder):
            paths = (
                path for pattern in ("det/*.txt", "det*.txt") for path in glob.glob(f"{glob.escape(folder)}/{pattern}")
            )
            return {os.path.relpath(path, folder) for path in paths}

        names = set.intersection(*(inside(folder) for folder in folders))
        if not names:
            return [None] * len(folders)

        def rank(name):
            return not all(is_probability(read_scores(os.path.join(folder, name))) for folder in folders), name

        ranked = sorted(names, key=rank)
        if len(ranked) > 1:
            self.say(f"there are detections of several detectors, {', '.join(sorted(names))}; --det chooses another")
        return [os.path.join(folder, ranked[0]) for folder in folders]

    def complete(self, sequence, folder):
        """Checks the files, and finds out what no seqinfo.ini says."""
        scores, last, corner = check_detections(sequence.det)
        last_truth, corner_truth = check_truth(sequence.gt)
        sequence.normalise = not is_probability(scores)
        if sequence.normalise:
            if len(set(scores)) == 1:
                raise Unusable(f"{sequence.det}: all scores are {scores[0]:g}; give detections with scores in 0..1")
            self.say(f"{sequence.name}: scores are not in 0..1, so they are squashed (--normalise-scores of gt2_mot)")
        last = max(last, last_truth)
        if sequence.frames is None:
            sequence.frames = last
            self.say(f"{sequence.name}: no seqinfo.ini; {last} frames, after the last one with a box")
        elif last > sequence.frames:
            self.say(f"{sequence.name}: seqinfo.ini says {sequence.frames} frames, but there are boxes up to {last}")
            sequence.frames = last
        if sequence.fps is None:
            self.say(f"{sequence.name}: nobody says the frame rate, so trackers think it 30 per second; --fps sets it")
        if sequence.images and not frames_module.enough(sequence):
            self.say(
                f"{sequence.name}: {sequence.images} has fewer than {sequence.frames} images, so they are not used"
            )
            sequence.images = None
        if sequence.size is None:
            sequence.size = frames_module.size_of(sequence.images) if sequence.images else None
        if sequence.size is None:
            sequence.size = "x".join(str(max(1, round(max(pair)))) for pair in zip(corner, corner_truth))
            self.say(f"{sequence.name}: nobody says the size of the images; {sequence.size} holds all boxes, --size "
                     "sets it")

    def find_motion(self, found, folders):
        if self.wishes.gmc == "estimate":
            for sequence in found:
                if not sequence.images:
                    raise Unusable(f"{sequence.name} has no images to estimate the camera's motion from")
                sequence.estimate_motion = True
            self.say("camera motion: estimated from the images")
            return
        motions = [first_of(folder, MOTIONS) for folder in folders]
        if self.wishes.gmc == "none" or not any(motions):
            self.say("camera motion: none" + (", as asked for" if any(motions) else " given"))
            return
        for sequence, path in zip(found, motions):
            sequence.gmc = path
        without = [sequence.name for sequence in found if not sequence.gmc]
        self.say("camera motion: gmc.txt" + (f", but for {some(without)}" if without else " of each sequence"))

    def find_embeddings(self, found, folders):
        wish = self.wishes.embeddings
        if not wish:
            if any(first_of(folder, [EMBEDDINGS]) for folder in folders):
                self.say(f"embeddings: none; {EMBEDDINGS} is there, --embeddings {EMBEDDINGS} gives it to the trackers")
            return
        for sequence, folder in zip(found, folders):
            path = os.path.join(folder, wish)
            if not os.path.isfile(path):
                raise Unusable(f"{path} is not there, which --embeddings asks for")
            count = len(read_scores(sequence.det))
            sequence.embeddings = path
            sequence.dimension, rest = divmod(os.path.getsize(path), 4 * max(count, 1))
            if rest or not sequence.dimension:
                raise Unusable(f"{path}: {os.path.getsize(path)} bytes are no whole number of 32-bit floats for each "
                               f"of the {count} rows of {sequence.det}")
        self.say(f"embeddings: {wish}, of {', '.join(sorted({str(each.dimension) for each in found}))} numbers")

    def find_images(self, found):
        with_images = [sequence.name for sequence in found if sequence.images]
        if self.wishes.images == "none":
            self.say("images: none, as asked for")
        elif not with_images:
            self.say("images: none; trackers see boxes only")
        else:
            without = [sequence.name for sequence in found if not sequence.images]
            self.say(
                "images: " + (f"of {some(with_images)}, not of {some(without)}" if without else "of each sequence") +
                ("" if self.wishes.gmc == "estimate" else "; only gentrack2 looks at them")
            )


def is_sequence(folder):
    return any(os.path.exists(os.path.join(folder, name)) for name in ("seqinfo.ini", "det", "det.txt", "img1"))


def is_probability(scores):
    return all(0 <= score <= 1 for score in scores)


def read_scores(path):
    return [values[6] for _, values, _ in rows.checked(path, rows.SCORED)]


def farther(corner, values):
    return max(corner[0], values[2] + values[4]), max(corner[1], values[3] + values[5])


def check_detections(path):
    """Scores, last frame and the corner that holds all boxes."""
    scores, last, corner = [], 0, (1.0, 1.0)
    for _, values, _ in rows.checked(path, rows.SCORED):
        scores.append(values[6])
        last, corner = max(last, int(values[0])), farther(corner, values)
    if not scores:
        raise Unusable(f"{path}: holds no detections")
    return scores, last, corner


def check_truth(path):
    """Last frame and the corner that holds all boxes."""
    seen, last, corner = {}, 0, (1.0, 1.0)
    for number, values, fields in rows.checked(path, rows.BOX):
        if values[1] != int(values[1]) or not 0 <= values[1] <= LARGEST_IDENTITY:
            raise rows.Malformed(f"{path}:{number}: id \"{fields[1]}\" is not a whole number in 0..{LARGEST_IDENTITY}")
        at = int(values[0]), int(values[1])
        if at in seen:
            raise rows.Malformed(f"{path}:{number}: identity {at[1]} is in frame {at[0]} already, by line {seen[at]}")
        seen[at] = number
        for name, text in zip(("flag", "class"), fields[6:8]):
            try:
                float(text)
            except ValueError:
                raise rows.Malformed(f"{path}:{number}: {name} \"{text}\" is not a number") from None
        last, corner = max(last, at[0]), farther(corner, values)
    if not seen:
        raise Unusable(f"{path}: holds no boxes")
    return last, corner
