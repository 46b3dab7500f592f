"""Writes first_come.h5, the controller of crossing_first_come.json: who is ahead drives on, the other one brakes."""

import h5py
import numpy as np

p, v, u = np.arange(-10, 11), np.arange(0, 3.5, 0.5), np.arange(-1, 1.5, 0.5)
axes = {"p1": p, "v1": v, "v2": v, "p2": p, "u1": u, "u2": u}
p1, v1, v2, p2, u1, u2 = np.meshgrid(*axes.values(), indexing="ij")
first = (p1 >= p2) | (p2 >= 2)  # vehicle 1 is ahead, or the other one has passed
second = (p1 < p2) | (p1 >= 2)
listed = np.where(first, u1 >= 0, u1 == -1) & np.where(second, u2 >= 0, u2 == -1)

with h5py.File("first_come.h5", "w") as file:
    file.attrs["filetype"] = "coordreq-results"
    file.attrs["version"] = np.array([1, 0], "int32")
    for name, points in axes.items():
        file[name] = points
        file[name].make_scale(name)
    joint = listed.reshape(*listed.shape[:4], -1)  # row-major over the inputs, the last one fastest
    bits = np.packbits(joint, axis=-1, bitorder="little")
    file["byte"] = np.arange(bits.shape[-1])
    file["byte"].make_scale("byte")
    controller = file.create_dataset("controller", data=bits, compression="gzip")
    controller.attrs.update({"inputs": "u1 u2", "actions": joint.shape[-1], "bitorder": "little"})
    for axis, name in enumerate(["p1", "v1", "v2", "p2", "byte"]):
        controller.dims[axis].attach_scale(file[name])
