"""The format of results files, pinned by a description of a file that has every dataset there is.

usage: format_test.py SAMPLE [--update]   (the file that `write_sample SAMPLE everything` made)
"""

import json
import pathlib
import sys
import unittest

import h5py
import numpy as np

GOLDEN = pathlib.Path(__file__).with_name("format_golden.json")
CHANGING = ("coordreq_version", "git_sha1", "spec_sha256")
UPDATE = "--update" in sys.argv
if UPDATE:
    sys.argv.remove("--update")
SAMPLE = sys.argv.pop()


def type_name(dtype):
    return "string" if h5py.check_string_dtype(dtype) and dtype.kind == "O" else dtype.str


def value_of(file, value):
    """Numbers and texts as they are, references as the paths they lead to."""
    if isinstance(value, bytes):
        return value.decode()
    if isinstance(value, h5py.Reference):
        return file[value].name
    if isinstance(value, (np.ndarray, list, tuple, np.void)):
        return [value_of(file, one) for one in (value.tolist() if isinstance(value, np.void) else value)]
    return value.item() if isinstance(value, np.generic) else value


def attribute(file, holder, name):
    value = holder.attrs[name]
    stored = holder.attrs.get_id(name)
    text = "not compared" if name in CHANGING else value_of(file, value)
    return [type_name(stored.dtype), list(stored.shape), text]


def described(file, item):
    result = {}
    if isinstance(item, h5py.Dataset):
        result = {"type": type_name(item.dtype), "shape": list(item.shape)}
        if item.chunks:
            result["chunks"] = list(item.chunks)
            result["filters"] = [item.id.get_create_plist().get_filter(i)[0]
                                 for i in range(item.id.get_create_plist().get_nfilters())]
    result["attributes"] = {name: attribute(file, item, name) for name in item.attrs}
    return result


def description(path):
    with h5py.File(path) as file:
        items = {"/": described(file, file)}
        file.visititems(lambda name, item: items.__setitem__("/" + name, described(file, item)))
        return items


def as_text(items):
    """A line an attribute, for a reader of a change."""
    return json.dumps(items, indent=1, ensure_ascii=False) + "\n"


class Format(unittest.TestCase):
    maxDiff = None

    def test_is_the_one_that_users_rely_on(self):
        found = description(SAMPLE)
        if UPDATE:
            lines = [f"{json.dumps(path)}: {json.dumps(found[path], ensure_ascii=False)}" for path in sorted(found)]
            GOLDEN.write_text("{\n" + ",\n".join(lines) + "\n}\n")
        golden = json.loads(GOLDEN.read_text())
        self.assertEqual(sorted(found), sorted(golden))
        for path, expected in golden.items():
            # Attributes come in the order in which they were written, too.
            self.assertEqual(as_text(found[path]), as_text(expected), path)


if __name__ == "__main__":
    unittest.main()
