#!/usr/bin/env python3
"""Evaluates all trackers on a folder of sequences in MOTChallenge's layout and writes a page about them; see
eval/README.md."""
import argparse
import os
import sys
import time

import dataset
import entries as entries_module
import environment
import evaluation as evaluation_module
import judge
import program
import rows
import store
import tables
import work


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    data_options(parser)
    parser.add_argument("--out", default=f"{environment.ROOT}/out/eval", help="directory of the page, index.html")
    parser.add_argument("--title", help="of the page; default: the folder's name")
    parser.add_argument("--entries", action="append", default=[], help="rows, as evaluate.py's; default: all trackers")
    parser.add_argument("--seed", type=int, help="seed of gentrack2; default: its own default")
    parser.add_argument(
        "--strips", type=int, default=3, metavar="N", help="worst switches shown per tracker; default: 3"
    )
    parser.add_argument("--json", metavar="FILE", help="also write all scores as JSON")
    program.common_options(parser)
    options = parser.parse_args()
    try:
        options.entry_list = entries_module.parse_all(options.entries or [",".join(entries_module.TRACKERS)],
                                                      options.settings)
    except ValueError as error:
        parser.error(str(error))
    return options


def data_options(parser):
    parser.add_argument("data", help="folder of the sequences")
    parser.add_argument("--sequences", metavar="PATTERN,...", help="only those of such names, such as MOT17-0*")
    parser.add_argument(
        "--det",
        metavar="FILE",
        help="file of detections in each sequence's folder (or in its det/), or a folder with SEQUENCE.txt",
    )
    parser.add_argument("--split", choices=("full", "half"), default="full", help="half: only the second halves count, "
                        "for a detector that was trained on the first")
    parser.add_argument("--classes", metavar="N,...", help="classes of the ground truth that count, as one, whatever "
                        "their flag; default: MOTChallenge's rules")
    parser.add_argument("--gmc", choices=("auto", "none", "estimate"), default="auto",
                        help="camera motion: gmc.txt if there, none, or estimated from the images")
    parser.add_argument(
        "--embeddings", metavar="FILE", help="file of embeddings in each sequence's folder; default: none"
    )
    parser.add_argument("--images", choices=("auto", "none"), default="auto", help="images, if there, or none")
    parser.add_argument("--fps", type=float, help="frames per second; default: seqinfo.ini's")
    parser.add_argument("--size", metavar="WxH", help="size of the images; default: seqinfo.ini's")


def find(options):
    """The set-up that the folder makes, and what was decided about it; ends the program if it makes none."""
    facts = []

    def say(sentence):
        facts.append(sentence)
        print(f"  {sentence}", file=sys.stderr)

    wishes = dataset.Wishes(
        options.sequences, options.det, options.gmc, options.embeddings, options.images, options.fps, options.size
    )
    try:
        classes = tuple(int(each) for each in options.classes.split(",")) if options.classes else None
    except ValueError:
        sys.exit(f"--classes {options.classes}: expected numbers with commas")
    print(f"{options.data}:", file=sys.stderr)
    try:
        sequences = dataset.Finder(options.data, wishes, say).find()
    except (dataset.Unusable, rows.Malformed, OSError) as error:
        sys.exit(str(error))
    halves = "only the second half of each sequence counts" if options.split == "half" else "all frames count"
    rules = "MOTChallenge's rules" if classes is None else f"classes {options.classes} count, as one"
    say(f"judged: {halves}; {rules}")
    name = os.path.basename(os.path.abspath(options.data))
    return evaluation_module.Setup(name, name, sequences, judge.Rules(options.split, classes)), facts


def evaluation_of(options, setup, entries):
    """The evaluation of the set-up; ends the program if there is nothing to judge."""
    try:
        return evaluation_module.Evaluation(
            options.program, options.cache, options.jobs, [setup], entries, [options.seed]
        )
    except evaluation_module.NothingCounts as error:
        sys.exit(str(error))


def main():
    start = time.monotonic()
    options = arguments()
    program.prepare(options)
    setup, facts = find(options)
    evaluation = evaluation_of(options, setup, options.entry_list)
    try:
        evaluation.run("eval")
    except work.Failed as error:
        sys.exit(str(error))
    table = tables.Table(evaluation, True)
    scores = [score for score in tables.SCORES if score not in ("FP", "FN")]
    tables.print_table(table, scores)
    import page
    path = os.path.join(os.path.abspath(options.out), "index.html")
    store.write(path, page.render(page.Report(evaluation, table, facts, options.title or setup.title, options.strips)))
    if options.json:
        store.write(os.path.abspath(options.json), tables.as_json(table))
    print(f"\n{program.new_work(evaluation)}; {time.monotonic() - start:.1f} s", file=sys.stderr)
    print(path)


if __name__ == "__main__":
    main()
