"""The images of a sequence: where they are, and single ones of them.

OpenCV is imported where it is used: the Python that has it is running only then.
"""
import contextlib
import os
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
VIDEOS = (".mp4", ".avi", ".mkv", ".mov", ".webm")
PICTURES = (".bmp", ".jpeg", ".jpg", ".pgm", ".png", ".ppm", ".tiff", ".tif", ".webp")
# The frames of this sequence of MOT15 are those of OpenCV's sample video.
SAMPLE_SEQUENCE = "PETS09-S2L1"
SAMPLE_FRAMES = 795


class NoVideo(Exception):
    """The sample video is not to be had."""


def sample_video():
    done = subprocess.run(["tools/sample-video.sh", "out"], cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        raise NoVideo(f"vtest.avi, the images of {SAMPLE_SEQUENCE}: {done.stderr.strip()[-300:]}")
    return os.path.join(ROOT, done.stdout.strip())


def pictures(directory):
    """The image files of a directory in the order of their names, as gt2_mot takes them."""
    return sorted(name for name in os.listdir(directory) if name.lower().endswith(PICTURES))


def find(folder, directory, sequence):
    """The directory or video with the images of a sequence's folder; None if there is none."""
    for name in (directory, "img1"):
        path = os.path.join(folder, name)
        if os.path.isdir(path) and pictures(path):
            return path
    videos = sorted(name for name in os.listdir(folder) if name.lower().endswith(VIDEOS))
    if videos:
        return os.path.join(folder, videos[0])
    if sequence.name == SAMPLE_SEQUENCE and sequence.frames == SAMPLE_FRAMES:
        with contextlib.suppress(NoVideo):
            return sample_video()
    return None


def enough(sequence):
    """Whether there is an image for each frame; a video is believed."""
    return not os.path.isdir(sequence.images) or len(pictures(sequence.images)) >= sequence.frames


def size_of(images):
    """WIDTHxHEIGHT, None if it cannot be read."""
    image = next(iter(read(images, [1]).values()), None)
    return None if image is None else f"{image.shape[1]}x{image.shape[0]}"


def read(images, numbers):
    """The images of the frames of these numbers, counted from 1; what cannot be read is left out."""
    import cv2
    found = {}
    if os.path.isdir(images):
        names = pictures(images)
        for number in numbers:
            image = cv2.imread(os.path.join(images, names[number - 1])) if number <= len(names) else None
            if image is not None:
                found[number] = image
        return found
    # To seek is not exact with all codecs, so all frames up to the last one wanted are gone through.
    wanted, video = set(numbers), cv2.VideoCapture(images)
    for number in range(1, max(wanted, default=0) + 1):
        if not video.grab():
            break
        if number in wanted:
            good, image = video.retrieve()
            if good:
                found[number] = image
    video.release()
    return found
