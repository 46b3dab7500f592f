"""Pictures as files that appear whole or not at all."""

import os
import pathlib
import tempfile

import matplotlib

from .errors import StreamError, UsageError

# No dates and no program versions, so that equal figures are equal files.
_METADATA = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


def check_output(path):
    """@throws UsageError if the extension names no format, StreamError if no file can be made there"""
    if pathlib.Path(path).suffix.lower() not in _METADATA:
        raise UsageError(f"expected a name that ends in .png, .svg or .pdf, found '{path}'", "-o")
    if pathlib.Path(path).is_dir():
        raise StreamError("it is a folder", path)
    os.unlink(_temporary(path))


def _temporary(path):
    target = os.path.realpath(path) if os.path.islink(path) else path
    folder = pathlib.Path(target).parent
    try:
        handle, name = tempfile.mkstemp(dir=folder, prefix=".coordreq-", suffix=".tmp")
        os.close(handle)
        return name
    except FileNotFoundError as error:
        raise StreamError("the folder does not exist", str(folder)) from error
    except OSError as error:
        raise StreamError(f"cannot write there: {error.strerror}", path) from error


def _mode(path):
    """Permission bits of what is replaced, else those of any new file."""
    try:
        return os.stat(path).st_mode & 0o7777
    except OSError:
        mask = os.umask(0)
        os.umask(mask)
        return 0o666 & ~mask


def save(figure, path, dpi):
    """Writes the picture in the format of the path's extension; the same figure gives the same bytes."""
    suffix = pathlib.Path(path).suffix.lower()
    temporary = _temporary(path)
    try:
        with matplotlib.rc_context({"svg.hashsalt": "coordreq"}):
            figure.savefig(temporary, format=suffix[1:], dpi=dpi, metadata=_METADATA[suffix])
        os.chmod(temporary, _mode(path))
        os.replace(temporary, os.path.realpath(path))
    except OSError as error:
        raise StreamError(f"cannot write the picture: {error.strerror}", path) from error
    finally:
        if os.path.exists(temporary):
            os.unlink(temporary)
