"""The page of a report: one file that needs no other."""
import dataclasses
import datetime
import importlib.metadata
import os
import platform
import sys

import jinja2
import tqdm

import evaluation as evaluation_module
import judge
import plots
import strips
import tables

HERE = os.path.dirname(os.path.abspath(__file__))
SCORES = ("ATA", "IDF1", "HOTA", "MOTA", "IDSW")
TIME = "µs/frame"
MEANINGS = {
    "ATA": "average tracking accuracy: how well whole trajectories coincide with those of people",
    "IDF1": "how much of the boxes has the right identity, over the whole sequence",
    "HOTA": "detection and association in equal parts, over localisation thresholds from 0.05 to 0.95",
    "MOTA": "boxes found, less false ones and switches; says more about the detector than the tracker",
    "IDSW": "identity switches: a person goes on under another number",
    TIME: "median time of one step of the tracker alone, the mean of all sequences",
}
CAUSES = {
    "swap": "the new track followed somebody else before",
    "live track": "the new track was there already, but followed nobody",
    "new id": "the new track began after the person was lost",
}


@dataclasses.dataclass
class Report:
    evaluation: evaluation_module.Evaluation
    table: tables.Table
    # What was found in the folder and decided about it, in sentences.
    facts: list
    title: str
    # Worst switches shown per tracker.
    strips: int

    def __post_init__(self):
        self.setup, = self.evaluation.setups
        self.entries = self.evaluation.entries
        self.names = [entry.name for entry in self.entries]
        self.marks = plots.marks(len(self.entries))

    def seed(self, entry):
        return self.evaluation.seeds(entry)[0]

    def result(self, entry, sequence):
        return self.evaluation.result(self.setup, entry, self.seed(entry), sequence)

    def scores(self, score, sequence=evaluation_module.ALL):
        return [self.table.values(self.setup, entry, sequence, score)[0] for entry in self.entries]

    def times(self):
        return [self.evaluation.time(self.setup, entry, self.seed(entry)) for entry in self.entries]


def grid(report, sequence=evaluation_module.ALL):
    """A table: columns, and rows of a name and cells, each a text and whether it is the best."""
    cells = tables.rows_of(report.table, report.setup, sequence, SCORES)
    columns = list(SCORES)
    if sequence == evaluation_module.ALL:
        columns.append(TIME)
        times = report.times()
        best = tables.best_of(times, False)
        cells = [(name, row + [(f"{time:.1f}" if time < 100 else f"{time:.0f}", is_best)])
                 for (name, row), time, is_best in zip(cells, times, best)]
    return {"columns": columns, "rows": cells}


def summary(report):
    """One sentence about who is first."""
    values = dict(zip(report.names, report.scores("HOTA")))
    if len(values) < 2:
        return ""
    (first, best), (second, next_best) = sorted(values.items(), key=lambda each: -each[1])[:2]
    if round(best, 2) == round(next_best, 2):
        return f"{first} and {second} have the highest HOTA, {best:.1f}."
    return f"{first} has the highest HOTA, {best:.1f}; {second} is next with {next_best:.1f}."


def numbers_of(report):
    truths = [report.evaluation.truths[report.setup.name, sequence.name] for sequence in report.setup.sequences]
    people = sum(len(report.result(report.entries[0], sequence.name)["identities"]["people"])
                 for sequence in report.setup.sequences)
    return {"sequences": len(truths), "frames": sum(truth.frames for truth in truths), "people": people,
            "trackers": len(report.entries)}


def charts(report):
    return {
        "bars": plots.bars(
            report.names, {score: report.scores(score) for score in ("ATA", "IDF1", "HOTA")}, report.marks
        ),
        "alpha": plots.hota_over_alpha(report.names, judge.thresholds(), report.scores("HOTA_alpha"), report.marks),
        "time": plots.accuracy_over_time(report.names, report.times(), report.scores("HOTA"), report.marks),
    }


def timelines(report, sequence, number, bar):
    truth = report.evaluation.truths[report.setup.name, sequence.name]
    drawn = []
    for at, entry in enumerate(report.entries):
        people = report.result(entry, sequence.name)["identities"]["people"]
        title = f"{sequence.name}, {entry.name}"
        drawn.append({"name": entry.name, "rows": len(plots.timeline_rows(people)), "people": len(people),
                      "svg": plots.timeline(f"t{number}-{at}", title, people, truth.skipped + 1,
                                            truth.skipped + truth.frames)})
        bar.update()
    return drawn


