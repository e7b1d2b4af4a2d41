"""The page's pictures: SVG by matplotlib, each drawn for two widths, with colours that follow the page's theme."""
import dataclasses
import io
import re

import matplotlib
import numpy

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

# Pixels of the page that a picture is drawn for, and the class of its SVG.
WIDTHS = {"wide": 860, "narrow": 340}
# Colours that stand for one of the page's theme.
TEXT, MUTED, GRID, SURFACE = THEME = ("#010101", "#020202", "#030303", "#040404")
THEME_NAMES = ("text", "muted", "grid", "surface")

# Legible on white and on near-black, and apart for the colour-blind together with dashes and markers.
TRACKER_COLOURS = ["#e8590c", "#868e96", "#7950f2", "#1c7ed6", "#0ca678", "#d6336c", "#5c940d", "#a9743a"]
DASHES = ["-", "--", "-.", ":"]
MARKERS = "osD^vPX*"
IDENTITY_COLOURS = ["#4c78a8", "#f58518", "#54a24b", "#e45756", "#72b7b2", "#b279a2", "#eeca3b", "#9d755d", "#2f9e44",
                    "#7048e8", "#e64980", "#1098ad", "#f76707", "#74b816", "#ae3ec9", "#3b5bdb"]
UNTRACKED = (128, 128, 128, 90)

plt.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "gentrack2", "font.size": 12, "font.family": "sans-serif",
    "text.color": TEXT, "axes.labelcolor": MUTED, "xtick.color": MUTED, "ytick.color": TEXT, "axes.edgecolor": GRID,
    "grid.color": GRID, "axes.grid": False, "axes.spines.top": False, "axes.spines.right": False,
    "figure.facecolor": "none", "axes.facecolor": "none", "savefig.facecolor": "none", "legend.frameon": False,
})


@dataclasses.dataclass
class Mark:
    """How an entry is drawn everywhere."""
    colour: str
    dash: str
    marker: str
    # The first entry stands out.
    width: float


