# SPDX-License-Identifier: BSD-3-Clause
"""Maps a folder of scans and draws it from above. usage: map_folder.py SCAN_DIR OUT_DIR"""

import sys

import numpy as np

import pcl6d

run = pcl6d.map_folder(sys.argv[1], sys.argv[2], progress=lambda *step: print(*step))
print(run.verdict)
x, y, z = run.map().world.T
path = run.poses[:, :2, 3]
try:
    import matplotlib.pyplot as plt

    plt.scatter(x, y, s=0.1, c=z)
    plt.plot(*path.T, "r.-")
    plt.axis("equal")
    plt.savefig(f"{run.path}/plot.png", dpi=150)
except ImportError:  # a grey picture that any viewer opens
    counts = np.histogram2d(y, x, bins=600)[0][::-1]
    grey = np.uint8(255 / (1 + counts))
    with open(f"{run.path}/plot.pgm", "wb") as file:
        file.write(b"P5 600 600 255\n" + grey.tobytes())
