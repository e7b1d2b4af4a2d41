"""Runs gt2_mot's ONNX detector on a model whose output can be worked out by hand.

usage: onnx_detector_test.py PROGRAM VENV-DIRECTORY

The model is built like YOLOX's head: per stride a convolution over each cell, so that image, letterbox, channel
order, grid, strides and suppression all count. Exit status 77 (skipped) if Python's onnx package cannot be installed.
"""
import math
import os
import subprocess
import sys
import tempfile

import own_venv

WIDTH, HEIGHT = 96, 64  # of the model's input
LN2 = math.log(2)
# Per stride: centre offset and log size in cells. Chosen so that the box of a stride-16 cell and that of the
# stride-8 cell at (2 x, 2 y + 1) are the same: ((x + 1/8) 16, (y + 7/8) 16) = ((2 x + 1/4) 8, (2 y + 1 + 3/4) 8) and
# 16 / 2 = 8 wide, 16 / 4 = 8 / 2 high.
REGRESSION = {8: [0.25, 0.75, 0.0, -LN2], 16: [0.125, 0.875, -LN2, -2 * LN2], 32: [0.0, 0.0, 0.0, 0.0]}


def build_model(path, strides):
    """Objectness is 0.1 where the mean blue is 0 and 0.9 where it is 255; the first class 0.2 and 0.8 by green; the
    second class is always sure and must not matter."""
    import numpy as np
    from onnx import TensorProto, checker, helper, numpy_helper, save

    nodes, weights, heads = [], [], []

    def weight(name, array):
        weights.append(numpy_helper.from_array(np.asarray(array), name))
        return name

    for s in strides:
        conv = dict(kernel_shape=[s, s], strides=[s, s])
        zero = weight(f"wr{s}", np.zeros((4, 3, s, s), np.float32))
        bias = weight(f"br{s}", np.array(REGRESSION[s], np.float32))
        nodes.append(helper.make_node("Conv", ["images", zero, bias], [f"reg{s}"], **conv))
        mean = np.zeros((3, 3, s, s), np.float32)
        # Logit from -l to l as the mean goes from 0 to 255; sigmoid(ln 9) = 0.9, sigmoid(ln 4) = 0.8.
        mean[0, 0] = math.log(9) / 127.5 / (s * s)
        mean[1, 1] = math.log(4) / 127.5 / (s * s)
        bias = weight(f"bs{s}", np.array([-math.log(9), -math.log(4), 5.0], np.float32))
        nodes.append(helper.make_node("Conv", ["images", weight(f"ws{s}", mean), bias], [f"logit{s}"], **conv))
        nodes.append(helper.make_node("Sigmoid", [f"logit{s}"], [f"prob{s}"]))
        nodes.append(helper.make_node("Concat", [f"reg{s}", f"prob{s}"], [f"all{s}"], axis=1))
        shape = weight(f"shape{s}", np.array([1, 7, -1], np.int64))
        nodes.append(helper.make_node("Reshape", [f"all{s}", shape], [f"flat{s}"]))
        heads.append(f"flat{s}")
    nodes.append(helper.make_node("Concat", heads, ["rows"], axis=2))
    nodes.append(helper.make_node("Transpose", ["rows"], ["output"], perm=[0, 2, 1]))
    cells = sum(WIDTH // s * (HEIGHT // s) for s in strides)
    graph = helper.make_graph(
        nodes, "head",
        [helper.make_tensor_value_info("images", TensorProto.FLOAT, [1, 3, HEIGHT, WIDTH])],
        [helper.make_tensor_value_info("output", TensorProto.FLOAT, [1, cells, 7])], weights)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 12)])
    model.ir_version = 7
    checker.check_model(model)
    save(model, path)


def write_image(path):
    """192x112, black, with a cyan and a yellow square of 16 pixels."""
    pixels = bytearray(192 * 112 * 3)
    for left, top, colour in ((32, 16, (0, 255, 255)), (96, 48, (255, 255, 0))):
        for y in range(top, top + 16):
            for x in range(left, left + 16):
                pixels[(y * 192 + x) * 3:(y * 192 + x) * 3 + 3] = bytes(colour)
    with open(path, "wb") as file:
        file.write(b"P6\n192 112\n255\n" + pixels)


# The image is halved (96/192 < 64/112) to 96x56, so that 8 rows, the last row of stride-8 cells, are padding.
# Box of stride-8 cell (x, y) in the image: centre ((x + 1/4) 16, (y + 3/4) 16), 16 wide, 8 high.
#   cyan:    cell (2, 1), blue 255, green 255: 0.9 x 0.8 = 0.72 at (36 - 8, 28 - 4). The stride-16 cell (1, 0) around
#            it sees a quarter of it, 0.25 x 1/3 = 0.083, with the same box: suppressed.
#   yellow:  cell (6, 3), blue 0, green 255: 0.1 x 0.8 = 0.08 at (100 - 8, 60 - 4). Swapped channels would make it 0.72.
#   padding: cells (0..11, 7), all 114: (114 - 127.5) / 127.5 = -0.10588, 9^-0.10588 = 0.79243, 4^-0.10588 = 0.86347:
#            0.79243 / 1.79243 x 0.86347 / 1.86347 = 0.44210 x 0.46337 = 0.20485 at (16 x + 4 - 8, 124 - 4). The
#            stride-16 cells (0..5, 3) below them, 0.073, have the same boxes as every second one: suppressed.
#   black:   0.1 x 0.2 = 0.02: below what is worth telling.
EXPECTED = [(28, 24, 16, 8, 0.72)] + [(16 * x - 4, 120, 16, 8, 0.2049) for x in range(12)] + [(92, 56, 16, 8, 0.08)]


def run(program, directory, model, *more):
    return subprocess.run(
        [program, "--tracker", "gentrack2", "--detector", f"onnx:{directory}/{model}", "--images", directory,
         "--out", f"{directory}/tracks.txt", *more], capture_output=True, text=True)


def main():
    program, directory = sys.argv[1:3]
    own_venv.enter(directory, "onnx")
    with tempfile.TemporaryDirectory() as work:
        write_image(f"{work}/1.ppm")
        build_model(f"{work}/good.onnx", (8, 16, 32))
        build_model(f"{work}/short.onnx", (8, 16))
        with open(f"{work}/text.onnx", "w") as file:
            file.write("not a model\n")

        done = run(program, work, "good.onnx", "--save-det", f"{work}/det.txt")
        assert done.returncode == 0, done.stderr
        with open(f"{work}/det.txt") as file:
            found = [tuple(map(float, line.split(","))) for line in file]
        assert len(found) == len(EXPECTED), found
        for row, (left, top, width, height, score) in zip(found, EXPECTED):
            assert row[:2] == (1, -1), row
            assert all(abs(a - b) <= 0.02 for a, b in zip(row[2:6], (left, top, width, height))), (row, left, top)
            assert abs(row[6] - score) <= 0.00015, (row, score)

        done = run(program, work, "short.onnx")
        assert done.returncode != 0 and "short.onnx: its output is not 1x126x(5+classes)" in done.stderr, done.stderr
        done = run(program, work, "text.onnx")
        assert done.returncode != 0 and "text.onnx: OpenCV cannot read this" in done.stderr, done.stderr
        assert done.stderr.count("\n") == 1, done.stderr
    print("ok")


if __name__ == "__main__":
    main()
