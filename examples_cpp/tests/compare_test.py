"""Runs compare as a user does: two trackers in one video, and one clear line for everything that is wrong.

usage: compare_test.py PROGRAM GT2_MOT
"""
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest

GT2_MOT = os.path.abspath(sys.argv.pop(2))
PROGRAM = os.path.abspath(sys.argv.pop(1))

# Two frames of this width and the line between them are as wide as a tile of the sheet, which then shows each pixel.
WIDTH, HEIGHT, GAP, BAND, TILE, FRAMES = 638, 240, 4, 54, 1280, 20
# The colour of identity switches.
MARK = bytes((255, 60, 255))


def run(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)


class Case(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)
        self.images = self.path("images")
        os.makedirs(self.images)
        for k in range(FRAMES):
            self.file(f"images/{k:03}.pgm", b"P5 %d %d 255\n" % (WIDTH, HEIGHT) + bytes([100]) * (WIDTH * HEIGHT))
        # Three people who walk apart from each other.
        self.det = self.file("det.txt", "".join(
            f"{frame},-1,{50 + 200 * person + 2 * frame},{100 + 10 * person},40,100,0.9\n"
            for frame in range(1, FRAMES + 1) for person in range(3)))
        self.base = ("--left", "gentrack2", "--right", "gentrack2", "--images", self.images, "--det", self.det)

    def file(self, name, content):
        path = self.path(name)
        with open(path, "wb" if isinstance(content, bytes) else "w") as file:
            file.write(content)
        return path

    def path(self, name):
        return os.path.join(self.directory.name, name)

    def compared(self, *arguments, remarks=""):
        """The two lines on stdout: (left or right, name, identities, boxes)."""
        done = run(PROGRAM, *self.base, "--out", self.path("both.avi"), *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, remarks))
        line = r"(left|right) (.+): (\d+) identities, (\d+) boxes, mean step [\d.]+ us(?:, (\d+) identity switches)?"
        rows = [re.fullmatch(line, text).groups() for text in done.stdout.splitlines()]
        self.switches = [None if row[4] is None else int(row[4]) for row in rows]
        return [(side, name, int(identities), int(boxes)) for side, name, identities, boxes, _ in rows]

    def refused(self, expected, *arguments):
        """The program must fail with exactly one line on stderr, containing `expected`."""
        done = run(PROGRAM, *arguments)
        self.assertEqual((done.returncode, done.stderr.count("\n"), done.stdout), (1, 1, ""), done)
        self.assertTrue(done.stderr.startswith("compare: "), done.stderr)
        self.assertIn(expected, done.stderr)


