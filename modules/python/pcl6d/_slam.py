# SPDX-License-Identifier: BSD-3-Clause
"""6D SLAM: many scans, and folders of scans."""

from __future__ import annotations

import os
from typing import Any, Optional, Union

import numpy.typing as npt

from . import _native
from ._registration import Progress
from ._results import Array, ScanResult, SlamResult, make, verdict_of
from ._runs import Run

Path = Union[str, "os.PathLike[str]"]


class Slam6D:
    """Scans and rough poses in, a consistent map out.

    Options have the names of pcl_slam6d with underscores (share/doc/options.md), such as voxel,
    max_distance, metric, initial_guess="global" (no poses needed), loop_closing, relaxation.
    None, or not given: derived from the scans. Use one object in one thread at a time.
    """

    def __init__(self, **options: Any) -> None:
        self._slam = _native.Slam(options)

    def add_scan(
        self,
        points: Array,
        initial_pose: Optional[npt.ArrayLike] = None,
        *,
        name: str = "",
        progress: Progress = None,
    ) -> None:
        """Adds a scan: (N, 3) points [m] in its own frame, 4x4 rough T_world_scan."""
        self._slam.add_scan(points, initial_pose, name, progress)

    def optimize(self, *, progress: Progress = None) -> SlamResult:
        """Registers all scans. After Ctrl-C, calling it again goes on."""
        self._slam.optimize(progress)
        return self.result

    @property
    def result(self) -> SlamResult:
        """Results so far: scans that are not yet registered are pending."""
        values = self._slam.result()
        values["scans"] = tuple(make(ScanResult, scan) for scan in values["scans"])
        values["verification"] = verdict_of(values["verification"])
        return make(SlamResult, values)


def map_folder(
    folder: Path,
    output: Path,
    *,
    format: Optional[str] = None,
    poses: Optional[Path] = None,
    first: int = 0,
    last: Optional[int] = None,
    every: int = 1,
    progress: Progress = None,
    **options: Any,
) -> Run:
    """Maps a folder of scans, or a file that holds several, and writes a run folder.

    Poses and files are those of `pcl_slam6d FOLDER --output OUTPUT --track off --moving keep
    --no-picture`, with the same options (names with underscores). `output` must not exist, or be
    empty: it appears when the run is complete.
    poses: file of initial poses; None: those of the folder. first, last, every: which scans.
    """
    reading = dict(format=format, poses=poses, first=first, last=last, every=every)
    _native.map_folder(folder, output, reading, options, progress)
    return Run.open(output)
