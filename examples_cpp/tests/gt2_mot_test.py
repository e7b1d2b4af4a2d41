"""Runs gt2_mot as a user does: right results, and one clear line for everything that is wrong.

usage: gt2_mot_test.py PROGRAM
"""
import collections
import math
import os
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))


def walk(frames):
    """Three people walking apart from each other, 10 px higher than each other and never less than 150 px apart:
    (frame, person, left, top, width, height, score)."""
    rows = []
    for frame in range(1, frames + 1):
        for person in range(3):
            rows.append((frame, person, 50 + 200 * person + 2 * frame, 100 + 10 * person, 40, 100, 0.9))
    return rows


def text_of(rows):
    return "".join(f"{f},-1,{x},{y},{w},{h},{s},-1,-1,-1\n" for f, _, x, y, w, h, s in rows)


class Swing:
    """A camera that swings over a textured ground, on which three people walk: grey images of 320x240 pixels."""

    width, height, margin = 320, 240, 80

    def __init__(self, frames):
        self.frames = frames
        width, height = self.width + 2 * self.margin, self.height
        source = random.Random(1)
        ground = [[source.gauss(0, 1) for _ in range(width)] for _ in range(height)]
        for _ in range(2):
            # A running mean over 5 pixels of each row, then the same with rows and columns swapped.
            for _ in range(2):
                ground = [[sum(row[max(0, i - 2):i + 3]) for i in range(len(row))] for row in ground]
                ground = [list(column) for column in zip(*ground)]
        deviation = math.sqrt(sum(x * x for row in ground for x in row) / (width * height))
        self.ground = [bytes(max(0, min(255, round(128 + 50 * x / deviation))) for x in row) for row in ground]

    def camera(self, frame):
        return round(60 * math.sin(0.6 * frame))

    def image(self, frame):
        """A PGM file."""
        left = self.margin + self.camera(frame)
        return b"P5 %d %d 255\n" % (self.width, self.height) + b"".join(
            row[left:left + self.width] for row in self.ground)

    def rows(self):
        """As those of `walk`; each person is missed in three frames of every ten."""
        return [(frame, person, 70 + 80 * person + 0.5 * frame - self.camera(frame), 80 + 10 * person, 25, 60, 0.9)
                for frame in range(1, self.frames + 1) for person in range(3)
                if frame < 10 or (frame + 3 * person) % 10 >= 3]


class Case(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)

    def file(self, name, content):
        path = os.path.join(self.directory.name, name)
        with open(path, "wb" if isinstance(content, bytes) else "w") as file:
            file.write(content)
        return path

    def path(self, name):
        return os.path.join(self.directory.name, name)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)

    def tracks(self, *arguments):
        """Rows that the program writes to stdout."""
        done = self.run_program("--tracker", "gentrack2", "--out", "-", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "", "nothing but results, and no progress in a pipe")
        return done.stdout

    def refused(self, expected, *arguments):
        """The program must fail with exactly one line on stderr, containing `expected`, and write no track."""
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(expected, done.stderr)
        self.assertEqual(done.stdout, "")

    def refused_det(self, expected, text, *arguments):
        det = self.file("bad.txt", text)
        self.refused(expected, "--tracker", "gentrack2", "--det", det, "--out", "-", *arguments)