class Results(Case):
    def test_the_same_tracker_twice_is_the_same_twice(self):
        left, right = self.compared()
        self.assertEqual((left[0], right[0]), ("left", "right"))
        self.assertEqual(left[1:], right[1:])
        self.assertEqual(left[1:3], ("gentrack2", 3))

    def test_each_side_is_what_gt2_mot_gives(self):
        preset = ("preset=paper",)
        for side, settings in zip(self.compared("--right-set", *preset), ((), preset)):
            more = [x for setting in settings for x in ("--set", setting)]
            done = run(GT2_MOT, "--tracker", "gentrack2", *self.base[4:], "--out", "-", *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            rows = [line.split(",") for line in done.stdout.splitlines()]
            self.assertEqual(side[2:], (len({row[1] for row in rows}), len(rows)))
            self.assertEqual(side[1], " ".join(["gentrack2", *(f"({x})" for x in settings)]))

    def test_settings_are_of_their_side(self):
        never = self.file("never.toml", "birth_score = 1.0\n")
        left, right = self.compared("--left-config", never, "--left-set", "seed=7")
        self.assertEqual(left, ("left", "gentrack2 (never.toml, seed=7)", 0, 0))
        self.assertEqual(right[1:3], ("gentrack2", 3))
        left, right = self.compared("--right-set", "birth_score=1")
        self.assertEqual(right, ("right", "gentrack2 (birth_score=1)", 0, 0))
        self.assertEqual(left[2], 3)

    def test_size_of_the_video(self):
        self.compared()
        with open(self.path("both.avi"), "rb") as file:
            header = file.read(72)
        self.assertEqual(header[:4], b"RIFF")
        self.assertEqual(struct.unpack("<2I", header[64:]), (2 * WIDTH + GAP, HEIGHT + BAND))

    def halves(self, *arguments):
        """The left and the right half of the last tile of the sheet: rows of pixels."""
        sheet = self.path("sheet.ppm")
        self.compared("--sheet", sheet, "--sheet-frames", "10,12,14,16,18,20", *arguments)
        with open(sheet, "rb") as file:
            magic, size, _, pixels = file.read().split(b"\n", 3)
        width, height = map(int, size.split())
        tile_height = BAND + HEIGHT
        self.assertEqual((magic, width, height), (b"P6", 2 * TILE + 3 * 6, 3 * tile_height + 4 * 6))
        left, top = TILE + 2 * 6, 2 * tile_height + 3 * 6
        rows = [pixels[3 * (y * width + left):3 * (y * width + left + TILE)] for y in range(top, top + tile_height)]
        return [row[:3 * WIDTH] for row in rows], [row[3 * (WIDTH + GAP):] for row in rows]

    def test_halves_show_their_tracker(self):
        left, right = self.halves()
        self.assertEqual(left, right)
        # Something is written in the band, and boxes are drawn below.
        self.assertTrue(any(max(row) > 150 for row in left[:BAND]))
        boxes = left[BAND + 95:]
        self.assertTrue(any(set(row) != {100} for row in boxes))
        other_left, other_right = self.halves("--right-set", "birth_score=1")
        self.assertEqual(other_left, left)
        self.assertNotEqual(other_right[:BAND], right[:BAND])
        # Without a track there is nothing from the people's heads down to the legend.
        self.assertTrue(all(set(row) == {100} for row in other_right[BAND + 95:BAND + 200]))

    def test_camera_motion_is_estimated_for_both(self):
        remark = f"camera motion: not estimated in {FRAMES - 1} of {FRAMES - 1} frames " \
                 f"(too few corners in the background: {FRAMES - 1})\n"
        left, right = self.compared("--estimate-camera-motion", remarks=remark)
        self.assertEqual(left[1:], right[1:])

    def test_number_of_frames(self):
        whole, part = self.compared()[0], self.compared("--frames", 12)[0]
        self.assertEqual(whole[3] - part[3], 3 * (FRAMES - 12))

    def gapped(self):
        """Detections in which the second person is missed in frames 10 to 12, and the truth, in which nobody is."""
        rows = [(frame, person, f"{50 + 200 * person + 2 * frame},{100 + 10 * person},40,100")
                for frame in range(1, FRAMES + 1) for person in range(3)]
        det = self.file("gapped.txt", "".join(
            f"{frame},-1,{box},0.9\n" for frame, person, box in rows if person != 1 or not 10 <= frame <= 12))
        truth = self.file("truth.txt", "".join(f"{frame},{person + 1},{box},1,1,1\n" for frame, person, box in rows))
        return det, truth

    def test_identity_switches_are_counted(self):
        """SORT as published forgets after one frame and needs three to trust again; GenTrack2 bridges the gap."""
        det, truth = self.gapped()
        self.base = ("--left", "gentrack2", "--right", "sort", "--images", self.images, "--det", det)
        self.compared()
        self.assertEqual(self.switches, [None, None])
        left, right = self.compared("--truth", truth)
        self.assertEqual(self.switches, [0, 1])
        self.assertEqual((left[2], right[2]), (3, 4))
        # Before the person is found again there is nothing to count.
        self.compared("--truth", truth, "--frames", 12)
        self.assertEqual(self.switches, [0, 0])

    def test_switches_are_marked_on_their_side(self):
        det, truth = self.gapped()
        self.base = ("--left", "gentrack2", "--right", "sort", "--images", self.images, "--det", det)
        marked = lambda row: sum(row[i:i + 3] == MARK for i in range(0, len(row), 3))
        for more, expected in (((), False), (("--truth", truth), True)):
            left, right = self.halves("--fps", 10, *more)
            self.assertEqual([any(marked(row) for row in half[BAND:]) for half in (left, right)], [False, expected])
            # The counter in the band lights up.
            self.assertEqual([any(marked(row) > 50 for row in half[:BAND]) for half in (left, right)],
                             [False, expected])

    def test_without_images_on_a_plain_ground(self):
        with_images = self.compared()
        self.base = (*self.base[:4], *self.base[6:], "--size", f"{WIDTH}x{HEIGHT}")
        left, right = self.halves("--right-set", "birth_score=1")
        self.assertEqual(self.compared()[0][1:], with_images[0][1:])
        # Boxes are tinted on the left; on the right there is the ground alone, with its mesh.
        colours = lambda half: {row[i:i + 3] for row in half[BAND + 95:BAND + 200] for i in range(0, len(row), 3)}
        self.assertEqual(len(colours(right)), 2)
        self.assertGreater(len(colours(left)), 10)

    def test_help(self):
        done = run(PROGRAM, "--help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("usage: compare --left NAME", done.stdout)
        self.assertIn(" gentrack2", done.stdout)


class Mistakes(Case):
    def test_command_line(self):
        out = ("--out", self.path("both.avi"))
        sides, images, det = self.base[:4], self.base[4:6], self.base[6:]
        truth = self.file("truth.txt", "1,1,10,10,40,100\n")
        for expected, arguments in (
            ("--left is missing", ()),
            ("--right is missing", (*self.base[:2], *images, *det, *out)),
            ("--video and --images exclude each other", (*self.base, "--video", "x", *out)),
            ("give either --det or --detector", (*sides, *images, *out)),
            ("give either --det or --detector", (*self.base, "--detector", "hog", *out)),
            ("--out is missing", self.base),
            ("unknown option --tracker", (*self.base, *out, "--tracker", "gentrack2")),
            ("--left-set preset: expected KEY=VALUE", (*self.base, *out, "--left-set", "preset")),
            ("--right-set needs a value", (*self.base, *out, "--right-set")),
            ("--sheet-frames needs --sheet", (*self.base, *out, "--sheet-frames", "1")),
            ("would overwrite what is read from it", (*self.base, "--out", self.det)),
            ("would overwrite what is read from it", (*self.base, "--truth", truth, "--out", truth)),
            ("--focus 1,x: expected identities with commas between", (*self.base, *out, "--focus", "1,x")),
        ):
            with self.subTest(arguments=arguments):
                self.refused(expected, *arguments)

    def test_the_side_is_named(self):
        out = ("--out", self.path("both.avi"))
        rest = (*self.base[4:], *out)
        self.refused("--left: ", "--left", "magic", "--right", "gentrack2", *rest)
        self.refused("--right: ", "--left", "gentrack2", "--right", "magic", *rest)
        self.refused("--right-set no_such_key=1: ", *self.base, *out, "--right-set", "no_such_key=1")
        self.refused("--left-set birth_score=2: ", *self.base, *out, "--left-set", "birth_score=2")
        other = self.file("other.toml", "birth_score = = 2\n")
        self.refused("other.toml", *self.base, *out, "--right-config", other)

    def test_files(self):
        out = ("--out", self.path("both.avi"))
        gone, sides = self.path("gone"), self.base[:4]
        self.refused("gone: no such file", *sides, *self.base[6:], "--video", gone, *out)
        self.refused("gone: No such file or directory", *self.base[:6], "--det", gone, *out)
        self.refused("gone: No such file or directory", *self.base, *out, "--truth", gone)
        bad = self.file("bad.txt", "1,1,10,10,40,100\n1,2,10,10,-40,100\n")
        self.refused('bad.txt:2: width "-40" is negative', *self.base, *out, "--truth", bad)
        self.refused("cannot write this as a video", *self.base, "--out", self.path("no/such/both.avi"))
        self.refused("det.txt has detections up to frame 20", *sides, "--images", self.few(), "--det", self.det, *out)

    def few(self):
        """A directory of two images."""
        directory = self.path("few")
        os.makedirs(directory)
        for k in range(2):
            os.symlink(f"{self.images}/{k:03}.pgm", f"{directory}/{k:03}.pgm")
        return directory


if __name__ == "__main__":
    unittest.main(verbosity=1)
