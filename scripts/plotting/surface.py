"""The surface of a set of cells in three dimensions."""

import numpy as np

# The corners of a face, as steps along the two other dimensions.
_CORNERS = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])


def visible_faces(members, viewer):
    """Faces of the union of cells that look towards a viewer far away.

    @param members bool [n_1, n_2, n_3]
    @param viewer for each dimension 1 if the viewer is at its upper end, -1 at its lower end
    @returns (cells, corners, dimensions): int [faces, 3], the cell of each face; int [faces, 4, 3], its corners as
        numbers of the cells' edges; int [faces], the dimension that it is across
    """
    cells, corners, dimensions = [], [], []
    for dimension, side in enumerate(viewer):
        outside = np.ones_like(members)
        inner = [slice(None)] * 3
        beyond = [slice(None)] * 3
        inner[dimension], beyond[dimension] = slice(None, -1), slice(1, None)
        if side < 0:
            inner, beyond = beyond, inner
        outside[tuple(inner)] = ~members[tuple(beyond)]
        found = np.argwhere(members & outside)
        offsets = np.insert(_CORNERS, dimension, side > 0, axis=1)
        cells.append(found)
        corners.append(found[:, None, :] + offsets[None])
        dimensions.append(np.full(len(found), dimension))
    return np.concatenate(cells), np.concatenate(corners), np.concatenate(dimensions)