class Results(Case):
    def test_people_keep_their_identity_and_place(self):
        det = self.file("det.txt", text_of(walk(30)))
        rows = [line.split(",") for line in self.tracks("--det", det).splitlines()]
        keys = [(int(r[0]), int(r[1])) for r in rows]
        self.assertEqual(keys, sorted(keys), "by frame, then by id")
        self.assertEqual(len(set(keys)), len(keys))
        self.assertTrue(all(len(r) == 10 and r[7:] == ["-1"] * 3 for r in rows))
        self.assertTrue(all(len(x.split(".")[1]) >= 6 for r in rows for x in r[2:7]), "six decimals")
        # By the 10th frame everyone is known; from then on each of the three has the same id, near the detection.
        truth = {(f, p): (x, y) for f, p, x, y, *_ in walk(30)}
        ids = {}
        for row in rows:
            frame, left, top = int(row[0]), float(row[2]), float(row[3])
            if frame < 10:
                continue
            person = min(range(3), key=lambda p: abs(left - truth[frame, p][0]))
            self.assertLess(abs(left - truth[frame, person][0]), 5)
            self.assertLess(abs(top - truth[frame, person][1]), 5)
            ids.setdefault(person, []).append(row[1])
        self.assertEqual({p: (len(set(i)), len(i)) for p, i in ids.items()}, {0: (1, 21), 1: (1, 21), 2: (1, 21)})

    def test_order_of_rows_and_missing_frames(self):
        """Rows may come in any order of frames, frames may be missing, lines may be blank or end as on Windows."""
        rows = [r for r in walk(20) if r[0] not in (12, 13)]
        det = self.file("det.txt", text_of(rows))
        shuffled = self.file("shuffled.txt", "\n" + text_of(rows[30:] + rows[:30]).replace("\n", "\r\n"))
        self.assertEqual(self.tracks("--det", det), self.tracks("--det", shuffled))

    def test_number_of_frames(self):
        det = self.file("det.txt", text_of(walk(20)))
        last = lambda text: max(int(line.split(",")[0]) for line in text.splitlines())
        self.assertEqual(last(self.tracks("--det", det)), 20)
        self.assertEqual(last(self.tracks("--det", det, "--frames", 15)), 15)
        steps = lambda *more: self.run_program(
            "--tracker", "gentrack2", "--det", det, "--out", os.devnull, "--time", *more).stderr
        self.assertIn("steps 20,", steps())
        self.assertIn("steps 35,", steps("--frames", 35))
        gmc = self.file("gmc.txt", "".join(f"{k} 1 0 0 0 1 0\n" for k in range(27)))
        self.assertIn("steps 27,", steps("--gmc", gmc))

    def test_detector_on_every_third_frame(self):
        """The rows in between are not read, and the tracker is told that nobody looked: nobody is lost there."""
        rows = walk(30)
        everything = self.file("all.txt", text_of(rows))
        thirds = self.file("thirds.txt", text_of([row for row in rows if row[0] % 3 == 1]))
        rested = self.tracks("--det", everything, "--detect-every", 3)
        self.assertEqual(rested, self.tracks("--det", thirds, "--frames", 30, "--detect-every", 3))
        frames = [int(line.split(",")[0]) for line in rested.splitlines()]
        self.assertTrue(all(frames.count(frame) == 3 for frame in range(10, 31)), frames)
        self.assertNotEqual(rested, self.tracks("--det", thirds, "--frames", 30), "empty frames are misses")

    def test_timestamps(self):
        """At the nominal rate they say nothing new; at half of it, two frame intervals go by per frame."""
        rows = [row for row in walk(40) if row[0] < 20]
        det = self.file("det.txt", text_of(rows))
        common = ("--det", det, "--fps", 30, "--frames", 200, "--all-states")
        last = lambda *more: max(int(line.split(",")[0]) for line in self.tracks(*common, *more).splitlines())
        self.assertEqual(last("--timestamp-rate", 30), last())
        self.assertAlmostEqual(last("--timestamp-rate", 15) - 19, (last() - 19) / 2, delta=1)

    def test_no_detections_are_no_frames(self):
        for content in ("", "\n\n"):
            self.assertEqual(self.tracks("--det", self.file("det.txt", content)), "")
        self.assertEqual(self.tracks("--det", self.file("det.txt", ""), "--frames", 5), "")

    def test_everything_reported_twice(self):
        rows = walk(40)
        det = self.file("det.txt", text_of([row for row in rows for _ in range(2)]))
        self.assertEqual(len({line.split(",")[1] for line in self.tracks("--det", det).splitlines()}), 3)

    def test_time_is_one_line_of_the_tracker_alone(self):
        det = self.file("det.txt", text_of(walk(20)))
        done = self.run_program("--tracker", "gentrack2", "--det", det, "--out", os.devnull, "--time")
        self.assertRegex(done.stderr,
                         r"^steps 20, total [\d.]+ ms, mean [\d.]+ us, median [\d.]+ us, p99 [\d.]+ us\n$")

    def test_same_run_same_bytes(self):
        det = self.file("det.txt", text_of(walk(40)))
        first, second = self.tracks("--det", det, "--seed", 5), self.tracks("--det", det, "--seed", 5)
        self.assertTrue(first)
        self.assertEqual(first, second)
        done = self.run_program("--tracker", "gentrack2", "--det", det, "--seed", 5, "--out", self.path("out.txt"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("out.txt")) as file:
            self.assertEqual(file.read(), first, "--out FILE and --out - are the same")

    def test_min_score_drops_rows_and_their_embeddings_together(self):
        rows = walk(20)
        low = [(f, p, x + 75, y, w, h, 0.3) for f, p, x, y, w, h, _ in rows]
        mixed = [r for pair in zip(low, rows) for r in pair]
        right, wrong = struct.pack("<2f", 1.0, 0.0), struct.pack("<2f", 0.0, 1.0)
        clean = self.tracks("--det", self.file("clean.txt", text_of(rows)), "--dim", 2,
                            "--embeddings", self.file("clean.f32", right * len(rows)))
        filtered = self.tracks("--det", self.file("mixed.txt", text_of(mixed)), "--dim", 2, "--min-score", 0.5,
                               "--embeddings", self.file("mixed.f32", (wrong + right) * len(rows)))
        self.assertTrue(clean)
        self.assertEqual(clean, filtered)

    def test_max_height_drops_rows(self):
        rows = walk(20)
        tall = [(f, p, x + 75, y, w, h + 0.5, s) for f, p, x, y, w, h, s in rows]
        self.assertEqual(self.tracks("--det", self.file("det.txt", text_of(rows))),
                         self.tracks("--det", self.file("both.txt", text_of(rows + tall)), "--max-height", 100))

    def test_normalised_scores(self):
        """Scores 30 and -40 have the root mean square sqrt((900 + 1600) / 2) = 35.3553: 1 / (1 + exp(-30 / 35.3553)) =
        0.700258 and 1 / (1 + exp(40 / 35.3553)) = 0.243908."""
        det = self.file("det.txt", "1,-1,10,10,20,40,30\n2,-1,10,10,20,40,-40\n")
        self.tracks("--det", det, "--normalise-scores", "--save-det", self.path("saved.txt"))
        with open(self.path("saved.txt")) as file:
            self.assertEqual([line.split(",")[6] for line in file], ["0.700258", "0.243908"])

    def test_saved_detections_are_what_the_tracker_got(self):
        det = self.file("det.txt", text_of(walk(5)))
        self.tracks("--det", det, "--save-det", self.path("saved.txt"))
        with open(self.path("saved.txt")) as file:
            saved = [tuple(map(float, line.split(","))) for line in file]
        self.assertEqual(saved, [(f, -1, x, y, w, h, s, -1, -1, -1) for f, _, x, y, w, h, s in walk(5)])

    def test_settings_and_their_order(self):
        """--config, then --set, then --seed and --fps; a birth score of 1 leaves no track."""
        det = self.file("det.txt", text_of(walk(20)))
        plain = self.tracks("--det", det)
        self.assertEqual(self.tracks("--det", det, "--set", "birth_score=1"), "")
        never = self.file("never.toml", "birth_score = 1.0\n")
        self.assertEqual(self.tracks("--det", det, "--config", never), "")
        self.assertEqual(self.tracks("--det", det, "--config", never, "--set", "birth_score=0.7"), plain)
        # A shift of the first id is visible without looking at a single box.
        first = lambda text: text.split(",")[1]
        self.assertEqual(first(self.tracks("--det", det, "--set", "first_id=7", "--set", "first_id=9")), "9")
        slow = self.tracks("--det", det, "--fps", 2)
        self.assertEqual(self.tracks("--det", det, "--set", "frame_rate=2"), slow)
        self.assertEqual(self.tracks("--det", det, "--set", "frame_rate=25", "--fps", 2), slow)
        self.assertEqual(self.tracks("--det", det, "--set", "seed=3", "--seed", 4),
                         self.tracks("--det", det, "--set", "seed=4"))

    def test_all_states_adds_rows(self):
        """Someone seen once is tentative: not written, unless asked for."""
        det = self.file("det.txt", text_of(walk(20) + [(15, 9, 900, 300, 40, 100, 0.95)]))
        usual, everything = self.tracks("--det", det), self.tracks("--det", det, "--all-states")
        at = lambda text: [l for l in text.splitlines() if l.startswith("15,") and abs(float(l.split(",")[2]) - 900) < 1]
        self.assertEqual((len(at(usual)), len(at(everything))), (0, 1))

    def test_drawing_without_images(self):
        det = self.file("det.txt", text_of(walk(12)))
        self.tracks("--det", det, "--size", "768x576", "--annotate", self.path("a.avi"), "--particles",
                    "--sheet", self.path("a.png"))
        self.assertGreater(os.path.getsize(self.path("a.avi")), 1000)
        with open(self.path("a.png"), "rb") as file:
            header = file.read(24)
        # Three tiles of 640x480 and four gaps of 6; two tiles and three gaps.
        self.assertEqual(struct.unpack(">2I", header[16:]), (3 * 640 + 4 * 6, 2 * 480 + 3 * 6))


class Drawing(Case):
    """Every tracker, on images and on a plain ground."""

    STRONG, WEAK, MOTION = bytes((60, 225, 70)), bytes((255, 60, 70)), bytes((255, 225, 60))

    def names(self):
        text = self.run_program("--help").stdout
        names = re.search(r"(?m)^  --tracker NAME +(.*)$", text)[1].split()
        self.assertEqual(len(names), 8)
        return names

    def sheet(self, tracker, *arguments, frames="25,26,27,28,29,30"):
        """Draws a video and a sheet; returns the pixels of the sheet."""
        sheet, video = self.path("a.ppm"), self.path("a.avi")
        done = self.run_program("--tracker", tracker, "--out", self.path("a.txt"), "--annotate", video,
                                "--sheet", sheet, "--sheet-frames", frames, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(video, "rb") as file:
            self.assertEqual(file.read(4), b"RIFF")
        self.assertGreater(os.path.getsize(video), 10000)
        with open(sheet, "rb") as file:
            magic, _, _, pixels = file.read().split(b"\n", 3)
        self.assertEqual(magic, b"P6")
        return pixels

    def people(self, frames=30):
        """As in `walk`, within 640x480 pixels; the one in the middle is missed from frame 24 on, and the three are near
        enough to each other to be neighbours."""
        rows = [(f, p, 100 + 42 * p + 3 * f, 100 + 2 * p, 40, 100, 0.9) for f in range(1, frames + 1) for p in range(3)
                if p != 1 or f < 24]
        return self.file("people.txt", text_of(rows))

    def images(self, frames=30):
        directory = self.path("images")
        os.makedirs(directory, exist_ok=True)
        for k in range(frames):
            self.file(f"images/{k:03}.pgm", b"P5 640 480 255\n" + bytes([100]) * (640 * 480))
        return directory

    def test_every_tracker_is_drawn(self):
        det, images = self.people(), self.images()
        for name in self.names():
            for ground in (("--images", images), ("--size", "640x480"), ()):
                with self.subTest(tracker=name, ground=ground[:1]):
                    # Two people, in six frames.
                    pixels = self.sheet(name, "--det", det, *ground, "--particles", "--neighbours")
                    self.assertGreater(pixels.count(self.STRONG), 2 * 6 * 150)

    def test_layers_on_request(self):
        det, images = self.people(), self.images()
        base = ("--det", det, "--images", images)
        usual = self.sheet("gentrack2", *base)
        self.assertGreater(usual.count(self.WEAK), 300)
        self.assertEqual(usual.count(self.MOTION), 0)
        near = self.sheet("gentrack2", *base, "--neighbours")
        self.assertGreater(near.count(self.MOTION), 1000)
        # The weak one is the second; those in focus are bold, and only of them there is more to see.
        first = self.sheet("gentrack2", *base, "--neighbours", "--focus", "1")
        second = self.sheet("gentrack2", *base, "--neighbours", "--focus", "2,3")
        self.assertGreater(first.count(self.STRONG), 1.2 * near.count(self.STRONG))
        self.assertGreater(second.count(self.MOTION), 5 * first.count(self.MOTION))

    def test_drawing_changes_no_result(self):
        det, images = self.people(), self.images()
        plain = self.tracks("--det", det, "--images", images)
        self.sheet("gentrack2", "--det", det, "--images", images, "--particles", "--neighbours")
        with open(self.path("a.txt")) as file:
            self.assertEqual(file.read(), plain)

    def test_without_size_all_detections_are_in_the_picture(self):
        det = self.file("far.txt", text_of([(f, p, x + f, y, w, h, s) for f, p, x, y, w, h, s in walk(12)]
                                           + [(12, 9, 1500, 700, 40, 100, 0.95)]))
        self.sheet("gentrack2", "--det", det, frames="7,8,9,10,11,12")
        with open(self.path("a.avi"), "rb") as file:
            self.assertEqual(struct.unpack("<2I", file.read(72)[64:]), (1540, 800))

    def test_class_names_stand_on_labels_and_classes_reach_the_tracker(self):
        rows = [f"{f},-1,{100 + 3 * f},100,40,100,0.9,{f // 20}\n" for f in range(1, 31)]
        det, names = self.file("classes.txt", "".join(rows)), self.file("names.txt", "person\nbicycle\n")
        images = ("--images", self.images())
        ids = lambda *more: {row.split(",")[1] for row in self.tracks("--det", det, *more).splitlines()}
        separate = ("--set", "class_policy=separate")
        self.assertEqual(len(ids(*separate)), 1)
        self.assertEqual(len(ids(*separate, "--class-names", names)), 2)
        def label(*more):
            """How often each colour is there."""
            pixels = self.sheet("sort", "--det", det, *images, *more, frames="10,11,12,13,14,15")
            return collections.Counter(pixels[i:i + 3] for i in range(0, len(pixels), 3))

        # A longer plate, in the colour of the identity.
        without, named = label(), label("--class-names", names)
        grown = [colour for colour in named if named[colour] > without[colour] + 1000]
        self.assertEqual(len(grown), 1)
        self.assertNotEqual(grown[0], bytes((100, 100, 100)))
        self.refused('classes.txt:1: --class-names needs a class id from 0 in the eighth field',
                     "--tracker", "sort", "--out", "-", "--class-names", names,
                     "--det", self.file("classes.txt", "1,-1,100,100,40,100,0.9,-1,-1,-1\n"))


# An oracle per tracker, with the options that feed it, and the settings in which it differs from the defaults.
SHIPPED_CONFTRACK = ("confidence_weighting=false", "noise_scaling=false", "constant_size=false",
                     "low_confidence_matching=false", "new_track_thresh=0.7")
ORACLES = (
    # tracker, folder, sequence, least score, camera motion, embeddings, settings
    ("sort", "sort", "syn_a1", 0.6, False, False, ()),
    ("sort", "sort-age30", "syn_a4", 0.6, False, False, ("max_age=30",)),
    ("deepsort", "deepsort", "syn_a2", 0.6, False, True, ()),
    ("ocsort", "ocsort", "syn_a3", 0.1, False, False, ()),
    ("ocsort", "ocsort-byte", "syn_a1", 0.1, False, False, ("use_byte=true",)),
    ("bytetrack", "bytetrack", "syn_b1", 0.1, False, False, ()),
    ("botsort", "botsort", "syn_b2", 0.1, True, False, ()),
    ("botsort", "botsort-reid", "syn_b3", 0.1, True, True, ()),
    ("smiletrack", "smiletrack", "syn_b2", 0.1, True, True, ()),
    ("conftrack", "conftrack", "syn_b2", 0.1, True, True, SHIPPED_CONFTRACK),
    ("conftrack", "conftrack-full-reid", "syn_b3", 0.1, True, True, ()),
)
FIXTURES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tests", "fixtures", "oracles")


@unittest.skipUnless(os.path.isdir(FIXTURES), "the oracles are not in a released package")
class Trackers(Case):
    def oracle(self, *parts):
        return os.path.join(FIXTURES, *parts)

    def read(self, lines):
        """By frame, the identities and boxes."""
        frames = {}
        for line in lines:
            frame, track, *box = line.split(",")[:6]
            frames.setdefault(int(frame), []).append((track, [float(x) for x in box]))
        return frames

    def same(self, ours, golden):
        """Per frame the same boxes to a thousandth of a pixel, and identities that differ in their names only."""
        self.assertEqual(sorted(ours), sorted(golden), "the frames with tracks")
        names, back = {}, {}
        for frame in sorted(golden):
            left = list(ours[frame])
            self.assertEqual(len(left), len(golden[frame]), f"tracks in frame {frame}")
            # Known identities first: two tracks may have the same box.
            for track, box in sorted(golden[frame], key=lambda row: row[0] not in names):
                near = [row for row in left if all(abs(a - b) <= 1e-3 for a, b in zip(row[1], box))
                        and names.get(track, row[0]) == row[0] and back.get(row[0], track) == track]
                self.assertTrue(near, f"frame {frame}: nobody is {track} at {box}")
                left.remove(near[0])
                names[track], back[near[0][0]] = near[0][0], track

    def test_oracles_are_reproduced(self):
        for tracker, folder, sequence, score, moving, looks, settings in ORACLES:
            with self.subTest(oracle=f"{folder}/{sequence}"):
                inputs = lambda end: self.oracle("synthetic", f"{sequence}.{end}")
                arguments = ["--tracker", tracker, "--det", inputs("det.txt"), "--out", "-", "--min-score", score]
                arguments += ["--gmc", inputs("gmc.txt")] if moving else []
                arguments += ["--embeddings", inputs("f32"), "--dim", 16] if looks else []
                for setting in settings:
                    arguments += ["--set", setting]
                done = self.run_program(*arguments, "--frames", 300)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                with open(self.oracle(folder, f"{sequence}.csv")) as file:
                    golden = self.read(file.readlines()[1:])
                self.assertGreater(len(golden), 50)
                self.same(self.read(done.stdout.splitlines()), golden)

    def test_every_tracker_takes_everything(self):
        """The eight that --help names, with all inputs at once."""
        text = self.run_program("--help").stdout
        names = re.search(r"(?m)^  --tracker NAME +(.*)$", text)[1].split()
        self.assertEqual(len(names), 8)
        inputs = lambda end: self.oracle("synthetic", f"syn_b1.{end}")
        for name in names:
            with self.subTest(tracker=name):
                done = self.run_program("--tracker", name, "--det", inputs("det.txt"), "--out", "-",
                                        "--gmc", inputs("gmc.txt"), "--embeddings", inputs("f32"), "--dim", 16,
                                        "--min-score", 0.1, "--set", "class_policy=separate", "--size", "1920x1080")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                rows = self.read(done.stdout.splitlines())
                self.assertGreater(len(rows), 200)
                self.assertTrue(all(len({track for track, _ in frame}) == len(frame) for frame in rows.values()))


class CameraMotion(Case):
    def swing(self, frames):
        swing = Swing(frames)
        os.makedirs(self.path("swing"))
        for frame in range(1, frames + 1):
            self.file(f"swing/{frame:03}.pgm", swing.image(frame))
        return swing, self.file("det.txt", text_of(swing.rows())), self.path("swing")

    def estimated(self, det, images):
        done = self.run_program("--tracker", "gentrack2", "--det", det, "--images", images, "--out", "-",
                                "--estimate-camera-motion")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, done.stderr

    def test_estimated_motion_is_as_good_as_known_motion(self):
        swing, det, images = self.swing(40)
        motion = [swing.camera(k - 1) - swing.camera(k) for k in range(1, 41)]
        gmc = self.file("gmc.txt", "".join(f"{k} 1 0 {x} 0 1 0\n" for k, x in enumerate(motion, 1)))
        known, unknown = (self.tracks("--det", det, "--images", images, *more) for more in (("--gmc", gmc), ()))
        estimated, remark = self.estimated(det, images)
        self.assertEqual(remark, "camera motion: not estimated in 0 of 39 frames\n")
        table = lambda text: [[float(x) for x in line.split(",")] for line in text.splitlines()]
        known, unknown, estimated = table(known), table(unknown), table(estimated)
        identities = lambda rows: len({row[1] for row in rows})
        self.assertEqual((identities(known), identities(estimated)), (3, 3))
        self.assertGreater(identities(unknown), 3)
        self.assertEqual([row[:2] for row in known], [row[:2] for row in estimated])
        for a, b in zip(known, estimated):
            for x, y in zip(a[2:6], b[2:6]):
                self.assertAlmostEqual(x, y, delta=1)

    def test_what_cannot_be_estimated_is_counted(self):
        os.makedirs(self.path("flat"))
        for frame in range(10):
            self.file(f"flat/{frame}.pgm", b"P5 320 240 255\n" + bytes([100]) * (320 * 240))
        _, remark = self.estimated(self.file("det.txt", ""), self.path("flat"))
        self.assertEqual(remark, "camera motion: not estimated in 9 of 9 frames "
                                 "(too few corners in the background: 9)\n")


class Mistakes(Case):
    good = "1,-1,10,10,20,40,0.9,-1,-1,-1\n"

    def test_bad_rows_name_line_and_reason(self):
        for row, reason in (
            ("2,-1,10,10,20,40", "expected at least 7 fields frame,id,left,top,width,height,score, found 6"),
            ("0,-1,10,10,20,40,0.9", 'frame "0" is not an integer in 1..10000000'),
            ("1.5,-1,10,10,20,40,0.9", 'frame "1.5" is not an integer'),
            ("1e9,-1,10,10,20,40,0.9", 'frame "1e9" is not an integer in'),
            ("2,-1,ten,10,20,40,0.9", 'left "ten" is not a finite number'),
            ("2,-1,10,nan,20,40,0.9", 'top "nan" is not a finite number'),
            ("2,-1,10,10,inf,40,0.9", 'width "inf" is not a finite number'),
            ("2,-1,-2e12,10,20,40,0.9", 'left "-2e12" is beyond 1e12 pixels'),
            ("2,-1,10,10,-0.5,40,0.9", 'width "-0.5" is negative'),
            ("2,-1,10,10,20,-4,0.9", 'height "-4" is negative'),
            ("2,-1,10,10,20,40,", 'score "" is not a finite number'),
            ("2,-1,10,10,20,40,3.1", 'score "3.1" is outside 0..1 (--normalise-scores'),
            ("2,-1,10,10,20,40,-0.1", 'score "-0.1" is outside 0..1'),
            ("2,-1,+-10,10,20,40,0.9", 'left "+-10" is not a finite number'),
            ("\ufeff2,-1,10,10,20,40,0.9", 'frame "\\xef\\xbb\\xbf2" is not a finite number'),
            ("2,-1,10,10,20,40," + 100 * "x", 'score "' + 60 * "x" + '..." is not a finite number'),
        ):
            with self.subTest(row=row):
                self.refused_det(f"bad.txt:3: {reason}", self.good + "\n" + row + "\n" + self.good)

    def test_bad_camera_motion(self):
        for line, reason in (("2 1 0 0 0 1", "found 6 fields"), ("2 1 0 x 0 1 0", '"x" is not a finite number'),
                             ("3 1 0 0 0 1 0", 'frame "3" where 2 is expected'),
                             ("2 1 0 2e12 0 1 0", "a number of the matrix is beyond 1e12"),
                             ("2 0 0 0 0 0 0", "the matrix scales by less than 0.001 or more than 1000"),
                             ("2 1 0 0 0 1001 0", "the matrix scales by less than 0.001 or more than 1000"),
                             ("2 1 1 0 1 1 0", "the matrix cannot be inverted")):
            with self.subTest(line=line):
                gmc = self.file("gmc.txt", "1\t1\t0\t0\t0\t1\t0\t\n" + line + "\n")
                self.refused_det("gmc.txt:2: ", self.good, "--gmc", gmc)
                self.refused_det(reason, self.good, "--gmc", gmc)

    def test_embeddings_must_fit(self):
        embeddings = self.file("e.f32", bytes(4 * 3))
        self.refused_det("e.f32: holds 12 bytes, but 1 rows of", self.good, "--embeddings", embeddings, "--dim", 4)
        embeddings = self.file("e.f32", bytes(4 * 5))
        self.refused_det("are 16", self.good, "--embeddings", embeddings, "--dim", 4)
        embeddings = self.file("e.f32", struct.pack("<4f", 1, 0, float("nan"), 0))
        self.refused_det("e.f32: number 1 of row 2, of ", self.good + "\n" + self.good, "--embeddings", embeddings,
                         "--dim", 2)
        self.refused_det("bad.txt:3, is not finite", self.good + "\n" + self.good, "--embeddings", embeddings, "--dim", 2)
        self.refused_det("--embeddings and --dim need each other", self.good, "--embeddings", embeddings)

    def test_inputs_are_not_overwritten(self):
        det = self.file("det.txt", self.good)
        self.refused("would overwrite what is read from it", "--tracker", "gentrack2", "--det", det, "--out", det)
        with open(det) as file:
            self.assertEqual(file.read(), self.good)

    def test_missing_files(self):
        gone = self.path("gone")
        base = ("--tracker", "gentrack2", "--out", "-")
        self.refused("gone: No such file or directory", *base, "--det", gone)
        self.refused("is a directory", *base, "--det", self.directory.name)
        for option in ("--gmc", "--config"):
            with self.subTest(option=option):
                self.refused_det("gone: No such file or directory", self.good, option, gone)
        self.refused_det("gone: no such file", self.good, "--video", gone)
        self.refused_det("gone: no such directory", self.good, "--images", gone)
        self.refused_det("holds no images", self.good, "--images", self.directory.name)
        self.refused_det("text.avi: OpenCV cannot open this as a video", self.good,
                         "--video", self.file("text.avi", "no video"))
        self.refused("gone: No such file or directory", *base, "--detector", f"onnx:{gone}",
                     "--images", self.images(1))

    def images(self, count):
        directory = self.path("images")
        os.makedirs(directory, exist_ok=True)
        for k in range(count):
            self.file(f"images/{k:03}.pgm", b"P5 64 48 255\n" + bytes([k]) * (64 * 48))
        return directory

    def test_images_that_end_too_soon(self):
        images = self.images(3)
        self.refused_end("images: ends after 3 frames, but --frames asks for 4", images, walk(3), "--frames", 4)
        self.refused_end("has detections up to frame 5", images, walk(5))

    def refused_end(self, expected, images, rows, *arguments):
        det = self.file("det.txt", text_of(rows))
        done = self.run_program("--tracker", "gentrack2", "--det", det, "--images", images, "--out", os.devnull,
                                *arguments)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done)
        self.assertIn(expected, done.stderr)

    def test_unreadable_image(self):
        images = self.images(2)
        self.file("images/001.pgm", "no image")
        self.refused_end("001.pgm: OpenCV cannot read this image", images, walk(2))

    def test_unknown_names(self):
        det = self.file("det.txt", self.good)
        self.refused("magic", "--tracker", "magic", "--det", det, "--out", "-")
        self.refused_det("no_such_key", self.good, "--set", "no_such_key=1")
        self.refused_det("birth_score", self.good, "--set", "birth_score=1.5")
        self.refused_det("birth_score", self.good, "--set", "birth_score=high")
        self.refused_det("bad.toml", self.good, "--config", self.file("bad.toml", "particles = 4\n\nlambda_p = = 2\n"))
        self.refused_det("line 3", self.good, "--config", self.path("bad.toml"))
        self.refused_det("seed", self.good, "--seed", "x")
        self.refused_det("frame_rate", self.good, "--fps", 0)
        self.refused("--detector yolo: expected hog or onnx:FILE", "--tracker", "gentrack2", "--out", "-",
                     "--detector", "yolo", "--images", self.images(1))

    def test_command_line(self):
        det = self.file("det.txt", self.good)
        base = ("--tracker", "gentrack2", "--det", det, "--out", "-")
        for expected, arguments in (
            ("--tracker is missing", ()),
            ("give either --det or --detector", ("--tracker", "gentrack2", "--out", "-")),
            ("give either --det or --detector", (*base, "--detector", "hog")),
            ("--out is missing", ("--tracker", "gentrack2", "--det", det)),
            ("unknown option --size=3x4", (*base, "--size=3x4")),
            ("--size 3: expected WIDTHxHEIGHT", (*base, "--size", "3")),
            ("--size 0x4: expected", (*base, "--size", "0x4")),
            ("--frames 0: expected an integer in 1..", (*base, "--frames", "0")),
            ("--min-score 2: expected a number in 0..1", (*base, "--min-score", "2")),
            ("--set a: expected KEY=VALUE", (*base, "--set", "a")),
            ("--seed needs a value", (*base, "--seed")),
            ("--detector needs --video or --images", ("--tracker", "gentrack2", "--detector", "hog", "--out", "-")),
            ("--estimate-camera-motion needs --video or --images", (*base, "--estimate-camera-motion")),
            ("--estimate-camera-motion and --gmc exclude each other",
             (*base, "--estimate-camera-motion", "--gmc", "x", "--images", "y")),
            ("--particles needs --annotate or --sheet", (*base, "--particles")),
            ("--neighbours needs --annotate or --sheet", (*base, "--neighbours")),
            ("--focus needs --annotate or --sheet", (*base, "--focus", "3")),
            ("--focus 0: expected identities with commas between", (*base, "--focus", "0")),
            ("no-names: No such file or directory", (*base, "--class-names", self.path("no-names"))),
        ):
            with self.subTest(arguments=arguments):
                self.refused(expected, *arguments)

    def test_unwritable_results(self):
        det = self.file("det.txt", text_of(walk(20)))
        base = ("--tracker", "gentrack2", "--det", det)
        self.refused("cannot be written", *base, "--out", self.path("no/such/directory/out.txt"))
        if os.path.exists("/dev/full"):
            self.refused("/dev/full: cannot be written", *base, "--out", "/dev/full")
        self.refused("cannot write this as a video", *base, "--out", os.devnull, "--size", "64x48",
                     "--annotate", self.path("no/such/a.avi"))

    def test_help(self):
        done = self.run_program("--help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("usage: gt2_mot --tracker NAME", done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=1)
