#!/usr/bin/env python3
"""Runs trackers over all set-ups and prints one table of their accuracy; see eval/README.md."""
import argparse
import os
import sys
import time

import environment
import entries as entries_module
import program
import setups as setups_module
import store
import work
from evaluation import Evaluation
from tables import SCORES, Table, as_json, blocks, print_table


def data_options(parser):
    program.common_options(parser)
    parser.add_argument("--data", default=os.environ.get("GENTRACK2_SHARED"),
                        help="directory of the data; default: what GENTRACK2_SHARED names")
    parser.add_argument("--degrade-seed", type=int, default=1, metavar="N", help="seed of set-up R's worse detector")


def prepare(options):
    """Ends the program where something is missing; sees to TrackEval."""
    if not options.data:
        environment.skip("GENTRACK2_SHARED does not name the measurement data, nor does --data")
    program.prepare(options)


def markdown(table, scores):
    lines = []
    for title, rows in blocks(table, scores):
        lines += [f"### {title}", "", "| | " + " | ".join(scores) + " |", "|---|" + "---|" * len(scores)]
        for name, cells in rows:
            lines.append(f"| {name} | " + " | ".join(f"**{text}**" if best else text for text, best in cells) + " |")
        lines.append("")
    return "\n".join(lines)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--setups", default="all", help=f"of {' '.join(setups_module.NAMES)}, with commas; W and L "
                        "stand for both of theirs; default: all")
    parser.add_argument("--entries", action="append", default=[],
                        help="rows, with commas: a tracker, `paper` (gentrack2 with that preset) or "
                        "NAME=TRACKER:KEY=VALUE,KEY=VALUE; may be given again; default: all trackers and paper")
    data_options(parser)
    seeds = parser.add_mutually_exclusive_group()
    seeds.add_argument("--seed", type=int, help="seed of gentrack2; default: its own default")
    seeds.add_argument("--seeds", type=int, metavar="N", help="seeds 1 to N: mean and standard deviation")
    parser.add_argument("--per-sequence", action="store_true", help="scores of each sequence, too")
    parser.add_argument("--counts", action="store_true", help="false positives and negatives, too")
    parser.add_argument("--json", metavar="FILE", help="also write everything as JSON")
    parser.add_argument("--markdown", metavar="FILE", help="also write the table as Markdown")
    options = parser.parse_args()
    options.seed_list = list(range(1, options.seeds + 1)) if options.seeds else [options.seed]
    try:
        options.setup_names = setups_module.expand(options.setups)
        options.entry_list = entries_module.parse_all(options.entries or [",".join(entries_module.DEFAULT)],
                                                      options.settings)
    except ValueError as error:
        parser.error(str(error))
    return options


def build_setups(options, names):
    builder = setups_module.Builder(os.path.abspath(options.data), os.path.abspath(options.cache),
                                    options.degrade_seed)
    built = []
    for name in names:
        try:
            built.append(builder.build(name))
        except setups_module.Missing as error:
            print(f"set-up {name} is left out: {error}", file=sys.stderr)
    if not built:
        environment.skip("no set-up has its data")
    return built


def main():
    start = time.monotonic()
    options = arguments()
    prepare(options)
    evaluation = Evaluation(options.program, options.cache, options.jobs, build_setups(options, options.setup_names),
                            options.entry_list, options.seed_list)
    try:
        evaluation.run()
    except work.Failed as error:
        sys.exit(str(error))
    table = Table(evaluation, options.per_sequence)
    scores = [score for score in SCORES if options.counts or score not in ("FP", "FN")]
    print_table(table, scores)
    if options.json:
        store.write(os.path.abspath(options.json), as_json(table))
    if options.markdown:
        store.write(os.path.abspath(options.markdown), markdown(table, scores))
    print(f"\n* best of its column. {program.new_work(evaluation)}; {time.monotonic() - start:.1f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
