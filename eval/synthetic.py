"""Small data sets for tests, in MOTChallenge's layout, made of the project's own synthetic sequences.

usage: synthetic.py FOLDER
"""
import os
import sys

import environment
import rows

SOURCE = os.path.join(environment.ROOT, "tests", "fixtures", "oracles", "synthetic")
SIZES = {"syn_a1": (1280, 720), "syn_b1": (1920, 1080), "syn_b2": (1920, 1080)}
RATE = 30


def up_to(path, frames):
    return [row for row in rows.read_rows(path) if rows.frame_of(row) <= frames]


def sequence(folder, name, frames, images=False):
    """A sequence's folder, with the first frames of a synthetic sequence, perhaps with images of it."""
    for part in ("gt", "det"):
        os.makedirs(f"{folder}/{part}")
        rows.write_rows(f"{folder}/{part}/{part}.txt", up_to(f"{SOURCE}/{name}.{part}.txt", frames))
    width, height = SIZES[name]
    with open(f"{folder}/seqinfo.ini", "w") as file:
        file.write(f"[Sequence]\nname={name}\nimDir=img1\nframeRate={RATE}\nseqLength={frames}\nimWidth={width}\n"
                   f"imHeight={height}\nimExt=.jpg\n")
    if images:
        draw(folder, frames, width, height)


def draw(folder, frames, width, height):
    """A gradient with a rectangle of its own colour for each person."""
    import cv2
    import numpy
    os.makedirs(f"{folder}/img1")
    ground = numpy.linspace(40, 120, width, dtype=numpy.uint8)[None, :, None].repeat(height, 0).repeat(3, 2)
    truth = rows.by_frame(rows.read_rows(f"{folder}/gt/gt.txt"))
    for frame in range(1, frames + 1):
        image = ground.copy()
        for row in truth.get(frame, []):
            left, top, w, h = (int(value) for value in rows.box_of(row))
            colour = [int(row[1]) * factor % 200 + 55 for factor in (37, 71, 113)]
            cv2.rectangle(image, (left, top), (left + w, top + h), colour, -1)
            cv2.circle(image, (left + w // 2, top + h // 6), w // 4, [255 - value for value in colour], -1)
        cv2.imwrite(f"{folder}/img1/{frame:06}.jpg", image)


def data_set(root, frames=100):
    """Three sequences, one of them with images."""
    for name in SIZES:
        sequence(f"{root}/train/{name}", name, frames, images=name == "syn_a1")
    return root


if __name__ == "__main__":
    environment.enter()
    data_set(sys.argv[1])
