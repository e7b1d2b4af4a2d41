"""Tests of symptoms.py: what it counts by itself, and how it writes tables."""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import symptoms  # noqa: E402


def track_file(directory, rows):
    path = os.path.join(directory, "tracks.txt")
    with open(path, "w") as file:
        file.writelines(f"{frame},{identity},{left},0,10,50,1,-1,-1,-1\n" for frame, identity, left in rows)
    return path


class Tremble(unittest.TestCase):
    def tremble(self, rows):
        with tempfile.TemporaryDirectory() as directory:
            return symptoms.tremble(track_file(directory, rows))

    def test_even_motion_does_not_tremble(self):
        self.assertEqual(self.tremble([(1, 1, 0), (2, 1, 3), (3, 1, 6)]), 0)

    def test_the_distance_from_the_middle_of_its_neighbours_counts(self):
        # 5 px from the middle of 0 and 0, of 50 px of height: 10 %. The other track has no frame between two others.
        self.assertAlmostEqual(self.tremble([(1, 1, 0), (2, 1, 5), (3, 1, 0), (1, 2, 0), (2, 2, 90)]), 10)

    def test_nothing_is_compared_across_a_gap(self):
        self.assertEqual(self.tremble([(1, 1, 0), (3, 1, 80), (4, 1, 80)]), 0)


class Page(unittest.TestCase):
    def test_a_table_has_a_row_per_run_and_one_table_per_sequence(self):
        scores = dict.fromkeys(symptoms.COLUMNS, 1.25)
        lines = symptoms.table("camera", [scores, scores | {"HOTA": 50.04}]).split("\n")
        self.assertEqual(len(lines), 4)
        self.assertTrue(lines[0].startswith("| MOT17-05, set-up H | HOTA |"))
        self.assertTrue(lines[3].startswith("| with it | 50.0 | 1.2 |"))
        self.assertEqual(symptoms.table("rate", [scores] * 4).count("set-up L4"), 2)

    def test_only_what_stands_between_the_marks_changes(self):
        page = "a\n<!-- measured: x -->\nold\n<!-- end -->\nb\n<!-- measured: y -->\n<!-- end -->\n"
        again = symptoms.written(symptoms.written(page, "x", "new"), "x", "newer")
        self.assertEqual(again, page.replace("old\n", "\nnewer\n\n"))
        with self.assertRaises(SystemExit):
            symptoms.written(page, "z", "new")

    def test_every_case_has_its_place_in_the_page(self):
        with open(symptoms.PAGE) as file:
            page = file.read()
        for name in symptoms.CASES:
            symptoms.written(page, name, "")
        self.assertEqual(page.count("<!-- measured: "), len(symptoms.CASES))


if __name__ == "__main__":
    unittest.main()