def marks(count):
    return [Mark(TRACKER_COLOURS[i % 8], DASHES[(i + i // 8) % 4] if i else "-", MARKERS[i % 8], 1.6 if i else 3.0)
            for i in range(count)]


def svg_of(figure, name, alt, width_class):
    """The figure as an element of a page; `name` makes the identities of its parts its own."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(figure)
    text = buffer.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r' id="([^"]*)"', rf' id="{name}-\1"', text)
    text = re.sub(r"url\(#([^)]*)\)", rf"url(#{name}-\1)", text)
    text = re.sub(r'href="#([^"]*)"', rf'href="#{name}-\1"', text)
    for colour, theme_name in zip(THEME, THEME_NAMES):
        text = text.replace(colour, f"var(--{theme_name})")
    text = re.sub(r"(\d\.\d\d)\d+", r"\1", text)
    box = re.search(r'viewBox="[^"]*"', text)[0]
    label = alt.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
    head = (f'<svg xmlns:xlink="http://www.w3.org/1999/xlink" {box} class="plot {width_class}" role="img" '
            f'aria-label="{label}">')
    return head + text[text.index(">") + 1:]


def both_widths(name, alt, draw):
    """draw(width) for each of the widths; one of the results is shown."""
    return "".join(svg_of(draw(width), f"{name}-{kind}", alt, kind) for kind, width in WIDTHS.items())


def figure_of(width, height, **more):
    return plt.subplots(figsize=(width / 72, height / 72), layout="constrained", **more)


def is_narrow(width):
    return width < 500


def bars(names, scores, marks_of):
    """A panel per score, a bar per entry. `scores` are lists by name."""
    def draw(width):
        rows, columns = (len(scores), 1) if is_narrow(width) else (1, len(scores))
        height = 30 + 24 * len(names)
        figure, axes = figure_of(width, rows * (height + 14), nrows=rows, ncols=columns, sharey=not is_narrow(width),
                                 squeeze=False)
        for axis, (score, values) in zip(axes.flat, scores.items()):
            axis.barh(range(len(names)), [max(value, 0) for value in values], height=0.68,
                      color=[mark.colour for mark in marks_of])
            best = max(values)
            for row, value in enumerate(values):
                axis.text(max(value, 0) + 1.5, row, f"{value:.1f}", va="center", fontsize=11.5,
                          fontweight="bold" if value == best else "normal")
            axis.set_title(score, fontsize=14, fontweight="bold", loc="left")
            axis.set_yticks(range(len(names)), names)
            axis.set_ylim(len(names) - 0.4, -0.6)
            axis.set_xlim(0, 114)
            axis.set_xticks([])
            axis.tick_params(length=0)
            for side in ("bottom", "left"):
                axis.spines[side].set_visible(False)
        return figure

    best = {score: names[int(numpy.argmax(values))] for score, values in scores.items()}
    alt = "Bar chart of " + ", ".join(scores) + " for each tracker. Highest: " + \
        ", ".join(f"{score} {best[score]} {max(values):.1f}" for score, values in scores.items()) + "."
    return both_widths("bars", alt, draw)


def hota_over_alpha(names, thresholds, curves, marks_of):
    def draw(width):
        figure, axis = figure_of(width, 400 if is_narrow(width) else 380)
        for name, curve, mark in reversed(list(zip(names, curves, marks_of))):
            axis.plot(thresholds, curve, mark.dash, color=mark.colour, linewidth=mark.width, label=name)
        axis.set_xlabel("localisation threshold α: the IoU from which a box counts as right")
        if is_narrow(width):
            axis.set_xlabel("localisation threshold α (IoU)")
        axis.set_ylabel("HOTA")
        axis.set_xlim(min(thresholds), max(thresholds))
        axis.set_ylim(0)
        axis.grid(axis="y", linewidth=1)
        axis.tick_params(length=0)
        handles, labels = axis.get_legend_handles_labels()
        figure.legend(handles[::-1], labels[::-1], handlelength=2.6,
                      **({"loc": "outside lower center", "ncols": 2} if is_narrow(width) else
                         {"loc": "outside right center", "labelspacing": 0.9}))
        return figure

    middle = len(thresholds) // 2
    alt = (f"HOTA of each tracker over the localisation threshold. At {thresholds[middle]:.2f}: " +
           ", ".join(f"{name} {curve[middle]:.1f}" for name, curve in zip(names, curves)) + ".")
    return both_widths("alpha", alt, draw)


def spread(places, least):
    """The places in their order, moved apart to the least distance, around where they were."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    groups = []
    for i in order:
        groups.append([[i], places[i]])
        # Groups that touch become one, centred on the mean of its members.
        while len(groups) > 1:
            (upper, middle), (lower, middle_before) = groups[-1], groups[-2]
            if middle - middle_before >= least * (len(upper) + len(lower)) / 2:
                break
            members = lower + upper
            groups[-2:] = [[members, sum(places[i] for i in members) / len(members)]]
    moved = [0.0] * len(places)
    for members, middle in groups:
        for at, i in enumerate(members):
            moved[i] = middle + least * (at - (len(members) - 1) / 2)
    return moved


def accuracy_over_time(names, microseconds, values, marks_of):
    def draw(width):
        height = 360
        figure, axis = figure_of(width, height)
        low, high = min(values), max(values)
        margin = max(1.0, 0.15 * (high - low))
        axis.set_ylim(low - margin, high + margin)
        axis.set_xscale("log")
        # Room for the names on the right.
        room = (max(microseconds) / min(microseconds)) ** (0.6 if is_narrow(width) else 0.2)
        axis.set_xlim(min(microseconds) / 1.5, max(microseconds) * max(room, 6 if is_narrow(width) else 1.8))
        axis.set_xlabel("microseconds per frame, on this machine (logarithmic)")
        if is_narrow(width):
            axis.set_xlabel("µs per frame, this machine (log.)")
        axis.set_ylabel("HOTA")
        axis.grid(linewidth=1)
        axis.tick_params(length=0, which="both")
        axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        axis.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        line = 15 * (high - low + 2 * margin) / (height - 90)
        # A column of names right of all points: names beside their points would cover other points.
        at = max(microseconds) * (1.35 if is_narrow(width) else 1.12)
        for name, time, value, label, mark in zip(names, microseconds, values, spread(values, line), marks_of):
            axis.plot([time, at], [value, label], color=mark.colour, linewidth=0.7, alpha=0.5)
            axis.plot([time], [value], mark.marker, color=mark.colour, markersize=8 if mark.width < 2 else 11)
            axis.text(at * 1.04, label, name, va="center", fontsize=11.5,
                      fontweight="bold" if mark.width > 2 else "normal")
        return figure

    alt = (
        "HOTA against time per frame: "
        + ", ".join(
            f"{name} {value:.1f} at {time:.0f} microseconds" for name, time, value in zip(names, microseconds, values)
        )
        + "."
    )
    return both_widths("time", alt, draw)


def identity_colours(people):
    """A colour for each track such that one person's tracks in succession differ."""
    before, colours = {}, {}
    for person in people.values():
        ids = [track for _, _, track in person["tracks"]]
        for one, other in zip(ids, ids[1:]):
            if one != other:
                before.setdefault(one, set()).add(other)
                before.setdefault(other, set()).add(one)
    order = sorted((run[0], run[2]) for person in people.values() for run in person["tracks"])
    for number, track in enumerate(dict.fromkeys(track for _, track in order)):
        taken = {colours.get(other) for other in before.get(track, ())}
        turned = [IDENTITY_COLOURS[(number + i) % len(IDENTITY_COLOURS)] for i in range(len(IDENTITY_COLOURS))]
        colours[track] = next((colour for colour in turned if colour not in taken), turned[0])
    return colours


def rgb(colour):
    return tuple(int(colour[i:i + 2], 16) for i in (1, 3, 5))


def switches_of(person):
    ids = [track for _, _, track in person["tracks"]]
    return sum(one != other for one, other in zip(ids, ids[1:]))


MOST_ROWS = 60


def row_height(rows):
    """Few people get more room."""
    return 20 if rows <= 10 else 14 if rows <= 25 else 9


def timeline_rows(people):
    """The people that get a row: those with most switches, then those longest there; in the order of appearance."""
    chosen = sorted(people, key=lambda name: (-switches_of(people[name]),
                                              -sum(end - begin for begin, end in people[name]["present"])))[:MOST_ROWS]
    return sorted(chosen, key=lambda name: (people[name]["present"][0][0], int(name)))


def timeline_image(people, chosen, colours, first, last, columns):
    """A row per person; where nobody is, it is transparent."""
    length, height = last - first + 1, row_height(len(chosen))
    image = numpy.zeros((height * len(chosen), columns, 4), dtype=numpy.uint8)

    def column(frame):
        return (frame - first) * columns // length

    for row, name in enumerate(chosen):
        top, bottom = height * row + 1, height * row + height - 1
        for begin, end in people[name]["present"]:
            image[top:bottom, column(begin):max(column(end + 1), column(begin) + 1)] = UNTRACKED
        before = None
        for begin, end, track in people[name]["tracks"]:
            at = column(begin)
            image[top:bottom, at:max(column(end + 1), at + 1)] = (*rgb(colours[track]), 255)
            if before not in (None, track):
                # A notch, too: colours alone do not tell everybody.
                image[top - 1:bottom + 1, max(at - 1, 0):at + 1] = 0
            before = track
    return image


def timeline(name, title, people, first, last):
    """A row per person, a colour per track: where the colour changes, the identity switched."""
    chosen, colours = timeline_rows(people), identity_colours(people)

    def draw(width):
        rows = row_height(len(chosen)) * len(chosen)
        height = rows + 44
        figure = plt.figure(figsize=(width / 72, height / 72))
        left, right = 34, 20
        axis = figure.add_axes((left / width, 40 / height, 1 - (left + right) / width, rows / height))
        columns = min(last - first + 1, 2 * (width - left - right))
        axis.imshow(timeline_image(people, chosen, colours, first, last, columns), aspect="auto", interpolation="none",
                    extent=(first - 0.5, last + 0.5, len(chosen), 0))
        for row, person in enumerate(chosen):
            axis.text(-4 / (width - left - right), 1 - (row + 0.5) / len(chosen), person, transform=axis.transAxes,
                      ha="right", va="center", fontsize=min(11, row_height(len(chosen)) - 1.5), color=MUTED)
        axis.set_yticks([])
        axis.spines["left"].set_visible(False)
        axis.tick_params(axis="x", length=3, labelsize=11)
        axis.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(4 if is_narrow(width) else 8, integer=True))
        axis.set_xlabel("frame", fontsize=11, labelpad=1)
        return figure

    total = sum(switches_of(person) for person in people.values())
    alt = (f"Identity timeline of {title}: one row for each of {len(chosen)} people from frame {first} to {last}, one "
           f"colour per track; {total} changes of colour in all.")
    return both_widths(name, alt, draw)
