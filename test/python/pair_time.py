# SPDX-License-Identifier: BSD-3-Clause
"""What the Python package costs: icp() and gicp() on a pair of scans against the same registrations
in C++, and the memory of a call beside that of its tree.
usage: pair_time.py PAIR_TIME TARGET SOURCE [ROUNDS]     PAIR_TIME: the program of pair_time.cpp
Each round runs a process of each language, five calls in each, in alternating order. A ratio is the
median over the rounds of Python's least time by C++'s of the same round."""

import resource
import subprocess
import sys
import time

REPEATS = 5


def peak_memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def measure(target_file, source_file, method):
    """Prints the line of pair_time.cpp."""
    import pcl6d

    target, source = (pcl6d.read_scans(name)[0].points for name in (target_file, source_file))
    call = getattr(pcl6d, method)
    before = peak_memory()
    walls, processors = [], []
    for _ in range(REPEATS):
        processor, wall = time.process_time(), time.perf_counter()
        result = call(source=source, target=target, max_distance=0.5)
        walls.append(time.perf_counter() - wall)
        processors.append(time.process_time() - processor)
    print(f"{min(walls):.6f} {min(processors):.6f} {result.iterations} "
          f"{result.T_target_source[0, 3]:.17g} {before} {peak_memory()}")


def numbers_of(command):
    words = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    return [float(word) for word in words]


def compare(program, target, source, method, rounds):
    commands = {"C++": [program, target, source, method, str(REPEATS)],
                "Python": [sys.executable, __file__, "--measure", target, source, method]}
    rows = {"C++": [], "Python": []}
    for i in range(rounds):
        for language in sorted(commands, reverse=i % 2 == 1):
            rows[language].append(numbers_of(commands[language]))
    if any(row[2:4] != rows["C++"][0][2:4] for row in rows["C++"] + rows["Python"]):
        sys.exit(f"{method}: the poses differ: {rows}")
    for language, values in rows.items():
        wall, processor = (min(row[k] for row in values) for k in (0, 1))
        grown = max(row[5] - row[4] for row in values) * 1024 / 1e6
        print(f"{method} {language}: least {wall:.4f} s, {processor:.4f} s of processor time, "
              f"{int(values[0][2])} iterations, peak memory grown by {grown:.1f} MB")
    for k, name in enumerate(("time", "processor time")):
        ratios = sorted(p[k] / c[k] for p, c in zip(rows["Python"], rows["C++"]))
        print(f"{method} {name}: Python / C++ {ratios[len(ratios) // 2]:.3f} "
              f"({ratios[0]:.3f} to {ratios[-1]:.3f} in {rounds} rounds)")


def measure_copy():
    """The memory of a call that copies its target and then refuses its source."""
    import numpy as np
    import pcl6d

    points = np.random.default_rng(1).random((8_000_000, 3))  # 192 MB of float64
    before = peak_memory()
    try:
        pcl6d.register(source=points[:2], target=points)
    except pcl6d.BadArgument:
        pass
    print(f"copy: {points.nbytes / 1e6:.0f} MB of float64, {points.nbytes / 2e6:.0f} MB as float32; "
          f"peak memory grown by {(peak_memory() - before) * 1024 / 1e6:.0f} MB")


def main():
    if sys.argv[1] == "--measure":
        measure(*sys.argv[2:])
        return
    rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 10
    for method in ("icp", "gicp"):
        compare(*sys.argv[1:4], method, rounds)
    measure_copy()


if __name__ == "__main__":
    main()
