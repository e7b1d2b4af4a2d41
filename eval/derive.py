"""Inputs made from others: a sequence with a worse detector, a sequence at a lower frame rate.

Both are functions of their inputs and a seed, the same on every machine: random numbers come from Python's Mersenne
twister, seeded with strings, a stream of its own for each purpose and person.
"""
import random

from rows import box_of, by_frame, frame_of

# The classes of MOT17 that are people in full view: pedestrians, and those who stand still.
PEOPLE = (1, 7)


def iou(a, b):
    """Intersection over union of two boxes."""
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    if width <= 0 or height <= 0:
        return 0.0
    return width * height / (a[2] * a[3] + b[2] * b[3] - width * height)


# What the worse detector does, see degrade().
MISSED = 0.2
MEAN_BURST = 8
LEAST_VISIBILITY = 0.4
JITTER = 0.05
CLUTTER = 0.03
LEAST_IOU = 0.5


def bursts(generator, length):
    """A two-state Markov chain: whether the person is missed, per frame. MISSED of all frames are, MEAN_BURST in a
    row on average."""
    ends = 1 / MEAN_BURST
    begins = ends * MISSED / (1 - MISSED)
    missed = generator.random() < MISSED
    states = []
    for _ in range(length):
        states.append(missed)
        missed = generator.random() >= ends if missed else generator.random() < begins
    return states


def degrade(detections, ground_truth, width, height, frames, seed):
    """What a worse detector would have found, rows as given.

    Every detection belongs to the person of the ground truth that it overlaps most, if by LEAST_IOU, so that doubles
    of a box share its fate. A person is missed in bursts, and while less than LEAST_VISIBILITY of it is to be seen.
    What belongs to nobody stays. Position and size of all boxes get Gaussian noise, JITTER of width and height.
    Boxes at random places are added, CLUTTER of those that stayed, with sizes and scores of random detections of
    the file.
    """
    people = by_frame(row for row in ground_truth if len(row) < 8 or int(float(row[7])) in PEOPLE)
    identities = sorted({int(float(row[1])) for rows in people.values() for row in rows})
    missed = {identity: bursts(random.Random(f"{seed}/missed/{identity}"), frames + 1) for identity in identities}
    found = by_frame(detections)
    jitter = random.Random(f"{seed}/jitter")
    kept = []
    for frame in sorted(found):
        persons = [(box_of(row), row) for row in people.get(frame, [])]
        for row in found[frame]:
            box = box_of(row)
            # Drawn for all, so that what happens to one box does not change the noise of the others.
            noise = [jitter.gauss(0, JITTER) for _ in range(4)]
            overlap, person = max(((iou(box, other), person) for other, person in persons), key=lambda pair: pair[0],
                                  default=(0.0, None))
            if overlap >= LEAST_IOU:
                visibility = float(person[8]) if len(person) > 8 else 1.0
                if missed[int(float(person[1]))][frame] or visibility < LEAST_VISIBILITY:
                    continue
            left, top, w, h = box
            centre = left + w / 2 + noise[0] * w, top + h / 2 + noise[1] * h
            w, h = max(1.0, w * (1 + noise[2])), max(1.0, h * (1 + noise[3]))
            kept.append((frame, [centre[0] - w / 2, centre[1] - h / 2, w, h], row[6]))
    clutter = random.Random(f"{seed}/clutter")
    for _ in range(round(CLUTTER * len(kept))):
        frame = 1 + int(clutter.random() * frames)
        like = detections[int(clutter.random() * len(detections))]
        w, h = float(like[4]), float(like[5])
        place = [clutter.random() * max(0.0, width - w), clutter.random() * max(0.0, height - h), w, h]
        kept.append((frame, place, like[6]))
    kept.sort(key=lambda row: row[0])
    return [[str(frame), "-1", *(f"{value:.2f}" for value in box), score, "-1", "-1", "-1"]
            for frame, box, score in kept]


def subsample(rows, step):
    """Every step-th frame from the first on, renumbered from 1."""
    kept = []
    for row in rows:
        frame = frame_of(row)
        if (frame - 1) % step == 0:
            kept.append([str((frame - 1) // step + 1), *row[1:]])
    return kept


def subsampled_length(frames, step):
    return (frames - 1) // step + 1


def after(second, first):
    """The 2x3 affine map, row by row, that does first one and then the other."""
    a, b, c, d, e, f = second
    p, q, r, s, t, u = first
    return [a * p + b * s, a * q + b * t, a * r + b * u + c, d * p + e * s, d * q + e * t, d * r + e * u + f]


def compose_motion(path, step):
    """Camera motion between every step-th frame: rows of strings. Lines of the file are frames, from the first on;
    each maps the frame before to its own."""
    with open(path) as file:
        maps = [[float(value) for value in line.replace(",", " ").split()[1:7]] for line in file if line.strip()]
    rows = []
    for kept in range(0, len(maps), step):
        total = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
        for skipped in range(max(1, kept - step + 1), kept + 1):
            total = after(maps[skipped], total)
        rows.append([str(kept // step), *(repr(value) for value in total)])
    return rows
