#!/usr/bin/env python3
"""Lists where one tracker's identities are lost: identity switches and fragmentations; see eval/README.md.

Boxes are matched as the judge matches them, on the judge's own data, and the number of switches is compared with its.
"""
import argparse
import sys

import entries
import evaluate
import identities
import setups as setups_module
import work
from evaluation import Evaluation

# Frames since the last match, the last of a group.
GAPS = (("1", 1), ("2-10", 10), ("11-30", 30), (">30", None))


def group_of(gap):
    return next(name for name, end in GAPS if end is None or gap <= end)


def line(event):
    left, top, width, height = event.box
    what = f"{event.before} kept" if not event.is_switch else f"{event.before} -> {event.now}"
    more = "" if event.came_from is None else f", which had {event.came_from}"
    if event.is_switch:
        where = event.went_to if isinstance(event.went_to, str) else f"has {event.went_to}"
        more += f"; {event.before} {where}"
    return (f"  frame {event.frame:5}  person {event.person:4}  gap {event.gap:4}  {event.cause:10}  {what}{more}  "
            f"at {left:.0f},{top:.0f} {width:.0f}x{height:.0f}")


def print_counts(events):
    print(f"  {'gap':<8}" + "".join(f"{cause:>12}" for cause in identities.CAUSES) + f"{'switches':>12}")
    for name in [group for group, _ in GAPS] + ["all"]:
        counts = [sum(event.cause == cause and name in ("all", group_of(event.gap)) for event in events)
                  for cause in identities.CAUSES]
        print(f"  {name:<8}" + "".join(f"{count:12}" for count in counts) + f"{sum(counts[:-1]):12}")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--setup", default="H", help=f"one of {' '.join(setups_module.NAMES)}; default: H")
    parser.add_argument("--entry", default="gentrack2", help="as one of evaluate.py's entries")
    parser.add_argument("--sequence", help="only this one; default: all of the set-up")
    parser.add_argument("--seed", type=int, help="seed of gentrack2")
    parser.add_argument("--fragments", action="store_true", help="list those that kept their identity, too")
    parser.add_argument("--counts-only", action="store_true", help="only the numbers")
    evaluate.data_options(parser)
    options = parser.parse_args()
    options.seed_list = [options.seed]
    try:
        options.setup_names = setups_module.expand(options.setup)
        options.entry_list = entries.parse_all([options.entry], options.settings)
        if len(options.setup_names) != 1 or len(options.entry_list) != 1:
            raise ValueError("one set-up and one entry, please")
    except ValueError as error:
        parser.error(str(error))
    return options


def main():
    options = arguments()
    evaluate.prepare(options)
    setup, = evaluate.build_setups(options, options.setup_names)
    entry, = options.entry_list
    if options.sequence:
        setup.sequences = [each for each in setup.sequences if each.name == options.sequence]
        if not setup.sequences:
            sys.exit(f"set-up {setup.name} has no sequence {options.sequence}")
    evaluation = Evaluation(options.program, options.cache, options.jobs, [setup], [entry], [options.seed])
    try:
        evaluation.run()
    except work.Failed as error:
        sys.exit(str(error))
    everything, differ = [], False
    for sequence in setup.sequences:
        result = evaluation.result(setup, entry, evaluation.seeds(entry)[0], sequence.name)
        events = identities.events(result)
        everything += events
        switches, judged = sum(event.is_switch for event in events), result["CLEAR"]["IDSW"]
        differ |= switches != judged
        print(f"{setup.name} {sequence.name}, {entry.name}: {switches} switches (judge: {judged}), "
              f"{sum(event.gap > 1 for event in events)} fragmentations")
        if not options.counts_only:
            for group, _ in GAPS:
                for event in events:
                    if group_of(event.gap) == group and (options.fragments or event.is_switch):
                        print(line(event))
        print_counts(events)
    if len(setup.sequences) > 1:
        print(f"{setup.name}, all sequences, {entry.name}")
        print_counts(everything)
    if differ:
        sys.exit("the judge counts other switches: this program does not match as it does")


if __name__ == "__main__":
    main()
