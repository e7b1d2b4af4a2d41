"""Runs the short examples that read videos on a made-up one: two squares, one bright and one dark, that pass each other.

usage: short_examples_test.py PROGRAM-DIRECTORY VENV-DIRECTORY

Exit status 77 (skipped) if Python's onnx package cannot be installed.
"""
import os
import subprocess
import sys
import tempfile
import unittest

import own_venv

WIDTH, HEIGHT, FRAMES, SIDE = 160, 96, 30, 24


def squares(t):
    """Left, top and brightness in frame t, from 0."""
    return ((8 + 4 * t, 20, 255), (128 - 4 * t, 30, 20))


def luma(t):
    plane = bytearray([114]) * (WIDTH * HEIGHT)
    for left, top, value in squares(t):
        for y in range(top, top + SIDE):
            plane[y * WIDTH + left:y * WIDTH + left + SIDE] = bytes([value]) * SIDE
    return plane


def build_model(path):
    """The mean colour, and its opposite: crops of 16x32 to 6 numbers."""
    import numpy as np
    from onnx import TensorProto, checker, helper, numpy_helper, save

    weight = np.zeros((6, 3, 32, 16), np.float32)
    for c in range(3):
        weight[c, c], weight[c + 3, c] = 1 / 512, -1 / 512
    nodes = [helper.make_node("Conv", ["images", "w"], ["mean"], kernel_shape=[32, 16]),
             helper.make_node("Flatten", ["mean"], ["embedding"], axis=1)]
    graph = helper.make_graph(
        nodes, "looks", [helper.make_tensor_value_info("images", TensorProto.FLOAT, ["n", 3, 32, 16])],
        [helper.make_tensor_value_info("embedding", TensorProto.FLOAT, ["n", 6])],
        [numpy_helper.from_array(weight, "w")])
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 12)])
    model.ir_version = 7
    checker.check_model(model)
    save(model, path)


