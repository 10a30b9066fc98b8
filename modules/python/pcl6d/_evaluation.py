# SPDX-License-Identifier: BSD-3-Clause
"""Errors of trajectories, and the quality of maps."""

from __future__ import annotations

import os
from collections import abc
from typing import Any, Optional, Tuple, Union

import numpy.typing as npt

from . import _native
from ._errors import BadArgument
from ._registration import Progress
from ._results import Array, Errors, MapQuality, ScanQuality, TrajectoryErrors, make

Trajectory = Union[Array, Tuple[Array, Array], str, "os.PathLike[str]"]
"""(N, 4, 4) poses; these and their stamps [s]; or a file: KITTI, TUM, EuRoC, ..."""


def _taken(trajectory: Trajectory) -> Tuple[Any, Any]:
    if isinstance(trajectory, (str, os.PathLike)):
        return _native.read_trajectory(trajectory)
    if isinstance(trajectory, tuple) and len(trajectory) == 2:
        return trajectory
    return trajectory, None


def evaluate_trajectory(
    *,
    estimate: Trajectory,
    reference: Trajectory,
    max_time_difference: float = 0.02,
    interpolation_gap: Optional[float] = None,
    lengths: Optional[abc.Sequence[float]] = None,
    progress: Progress = None,
) -> TrajectoryErrors:
    """Compares a trajectory with a reference: ATE, errors per step, drift per metre, loops.

    max_time_difference: [s] between stamps of a pair. interpolation_gap: [s] of the reference over
    which it is interpolated; None: not. lengths: [m] of drift; None: by the path.
    """
    options = dict(
        max_time_difference=max_time_difference,
        interpolation_gap=interpolation_gap,
        lengths=lengths,
    )
    values = _native.evaluate_trajectory(
        *_taken(estimate), *_taken(reference), options, progress
    )
    errors = {
        key: make(Errors, value) if isinstance(value, dict) else value
        for key, value in values.items()
    }
    return make(TrajectoryErrors, errors)


def evaluate_map(
    *,
    scans: abc.Sequence[Array],
    poses: npt.ArrayLike,
    reference: Optional[Array] = None,
    voxel: float = 0.1,
    radius: Optional[float] = None,
    max_distance: Optional[float] = None,
    planes: bool = True,
    num_threads: int = 0,
    progress: Progress = None,
) -> MapQuality:
    """Measures the map that scans make at their poses (share/doc/measures.md).

    scans: (N, 3) points [m] of each, in its own frame. poses: (N, 4, 4) T_world_scan.
    reference: points of the world. voxel: [m] of the samples; radius of the entropy and
    max_distance [m] follow from it.
    """
    options = dict(
        voxel=voxel,
        radius=radius,
        max_distance=max_distance,
        planes=planes,
        num_threads=num_threads,
    )
    try:
        clouds = list(scans)
    except TypeError as error:
        word = type(scans).__name__
        raise BadArgument(f"scans is a {word}, but must be a list of arrays") from error
    values = _native.evaluate_map(clouds, poses, reference, options, progress)
    values["scans"] = tuple(make(ScanQuality, scan) for scan in values["scans"])
    return make(MapQuality, values)
