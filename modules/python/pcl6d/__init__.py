# SPDX-License-Identifier: BSD-3-Clause
"""6D SLAM from 3D scans: registration, verification, maps of folders, evaluation.

Points are (N, 3) arrays of float32 or float64 [m], poses 4x4 float64 T_target_source. Long calls
let other threads run, take progress= and stop on Ctrl-C.
"""

import atexit

try:
    from . import _native
except ImportError as _error:
    raise ImportError(
        f"pcl6d: the extension module cannot be loaded: {_error}; install the missing library "
        "(Debian: apt --fix-broken install), or build the package for this Python"
    ) from _error
from ._errors import BadArgument, ComputeFailed, FileError
from ._evaluation import evaluate_map, evaluate_trajectory
from ._points import KdTree, estimate_normals, planes, voxel_downsample
from ._registration import gicp, icp, ndt, register, verify
from ._results import (
    Errors,
    Link,
    LinkTest,
    MapPoints,
    MapQuality,
    MapVerdict,
    Plane,
    RegistrationResult,
    Result,
    Scan,
    ScanQuality,
    ScanResult,
    SlamResult,
    TrajectoryErrors,
    Verification,
)
from ._runs import Run, Scans, read_scans, write_map
from ._slam import Slam6D, map_folder

__version__: str = _native.version

__all__ = [
    "BadArgument",
    "ComputeFailed",
    "Errors",
    "FileError",
    "KdTree",
    "Link",
    "LinkTest",
    "MapPoints",
    "MapQuality",
    "MapVerdict",
    "Plane",
    "RegistrationResult",
    "Result",
    "Run",
    "Scan",
    "ScanQuality",
    "ScanResult",
    "Scans",
    "Slam6D",
    "SlamResult",
    "TrajectoryErrors",
    "Verification",
    "estimate_normals",
    "evaluate_map",
    "evaluate_trajectory",
    "gicp",
    "icp",
    "map_folder",
    "ndt",
    "planes",
    "read_scans",
    "register",
    "verify",
    "voxel_downsample",
    "write_map",
]

atexit.register(_native.wait_for_stopped)