def build_detector(path, width, height):
    """YOLOX's three grids. In the finest, whose cells look at 24x24 pixels around them, an object is where those are
    all bright (the first class) or all dark (the second); the others find nothing."""
    import numpy as np
    from onnx import TensorProto, checker, helper, numpy_helper, save

    nodes, weights, heads = [], [], []

    def weight(name, array, kind=np.float32):
        weights.append(numpy_helper.from_array(np.asarray(array, kind), name))
        return name

    for s, size in ((8, 24), (16, 16), (32, 32)):
        boxes, sure = np.zeros((4, 3, size, size)), np.zeros((3, 3, size, size))
        # From 0 for the background, 114, to 1 for 255 and for 20, times 20: 0.7 and more of a square is an object.
        sure[1], sure[2] = 20 / 141 / (3 * size * size), -20 / 94 / (3 * size * size)
        bias = [10, -20 * 114 / 141 - 14, 20 * 114 / 94 - 14]
        if s != 8:
            sure[:], bias = 0, [-10, 0, 0]
        place = [0.5, 0.5, np.log(size / s), np.log(size / s)]
        for name, array, offset in (("box", boxes, place), ("logit", sure, bias)):
            nodes.append(helper.make_node(
                "Conv", ["images", weight(f"w{name}{s}", array), weight(f"b{name}{s}", offset)], [f"{name}{s}"],
                kernel_shape=[size, size], strides=[s, s], pads=[(size - s) // 2] * 4))
        nodes.append(helper.make_node("Sigmoid", [f"logit{s}"], [f"sure{s}"]))
        nodes.append(helper.make_node("Concat", [f"box{s}", f"sure{s}"], [f"all{s}"], axis=1))
        nodes.append(helper.make_node("Reshape", [f"all{s}", weight(f"shape{s}", [1, 7, -1], np.int64)], [f"rows{s}"]))
        heads.append(f"rows{s}")
    nodes.append(helper.make_node("Concat", heads, ["rows"], axis=2))
    nodes.append(helper.make_node("Transpose", ["rows"], ["output"], perm=[0, 2, 1]))
    cells = sum(width // s * (height // s) for s in (8, 16, 32))
    graph = helper.make_graph(
        nodes, "detector", [helper.make_tensor_value_info("images", TensorProto.FLOAT, [1, 3, height, width])],
        [helper.make_tensor_value_info("output", TensorProto.FLOAT, [1, cells, 7])], weights)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 12)])
    model.ir_version = 7
    checker.check_model(model)
    save(model, path)


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        with open(cls.path("det.txt"), "w") as file:
            for t in range(FRAMES):
                for left, top, _ in squares(t):
                    file.write(f"{t + 1},-1,{left},{top},{SIDE},{SIDE},0.9,-1,-1,-1\n")
        with open(cls.path("frames.yuv"), "wb") as file:
            for t in range(FRAMES):
                file.write(luma(t) + bytes([128]) * (WIDTH * HEIGHT // 2))
        # What OpenCV reads as a video: pictures with numbers.
        for t in range(FRAMES):
            with open(cls.path(f"{t:03}.pgm"), "wb") as file:
                file.write(f"P5\n{WIDTH} {HEIGHT}\n255\n".encode() + luma(t))
        build_model(cls.path("model.onnx"))

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def run_example(self, name, *arguments, stdin=None):
        done = subprocess.run([os.path.join(sys.argv[1], name), *arguments], stdin=stdin, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def assert_both_kept(self, rows):
        """Each square has one number from beginning to end."""
        ids = {}
        for row in rows.splitlines():
            frame, number, left = [float(x) for x in row.split(",")[:3]]
            for k, square in enumerate(squares(int(frame) - 1)):
                top = float(row.split(",")[3])
                if abs(left - square[0]) < 6 and abs(top - square[1]) < 4:
                    ids.setdefault(k, []).append(number)
        self.assertEqual({k: set(v) for k, v in ids.items()}, {0: {ids[0][0]}, 1: {ids[1][0]}})
        self.assertGreater(min(len(v) for v in ids.values()), FRAMES - 5)

    def test_raw_frames(self):
        with open(self.path("frames.yuv"), "rb") as frames:
            rows = self.run_example("raw_yuv", str(WIDTH), str(HEIGHT), "25", self.path("det.txt"), stdin=frames)
        self.assert_both_kept(rows)

    def test_particles(self):
        said = self.run_example("particles", self.path("%03d.pgm"), self.path("det.txt"), self.path("out.png"))
        self.assertGreater(int(said.split()[0]), 8 * FRAMES)
        self.assertGreater(os.path.getsize(self.path("out.png")), 500)

    def test_embeddings(self):
        rows = self.run_example("reid_embeddings", self.path("%03d.pgm"), self.path("det.txt"), self.path("model.onnx"),
                                "16x32")
        self.assert_both_kept(rows)

    def test_detector(self):
        # Twice as large as the model takes them, and of another shape; nothing crosses. Zeros at the borders of a
        # convolution are dark, so that the squares keep off them.
        for t in range(FRAMES):
            pixels = bytearray([114]) * (4 * WIDTH * HEIGHT)
            for left, top, value in ((16 + 8 * t, 32, 255), (256 - 8 * t, 112, 20)):
                for y in range(top, top + 2 * SIDE):
                    pixels[y * 2 * WIDTH + left:y * 2 * WIDTH + left + 2 * SIDE] = bytes([value]) * (2 * SIDE)
            with open(self.path(f"large{t:03}.pgm"), "wb") as file:
                file.write(f"P5\n{2 * WIDTH} {2 * HEIGHT}\n255\n".encode() + pixels)
        build_detector(self.path("detector.onnx"), 160, 128)
        rows = self.run_example("onnx_detector", self.path("large%03d.pgm"), self.path("detector.onnx"), "160x128")
        ids = {}
        for row in rows.splitlines():
            frame, number, left, top, width, height, score, kind = [float(x) for x in row.split(",")]
            expected = (16 + 8 * (frame - 1), 32) if kind == 0 else (256 - 8 * (frame - 1), 112)
            # The model knows a square's place to a cell, of 16 pixels.
            self.assertTrue(abs(left - expected[0]) <= 16 and abs(top - expected[1]) <= 4, row)
            self.assertTrue(abs(width - 48) < 6 and abs(height - 48) < 6 and score > 0.8, row)
            ids.setdefault(kind, []).append(number)
        self.assertEqual({kind: len(set(numbers)) for kind, numbers in ids.items()}, {0: 1, 1: 1})
        self.assertNotEqual(ids[0][0], ids[1][0])
        self.assertGreater(min(len(numbers) for numbers in ids.values()), FRAMES - 5)


if __name__ == "__main__":
    own_venv.enter(sys.argv[2], "onnx")
    unittest.main(argv=sys.argv[:1], verbosity=2)
