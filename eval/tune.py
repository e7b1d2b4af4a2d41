#!/usr/bin/env python3
"""Searches GenTrack2's parameters on your own sequences, and tells on sequences that the search did not see whether
they are better; see eval/README.md.

May be stopped and started again: it goes on where it was, and with a larger --trials it goes farther.
"""

import argparse
import json
import os
import sys
import time

import entries
import environment
import folds
import parameters
import program
import report
import space
import store
import work

TRACKER = "gentrack2"
METRICS = ("HOTA", "IDF1", "MOTA", "ATA")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    report.data_options(parser)
    program.common_options(parser)
    parser.add_argument("--metric", choices=METRICS, default="HOTA", help="what is to become better; default: HOTA")
    parser.add_argument("--trials", type=int, default=60, metavar="N", help="parameter sets tried per search, of which "
                        "there is one per fold and one on all sequences; default: 60")
    parser.add_argument("--time", type=float, metavar="MINUTES", help="stop after this time, whatever --trials says")
    parser.add_argument("--folds", type=int, default=4, metavar="K", help="groups of sequences, each held out once; "
                        "default: 4, or as many as there are sequences")
    parser.add_argument(
        "--parameters",
        metavar="KEY,...",
        help="what is searched, or all; default: those of the table of docs/tuning.md",
    )
    parser.add_argument("--reach", type=float, default=2.0, metavar="F", help="numbers are searched from the default "
                        "divided by this to the default times this; default: 2")
    parser.add_argument("--seed", type=int, default=0, help="of the search; default: 0")
    parser.add_argument("--out", default=f"{environment.ROOT}/out/tune", help="directory of gentrack2.toml")
    options = parser.parse_args()
    for name, least in (("trials", 1), ("folds", 1)):
        if getattr(options, name) < least:
            parser.error(f"--{name} is at least {least}")
    if options.reach <= 1:
        parser.error("--reach is more than 1")
    return options


def library_of(path):
    """The library that a gt2_mot was built with."""
    return os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(path))), "lib", "libgentrack2.so")


def find_space(options, library, trials, fixed):
    """The dimensions that make a difference on these sequences, and are not fixed."""
    dimensions = [each for each in space.dimensions(library, TRACKER, options.parameters, options.reach)
                  if each.key not in fixed]
    effective = trials.effective(dimensions)
    idle = [each.key for each in dimensions if each not in effective]
    if idle:
        print(f"  without effect here, so left alone: {', '.join(idle)}", file=sys.stderr)
    if not effective:
        sys.exit("none of the parameters makes a difference on these sequences: nothing to tune")
    print(f"  searched: {', '.join(each.key for each in effective)}", file=sys.stderr)
    return effective


def table(rows, metric):
    lines = [f"{'':<10}{'searched on':>26}{'held out':>26}", f"{metric:<10}" + f"{'default':>13}{'tuned':>13}" * 2]
    for name, row in rows:
        cells = "".join(f"{value:13.2f}" if value is not None else f"{'-':>13}"
                        for value in (row.train_default, row.train, row.held_default, row.held))
        lines.append(f"{name:<10}{cells}")
    return "\n".join(lines)


def toml(header, described, values):
    """The values that are not defaults, each with what the library says of it."""
    lines = [f"# {line}" for line in header] + [f'algorithm = "{TRACKER}"']
    for each in described:
        if each.key in values and values[each.key] != each.default:
            value = values[each.key]
            text = f'"{value}"' if each.kind == parameters.CHOICE else value
            lines += ["", f"# {each.documentation}", f"# Default: {each.default}", f"{each.key} = {text}"]
    return "\n".join(lines) + "\n"


def fixed_values(settings, described):
    """What --set fixes, by key."""
    values = dict(setting.split("=", 1) for setting in settings if "=" in setting)
    single = {each.key for each in described if each.kind in parameters.SINGLE}
    unknown = [each for each in settings if each.split("=", 1)[0] not in single]
    if unknown:
        raise ValueError(
            f"--set {unknown[0]}: {TRACKER} has no such parameter of a single value (presets are not tuned)"
        )
    return values


def remove(path):
    """One of an earlier search."""
    if os.path.exists(path):
        os.remove(path)


def write(options, title, described, fixed, found, final):
    """Prints what was found and writes the files."""
    verdict, out = folds.verdict(found, final), os.path.abspath(options.out)
    names = [f"fold {i + 1}" for i in range(len(found))]
    text = table([*zip(names, found), ("all", final)], options.metric)
    print(f"\n{text}\n\n{verdict.text}")
    header = [title, *text.splitlines(), *verdict.text.splitlines()]
    config, candidate = f"{out}/{TRACKER}.toml", f"{out}/unproven.toml"
    best = toml(header, described, fixed | final.values)
    if verdict.proven:
        store.write(config, best)
        remove(candidate)
    else:
        store.write(config, toml(header, described, fixed))
        also = " and what --set says" if fixed else ""
        if final.values:
            store.write(candidate, best)
            print(f"{config} has the defaults{also}; what was best where it was searched is in {candidate}")
        else:
            remove(candidate)
            print(f"{config} has the defaults{also}")
    store.write(
        f"{out}/tune.json",
        json.dumps(
            {
                "metric": options.metric,
                "proven": verdict.proven,
                "folds": [vars(each) for each in found],
                "all": vars(final),
            },
            indent=1,
        )
        + "\n",
    )
    print(config)


def main():
    start = time.monotonic()
    options = arguments()
    program.prepare(options)
    import search  # needs what is only there now
    try:
        library = parameters.Library(library_of(options.program))
    except OSError as error:
        sys.exit(f"the library of {options.program} cannot be loaded: {error}")
    setup, _ = report.find(options)
    evaluation = report.evaluation_of(options, setup, [])
    base = entries.parse_all([TRACKER], options.settings)[0]
    trials = search.Trials(evaluation, setup, base, options.metric, library)
    described = library.parameters(TRACKER)
    try:
        fixed = fixed_values(options.settings, described)
        dimensions = find_space(options, library, trials, fixed)
    except ValueError as error:
        sys.exit(str(error))
    end = start + 60 * options.time if options.time else None
    searcher = search.Searcher(trials, dimensions, options.trials, end, options.seed,
                               os.path.join(os.path.abspath(options.out), "search.log"))
    try:
        found, final = folds.cross_validate(searcher, setup.sequences, options.folds)
    except KeyboardInterrupt:
        sys.exit("stopped; the same command goes on from here")
    except work.Failed as error:
        sys.exit(str(error))
    write(
        options,
        f"{options.metric} on {setup.title}: {', '.join(each.name for each in setup.sequences)}",
        described,
        fixed,
        found,
        final,
    )


if __name__ == "__main__":
    main()
