"""A small search on synthetic sequences, end to end; its TOML is read by gt2_mot and by the C interface.

usage: tune_test.py GT2-MOT

Exit status 77 (skipped) where the Python packages cannot be installed.
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

import environment

PROGRAM = os.path.abspath(sys.argv[1])
environment.enter()
import parameters  # noqa: E402
import space  # noqa: E402
import synthetic  # noqa: E402
import tune  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
# These scenes' scores are mostly above the default, so a search finds something.
KEYS = "birth_score,confirm_evidence,min_iou,max_missed"
LIBRARY = parameters.Library(tune.library_of(PROGRAM))


class Tune(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.root = cls.directory.name
        for name in synthetic.SIZES:
            synthetic.sequence(f"{cls.root}/data/{name}", name, 60)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def tune(self, trials, *more, out="out"):
        command = [sys.executable, f"{HERE}/tune.py", f"{self.root}/data", "--program", PROGRAM, "--cache",
                   f"{self.root}/cache", "--out", f"{self.root}/{out}", "--trials", str(trials), "--folds", "3",
                   "--parameters", KEYS, *more]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(f"{self.root}/{out}/tune.json") as file:
            return json.load(file), done.stdout + done.stderr

    def read(self, name):
        with open(f"{self.root}/out/{name}") as file:
            return file.read()

    def test_a_search_its_resumption_and_its_files(self):
        result, said = self.tune(4)
        self.assertEqual([len(fold["held_out"]) for fold in result["folds"]], [1, 1, 1])
        for fold in result["folds"] + [result["all"]]:
            self.assertGreaterEqual(fold["train"], fold["train_default"])
        again, _ = self.tune(4)
        self.assertEqual(again, result, "a search that was at its end goes no farther")
        more, said = self.tune(8)
        self.assertGreaterEqual(more["all"]["train"], result["all"]["train"])
        self.assertTrue(more["all"]["values"], "nothing was found, so nothing is tested")

        # What is claimed is what gentrack2.toml has; the rest is in a file of another name.
        best = "gentrack2.toml" if more["proven"] else "unproven.toml"
        self.assertEqual(os.path.exists(f"{self.root}/out/unproven.toml"), not more["proven"])
        self.assertIn("The gain holds" if more["proven"] else "o gain is claimed", said)
        values = more["all"]["values"]
        loaded = LIBRARY.load_toml("gentrack2", self.read(best), values)
        self.assertEqual({key: float(value) for key, value in loaded.items()},
                         {key: float(value) for key, value in values.items()})
        if not more["proven"]:
            defaults = {each.key: each.default for each in LIBRARY.parameters("gentrack2")}
            stands = LIBRARY.load_toml("gentrack2", self.read("gentrack2.toml"), values)
            self.assertEqual(stands, {key: defaults[key] for key in values})
        self.assertEqual(self.tracks("--config", f"{self.root}/out/{best}"),
                         self.tracks(*(word for key, value in values.items() for word in ("--set", f"{key}={value}"))))

    def tracks(self, *more):
        command = [
            PROGRAM,
            "--tracker",
            "gentrack2",
            "--det",
            f"{self.root}/data/syn_b1/det/det.txt",
            "--size",
            "1920x1080",
            "--out",
            "-",
            *more,
        ]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(done.stdout)
        return done.stdout

    def test_a_search_of_other_inputs_begins_anew(self):
        one = ("--sequences", "syn_b1", "--seed", "3")
        self.tune(4, *one, "--fps", "30")
        after, _ = self.tune(4, *one, "--fps", "4")
        alone, _ = self.tune(4, *one, "--fps", "4", out="alone")
        self.assertEqual(after, alone)

    def test_time_ends_the_search(self):
        result, _ = self.tune(10000, "--time", "0.02", "--seed", "1", "--metric", "IDF1")
        self.assertEqual(result["metric"], "IDF1")

    def test_one_sequence_proves_nothing(self):
        result, said = self.tune(2, "--sequences", "syn_b1", "--seed", "2")
        self.assertFalse(result["proven"])
        self.assertIn("No gain is claimed" if result["all"]["values"] else "Nothing better", said)

    def test_the_space_comes_from_the_library(self):
        every = LIBRARY.own_parameters("gentrack2")
        self.assertGreater(len(every), 60)
        for each in space.dimensions(LIBRARY, "gentrack2", "all", 2.0):
            for end in each.ends():
                # Some ends exclude one another; none is out of range.
                complaint = LIBRARY.complaint("gentrack2", {each.key: end})
                self.assertFalse(complaint and "outside" in complaint, complaint)
        first = space.dimensions(LIBRARY, "gentrack2", None, 2.0)
        self.assertGreater(len(first), 12)
        self.assertIn("birth_score", [each.key for each in first])
        self.assertRaises(ValueError, space.dimensions, LIBRARY, "gentrack2", "seed", 2.0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
