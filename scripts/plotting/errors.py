"""Errors as the program has them: one line `WHAT (WHERE)` and its exit codes."""


class PlotError(Exception):
    """@param where the option, the file or the object concerned; empty if the message says it"""

    code = 70

    def __init__(self, what, where=""):
        super().__init__(f"{what} ({where})" if where else what)


class UsageError(PlotError):
    code = 2


class FileError(PlotError):
    """A file that is not what it should be."""

    code = 3


class StreamError(PlotError):
    """The system cannot read or write."""

    code = 5


def quoted(names, last="or"):
    """'a', 'b' or 'c'; of no names: nothing"""
    texts = [f"'{name}'" for name in names]
    return f" {last} ".join(filter(None, [", ".join(texts[:-1]), *texts[-1:]])) or "nothing"
