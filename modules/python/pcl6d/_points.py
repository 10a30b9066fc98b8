# SPDX-License-Identifier: BSD-3-Clause
"""Tools for the points of one scan."""

from __future__ import annotations

from typing import Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _native
from ._registration import Progress
from ._results import Array, Plane, make


class KdTree:
    """The exact k-d tree of the suite. Several threads may ask one tree at once.

    points: (N, 3) float32 or float64 [m]; NaN rows are never found.
    """

    def __init__(
        self, points: Array, *, num_threads: int = 0, progress: Progress = None
    ) -> None:
        self._tree = _native.Tree(points, num_threads, progress)

    def __len__(self) -> int:
        """The number of finite points."""
        return self._tree.size()

    def __repr__(self) -> str:
        return f"KdTree({len(self)} points)"

    def query(
        self,
        queries: Array,
        k: int = 1,
        *,
        max_distance: float = np.inf,
        progress: Progress = None,
    ) -> Tuple[Array, Array]:
        """The k nearest points of each row: distances [m] and rows, both (N, k), nearest first.

        Where there are fewer: infinity and -1. k is at most the number of points.
        """
        return self._tree.query(queries, k, max_distance, progress)

    def query_radius(self, query: npt.ArrayLike, radius: float) -> Tuple[Array, Array]:
        """All points within a radius [m] of one place: distances and rows, nearest first."""
        return self._tree.query_radius(query, radius)


def voxel_downsample(
    points: Array,
    voxel: float,
    *,
    method: str = "mean",
    points_per_voxel: int = 1,
    seed: int = 0,
    progress: Progress = None,
) -> Array:
    """One point for each occupied voxel of `voxel` metres, in the dtype of the points.

    method: mean, centre (of the voxel) or random (points_per_voxel measured points). NaN rows are
    left out.
    """
    options = dict(voxel=voxel, method=method, points_per_voxel=points_per_voxel, seed=seed)
    return _native.voxel_downsample(points, options, progress)


def estimate_normals(
    points: Array,
    *,
    neighbours: int = 20,
    viewpoint: npt.ArrayLike = (0.0, 0.0, 0.0),
    num_threads: int = 0,
    progress: Progress = None,
) -> Array:
    """(N, 3) float32 unit normals towards the viewpoint; zero where a point has none.

    neighbours: points of a patch, 3 to 64.
    """
    options = dict(neighbours=neighbours, viewpoint=viewpoint, num_threads=num_threads)
    return _native.estimate_normals(points, options, progress)


def planes(
    points: Array,
    *,
    method: str = "region-growing",
    viewpoint: npt.ArrayLike = (0.0, 0.0, 0.0),
    voxel: Optional[float] = None,
    noise: Optional[float] = None,
    min_area: float = 0.1,
    num_threads: int = 0,
    progress: Progress = None,
) -> Tuple[Plane, ...]:
    """The planes in a scan, largest area first.

    method: region-growing, ransac or hough. viewpoint: [m] where the scanner stood.
    voxel, noise: [m]; None: estimated. min_area: [m^2].
    """
    options = dict(
        method=method,
        viewpoint=viewpoint,
        voxel=voxel,
        noise=noise,
        min_area=min_area,
        num_threads=num_threads,
    )
    return tuple(make(Plane, plane) for plane in _native.planes(points, options, progress))
