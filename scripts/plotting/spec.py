"""The spec inside a results file."""

import json
import math
import re
from fractions import Fraction

from .condition import Conditions
from .errors import FileError
from .values import evaluate


def without_comments(text):
    """JSON with // and /* */ blanked out, but not inside of strings."""
    kept, i = [], 0
    while i < len(text):
        if text[i] == '"':
            end = i + 1
            while end < len(text) and text[end] != '"':
                end += 2 if text[end] == "\\" else 1
            kept.append(text[i : end + 1])
            i = end + 1
        elif text.startswith("//", i):
            end = text.find("\n", i)
            i = len(text) if end < 0 else end
        elif text.startswith("/*", i):
            end = text.find("*/", i + 2)
            i = len(text) if end < 0 else end + 2
            kept.append(" ")
        else:
            kept.append(text[i])
            i += 1
    return "".join(kept)


class Spec:
    """What figures ask of a spec. Numbers are exact."""

    def __init__(self, text, path):
        self._path = path
        try:
            self._keys = json.loads(without_comments(text), parse_float=Fraction)
        except ValueError as error:
            raise FileError(f"the spec in the file is no JSON: {error}", path) from error
        self._constants = self._evaluated(self._keys.get("constants", {}))

    @property
    def goal_then(self):
        """What follows arrival at the goal."""
        goal = self._keys.get("goal")
        return goal["then"] if isinstance(goal, dict) else "safe"

    def _evaluated(self, constants):
        """Constants may use one another in any order."""
        self._constants = {}
        for _ in constants:
            for name, value in constants.items():
                try:
                    self._constants.setdefault(name, self._number(value))
                except ValueError:
                    pass  # uses one that comes later
        return self._constants

    def _number(self, value):
        return evaluate(value, self._constants) if isinstance(value, str) else Fraction(value)

    def state(self, name):
        kept = {"name": name, "discrete": True}  # by a memory
        return next((state for state in self._keys["states"] if state["name"] == name), kept)

    def is_kept(self, name):
        """The state is one that a memory keeps, 0 at first."""
        return all(state["name"] != name for state in self._keys["states"])

    def is_discrete(self, name):
        return bool(self.state(name).get("discrete", False))

    def is_periodic(self, name):
        return self.state(name).get("outside") == "periodic"

    def jumps(self, name):
        """The state keeps its value until the next sample."""
        return self._keys["dynamics"].get("time") == "discrete" or self.is_discrete(name)

    def period(self, name):
        """Of a periodic state, else infinity."""
        if not self.is_periodic(name):
            return math.inf
        state = self.state(name)
        return float(self._number(state["upper"]) - self._number(state["lower"]))

    def grid_between(self, name, least, most):
        """The grid points of a discrete state from least to most."""
        state = self.state(name)
        origin, step = self._number(state.get("origin", 0)), self._number(state.get("step", 1))
        if "count" in state:
            origin = self._number(state["lower"])
            gaps = self._number(state["count"]) - (not self.is_periodic(name))
            step = (self._number(state["upper"]) - origin) / max(gaps, 1)
        first, last = (round((Fraction(value) - origin) / step) for value in (least, most))
        return [float(origin + k * step) for k in range(first, last + 1)]

    def conditions(self, boxes):
        """What is asked of boxes of states: name -> (least, greatest)."""
        return Conditions(boxes, {**self._constants, **self._keys.get("definitions", {})})

    def boxes(self, axes):
        """The closed cells, each along a direction of its own, widened by what a measurement may be off."""
        boxes = {}
        for i, axis in enumerate(axes):
            off = float(self._number(self.state(axis.name).get("measurement_error", 0)))
            low, high = (axis.points, axis.points) if axis.is_points else (axis.edges[:-1], axis.edges[1:])
            shape = [-1 if j == i else 1 for j in range(len(axes))]
            boxes[axis.name] = (low - off).reshape(shape), (high + off).reshape(shape)
        return boxes

    def states_of_safe(self):
        """The names of the states that "safe" asks, also in definitions."""
        return [state["name"] for state in self._keys["states"] if state["name"] in self._names_of_safe()]

    def safe(self):
        return self._keys.get("safe", "true")

    def safe_jumps(self):
        """Whether "safe" is asked of a state that jumps, also in definitions and memories."""
        known = {state["name"] for state in self._keys["states"]} | self._keys.get("memory", {}).keys()
        return any(self.jumps(name) for name in self._names_of_safe() & known)

    def _names_of_safe(self):
        formulas = {**self._keys.get("definitions", {}), **self._keys.get("memory", {}), "safe": self.safe()}
        names, new = set(), {"safe"}
        while new:
            names |= new
            new = {word for name in new for word in re.findall(r"[A-Za-z_]\w*", str(formulas.get(name, "")))} - names
        return names

    def units(self, kind):
        """Units of all "states", "inputs" or "disturbances" by name, "" for none."""
        return {one["name"]: one.get("unit", "") for one in self._keys.get(kind, [])}

    def requirements(self):
        return self._keys.get("requirements", [])

    def required_steps(self, requirement):
        """Steps that a requirement asks for, ceil(time / period) if it names a time; 0 if it asks for K only."""
        try:
            if "min_delay" in requirement:
                return math.ceil(self._number(requirement["min_delay"]))
            if "min_delay_time" in requirement:
                period = self._number(self._keys["dynamics"].get("period", 1))
                return math.ceil(self._number(requirement["min_delay_time"]) / period)
        except ValueError as error:
            raise FileError(f"requirement '{requirement['name']}': {error}", self._path) from error
        return 0

    def canonical_partitions(self):
        """Given names of the listed partitions by their canonical ones: {"a+b|c": "name"}."""
        agents = [agent["name"] for agent in self._keys["agents"]]
        listed = self._keys.get("coordination", {}).get("partitions", [])
        names = {}
        for partition in listed if isinstance(listed, list) else []:
            classes = [sorted(one, key=agents.index) for one in partition.get("classes", [])]
            together = {agent for one in classes for agent in one}
            classes += [[agent] for agent in agents if agent not in together]
            classes.sort(key=lambda one: agents.index(one[0]))
            canonical = "|".join("+".join(one) for one in classes)
            names[canonical] = partition.get("name", canonical)
        return names
