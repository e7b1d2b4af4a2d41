"""What all programs that run trackers share: options, and what must be there."""
import os
import sys

import environment


def common_options(parser):
    """Those of all programs that run trackers."""
    root = environment.ROOT
    parser.add_argument("--program", default=f"{root}/build/examples_cpp/gt2_mot", help="the built gt2_mot")
    parser.add_argument("--cache", default=f"{root}/out/eval-cache", help="where results are kept")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings",
                        help="a parameter of all entries that are gentrack2; may be given again")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="default: all cores")


def prepare(options):
    if not os.access(options.program, os.X_OK):
        sys.exit(f"{options.program} is not there: run `make build` or give --program")
    environment.enter()


def new_work(evaluation):
    done = evaluation.scheduler.done
    return f"{done.get('track', 0)} runs and {done.get('judge', 0)} judgements were new"
