"""Numbers that a user types or a spec holds, exact: decimals and constant expressions such as 2*pi or 7/9."""

import ast
import math
import operator
from fractions import Fraction

from .errors import UsageError

_BINARY = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
_MAX_EXPONENT = 1000
_EXACT = {"abs": abs, "min": min, "max": max, "floor": math.floor, "mod": operator.mod}
_ROUNDED = ("sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt").split()


def evaluate(text, names=None):
    """The value of a constant expression of the spec language as a Fraction; `names` are constants.

    Functions that have no rational value give their nearest double.
    @throws ValueError saying what is wrong
    """
    source = text.strip().replace("^", "**")
    try:
        return _value(ast.parse(source, mode="eval").body, source, {"pi": Fraction(math.pi), **(names or {})})
    except (SyntaxError, RecursionError, MemoryError, ArithmeticError, TypeError) as error:
        raise ValueError(f"expected a number, found '{text}'") from error


def _value(node, source, names):
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        return Fraction(ast.get_source_segment(source, node))
    if isinstance(node, ast.Name):
        if node.id not in names:
            raise ValueError(f"'{node.id}' is not defined")
        return names[node.id]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.UAdd, ast.USub)):
        value = _value(node.operand, source, names)
        return -value if isinstance(node.op, ast.USub) else value
    if isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
        left, right = _value(node.left, source, names), _value(node.right, source, names)
        if isinstance(node.op, ast.Pow) and abs(right) > _MAX_EXPONENT:
            raise ValueError(f"the exponent {right} is too large")
        return Fraction(_BINARY[type(node.op)](left, right))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
        values = [_value(argument, source, names) for argument in node.args]
        if node.func.id in _ROUNDED:
            return Fraction(getattr(math, node.func.id)(*map(float, values)))
        if node.func.id in _EXACT:
            return Fraction(_EXACT[node.func.id](*values))
        raise ValueError(f"'{node.func.id}' is no function")
    raise ValueError(f"expected a number, found '{ast.get_source_segment(source, node)}'")


def named_values(texts, option):
    """{"v1": Fraction(14, 5)} of "v1=2.8,..."; each text may hold several."""
    values = {}
    for part in (part for text in texts for part in text.split(",")):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not (name and equals and value):
            raise UsageError(f"expected NAME=VALUE, found '{part.strip()}'", option)
        if name in values:
            raise UsageError(f"'{name}' is given twice", option)
        try:
            values[name] = evaluate(value)
        except ValueError as error:
            raise UsageError(str(error), f"{option}, {name}") from error
    return values


def whole_numbers(text, option):
    """[1, 14, 29] of "1,14,29"; none below 0."""
    try:
        values = [int(part) for part in text.split(",")]
    except ValueError:
        values = [-1]
    if min(values) < 0:
        raise UsageError(f"expected whole numbers such as 1,14,29, found '{text}'", option)
    return values


def shown(value):
    """A number as short as it can be: 0.3 and not 0.30000000000000004."""
    return f"{float(value):.10g}"
