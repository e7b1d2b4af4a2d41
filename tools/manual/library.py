"""The built library as the manual's checks see it: algorithms, parameters, presets, through its C interface."""
import ctypes as c


class Info(c.Structure):
    _fields_ = [("struct_size", c.c_size_t), ("key", c.c_char_p), ("kind", c.c_int32), ("reserved", c.c_int32),
                ("default_text", c.c_char_p), ("minimum", c.c_double), ("maximum", c.c_double), ("unit", c.c_char_p),
                ("symbol", c.c_char_p), ("documentation", c.c_char_p), ("choices", c.POINTER(c.c_char_p)),
                ("choice_count", c.c_size_t)]


class Library:
    def __init__(self, path):
        self.c = c.CDLL(str(path))
        for name in ("gt2_algorithm_name", "gt2_last_error_message", "gt2_config_preset_name"):
            getattr(self.c, name).restype = c.c_char_p
        for name in ("gt2_algorithm_count", "gt2_config_parameter_count", "gt2_config_preset_count"):
            getattr(self.c, name).restype = c.c_size_t
        self.c.gt2_config_parameter_info.argtypes = [c.c_void_p, c.c_size_t, c.c_void_p]
        self.c.gt2_config_preset_name.argtypes = [c.c_void_p, c.c_size_t]
        self.c.gt2_config_load_toml.argtypes = [c.c_void_p, c.c_char_p, c.c_size_t]
        self.algorithms = [self.c.gt2_algorithm_name(c.c_size_t(i)).decode()
                           for i in range(self.c.gt2_algorithm_count())]
        # By algorithm: defaults by key; choices and presets are values that may be named.
        self.defaults, self.values = {}, set()
        for name in self.algorithms:
            self.defaults[name] = dict(self._parameters(name))

    def config(self, algorithm):
        made = c.c_void_p()
        self.call("gt2_config_new", algorithm.encode(), c.byref(made))
        return made

    def call(self, function, *arguments):
        if getattr(self.c, function)(*arguments):
            raise ValueError(self.c.gt2_last_error_message().decode())

    def _parameters(self, algorithm):
        config = self.config(algorithm)
        for i in range(self.c.gt2_config_parameter_count(config)):
            info = Info(struct_size=c.sizeof(Info))
            self.call("gt2_config_parameter_info", config, i, c.byref(info))
            self.values |= {info.choices[n].decode() for n in range(info.choice_count)}
            yield info.key.decode(), info.default_text.decode()
        self.values |= {self.c.gt2_config_preset_name(config, i).decode()
                        for i in range(self.c.gt2_config_preset_count(config))}
        self.c.gt2_config_free(config)

    def keys(self):
        return {key for defaults in self.defaults.values() for key in defaults} | {"preset"}

    def accepts(self, key, value):
        """What is wrong with a setting; None if an algorithm takes it."""
        trouble = f"no parameter {key}"
        for algorithm in self.algorithms:
            if key != "preset" and key not in self.defaults[algorithm]:
                continue
            config = self.config(algorithm)
            try:
                self.call("gt2_config_set", config, key.encode(), value.encode())
                return None
            except ValueError as error:
                trouble = str(error)
            finally:
                self.c.gt2_config_free(config)
        return trouble

    def load_toml(self, text):
        config = self.config(self.algorithms[0])
        try:
            self.call("gt2_config_load_toml", config, text.encode(), len(text.encode()))
        finally:
            self.c.gt2_config_free(config)
