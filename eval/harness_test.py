"""Tests of what eval/ makes of its inputs, on made-up rows; needs neither data nor packages."""
import os
import random
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dataset  # noqa: E402
import derive  # noqa: E402
import entries  # noqa: E402
import folds  # noqa: E402
import identities  # noqa: E402
import judge  # noqa: E402
import parameters  # noqa: E402
import rows  # noqa: E402
import space  # noqa: E402

FRAMES = 2000


def person(identity, left, visibility=1.0):
    return [[str(frame), str(identity), str(left), "100", "40", "100", "1", "1", str(visibility)]
            for frame in range(1, FRAMES + 1)]


def detections(*rows_of_people):
    return [row[:1] + ["-1"] + row[2:6] + ["0.9"] for rows in rows_of_people for row in rows]


class Degrade(unittest.TestCase):
    def setUp(self):
        self.truth = [row for i in range(10) for row in person(i, 100 * i)]
        self.found = detections(self.truth)

    def degraded(self, found, truth, seed=1):
        return derive.degrade(found, truth, 1000, 500, FRAMES, seed)

    def test_a_fifth_is_missed_and_some_are_added(self):
        rows = self.degraded(self.found, self.truth)
        self.assertAlmostEqual(len(rows) / len(self.found), 0.8 * 1.03, delta=0.02)

    def test_misses_come_in_bursts_of_eight(self):
        states = derive.bursts(random.Random("a"), 200000)
        begins = sum(now and not before for before, now in zip(states, states[1:]))
        self.assertAlmostEqual(sum(states) / begins, 8, delta=0.3)
        self.assertAlmostEqual(sum(states) / len(states), 0.2, delta=0.01)

    def test_doubles_of_a_box_share_its_fate(self):
        one = person(1, 300)
        found = self.degraded(detections(one, one), one)
        counts = [len(rows) for rows in rows.by_frame(found).values()]
        self.assertTrue(all(count >= 2 for count in counts if count) or counts.count(1) <= 0.07 * len(counts))

    def test_the_hidden_go_and_strangers_stay(self):
        hidden, stranger = person(1, 300, 0.39), person(2, 600)
        rows = self.degraded(detections(hidden, stranger), hidden)
        self.assertEqual(len(rows), round(1.03 * FRAMES))

    def test_the_seed_decides(self):
        one = person(1, 300)
        first, again, other = (self.degraded(detections(one), one, seed) for seed in (1, 1, 2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)


class Slower(unittest.TestCase):
    def test_every_second_frame_is_kept_and_renumbered(self):
        rows = [[str(frame), "x"] for frame in range(1, 8)]
        self.assertEqual([row[0] for row in derive.subsample(rows, 2)], ["1", "2", "3", "4"])
        self.assertEqual(derive.subsampled_length(7, 2), 4)
        self.assertEqual(derive.subsampled_length(8, 4), 2)

    def test_motions_are_composed_in_their_order(self):
        # x -> 2x, then x -> x + 3: together x -> 2x + 3.
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write("0 1 0 0 0 1 0\n1 2 0 0 0 1 0\n2 1 0 3 0 1 0\n3 9 9 9 9 9 9\n")
            file.flush()
            rows = derive.compose_motion(file.name, 2)
        self.assertEqual([row[0] for row in rows], ["0", "1"])
        self.assertEqual([float(value) for value in rows[1][1:]], [2, 0, 3, 0, 1, 0])


class Entries(unittest.TestCase):
    def test_settings_go_to_the_entry_before_them(self):
        parsed = entries.parse("sort,a=gentrack2:preset=paper,birth_score=0.8,paper,b=bytetrack")
        self.assertEqual([(entry.name, entry.tracker, entry.settings) for entry in parsed], [
            ("sort", "sort", []),
            ("a", "gentrack2", ["preset=paper", "birth_score=0.8"]),
            ("paper", "gentrack2", ["preset=paper"]),
            ("b", "bytetrack", []),
        ])

    def test_what_is_no_entry_is_refused(self):
        for text in ("sortt", "sort,x=1", "a=sortt:x=1"):
            self.assertRaises(ValueError, entries.parse, text)


class Rows(unittest.TestCase):
    def checked(self, text, columns=rows.BOX):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write(text)
            file.flush()
            return [(number, values) for number, values, _ in rows.checked(file.name, columns)]

    def test_commas_or_blanks_and_empty_lines(self):
        row = [1, 2, 3, 4, 5, 6]
        self.assertEqual(self.checked("1,2,3,4,5,6,extra\n\n1 2 3 4 5 6\n"), [(1, row), (3, row)])

    def test_what_is_no_row_is_refused(self):
        for text in ("1,2,3", "a,2,3,4,5,6", "1,2,nan,4,5,6", "1,2,3,4,-5,6", "1.5,2,3,4,5,6", "0,2,3,4,5,6"):
            self.assertRaises(rows.Malformed, self.checked, text)
        self.assertRaises(rows.Malformed, self.checked, "1,2,3,4,5,6", rows.SCORED)


class Layout(unittest.TestCase):
    """What is taken from folders of several layouts."""

    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.root, self.said = self.directory.name, []

    def tearDown(self):
        self.directory.cleanup()

    def write(self, path, text="1,1,10,20,30,40,1,1,1\n"):
        os.makedirs(os.path.dirname(f"{self.root}/{path}"), exist_ok=True)
        with open(f"{self.root}/{path}", "w") as file:
            file.write(text)

    def sequence(self, name, det="det/det.txt"):
        self.write(f"{name}/gt/gt.txt")
        self.write(f"{name}/{det}", "1,-1,10,20,30,40,0.9\n")
        self.write(f"{name}/seqinfo.ini", "[Sequence]\nseqLength=2\nimWidth=64\nimHeight=48\nframeRate=25\n")

    def find(self, **wishes):
        self.said.clear()
        return dataset.Finder(self.root, dataset.Wishes(**wishes), self.said.append).find()

    def test_train_comes_before_val(self):
        self.sequence("val/b")
        self.assertEqual([each.name for each in self.find()], ["b"])
        self.sequence("train/a")
        self.assertEqual([each.name for each in self.find()], ["a"])
        self.assertIn("sequences are those of train/", self.said)

    def test_a_sequence_without_truth_is_left_out(self):
        self.sequence("a")
        self.write("b/det/det.txt")
        self.assertEqual([each.name for each in self.find()], ["a"])
        self.assertIn("without ground truth, so left out: b", self.said)

    def test_one_public_detector_of_three(self):
        for name in ("M-02", "M-04"):
            for detector in dataset.PUBLIC_DETECTORS:
                self.sequence(f"train/{name}{detector}")
        self.assertEqual([each.name for each in self.find()], ["M-02-SDP", "M-04-SDP"])
        self.assertEqual(len(self.find(sequences="*")), 6)
        self.assertEqual([each.name for each in self.find(sequences="M-02-*N,*04-DPM")], ["M-02-FRCNN", "M-04-DPM"])

    def test_of_several_detectors_one_with_probabilities(self):
        for name in ("a", "b"):
            self.sequence(name, "det-y.txt")
            self.write(f"{name}/det-x.txt", "1,-1,10,20,30,40,50\n2,-1,10,20,30,40,70\n")
        self.assertEqual({os.path.basename(each.det) for each in self.find()}, {"det-y.txt"})
        self.assertTrue(any("--det chooses another" in each for each in self.said))
        found = self.find(det="det-x.txt")
        self.assertTrue(all(each.det.endswith("det-x.txt") for each in found))

    def test_equal_scores_beyond_probabilities_say_nothing(self):
        self.sequence("a")
        self.write("a/det/det.txt", "1,-1,10,20,30,40,-1\n2,-1,10,20,30,40,-1\n")
        self.assertRaises(dataset.Unusable, self.find)

    def test_motion_is_taken_if_there(self):
        self.sequence("a")
        self.assertIsNone(self.find()[0].gmc)
        self.write("a/gmc.txt", "0 1 0 0 0 1 0\n")
        self.assertTrue(self.find()[0].gmc)
        self.assertIsNone(self.find(gmc="none")[0].gmc)
        self.assertRaises(dataset.Unusable, self.find, gmc="estimate")

    def test_what_gt2_mot_is_told(self):
        self.sequence("a")
        sequence = self.find(fps=12.5)[0]
        self.assertEqual([(option, value) for option, value, _ in sequence.arguments(False)[1:]],
                         [("--size", "64x48"), ("--frames", "2"), ("--fps", "12.5")])
        sequence.images, sequence.normalise = f"{self.root}/a", True
        self.assertIn(("--images", sequence.images, True), sequence.arguments(True))
        self.assertNotIn("--images", [option for option, _, _ in sequence.arguments(False)])
        self.assertIn(("--normalise-scores", "", False), sequence.arguments(False))


class Judging(unittest.TestCase):
    def counted(self, text, classes=None, places=False):
        row = judge.counted(text.split(","), places, judge.Rules(classes=classes))
        return row and ",".join(row[6:])

    def test_flags_and_classes_as_the_judge_takes_them(self):
        self.assertEqual(self.counted("1,2,3,4,5,6,0,7,0.5"), "0,7,0.5")
        self.assertEqual(self.counted("1,2,3,4,5,6"), "1,1,1")
        self.assertEqual(self.counted("1,2,3,4,5,6,0.5,1,1"), "1,1,1")
        # Places in the world instead of classes.
        self.assertEqual(self.counted("1,2,3,4,5,6,1,-4.5,2.25,0", places=True), "1,1,1")
        # All people: standing ones count as well, flags do not.
        self.assertEqual(self.counted("1,2,3,4,5,6,0,7,0.5", judge.PEOPLE), "1,1,0.5")
        self.assertIsNone(self.counted("1,2,3,4,5,6,1,3,0.5", judge.PEOPLE))

    def test_places_are_told_from_classes(self):
        def places(value, classes=None):
            return judge.has_places([["1"] * 7 + [value]], judge.Rules(classes=classes))

        self.assertEqual([places(value) for value in ("1", "13", "-1", "2.5", "14")], [False, False, True, True, True])
        self.assertFalse(places("14", (14,)))


class Identities(unittest.TestCase):
    def test_runs_are_stretches_of_frames(self):
        self.assertEqual(identities.runs_of([5, 5, None, 5, 7], 11), [[11, 12, 5], [14, 14, 5], [15, 15, 7]])

    def test_causes_of_switches(self):
        # Person 1 is lost by track 10 in frame 2 and found by 12, which began then; person 2 and person 3 swap.
        matches = [{1: 10, 2: 20, 3: 30}, {2: 20, 3: 30}, {1: 12, 2: 30, 3: 20}]
        present, boxes = [[1, 2, 3]] * 3, [[[0, 0, 1, 1]] * 3] * 3
        found = list(identities.events_of(matches, present, boxes, [[10, 20, 30], [20, 30], [12, 20, 30]], 1))
        self.assertEqual(
            [(each.person, each.frame, each.gap, each.cause, each.came_from, each.went_to) for each in found],
            [
                (1, 3, 2, "new id", None, "ended"),
                (2, 3, 1, "swap", 3, 3),
                (3, 3, 1, "swap", 2, 2),
            ],
        )


class Folds(unittest.TestCase):
    def verdict(self, *gains):
        found = [folds.Outcome({}, 50, 55, ["x"], 50, 50 + gain) for gain in gains]
        return folds.verdict(found, folds.Outcome({"x": "1"}, 50, 55, [])).proven

    def test_each_sequence_is_held_out_once(self):
        self.assertEqual(folds.groups([1, 2, 3, 4, 5], 2), [[1, 3, 5], [2, 4]])
        self.assertEqual(folds.groups([1, 2], 4), [[1], [2]])

    def test_only_what_holds_elsewhere_is_claimed(self):
        self.assertTrue(self.verdict(1, 2, 1))
        self.assertFalse(self.verdict(-1, -2, 1))
        # One lucky fold of four.
        self.assertFalse(self.verdict(9, -1, -1, -1))
        # More than half, but no more than chance.
        self.assertFalse(self.verdict(1, 1, -2.5))
        self.assertFalse(self.verdict(3))
        self.assertFalse(folds.verdict([], folds.Outcome({}, 50, 50, [])).proven)


class Space(unittest.TestCase):
    def dimension(self, kind, default, low, high):
        found = space.dimension(parameters.Parameter("x", kind, default, low, high, (), ""), 2.0)
        return found and (found.low, found.high, found.log)

    def test_ranges_are_around_defaults_and_within_limits(self):
        self.assertEqual(self.dimension(parameters.NUMBER, "0.5", 0, 1e6), (0.25, 1.0, True))
        self.assertEqual(self.dimension(parameters.NUMBER, "0.9", 0, 1), (0.45, 1, True))
        self.assertEqual(self.dimension(parameters.NUMBER, "0", 0, 1), (0, 0.2, False))
        self.assertEqual(self.dimension(parameters.NUMBER, "-0.5", -1, 1), (-1, -0.25, False))
        self.assertEqual(self.dimension(parameters.INTEGER, "8", 1, 256), (4, 16, True))
        self.assertEqual(self.dimension(parameters.INTEGER, "1", 0, 100), (0, 2, False))
        self.assertIsNone(self.dimension(5, "", 0, 0))


if __name__ == "__main__":
    unittest.main()
