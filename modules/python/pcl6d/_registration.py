# SPDX-License-Identifier: BSD-3-Clause
"""Registration and verification of two scans."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy.typing as npt

from . import _native
from ._results import Array, RegistrationResult, Verification, make

Progress = Optional[Callable[[str, int, int], object]]
"""Called with stage, finished steps and all steps (0: not known), in the calling thread."""


def icp(
    *,
    source: Array,
    target: Array,
    guess: Optional[npt.ArrayLike] = None,
    metric: str = "point",
    max_distance: float = 0.25,
    max_distance_start: float = 0.0,
    distance_decay: float = 0.9,
    max_iterations: int = 100,
    robust: str = "none",
    kept_share: float = 1.0,
    search: str = "remembered",
    neighbours: int = 20,
    gicp_epsilon: float = 1e-3,
    translation_epsilon: float = 1e-4,
    rotation_epsilon: float = 1e-5,
    num_threads: int = 0,
    progress: Progress = None,
) -> RegistrationResult:
    """Registers a scan from a guess: closest pairs, the motion that brings them together, again.

    source, target: (N, 3) float32 or float64 [m]; NaN rows are left out.
    guess: 4x4 T_target_source; None: identity.
    metric: point, plane (to the target's planes) or gicp (of planes).
    max_distance: [m] of a pair; with max_distance_start it shrinks from there,
    by the factor distance_decay in each iteration.
    robust: none, huber, cauchy, geman-mcclure. kept_share: of the closest pairs that count.
    neighbours: points of a normal. num_threads: 0: a thread per core; never changes the result.
    """
    options = dict(
        metric=metric,
        max_distance=max_distance,
        max_distance_start=max_distance_start,
        distance_decay=distance_decay,
        max_iterations=max_iterations,
        robust=robust,
        kept_share=kept_share,
        search=search,
        neighbours=neighbours,
        gicp_epsilon=gicp_epsilon,
        translation_epsilon=translation_epsilon,
        rotation_epsilon=rotation_epsilon,
        num_threads=num_threads,
    )
    return make(RegistrationResult, _native.icp(target, source, guess, options, progress))


def gicp(
    *,
    source: Array,
    target: Array,
    guess: Optional[npt.ArrayLike] = None,
    progress: Progress = None,
    **options: Any,
) -> RegistrationResult:
    """Generalized-ICP: icp() with metric="gicp" and the same options."""
    if "metric" in options:
        raise TypeError("gicp() takes no metric: use icp()")
    return icp(
        source=source, target=target, guess=guess, metric="gicp", progress=progress, **options
    )


def ndt(
    *,
    source: Array,
    target: Array,
    guess: Optional[npt.ArrayLike] = None,
    resolution: float = 1.0,
    step_size: float = 0.1,
    outlier_ratio: float = 0.55,
    max_iterations: int = 35,
    min_points: int = 6,
    translation_epsilon: float = 1e-3,
    rotation_epsilon: float = 1e-3,
    num_threads: int = 0,
    progress: Progress = None,
) -> RegistrationResult:
    """The normal distributions transform: a scan on the distributions of the target's cells.

    resolution: [m] side of a cell. min_points: cells with fewer do not count.
    """
    options = dict(
        resolution=resolution,
        step_size=step_size,
        outlier_ratio=outlier_ratio,
        max_iterations=max_iterations,
        min_points=min_points,
        translation_epsilon=translation_epsilon,
        rotation_epsilon=rotation_epsilon,
        num_threads=num_threads,
    )
    return make(RegistrationResult, _native.ndt(target, source, guess, options, progress))


def register(
    *,
    source: Array,
    target: Array,
    voxel: Optional[float] = None,
    min_range: Optional[float] = None,
    max_range: Optional[float] = None,
    max_ambiguity: Optional[float] = None,
    min_overlap: Optional[float] = None,
    any_axis: Optional[bool] = None,
    num_threads: int = 0,
    progress: Progress = None,
) -> RegistrationResult:
    """Registers a scan without a guess. `converged` only if the pose is the one that fits.

    Both scans are in the frames of their scanners, which stood at the origin. None: derived from
    the scans, or the library's default.
    """
    options = dict(
        voxel=voxel,
        min_range=min_range,
        max_range=max_range,
        max_ambiguity=max_ambiguity,
        min_overlap=min_overlap,
        any_axis=any_axis,
        num_threads=num_threads,
    )
    return make(RegistrationResult, _native.register(target, source, options, progress))


def verify(
    *,
    source: Array,
    target: Array,
    T_target_source: npt.ArrayLike,
    source_origin: npt.ArrayLike = (0.0, 0.0, 0.0),
    target_origin: npt.ArrayLike = (0.0, 0.0, 0.0),
    voxel: Optional[float] = None,
    min_range: Optional[float] = None,
    max_range: Optional[float] = None,
    progress: Progress = None,
) -> Verification:
    """Tests a pose by rays and surfaces of both scans, whatever program found it.

    source_origin, target_origin: [m] where each scanner stood, in the frame of its scan.
    """
    options = dict(
        voxel=voxel,
        min_range=min_range,
        max_range=max_range,
        source_origin=source_origin,
        target_origin=target_origin,
    )
    return make(
        Verification, _native.verify(target, source, T_target_source, options, progress)
    )
