# SPDX-License-Identifier: BSD-3-Clause
"""What functions return: frozen values with a short repr and to_dict()."""

from __future__ import annotations

import dataclasses
from collections import abc
from dataclasses import dataclass
from typing import Any, Optional, Tuple, Type, TypeVar

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]
_R = TypeVar("_R", bound="Result")


def _plain(value: Any) -> Any:
    if isinstance(value, Result):
        return value.to_dict()
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, (tuple, list)):
        return [_plain(entry) for entry in value]
    if isinstance(value, abc.Mapping):
        return {key: _plain(entry) for key, entry in value.items()}
    return value


def _short(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"<{'x'.join(map(str, value.shape))} {value.dtype}>"
    if isinstance(value, tuple) and len(value) > 3:
        return f"<{len(value)} entries>"
    if isinstance(value, float):
        return f"{value:.6g}"
    return repr(value)


@dataclass(frozen=True, eq=False, repr=False)
class Result:
    """Base of all results. Fields cannot be set, arrays are read-only."""

    def __post_init__(self) -> None:
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
            elif isinstance(value, list):
                object.__setattr__(self, field.name, tuple(value))

    def __repr__(self) -> str:
        values = (f"{f.name}={_short(getattr(self, f.name))}" for f in dataclasses.fields(self))
        return f"{type(self).__name__}({', '.join(values)})"

    def to_dict(self) -> dict[str, Any]:
        """All fields as numbers, words, lists and dicts, as json takes them."""
        return {f.name: _plain(getattr(self, f.name)) for f in dataclasses.fields(self)}


def make(kind: Type[_R], values: abc.Mapping[str, Any]) -> _R:
    return kind(**values)


@dataclass(frozen=True, eq=False, repr=False)
class RegistrationResult(Result):
    """The pose of a source on a target, and how far to trust it."""

    T_target_source: Array
    """4x4: maps source points to the target's frame."""
    converged: bool
    """At rest, and the surfaces fix the pose; of register(): the pose is unique."""
    status: str
    """ok, rank-deficient, too-few-pairs, max-iterations, diverged; of register(): unique,
    ambiguous, none."""
    num_inliers: int
    """Pairs that count; of ndt(): source points near a distribution."""
    fitness: float
    """Share of the source with a partner, in [0, 1]."""
    inlier_rmse: Optional[float]
    """[m] distance of the pairs; None without pairs, as of ndt()."""
    covariance: Optional[Array]
    """6x6 of x y z roll pitch yaw [m, rad]; None if the pairs do not fix the pose, and of ndt()."""
    free_directions: Array
    """(k, 6): motions (translation [m], rotation [rad]) that the surfaces leave open, about the
    centroid of the pairs in the target's axes; empty: none."""
    iterations: int
    reason: str
    """Why it stopped, or was not unique, in words."""


@dataclass(frozen=True, eq=False, repr=False)
class Verification(Result):
    """Test of the relative pose of two scans, by their rays and surfaces."""

    result: str
    """good, weak, unverified or wrong."""
    probability_wrong: float
    reason: str
    num_patches: int
    """Patches of surface tested by the rays of the other scan."""
    num_violated: int
    """Patches that these rays passed through."""
    num_inliers: int
    fitness: float
    inlier_rmse: float
    shift: float
    """[m] shift of the source that the surfaces ask for."""
    deviation: float
    """[m] standard deviation of the shift."""
    covariance: Optional[Array]
    free_directions: Array

    @property
    def consistent(self) -> bool:
        """Whether the result is good: rays and surfaces confirm the pose."""
        return self.result == "good"


@dataclass(frozen=True, eq=False, repr=False)
class ScanResult(Result):
    """A scan of a map."""

    name: str
    index: int
    T_world_scan: Array
    initial_pose: Array
    state: str
    """fixed, matched, unconverged, predicted or pending."""
    status: str
    converged: bool
    num_points: int
    num_inliers: int
    fitness: float
    inlier_rmse: float
    iterations: int
    covariance: Optional[Array]
    reason: str
    """Why a match was rejected; else empty."""


@dataclass(frozen=True, eq=False, repr=False)
class LinkTest(Result):
    """Test of a link between two scans of a map, given by their indices."""

    first: int
    second: int
    result: str
    """good, weak, unverified or wrong."""
    probability_wrong: float
    reason: str


@dataclass(frozen=True, eq=False, repr=False)
class MapVerdict(Result):
    """The verdict on a map, from the points and rays of its scans."""

    verdict: str
    """good, doubtful, ambiguous or unverified."""
    doubts: Tuple[str, ...]
    links: Tuple[LinkTest, ...]


@dataclass(frozen=True, eq=False, repr=False)
class SlamResult(Result):
    """The map of a Slam6D."""

    scans: Tuple[ScanResult, ...]
    reliable: bool
    """Every scan is registered, converged and connected with the first scan, and the verdict is
    good or unverified."""
    verification: Optional[MapVerdict]
    parameters: abc.Mapping[str, str]
    """Lengths that were given, or derived from the scans."""
    disconnected: Tuple[int, ...]
    """Scans without a link to the first one."""

    @property
    def poses(self) -> Array:
        """(N, 4, 4) T_world_scan."""
        return poses_of(self.scans)


@dataclass(frozen=True, eq=False, repr=False)
class Scan(Result):
    """A scan as it was read. Its points are near the origin, and `initial_pose` belongs to them."""

    name: str
    index: int
    points: Array
    """(N, 3) float32 [m]."""
    initial_pose: Array
    stamp: Optional[float]
    intensity: Optional[Array]
    num_dropped: int
    """Points left out because they were not finite."""


@dataclass(frozen=True, eq=False, repr=False)
class MapPoints(Result):
    """The points of a map."""

    points: Array
    """(N, 3) float32 [m], relative to world_offset."""
    world_offset: Array
    scan: Optional[Array]
    """Index of the scan of each point."""
    intensity: Optional[Array]

    @property
    def world(self) -> Array:
        """(N, 3) float64 [m] in the world."""
        return self.points.astype(np.float64) + self.world_offset


@dataclass(frozen=True, eq=False, repr=False)
class Link(Result):
    """A link of a run between two scans, by their indices."""

    first: int
    second: int
    kind: str
    verdict: str
    reason: str
    num_inliers: int
    inlier_rmse: float
    fitness: float


@dataclass(frozen=True, eq=False, repr=False)
class Plane(Result):
    """A bounded part of the plane normal . p = offset."""

    normal: Array
    offset: float
    hull: Array
    """(N, 3) corners [m] of the convex hull."""
    area: float
    num_inliers: int
    inlier_rmse: float
    indices: Array
    """Rows of the points on it."""


@dataclass(frozen=True, eq=False, repr=False)
class Errors(Result):
    """One kind of error: [m] of positions, [rad] of orientations."""

    count: int
    rmse: float
    mean: float
    median: float
    max: float


@dataclass(frozen=True, eq=False, repr=False)
class TrajectoryErrors(Result):
    """How far a trajectory is from a reference."""

    num_pairs: int
    matched_by_time: bool
    path_length: float
    alignment: Array
    """4x4 T_reference_estimate that was applied."""
    status: str
    """Of the alignment: ok, rank-deficient or too-few-pairs."""
    position: Errors
    """After alignment: its rmse is the absolute trajectory error (ATE)."""
    orientation: Errors
    position_without_alignment: Errors
    orientation_without_alignment: Errors
    step_translation: Errors
    step_rotation: Errors
    translation_per_metre: float
    """Drift; times 100 it is KITTI's percent."""
    rotation_per_metre: float
    loop_translation: Errors


@dataclass(frozen=True, eq=False, repr=False)
class ScanQuality(Result):
    """Quality of the map around one scan. NaN: nothing to measure."""

    num_neighbours: int
    agreement: float
    entropy: float
    thickness: float
    distance_to_others: float
    distance_to_reference: float
    stands_out: Tuple[str, ...]
    """Measures by which it stands out, worst first."""


@dataclass(frozen=True, eq=False, repr=False)
class MapQuality(Result):
    """How good a map is, without its true poses. NaN: nothing to measure."""

    num_pairs: int
    agreement: float
    entropy: float
    plane_variance: float
    thickness: float
    """[m] rms of the points of all scans to the planes of single ones."""
    distance_to_others: float
    distance_to_reference: float
    revisit_blur: float
    scans: Tuple[ScanQuality, ...]
    worst_first: Tuple[int, ...]


def poses_of(scans: Tuple[ScanResult, ...]) -> Array:
    if not scans:
        return np.empty((0, 4, 4))
    return np.stack([scan.T_world_scan for scan in scans])


def verdict_of(values: Optional[abc.Mapping[str, Any]]) -> Optional[MapVerdict]:
    if values is None:
        return None
    links = tuple(make(LinkTest, link) for link in values["links"])
    return make(MapVerdict, {**values, "links": links})