def about(switch):
    """A switch in words."""
    event = switch.event
    where = event.went_to if isinstance(event.went_to, str) else f"follows person {event.went_to} now"
    where = {"alone": "follows nobody now", "ended": "has ended"}.get(where, where)
    seconds = f" ({event.frame / switch.sequence.fps:.1f} s)" if switch.sequence.fps else ""
    gap = (
        "from one frame to the next"
        if event.gap == 1
        else f"after {event.gap - 1} frame{'s' * (event.gap > 2)} without"
    )
    other = f" It followed person {event.came_from} before." if event.came_from is not None else ""
    return {
        "title": f"{switch.sequence.name}, person {event.person}, frame {event.frame}{seconds}",
        "text": f"Track {event.before}, which had this person for {switch.held} frames, {where}. "
        f"Track {event.now} took over {gap}, for {switch.kept} frames.{other}",
        "cause": event.cause,
        "before": event.before,
        "now": event.now,
        "frame": event.frame,
        "pictures": [
            {
                "frame": number,
                "data": data,
                "is_switch": number == event.frame,
                "alt": f"frame {number}: person {event.person}"
                + (f" is now track {event.now}" if number >= event.frame else f" is or was track {event.before}"),
            }
            for number, data in switch.pictures
        ],
    }


def switches(report):
    """The worst switches per tracker, with pictures."""
    chosen = []
    for entry in report.entries:
        results = [(sequence, report.result(entry, sequence.name)) for sequence in report.setup.sequences]
        chosen.append((entry, strips.worst(results, report.strips)))

    def place(entry_name, sequence):
        entry = next(entry for entry in report.entries if entry.name == entry_name)
        return entry, (report.setup.name, entry_name, report.seed(entry), sequence)

    strips.draw([(entry.name, switch) for entry, found in chosen for switch in found],
                lambda sequence: report.evaluation.truths[report.setup.name, sequence].skipped + 1,
                lambda name, sequence: report.evaluation.tracks[place(name, sequence)[1]],
                lambda name, sequence: report.result(place(name, sequence)[0], sequence)["identities"]["people"])
    return [{"name": entry.name, "count": int(count), "switches": [about(switch) for switch in found]}
            for (entry, found), count in zip(chosen, report.scores("IDSW"))]


def processor():
    try:
        with open("/proc/cpuinfo") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.machine()


def circumstances(report):
    """What the numbers were measured with, in sentences."""
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("trackeval", "numpy", "scipy"))
    settings = "; ".join(f"{entry.name}: {', '.join(entry.all_settings())}" for entry in report.entries
                         if entry.all_settings())
    together = min(report.evaluation.scheduler.jobs, len(report.entries) * len(report.setup.sequences))
    return [
        f"judge: {versions}",
        "parameters: defaults" + (f", but for {settings}" if settings else ""),
        f"times: measured on this machine ({processor()}), with up to {together} trackers running at a time; they "
        "depend on what else it did and are no more than a comparison",
        f"library and program: {evaluation_module.program_identity(report.evaluation.program)[:12]}",
    ]


def render(report):
    """The page as text."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    with tqdm.tqdm(
        desc="page",
        total=len(report.entries) * len(report.setup.sequences) + 1,
        file=sys.stderr,
        disable=None,
        leave=False,
    ) as bar:
        sequences = [{"name": sequence.name, "grid": grid(report, sequence.name),
                      "timelines": timelines(report, sequence, number, bar)}
                     for number, sequence in enumerate(report.setup.sequences)]
        found = switches(report)
        bar.update()
    return environment.get_template("page.html.j2").render(
        title=report.title, date=datetime.date.today().isoformat(), numbers=numbers_of(report), summary=summary(report),
        grid=grid(report), meanings=MEANINGS, charts=charts(report), sequences=sequences, switches=found, causes=CAUSES,
        with_images=any(sequence.images for sequence in report.setup.sequences), facts=report.facts,
        circumstances=circumstances(report))
