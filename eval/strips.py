"""The worst identity switches, and strips of frames that show them."""
import base64
import collections
import dataclasses

import frames
import identities
import plots
import rows

SHOWN = (150, 190)
# Height of what is shown, in heights of the person.
AROUND = 1.9
QUALITY = 80


@dataclasses.dataclass
class Switch:
    sequence: object
    event: identities.Event
    # Frames that the old track had had the person, and the new one would have it.
    held: int
    kept: int
    # Per frame shown: its number and the image as a data URL.
    pictures: list = dataclasses.field(default_factory=list)

    @property
    def severity(self):
        """To lose a long identity to one that lasts is worst, and worse when two people take part."""
        return min(self.held, self.kept) * (2 if self.event.cause == "swap" else 1)


def frames_with(person, track, begin, end):
    return sum(
        max(0, min(last, end) - max(first, begin) + 1) for first, last, each in person["tracks"] if each == track
    )


def worst(results, count):
    """The worst switches of judged sequences, given as pairs of sequence and result."""
    found = []
    for sequence, result in results:
        for event in identities.events(result):
            if event.is_switch:
                person = result["identities"]["people"][str(event.person)]
                found.append(Switch(sequence, event, frames_with(person, event.before, 0, event.frame - 1),
                                    frames_with(person, event.now, event.frame, 10 ** 9)))
    found.sort(key=lambda switch: (-switch.severity, switch.sequence.name, switch.event.frame))
    chosen = []
    for switch in found:
        if len(chosen) < count and not any(same_scene(switch, other) for other in chosen):
            chosen.append(switch)
    return chosen


def same_scene(one, other):
    """A swap is a switch of two people."""
    tracks = {one.event.before, one.event.now} & {other.event.before, other.event.now}
    return (one.sequence.name == other.sequence.name and bool(tracks) and
            abs(one.event.frame - other.event.frame) <= 30)


def moments(switch, first):
    """The frames shown: before, the last one with the old track, between, the first with the new one, after."""
    event, sequence = switch.event, switch.sequence
    pause = max(3, round((sequence.fps or 30) / 2))
    lost = event.frame - event.gap
    numbers = [lost - pause, lost, (lost + event.frame) // 2, event.frame, event.frame + pause, event.frame + 2 * pause]
    return sorted({min(max(number, first), sequence.frames) for number in numbers})[:5]


class Boxes:
    """Boxes of a file by frame: identity and box."""

    def __init__(self, path):
        self.frames = collections.defaultdict(dict)
        for row in rows.read_rows(path):
            self.frames[rows.frame_of(row)][int(float(row[1]))] = rows.box_of(row)

    def near(self, identity, frame):
        """The identity's box in the frame, or in the nearest one that has it."""
        numbers = [number for number, boxes in self.frames.items() if identity in boxes]
        return self.frames[min(numbers, key=lambda number: abs(number - frame))][identity]


def window(box, height):
    """Left, top and scale of the part of an image around a box."""
    scale = SHOWN[1] / height
    centre = box[0] + box[2] / 2, box[1] + box[3] / 2
    return centre[0] - SHOWN[0] / scale / 2, centre[1] - SHOWN[1] / scale / 2, scale


def label(picture, text, corner, colour):
    import cv2
    (width, height), _ = cv2.getTextSize(text, cv2.FONT_HERSHEY_SIMPLEX, 0.42, 1)
    x, y = max(0, min(corner[0], SHOWN[0] - width - 5)), max(height + 5, min(corner[1], SHOWN[1]))
    cv2.rectangle(picture, (x, y - height - 5), (x + width + 4, y), colour, -1)
    cv2.putText(picture, text, (x + 2, y - 3), cv2.FONT_HERSHEY_SIMPLEX, 0.42, (255, 255, 255), 1, cv2.LINE_AA)


def picture(image, at, tracks, person, colours, involved):
    """The part of the image with the boxes of tracks, and of the person; without an image, on plain ground."""
    import cv2
    import numpy
    left, top, scale = at
    shown = numpy.full((SHOWN[1], SHOWN[0], 3), 60, dtype=numpy.uint8)
    if image is not None:
        matrix = numpy.array([[scale, 0, -left * scale], [0, scale, -top * scale]])
        # What is made smaller is averaged first, or it would flicker.
        shrink = max(1, int(1 / scale))
        small = cv2.resize(image, None, fx=1 / shrink, fy=1 / shrink, interpolation=cv2.INTER_AREA)
        matrix[:, :2] *= shrink
        shown = cv2.warpAffine(small, matrix, SHOWN, borderValue=(60, 60, 60))

    def corners(box):
        x, y = (box[0] - left) * scale, (box[1] - top) * scale
        return (round(x), round(y)), (round(x + box[2] * scale), round(y + box[3] * scale))

    if person:
        (x0, y0), (x1, y1) = corners(person)
        for start in range(0, 2 * (x1 - x0 + y1 - y0), 8):
            for step in range(4):
                point = along(start + step, x0, y0, x1, y1)
                cv2.circle(shown, point, 1, (255, 255, 255), -1)
    for identity, box in sorted(tracks.items(), key=lambda each: each[0] in involved):
        first, second = corners(box)
        if first[0] < SHOWN[0] and first[1] < SHOWN[1] and second[0] > 0 and second[1] > 0:
            colour = plots.rgb(colours.get(identity, "#777777"))[::-1]
            cv2.rectangle(shown, first, second, colour, 3 if identity in involved else 1, cv2.LINE_AA)
            # In a crowd the numbers of all would hide what matters.
            if identity in involved:
                label(shown, str(identity), (first[0], first[1]), colour)
    good, data = cv2.imencode(".jpg", shown, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
    return "data:image/jpeg;base64," + base64.b64encode(data).decode()


def along(distance, x0, y0, x1, y1):
    """A point of the edge of a box."""
    for begin, end in (((x0, y0), (x1, y0)), ((x1, y0), (x1, y1)), ((x1, y1), (x0, y1)), ((x0, y1), (x0, y0))):
        length = abs(end[0] - begin[0]) + abs(end[1] - begin[1])
        if distance < length:
            share = distance / length
            return round(begin[0] + share * (end[0] - begin[0])), round(begin[1] + share * (end[1] - begin[1]))
        distance -= length
    return x0, y0


def draw(switches, first_frame, tracks_of, people_of):
    """Makes the pictures of all switches, each given with its entry's name; every sequence is read once."""
    by_sequence = collections.defaultdict(list)
    for entry, switch in switches:
        by_sequence[switch.sequence.name].append((entry, switch))
    for name, here in by_sequence.items():
        sequence, first = here[0][1].sequence, first_frame(name)
        numbers = {number for _, switch in here for number in moments(switch, first)}
        images = frames.read(sequence.images, numbers) if sequence.images else {}
        truth, boxes, colours = Boxes(sequence.gt), {}, {}
        for entry, switch in here:
            if entry not in boxes:
                boxes[entry] = Boxes(tracks_of(entry, name))
                colours[entry] = plots.identity_colours(people_of(entry, name))
            event = switch.event
            near = {number: truth.near(event.person, number) for number in moments(switch, first)}
            height = AROUND * max(box[3] for box in near.values())
            for number, box in near.items():
                data = picture(images.get(number), window(box, height), boxes[entry].frames[number],
                               truth.frames[number].get(event.person), colours[entry], (event.before, event.now))
                switch.pictures.append((number, data))
