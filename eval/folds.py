"""Whether what a search found is better on sequences that it did not see."""
import dataclasses
import typing


@dataclasses.dataclass
class Outcome:
    """Scores of the defaults and of what was found, where it was searched and on the sequences held out."""
    values: dict
    train_default: float
    train: float
    held_out: list
    held_default: typing.Optional[float] = None
    held: typing.Optional[float] = None

    @property
    def gain(self):
        return self.held - self.held_default


@dataclasses.dataclass
class Verdict:
    proven: bool
    text: str


def groups(items, count):
    """The items in so many groups of about one size, neighbours apart."""
    count = min(count, len(items))
    return [items[i::count] for i in range(count)]


def outcome(searcher, train, held):
    values, score = searcher.search(train)
    result = Outcome(values, searcher.trials.score(train, {}), score, [sequence.name for sequence in held])
    if held:
        result.held_default, result.held = searcher.trials.score(held, {}), searcher.trials.score(held, values)
    return result


def cross_validate(searcher, sequences, count):
    """A search with each group held out in its turn, and one on all sequences."""
    held_out = groups(sequences, count) if len(sequences) > 1 and count > 1 else []
    with searcher.plan(len(held_out) + 1):
        found = [outcome(searcher, [each for each in sequences if each not in held], held) for held in held_out]
        return found, outcome(searcher, sequences, [])


def verdict(found, final):
    """A gain is claimed only if the sequences held out show it: in most folds, and beyond what chance would do."""
    if not final.values:
        return Verdict(False, "Nothing better than the defaults was found.")
    if len(found) < 2:
        return Verdict(False, "There is nothing to hold out, so nothing tells whether what was found helps on other "
                              "sequences.\nNo gain is claimed.")
    gains = [each.gain for each in found]
    mean = sum(gains) / len(gains)
    error = (sum((gain - mean) ** 2 for gain in gains) / (len(gains) - 1) / len(gains)) ** 0.5
    better = sum(gain > 0 for gain in gains)
    shown = (f"On sequences held out: {mean:+.2f} in the mean, standard error {error:.2f}, "
             f"better in {better} of {len(gains)}.")
    if mean > error and 2 * better > len(gains):
        return Verdict(True, f"{shown}\nThe gain holds where the search did not look.")
    return Verdict(
        False,
        f"{shown}\nThe gain where it was searched, {final.train - final.train_default:+.2f}, does not hold "
        "elsewhere: no gain is claimed.",
    )
