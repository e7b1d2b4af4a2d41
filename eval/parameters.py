"""The parameters of a tracker, as the library describes them: through gt2_config_parameter_info."""
import ctypes as c
import dataclasses

# GT2_PARAMETER_... of gentrack2.h: the kinds that are a single value.
NUMBER, INTEGER, BOOLEAN, CHOICE = SINGLE = (1, 2, 3, 4)


class Info(c.Structure):
    """gt2_parameter_info of gentrack2.h."""
    _fields_ = [("struct_size", c.c_size_t), ("key", c.c_char_p), ("kind", c.c_int32), ("reserved", c.c_int32),
                ("default_text", c.c_char_p), ("minimum", c.c_double), ("maximum", c.c_double), ("unit", c.c_char_p),
                ("symbol", c.c_char_p), ("documentation", c.c_char_p), ("choices", c.POINTER(c.c_char_p)),
                ("choice_count", c.c_size_t)]


@dataclasses.dataclass(frozen=True)
class Parameter:
    key: str
    kind: int
    # As text, of the parameter's own kind.
    default: str
    minimum: float
    maximum: float
    choices: tuple
    documentation: str


class Refused(Exception):
    """The library refused something; the message is its own."""


class Library:
    def __init__(self, path):
        self.lib = c.CDLL(path)
        self.lib.gt2_last_error_message.restype = self.lib.gt2_algorithm_name.restype = c.c_char_p
        self.lib.gt2_config_parameter_count.restype = self.lib.gt2_algorithm_count.restype = c.c_size_t

    def call(self, function, *arguments):
        if getattr(self.lib, function)(*arguments) != 0:
            raise Refused(self.lib.gt2_last_error_message().decode())

    def config(self, algorithm):
        config = c.c_void_p()
        self.call("gt2_config_new", algorithm.encode(), c.byref(config))
        return config

    def algorithms(self):
        return [self.lib.gt2_algorithm_name(c.c_size_t(i)).decode() for i in range(self.lib.gt2_algorithm_count())]

    def parameters(self, algorithm):
        config = self.config(algorithm)
        try:
            return [self.describe(config, i) for i in range(self.lib.gt2_config_parameter_count(config))]
        finally:
            self.lib.gt2_config_free(config)

    def describe(self, config, index):
        info = Info(struct_size=c.sizeof(Info))
        self.call("gt2_config_parameter_info", config, c.c_size_t(index), c.byref(info))
        choices = tuple(info.choices[i].decode() for i in range(info.choice_count))
        return Parameter(info.key.decode(), info.kind, info.default_text.decode(), info.minimum, info.maximum, choices,
                         info.documentation.decode())

    def own_parameters(self, algorithm):
        """Those that not all algorithms have: seeds, limits and the like have nothing to do with accuracy."""
        common = set.intersection(*({each.key for each in self.parameters(name)} for name in self.algorithms()))
        return [each for each in self.parameters(algorithm) if each.key not in common]

    def complaint(self, algorithm, values):
        """What the library says against these values, by key as text; None if it takes them."""
        config, tracker = self.config(algorithm), c.c_void_p()
        try:
            for key, value in values.items():
                self.call("gt2_config_set", config, key.encode(), value.encode())
            self.call("gt2_tracker_new", config, c.byref(tracker))
        except Refused as error:
            return str(error)
        finally:
            self.lib.gt2_tracker_free(tracker)
            self.lib.gt2_config_free(config)
        return None

    def load_toml(self, algorithm, text, keys):
        """The values, as text, that these parameters have once the C interface has read the text."""
        config, data = self.config(algorithm), text.encode()
        try:
            self.call("gt2_config_load_toml", config, data, c.c_size_t(len(data)))
            return {key: self.value(config, key) for key in keys}
        finally:
            self.lib.gt2_config_free(config)

    def value(self, config, key):
        needed = c.c_size_t()
        self.lib.gt2_config_get(config, key.encode(), None, c.c_size_t(0), c.byref(needed))
        buffer = c.create_string_buffer(needed.value)
        self.call("gt2_config_get", config, key.encode(), buffer, needed, None)
        return buffer.value.decode()
