"""Tests of derive.py and entries.py, on made-up rows."""
import os
import random
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import derive  # noqa: E402
import entries  # noqa: E402

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
        rows = self.degraded(detections(one, one), one)
        counts = [len(rows) for rows in derive.by_frame(rows).values()]
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


if __name__ == "__main__":
    unittest.main()
