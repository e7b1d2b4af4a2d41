"""Which of a tracker's parameters are searched, and where: from the library's own descriptions."""
import dataclasses
import math
import os
import re

import environment
import parameters

# The page whose table names the parameters to try first, and how that begins.
PAGE = os.path.join(environment.ROOT, "docs", "tuning.md")
TRY_FIRST = "| symptom | parameter"


@dataclasses.dataclass(frozen=True)
class Dimension:
    """Where one parameter is searched."""
    parameter: parameters.Parameter
    low: float = 0.0
    high: float = 0.0
    # Multiples of the default are as far from it as fractions.
    log: bool = False

    @property
    def key(self):
        return self.parameter.key

    @property
    def options(self):
        return ("false", "true") if self.parameter.kind == parameters.BOOLEAN else self.parameter.choices

    def suggest(self, trial):
        """The trial's value as text."""
        if self.parameter.kind == parameters.NUMBER:
            return f"{trial.suggest_float(self.key, self.low, self.high, log=self.log):.4g}"
        if self.parameter.kind == parameters.INTEGER:
            return str(trial.suggest_int(self.key, int(self.low), int(self.high), log=self.log))
        return trial.suggest_categorical(self.key, self.options)

    def default(self):
        """The default as the search counts it."""
        if self.parameter.kind == parameters.NUMBER:
            return float(self.parameter.default)
        return int(self.parameter.default) if self.parameter.kind == parameters.INTEGER else self.parameter.default

    def ends(self):
        """The values farthest from the default, as text."""
        if self.parameter.kind == parameters.NUMBER:
            return [f"{self.low:.4g}", f"{self.high:.4g}"]
        if self.parameter.kind == parameters.INTEGER:
            return [str(int(self.low)), str(int(self.high))]
        return [option for option in self.options if option != self.parameter.default]


def dimension(parameter, reach):
    """Numbers are searched from the default divided by `reach` to the default times it, as far as they may go; None for
    what is no single value."""
    if parameter.kind in (parameters.BOOLEAN, parameters.CHOICE):
        return Dimension(parameter)
    if parameter.kind not in parameters.SINGLE:
        return None
    default, whole = float(parameter.default), parameter.kind == parameters.INTEGER
    # Around 0, and beyond what is whole, a step of one or a part of it.
    step = 1.0 if whole else 0.0 if default else 0.1 * reach
    low = min(default / reach, default * reach, default - step)
    high = max(default / reach, default * reach, default + step)
    if whole:
        low, high = math.ceil(low), math.floor(high)
    low, high = max(low, parameter.minimum), min(high, parameter.maximum)
    return Dimension(parameter, low, high, low > 0) if low < high else None


def try_first():
    """The keys that docs/tuning.md names in its table of symptoms."""
    with open(PAGE, encoding="utf-8") as file:
        text = file.read()
    if TRY_FIRST not in text:
        raise ValueError(f"{PAGE} has no table of symptoms and parameters")
    table = text[text.index(TRY_FIRST):].split("\n\n", 1)[0]
    columns = [row.split("|")[2:5] for row in table.splitlines()[2:]]
    return set(re.findall(r"`(\w+)`", " ".join(cell for row in columns for cell in row)))


def dimensions(library, algorithm, wanted, reach):
    """`wanted`: keys with commas, "all", or None for those to try first."""
    own = library.own_parameters(algorithm)
    keys = {each.key for each in own}
    if wanted and wanted != "all":
        chosen = set(wanted.split(","))
        if unknown := sorted(chosen - keys):
            raise ValueError(f"{algorithm} has no parameter {', '.join(unknown)} to tune")
    else:
        chosen = keys if wanted == "all" else keys & try_first()
    made = (dimension(each, reach) for each in own if each.key in chosen)
    return [each for each in made if each]
