# SPDX-License-Identifier: BSD-3-Clause
"""Scans and runs on disk."""

from __future__ import annotations

import os
from collections import abc
from typing import Any, List, Optional, Tuple, Union, overload

import numpy.typing as npt

from . import _native
from ._registration import Progress
from ._results import (
    Array,
    Link,
    MapPoints,
    MapVerdict,
    Scan,
    ScanResult,
    make,
    poses_of,
    verdict_of,
)

Path = Union[str, "os.PathLike[str]"]


class Scans(abc.Sequence[Scan]):
    """The scans of a folder, each read when it is asked for."""

    def __init__(self, folder: _native.Folder, progress: Progress) -> None:
        self._folder = folder
        self._progress = progress

    def __len__(self) -> int:
        return self._folder.size()

    @overload
    def __getitem__(self, i: int) -> Scan: ...

    @overload
    def __getitem__(self, i: slice) -> Tuple[Scan, ...]: ...

    def __getitem__(self, i: Union[int, slice]) -> Union[Scan, Tuple[Scan, ...]]:
        if isinstance(i, slice):
            return tuple(self[k] for k in range(*i.indices(len(self))))
        if not -len(self) <= i < len(self):
            raise IndexError(f"scan {i} of {len(self)}")
        return make(Scan, self._folder.read(i % len(self), self._progress))

    def __iter__(self) -> abc.Iterator[Scan]:
        for i in range(len(self)):
            scan = make(Scan, self._folder.read(i, None))
            if self._progress is not None:
                self._progress("reading", i + 1, len(self))
            yield scan

    def __repr__(self) -> str:
        return f"Scans({len(self)} scans, poses from {self.pose_source})"

    @property
    def pose_source(self) -> str:
        """Where the initial poses come from."""
        return self._folder.pose_source()

    @property
    def note(self) -> str:
        """How points far from the origin were brought near; empty: they are not far."""
        return self._folder.note()


def read_scans(
    path: Path,
    *,
    format: Optional[str] = None,
    poses: Optional[Path] = None,
    first: int = 0,
    last: Optional[int] = None,
    every: int = 1,
    progress: Progress = None,
) -> Scans:
    """Opens a folder of scans, a scan, or a file of several (E57, PTX, recordings of robots).

    format: pcd, ply, uos, las, ...; None: by extension. poses: KITTI or TUM file; None: those of
    the folder. first, last, every: which scans.
    """
    options = dict(format=format, poses=poses, first=first, last=last, every=every)
    return Scans(_native.Folder(path, options, progress), progress)


def write_map(
    path: Path,
    points: Array,
    *,
    pose: Optional[npt.ArrayLike] = None,
    intensity: Optional[abc.Sequence[float]] = None,
    format: Optional[str] = None,
    progress: Progress = None,
) -> List[str]:
    """Writes points, in the format of the extension: pcd, ply, las, laz, ptx, 3d, xyz, bin.

    float64 points keep their digits where the format has them. pose: 4x4 T_world_scan.
    Returns what the file does not hold, in words.
    """
    options = dict(format=format, intensity=intensity)
    return _native.write_map(path, points, pose, options, progress)


class Run:
    """A run folder of pcl_slam6d or map_folder(). The summary is read at once, files when they
    are asked for."""

    def __init__(self, path: Path) -> None:
        self._folder = _native.RunFolder(path)
        self._path = os.fspath(path)
        self._summary = self._folder.summary()
        self._scans = tuple(make(ScanResult, scan) for scan in self._summary["scans"])

    @classmethod
    def open(cls, path: Path) -> "Run":
        """Opens a run folder; raises FileError if there is none, or its summary is broken."""
        return cls(path)

    def __repr__(self) -> str:
        word = "reliable" if self.reliable else "not reliable"
        return f"Run({self._path!r}, {len(self._scans)} scans, {word})"

    @property
    def path(self) -> str:
        return self._path

    @property
    def scans(self) -> Tuple[ScanResult, ...]:
        return self._scans

    @property
    def poses(self) -> Array:
        """(N, 4, 4) T_world_scan in full coordinates."""
        return poses_of(self._scans)

    @property
    def reliable(self) -> bool:
        """Whether every scan is registered, converged and connected with the first scan, and the
        verification does not call the map doubtful or ambiguous; pcl_slam6d then exits with 0."""
        return bool(self._summary["reliable"])

    @property
    def complete(self) -> bool:
        """False: the run was interrupted."""
        return bool(self._summary["complete"])

    @property
    def verdict(self) -> str:
        """The verdict in words, as pcl_slam6d prints it."""
        return str(self._summary["verdict"])

    @property
    def warnings(self) -> Tuple[str, ...]:
        return tuple(self._summary["warnings"])

    @property
    def verification(self) -> Optional[MapVerdict]:
        """The verdict, with the tests of links from verification.csv; None: not verified."""
        return verdict_of(self._folder.verification())

    @property
    def options(self) -> abc.Mapping[str, str]:
        return dict(self._summary["options"])

    @property
    def missing(self) -> Tuple[str, ...]:
        """Files that a finished run has and this one has not."""
        return tuple(self._summary["missing"])

    def map(self, *, progress: Progress = None) -> MapPoints:
        """The points of map.pcd."""
        values = self._folder.map(progress)
        return make(MapPoints, {**values, "world_offset": self._summary["world_offset"]})

    def scan(self, i: int, *, progress: Progress = None) -> Array:
        """(N, 3) float32 points of the i-th scan in its own frame, without dynamic ones."""
        if not -len(self._scans) <= i < len(self._scans):
            raise IndexError(f"scan {i} of {len(self._scans)}")
        return self._folder.scan(i % len(self._scans), progress)

    def links(self) -> Tuple[Link, ...]:
        """The links between scans, and candidates, of links.csv."""
        return tuple(make(Link, link) for link in self._folder.links())

    def to_dict(self) -> dict[str, Any]:
        """The summary as numbers, words, lists and dicts."""
        verification = self.verification
        return {
            "path": self._path,
            "scans": [scan.to_dict() for scan in self._scans],
            "reliable": self.reliable,
            "complete": self.complete,
            "verdict": self.verdict,
            "warnings": list(self.warnings),
            "verification": verification and verification.to_dict(),
            "options": dict(self.options),
            "missing": list(self.missing),
        }
