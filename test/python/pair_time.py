# SPDX-License-Identifier: BSD-3-Clause
"""Time of gicp() on a pair of scans, to compare with pair_time (C++), and the memory that a call
takes beside that of the tree. usage: pair_time.py TARGET SOURCE [REPEATS]"""

import resource
import sys
import time
import tracemalloc

import numpy as np

import pcl6d

target, source = (pcl6d.read_scans(name)[0].points for name in sys.argv[1:3])
times = []
for _ in range(int(sys.argv[3]) if len(sys.argv) > 3 else 20):
    start = time.perf_counter()
    result = pcl6d.gicp(source=source, target=target, max_distance=0.5)
    times.append(time.perf_counter() - start)
print(f"Python: least {min(times):.4f} s, median {np.median(times):.4f} s, "
      f"{result.iterations} iterations, x = {result.T_target_source[0, 3]:.17g}")

points = np.random.default_rng(1).random((8_000_000, 3))  # 192 MB of float64
small = points[:10]
pcl6d.voxel_downsample(small, 1.0)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
tracemalloc.start()
try:
    pcl6d.register(source=small[:2], target=points)  # copies the target, then refuses the source
except pcl6d.BadArgument:
    pass
after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print(f"memory: {points.nbytes / 1e6:.0f} MB of float64, {points.nbytes / 2e6:.0f} MB as float32; "
      f"grown by {(after - before) * 1024 / 1e6:.0f} MB, "
      f"numpy's part {tracemalloc.get_traced_memory()[1] / 1e6:.2f} MB")
