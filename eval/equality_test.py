"""The reports' numbers are those of the measurement data's own judging program, tools/eval_mot.py, to three decimals,
for all trackers and sequences of mot17, mot15 and dancetrack.

usage: equality_test.py GT2-MOT

Exit status 77 (skipped) where GENTRACK2_SHARED does not name the data, or the Python packages cannot be installed.
"""

import concurrent.futures
import json
import os
import subprocess
import sys
import tempfile
import unittest

import environment

PROGRAM = os.path.abspath(sys.argv[1])
SHARED = os.environ.get("GENTRACK2_SHARED")
if not SHARED or not os.path.isfile(f"{SHARED}/tools/eval_mot.py"):
    environment.skip("GENTRACK2_SHARED does not name the measurement data: the reports' numbers were NOT compared")
environment.enter()
import dataset  # noqa: E402
import entries  # noqa: E402
import judge  # noqa: E402
from evaluation import ALL, Evaluation, Setup  # noqa: E402

# Data set, and how it is judged.
CASES = {"mot17": judge.Rules("half"), "mot15": judge.Rules(), "dancetrack": judge.Rules()}
COMPARED = ("ATA", "IDF1", "HOTA", "MOTA", "IDSW", "FP", "FN", "AssA", "DetA")


def expected(setup, evaluation, entry):
    """eval_mot.py's table of an entry's tracks."""
    with tempfile.TemporaryDirectory() as work:
        for kind in ("gt", "res"):
            os.mkdir(f"{work}/{kind}")
        for sequence in setup.sequences:
            os.symlink(sequence.gt, f"{work}/gt/{sequence.name}.txt")
            os.symlink(
                evaluation.tracks[setup.name, entry.name, None, sequence.name], f"{work}/res/{sequence.name}.txt"
            )
        command = [
            sys.executable,
            f"{SHARED}/tools/eval_mot.py",
            "--gt",
            f"{work}/gt",
            "--res",
            f"{work}/res",
            "--json",
            "--split",
            setup.rules.split,
            *(["--humans"] if setup.rules.classes else []),
        ]
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout.strip().splitlines()[-1])


class Equality(unittest.TestCase):
    def compare(self, name, rules, names=None):
        found = dataset.Finder(f"{SHARED}/{name}", dataset.Wishes(names), lambda sentence: None).find()
        setup, rows = Setup(name, name, found, rules), entries.parse_all(entries.TRACKERS, [])
        jobs = len(os.sched_getaffinity(0))
        evaluation = Evaluation(PROGRAM, f"{environment.ROOT}/out/eval-cache", jobs, [setup], rows)
        evaluation.run()
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            tables = list(pool.map(lambda entry: expected(setup, evaluation, entry), rows))
        count = 0
        for entry, table in zip(rows, tables):
            self.assertEqual(set(table), {sequence.name for sequence in found} | {ALL})
            for sequence, scores in table.items():
                ours = evaluation.scores(setup, entry, None, sequence)
                for score in COMPARED:
                    self.assertAlmostEqual(
                        ours[score], scores[score], delta=0.0005, msg=f"{entry.name} {sequence} {score}"
                    )
                    count += 1
        print(f"{name}: {count} numbers compared", flush=True)

    def test_all_data_sets(self):
        for name, rules in CASES.items():
            self.compare(name, rules)

    def test_the_papers_set_up(self):
        self.compare("mot17", judge.Rules("full", judge.PEOPLE), "MOT17-04")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
