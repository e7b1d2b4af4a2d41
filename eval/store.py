"""What results are stored under: hashes of all they depend on."""
import functools
import hashlib
import os
import tempfile


@functools.lru_cache(maxsize=None)
def content(path):
    """The hash of a file's content; of a directory, of its files' names, sizes and times: images are many."""
    digest = hashlib.sha256()
    if os.path.isdir(path):
        for entry in sorted(os.scandir(path), key=lambda entry: entry.name):
            digest.update(repr((entry.name, entry.stat().st_size, entry.stat().st_mtime_ns)).encode())
        return digest.hexdigest()
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


def key(*parts):
    return hashlib.sha256("\0".join(str(part) for part in parts).encode()).hexdigest()[:32]


def write(path, text):
    """Writes a file so that nobody ever sees half of it."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    handle, part = tempfile.mkstemp(dir=os.path.dirname(path))
    with os.fdopen(handle, "w") as file:
        file.write(text)
    # A temporary file is for its owner only.
    mask = os.umask(0)
    os.umask(mask)
    os.chmod(part, 0o666 & ~mask)
    os.replace(part, path)
