"""The report of a small data set, end to end: page, cache, layouts and what is said of bad data.

usage: report_test.py GT2-MOT

Exit status 77 (skipped) where the Python packages cannot be installed.
"""
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import environment

PROGRAM = os.path.abspath(sys.argv[1])
environment.enter()
import entries  # noqa: E402
import rows  # noqa: E402
import synthetic  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))


class Page(html.parser.HTMLParser):
    """What a test asks of a page."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.addresses, self.labels, self.row_names, self.in_row_name = [], [], [], [], False
        # Of all tables: the heads of their columns, and per row the cells' texts and whether they are marked as best.
        self.heads, self.cells, self.place = [], [], None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append(tag)
        self.addresses += [attributes[name] for name in ("src", "href", "xlink:href") if name in attributes]
        self.labels += [attributes.get("aria-label")] if tag == "svg" else []
        self.in_row_name = attributes.get("scope") == "row"
        if tag == "table":
            self.heads.append([])
            self.cells.append([])
        elif tag == "th":
            self.place = "head" if attributes.get("scope") == "col" else None
            if self.in_row_name:
                self.cells[-1].append([])
        elif tag == "td":
            self.place = "cell"
            self.cells[-1][-1].append(["", attributes.get("class") == "best"])
        elif tag == "span":
            self.place = None

    def handle_endtag(self, tag):
        if tag in ("th", "td"):
            self.place = None

    def handle_data(self, data):
        if self.place == "head":
            self.heads[-1].append(data)
        elif self.place == "cell":
            self.cells[-1][-1][-1][0] += data
        if self.in_row_name and data.strip():
            self.row_names.append(data.strip())
            self.in_row_name = False


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.root = cls.directory.name
        cls.data = synthetic.data_set(f"{cls.root}/data")
        cls.first = cls.report(cls.data, "--json", f"{cls.root}/scores.json")
        with open(f"{cls.root}/out/index.html") as file:
            cls.page = file.read()

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    @classmethod
    def report(cls, data, *more, code=0):
        command = [
            sys.executable,
            f"{HERE}/report.py",
            data,
            "--program",
            PROGRAM,
            "--cache",
            f"{cls.root}/cache",
            "--out",
            f"{cls.root}/out",
            *more,
        ]
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == code, f"{done.returncode}: {done.stdout}{done.stderr}"
        return done.stdout + done.stderr

    def test_the_page_has_everything_in_itself(self):
        text, page = self.page, Page(self.page)
        self.assertEqual(page.row_names, entries.TRACKERS * 4)
        outside = [each for each in page.addresses if not each.startswith(("#", "data:"))]
        self.assertEqual(outside, [])
        self.assertNotRegex(text, r"@import|url\((?!#)")
        # Three charts, and a timeline per tracker and sequence, each in two widths.
        self.assertEqual(len(page.labels), 2 * (3 + 3 * 8))
        self.assertTrue(all(label and len(label) > 40 for label in page.labels))
        self.assertGreater(page.tags.count("img"), 8)

    def test_scores_are_those_of_the_table(self):
        with open(f"{self.root}/scores.json") as file:
            scores = json.load(file)["data"]
        self.assertEqual(list(scores), entries.TRACKERS)
        together = scores["gentrack2"]["runs"][0]["scores"]["COMBINED_SEQ"]
        self.assertRegex(self.first, rf"gentrack2 +{together['ATA']:.2f}\*? +{together['IDF1']:.2f}")
        # Easy scenes: a tracker that loses them is broken, and so is a judge that finds no switches at all.
        self.assertGreater(together["HOTA"], 60)
        self.assertGreater(max(row["runs"][0]["scores"]["COMBINED_SEQ"]["IDSW"] for row in scores.values()), 0)

    def test_the_pages_numbers_and_marks_are_those_of_the_scores(self):
        with open(f"{self.root}/scores.json") as file:
            scores = [row["runs"][0]["scores"] for row in json.load(file)["data"].values()]
        page = Page(self.page)
        sequences = ["COMBINED_SEQ", *sorted(set(scores[0]) - {"COMBINED_SEQ"})]
        self.assertEqual(len(page.cells), len(sequences))
        for sequence, heads, rows_of_table in zip(sequences, page.heads, page.cells):
            self.assertEqual(heads[:6], ["tracker", "ATA", "IDF1", "HOTA", "MOTA", "IDSW"])
            for at, name in enumerate(heads[1:6]):
                values = [row[sequence][name] for row in scores]
                texts = [f"{value:.0f}" if name == "IDSW" else f"{value:.2f}" for value in values]
                self.assertEqual([row[at][0] for row in rows_of_table], texts, f"{sequence} {name}")
                best = (min if name == "IDSW" else max)(values)
                marked = [abs(value - best) < 1e-6 for value in values]
                self.assertEqual([row[at][1] for row in rows_of_table], marked, f"{sequence} {name}")

    def test_a_second_run_does_only_what_changed(self):
        self.assertIn("0 runs and 0 judgements were new", self.report(self.data))
        changed = f"{self.root}/changed"
        shutil.copytree(self.data, changed)
        path = f"{changed}/train/syn_b1/det/det.txt"
        rows.write_rows(path, rows.read_rows(path)[1:])
        # One sequence of three, by eight trackers; botsort and smiletrack give the same tracks, others might.
        said = re.search(r"(\d+) runs and (\d+) judgements were new", self.report(changed))
        self.assertEqual(said[1], "8")
        self.assertLessEqual(int(said[2]), 8)
        self.assertGreaterEqual(int(said[2]), 5)

    def one(self, name="syn_b1", frames=20):
        """A folder with one short sequence, for a test of its own."""
        folder = tempfile.mkdtemp(dir=self.root)
        synthetic.sequence(f"{folder}/{name}", name, frames)
        return folder, f"{folder}/{name}"

    def only_sort(self, folder, *more, code=0):
        return self.report(folder, "--entries", "sort", "--out", f"{self.root}/other", *more, code=code)

    def test_a_folder_of_flat_files_without_seqinfo(self):
        folder, sequence = self.one()
        for part in ("gt", "det"):
            shutil.move(f"{sequence}/{part}/{part}.txt", f"{sequence}/{part}.txt")
            os.rmdir(f"{sequence}/{part}")
        os.remove(f"{sequence}/seqinfo.ini")
        said = self.only_sort(folder)
        for fact in (
            "no seqinfo.ini; 20 frames",
            "--fps sets it",
            "holds all boxes, --size",
            "det.txt of each sequence",
        ):
            self.assertIn(fact, said)
        self.assertIn("one sequence by itself", self.only_sort(sequence))

    def test_scores_of_any_range_are_squashed(self):
        folder, sequence = self.one()
        path = f"{sequence}/det/det.txt"
        rows.write_rows(path, [[*row[:6], str(50 * float(row[6])), *row[7:]] for row in rows.read_rows(path)])
        self.assertIn("scores are not in 0..1, so they are squashed", self.only_sort(folder, "--set", "min_score=0.1"))

    def test_numbers_and_files_as_other_programs_write_them(self):
        folder, sequence = self.one()
        usual = self.scores(folder)
        path = f"{sequence}/gt/gt.txt"
        written = rows.read_rows(path)
        for columns in (lambda row: [f"{float(each)}" for each in row], lambda row: [f" {each}" for each in row]):
            rows.write_rows(path, [columns(row) for row in written])
            self.assertEqual(self.scores(folder), usual)
        for name in ("gt/gt.txt", "det/det.txt", "seqinfo.ini"):
            with open(f"{sequence}/{name}", "rb") as file:
                content = file.read()
            with open(f"{sequence}/{name}", "wb") as file:
                file.write(b"\xef\xbb\xbf" + content.replace(b"\n", b"\r\n"))
        self.assertEqual(self.scores(folder), usual)

    def scores(self, folder):
        """All scores of sort."""
        self.only_sort(folder, "--json", f"{self.root}/one.json")
        with open(f"{self.root}/one.json") as file:
            result, = json.load(file).values()
        return result["sort"]["runs"]

    def test_own_detections_in_a_folder(self):
        folder, sequence = self.one()
        os.mkdir(f"{folder}/mine")
        shutil.move(f"{sequence}/det/det.txt", f"{folder}/mine/syn_b1.txt")
        self.only_sort(folder, "--det", f"{folder}/mine")
        self.assertIn("other.txt is not there", self.renamed(folder, sequence))

    def renamed(self, folder, sequence):
        os.rename(sequence, f"{folder}/other")
        return self.only_sort(folder, "--det", f"{folder}/mine", code=1)

    def test_only_some_classes_count(self):
        folder, _ = self.one()
        self.only_sort(folder, "--classes", "1,7")
        self.assertIn("gt.txt: no box counts: none of classes 3", self.only_sort(folder, "--classes", "3", code=1))

    def test_embeddings_must_fit(self):
        folder, sequence = self.one()
        count = len(rows.read_rows(f"{sequence}/det/det.txt"))
        with open(f"{sequence}/embeddings.f32", "wb") as file:
            file.write(bytes(4 * 2 * count))
        self.assertIn("--embeddings embeddings.f32 gives it", self.only_sort(folder))
        self.assertIn("of 2 numbers", self.only_sort(folder, "--embeddings", "embeddings.f32"))
        with open(f"{sequence}/embeddings.f32", "ab") as file:
            file.write(b"x")
        self.assertIn(
            "no whole number of 32-bit floats", self.only_sort(folder, "--embeddings", "embeddings.f32", code=1)
        )

    def test_what_is_wrong_is_named(self):
        folder, sequence = self.one()
        for path, line, text, said in (
            ("gt/gt.txt", 3, "1,2,x,4,5,6,1,1,1", 'gt/gt.txt:3: left "x" is not a finite number'),
            (
                "gt/gt.txt",
                2,
                "1,2,3",
                "gt/gt.txt:2: expected frame,id,left,top,width,height,..., found 3 fields: 1,2,3",
            ),
            ("gt/gt.txt", 2, None, "is in frame 1 already, by line 1"),
            ("gt/gt.txt", 3, "1,-1,3,4,5,6,1,1,1", 'gt/gt.txt:3: id "-1" is not a whole number in 0..10000000'),
            ("gt/gt.txt", 3, "1,1.5,3,4,5,6,1,1,1", 'gt/gt.txt:3: id "1.5" is not a whole number'),
            ("gt/gt.txt", 3, "1,3000000000,3,4,5,6,1,1,1", 'gt/gt.txt:3: id "3000000000" is not a whole number'),
            ("det/det.txt", 5, "0,-1,1,2,3,4,0.5", 'det/det.txt:5: frame "0" is not a whole number from 1 on'),
            ("det/det.txt", 5, "1,-1,1,2,-3,4,0.5", 'det/det.txt:5: width "-3" is negative'),
            ("det/det.txt", 5, "1,-1,1,2,3,4", "det/det.txt:5: expected frame,id,left,top,width,height,score,..."),
            ("seqinfo.ini", 6, "", "seqinfo.ini: 'imwidth' is missing".replace("'", "")),
            ("seqinfo.ini", 5, "seqLength=many", "seqinfo.ini: invalid literal"),
        ):
            with open(f"{sequence}/{path}") as file:
                lines = file.read().splitlines()
            good = list(lines)
            lines[line - 1] = lines[0] if text is None else text
            with open(f"{sequence}/{path}", "w") as file:
                file.write("\n".join(lines) + "\n")
            self.assertIn(said.lower(), self.only_sort(folder, code=1).lower())
            with open(f"{sequence}/{path}", "w") as file:
                file.write("\n".join(good) + "\n")
        self.only_sort(folder)

    def test_what_is_missing_is_named(self):
        folder, sequence = self.one()
        self.assertIn("nowhere is not there", self.only_sort(f"{folder}/nowhere", code=1))
        self.assertIn("is a file, not a folder", self.only_sort(f"{sequence}/seqinfo.ini", code=1))
        self.assertIn("no sequence is named x*", self.only_sort(folder, "--sequences", "x*", code=1))
        os.remove(f"{sequence}/det/det.txt")
        self.assertIn("has no detections: looked for det/det.txt and det.txt", self.only_sort(folder, code=1))
        os.remove(f"{sequence}/gt/gt.txt")
        self.assertIn("has no ground truth", self.only_sort(folder, code=1))
        empty = tempfile.mkdtemp(dir=self.root)
        self.assertIn("holds no sequences", self.only_sort(empty, code=1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
