"""Conditions of a spec over boxes of states: where they may hold, and where they hold for every point.

A value is a pair of arrays, the least and the greatest over each box; a condition a pair of masks (may hold, must hold).
Numbers are doubles, so that sides that differ by rounding alone count as equal.
"""

import ast

import numpy as np

_CLOSE = 1e-9
_RISING = {name: getattr(np, name) for name in ("exp", "floor", "sign", "sinh", "tanh")}
_RISING |= {"asin": np.arcsin, "atan": np.arctan, "log": np.log, "sqrt": np.sqrt}
_OTHER = {"tan": np.tan, "cosh": np.cosh, "atan2": np.arctan2, "mod": np.mod, "pow": np.power}  # of points alone
_SPELLINGS = (("&&", " and "), ("||", " or "), ("!=", "<>"), ("!", " not "), ("<>", "!="), ("^", "**"), ("if(", "if_("))


class Conditions:
    """@param boxes name -> (least, greatest), arrays that broadcast
    @param formulas name -> text of what the spec defines
    """

    def __init__(self, boxes, formulas):
        self._boxes = boxes
        self._formulas = formulas

    def ask(self, text):
        """@returns (may hold, must hold); @throws ValueError for what boxes alone do not decide"""
        with np.errstate(all="ignore"):
            return self._truth(self._parsed(str(text)))

    @staticmethod
    def _parsed(text):
        for old, new in _SPELLINGS:
            text = text.replace(old, new)
        try:
            return ast.parse(" ".join(text.split()), mode="eval").body
        except (SyntaxError, RecursionError, MemoryError) as error:
            raise ValueError(f"cannot read '{text}'") from error

    def _truth(self, node):
        if isinstance(node, ast.BoolOp):
            join = np.logical_and if isinstance(node.op, ast.And) else np.logical_or
            parts = [self._truth(value) for value in node.values]
            may, must = parts[0]
            for part in parts[1:]:
                may, must = join(may, part[0]), join(must, part[1])
            return may, must
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            may, must = self._truth(node.operand)
            return np.logical_not(must), np.logical_not(may)
        if isinstance(node, ast.Compare):
            sides = [self._value(side) for side in (node.left, *node.comparators)]
            found = [_compare(op, *pair) for op, *pair in zip(node.ops, sides, sides[1:])]
            return np.all(np.broadcast_arrays(*(f[0] for f in found)), axis=0), np.all(
                np.broadcast_arrays(*(f[1] for f in found)), axis=0
            )
        if isinstance(node, ast.Name) and node.id in ("true", "false"):
            return np.bool_(node.id == "true"), np.bool_(node.id == "true")
        if isinstance(node, ast.Name) and node.id in self._formulas:
            return self._truth(self._parsed(str(self._formulas[node.id])))
        raise ValueError("not a condition on states")

    def _value(self, node):
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            return np.float64(node.value), np.float64(node.value)
        if isinstance(node, ast.Name):
            if node.id in self._boxes:
                return self._boxes[node.id]
            if node.id == "pi":
                return np.float64(np.pi), np.float64(np.pi)
            if node.id in self._formulas:
                return self._value(self._parsed(str(self._formulas[node.id])))
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.UAdd, ast.USub)):
            low, high = self._value(node.operand)
            return (-high, -low) if isinstance(node.op, ast.USub) else (low, high)
        if isinstance(node, ast.BinOp):
            return self._binary(node)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            if node.func.id == "if_" and len(node.args) == 3:
                may, must = self._truth(node.args[0])
                yes, no = (self._value(side) for side in node.args[1:])
                return (np.where(must, yes[0], np.where(may, np.minimum(yes[0], no[0]), no[0])),
                        np.where(must, yes[1], np.where(may, np.maximum(yes[1], no[1]), no[1])))  # fmt: skip
            return _called(node.func.id, [self._value(argument) for argument in node.args])
        raise ValueError("not a function of states")

    def _binary(self, node):
        (a, b), (c, d) = self._value(node.left), self._value(node.right)
        if isinstance(node.op, ast.Add):
            return a + c, b + d
        if isinstance(node.op, ast.Sub):
            return a - d, b - c
        if isinstance(node.op, ast.Mult):
            return _hull(a * c, a * d, b * c, b * d)
        if isinstance(node.op, ast.Div):
            has_zero = (c <= 0) & (d >= 0)
            low, high = _hull(a / c, a / d, b / c, b / d)
            return np.where(has_zero, -np.inf, low), np.where(has_zero, np.inf, high)
        if isinstance(node.op, ast.Pow) and np.ndim(c) == 0 and c == d and c == int(c) and c > 0:
            low, high = _hull(a**c, b**c)
            return np.where((c % 2 == 0) & (a < 0) & (b > 0), 0.0, low), high
        return _called("pow", [(a, b), (c, d)])


def _hull(*ends):
    """Of 0 times infinity comes no number: nothing is known then."""
    ends = np.broadcast_arrays(*ends)
    low, high = np.min(ends, axis=0), np.max(ends, axis=0)
    return np.where(np.isnan(low), -np.inf, low), np.where(np.isnan(high), np.inf, high)


def _compare(op, left, right):
    (a, b), (c, d) = left, right
    slack = _CLOSE * np.maximum(1, np.maximum(np.minimum(abs(a), abs(b)), np.minimum(abs(c), abs(d))))
    slack = np.where(np.isfinite(slack), slack, 0)
    if isinstance(op, (ast.Gt, ast.GtE)):
        return _compare(ast.Lt() if isinstance(op, ast.Gt) else ast.LtE(), right, left)
    if isinstance(op, ast.Lt):
        return a < d - slack, b < c - slack
    if isinstance(op, ast.LtE):
        return a <= d + slack, b <= c + slack
    may = (a <= d + slack) & (c <= b + slack)
    must = (abs(b - c) <= slack) & (abs(d - a) <= slack)
    return (may, must) if isinstance(op, ast.Eq) else (~must, ~may)


def _called(name, values):
    if name in _RISING and len(values) == 1:
        return tuple(_RISING[name](end) for end in values[0])
    if name == "acos" and len(values) == 1:
        return tuple(np.arccos(end) for end in values[0][::-1])
    if name == "abs" and len(values) == 1:
        low, high = values[0]
        return np.maximum(np.maximum(low, -high), 0.0), np.maximum(abs(low), abs(high))
    if name in ("min", "max") and values:
        extreme = np.minimum if name == "min" else np.maximum
        low, high = values[0]
        for other in values[1:]:
            low, high = extreme(low, other[0]), extreme(high, other[1])
        return low, high
    if name in ("sin", "cos") and len(values) == 1:
        shift = np.pi / 2 if name == "cos" else 0
        return _sine(values[0][0] + shift, values[0][1] + shift)
    if name in _OTHER and all(np.array_equal(low, high) for low, high in values):
        points = _OTHER[name](*(low for low, _ in values))
        return points, points
    raise ValueError(f"'{name}' is not known of boxes")


def _sine(low, high):
    ends = np.sin(low), np.sin(high)
    has_top = np.floor((high - np.pi / 2) / (2 * np.pi)) >= np.ceil((low - np.pi / 2) / (2 * np.pi))
    has_bottom = np.floor((high + np.pi / 2) / (2 * np.pi)) >= np.ceil((low + np.pi / 2) / (2 * np.pi))
    return np.where(has_bottom, -1.0, np.minimum(*ends)), np.where(has_top, 1.0, np.maximum(*ends))
