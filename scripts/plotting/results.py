"""Reads what coordreq writes: results of `analyze` and runs of `simulate`."""

from dataclasses import dataclass
from fractions import Fraction

import h5py
import numpy as np

from .errors import FileError, StreamError, UsageError, quoted
from .spec import Spec

_WRITERS = {"coordreq-results": "analyze", "coordreq-runs": "simulate"}
_VERSION = 1


@dataclass(frozen=True)
class Axis:
    """Grid points of a state or an input; step is None for listed input values.

    Where `is_points` is set there is nothing between them.
    """

    name: str
    unit: str
    points: np.ndarray
    step: float
    is_points: bool

    @property
    def label(self):
        return f"{self.name} [{self.unit}]" if self.unit else self.name

    @property
    def edges(self):
        """Faces of the cells, one more than there are points."""
        return np.append(self.points, self.points[-1] + self.step) - self.step / 2

    def shown(self, value):
        return f"{self.name} = {value}{' ' if self.unit else ''}{self.unit}"


class StoredFile:
    """A file open for reading, of the kind that its attribute `filetype` tells.

    @throws StreamError if the system cannot read it, FileError if it is none of ours
    """

    def __init__(self, path, kind):
        self.path = path
        try:
            with open(path, "rb"):
                self._file = h5py.File(path, "r")
        except OSError as error:
            if error.strerror:
                raise StreamError(f"cannot read the file: {error.strerror}", path) from error
            raise FileError("not a coordreq file: it is not HDF5, or cut short", path) from error
        found = self.attribute("/", "filetype", "")
        if found != kind:
            other = f", it is one of {_WRITERS[found]}" if found in _WRITERS else ""
            raise FileError(f"not a file that {_WRITERS[kind]} wrote{other}", path)
        version = self.attribute("/", "version")
        if version[0] != _VERSION:
            raise FileError(f"version {version[0]} of the format, expected {_VERSION}", path)
        self.title = self.attribute("/", "title")
        self.period = self.attribute("/", "period")
        self.period_unit = self.attribute("/", "period_unit")
        self.spec = Spec(self.read("/spec"), path)

    def __contains__(self, name):
        return name in self._file

    def names(self, group):
        return list(self._object(group))

    def _object(self, name):
        if name not in self._file:
            raise FileError(f"no {name} in the file", self.path)
        return self._file[name]

    def attribute(self, name, key, default=None):
        value = self._object(name).attrs.get(key, default)
        if value is None:
            raise FileError(f"no attribute {key} of {name} in the file", self.path)
        return value

    def read(self, name, index=()):
        """The elements that numpy would give for array[index]; texts as str."""
        dataset = self._object(name)
        try:
            text = h5py.check_string_dtype(dataset.dtype)
            return (dataset.asstr() if text else dataset)[index]
        except (OSError, ValueError, TypeError) as error:
            raise FileError(f"cannot read {name}: {error}", self.path) from error

    def seconds(self, steps):
        """Steps as text: "25 steps (0.25 s)"."""
        time = f" ({steps * self.period:.6g} {self.period_unit})" if self.period_unit else ""
        return f"{steps} step{'' if steps == 1 else 's'}{time}"


class Results(StoredFile):
    def __init__(self, path):
        super().__init__(path, "coordreq-results")
        # Attached scales are the axes in their order.
        self.states = [self.axis(scales[0].name[1:]) for scales in self._object("/safe").dims]
        self.partitions = [str(name) for name in self.read("/partition")]

    def axis(self, name):
        unit = self.attribute(f"/{name}", "units")
        points = self.read(f"/{name}")
        step = self._object(f"/{name}").attrs.get("step")
        # What is no state with cells around its points is a discrete one or an input.
        return Axis(name, "" if unit == "1" else unit, points, step, self.spec.is_discrete(name))

    def axes_of(self, name):
        """The names of the axes of a dataset, in their order."""
        return [scales[0].name[1:] for scales in self._object(name).dims]

    def partition(self, name):
        """Its number; without a name that of the only one."""
        if name is None:
            if len(self.partitions) == 1:
                return 0
            raise UsageError(f"which partition? expected --partition {quoted(self.partitions)}")
        name = self.spec.canonical_partitions().get(name, name)
        if name not in self.partitions:
            raise UsageError(f"no partition '{name}', expected {quoted(self.partitions)}", "--partition")
        return self.partitions.index(name)

    def flags(self, name):
        """Values of a dataset with a meaning of their own, {"not_safe": -2, ...}."""
        values = np.atleast_1d(self.attribute(name, "flag_values"))
        return dict(zip(self.attribute(name, "flag_meanings").split(), values.tolist()))

    def cell(self, axis, value, option):
        """Index of the cell [a, b) that holds an exact value, as `query` finds it."""
        points = [Fraction(repr(float(point))) for point in (axis.points[0], axis.step)]
        place = (value - points[0]) / points[1]
        if self.spec.is_discrete(axis.name):
            index = int(place) if place == int(place) else -1
        else:
            index = (place + Fraction(1, 2)).__floor__()
        if self.spec.is_periodic(axis.name):
            index %= len(axis.points)
        if not 0 <= index < len(axis.points):
            raise UsageError(f"{axis.name} = {float(value):.10g} is outside of the domain", option)
        return index

    def cell_of(self, values, option):
        """Indices of a state that names a value for each dimension."""
        names = [axis.name for axis in self.states]
        for name in values:
            if name not in names:
                raise UsageError(f"'{name}' is no state, expected {quoted(names)}", option)
        for name in names:
            if name not in values:
                raise UsageError(f"no value for the state '{name}'", option)
        return tuple(self.cell(axis, values[axis.name], option) for axis in self.states)
