"""Work in parallel: tasks that each make a file, none of them twice."""
import concurrent.futures
import dataclasses
import heapq
import itertools
import multiprocessing
import os
import sys


@dataclasses.dataclass(order=True)
class Task:
    # Most expensive first, so that no long one is left at the end.
    priority: float
    number: int
    function: object = dataclasses.field(compare=False)
    arguments: tuple = dataclasses.field(compare=False)
    out: str = dataclasses.field(compare=False)


class Scheduler:
    """Does tasks in parallel, those whose output file exists not at all, and none twice."""

    def __init__(self, jobs):
        self.jobs = jobs
        self.numbers = itertools.count()
        self.ready, self.known = [], {}
        # How many tasks were done, by the name of their function.
        self.done = {}
        self.added = 0

    def add(self, cost, function, arguments, out, then):
        """`then` is called when the file is there: at once, if it is."""
        if os.path.exists(out):
            then()
        elif out in self.known:
            self.known[out].append(then)
        else:
            self.known[out] = [then]
            self.added += 1
            heapq.heappush(self.ready, Task(-cost, next(self.numbers), function, arguments, out))

    def run(self, what=None):
        """Does all tasks, with a bar of progress of that name if it has one."""
        if not self.ready:
            return
        import tqdm
        # Its thread would be copied into the processes.
        tqdm.tqdm.monitor_interval = 0
        context = multiprocessing.get_context("fork")
        with (
            concurrent.futures.ProcessPoolExecutor(self.jobs, mp_context=context) as pool,
            tqdm.tqdm(desc=what, total=self.added, file=sys.stderr, disable=None if what else True, leave=False) as bar,
        ):
            running = {}
            while self.ready or running:
                while self.ready and len(running) < self.jobs:
                    task = heapq.heappop(self.ready)
                    running[pool.submit(task.function, *task.arguments)] = task
                bar.total = self.added
                bar.refresh()
                finished, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in finished:
                    task = running.pop(future)
                    future.result()
                    name = task.function.__name__
                    self.done[name] = self.done.get(name, 0) + 1
                    bar.update()
                    for then in self.known.pop(task.out):
                        then()
