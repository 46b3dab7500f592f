"""Checkpoints taken to pieces and put together again: lib/results/checkpoint_file.hpp says what they are."""

import hashlib
import json
import struct
import zlib

import numpy as np

SIGNATURE = b"coordreq-checkpoint 3\n"
BLOCK = 1 << 18


def line(head):
    return json.dumps(head, separators=(",", ":")).encode() + b"\n"


def checksum(data):
    return hashlib.sha256(data).hexdigest().encode() + b"\n"


def take(data):
    """The header, and the sections: each what it says of itself, and lists of a head and packed blocks."""
    place = len(SIGNATURE)
    assert data.startswith(SIGNATURE)

    def next_line():
        nonlocal place
        end = data.index(b"\n", place) + 1
        text, place = data[place:end], end
        return text

    header, sections = json.loads(next_line()), []
    while (text := next_line()) != b"end\n":
        head = json.loads(text)
        if "section" in head:
            sections.append((head, []))
            continue
        blocks = []
        for _ in range(0, head["rows"] * head["length"] * int(head["type"][1]), BLOCK):
            (length,) = struct.unpack("<I", data[place : place + 4])
            blocks.append(data[place + 4 : place + 4 + length])
            place += 4 + length
        next_line()
        sections[-1][1].append({"head": head, "blocks": blocks})
    return header, sections


def put(header, sections):
    """The file, with all checksums."""
    data = SIGNATURE + line(header)
    for head, lists in sections:
        data += line(head)
        for own in lists:
            data += line(own["head"]) + b"".join(struct.pack("<I", len(block)) + block for block in own["blocks"])
            data += checksum(data)
    data += b"end\n"
    return data + checksum(data)


def numbers(own):
    """Of a list: [rows, length]."""
    kind = own["head"]["type"]
    size, raw = int(kind[1]), b""
    for block in own["blocks"]:
        raw += np.frombuffer(zlib.decompress(block), np.uint8).reshape(size, -1).T.tobytes()
    return np.frombuffer(raw, "<" + kind).reshape(own["head"]["rows"], own["head"]["length"]).copy()


def list_of(values):
    """The list of an array [rows, length]."""
    size, raw, blocks = values.dtype.itemsize, values.tobytes(), []
    for begin in range(0, len(raw), BLOCK):
        block = np.frombuffer(raw[begin : begin + BLOCK], np.uint8).reshape(-1, size).T.tobytes()
        blocks.append(zlib.compress(block, 1))
    head = {"type": f"{values.dtype.kind}{size}", "rows": values.shape[0], "length": values.shape[1]}
    return {"head": head, "blocks": blocks}
