# SPDX-License-Identifier: BSD-3-Clause
"""Inputs of the names in the documents, for sh_blocks.py: SHELL_MADE by lines of sh with our
programs, PYTHON_MADE by functions here, from other inputs. Both are made in a common folder."""
import json
import math
import pathlib
import re
import struct

from sh_block_pictures import (boards, camera_file, depth_images, phase_images, textured_pair)

# Names of placeholders whose file needs an extension.
FILE_NAMES = {"SCAN_A": "scan_a.pcd", "SCAN_B": "scan_b.pcd"}

SHELL_MADE = {
    # Ten scans of a corridor, 1.1 m apart, and their map.
    "corridor_50": "pcl_slam6d_simulate corridor -o corridor_50 --scans 50 --resolution 2",
    "SCAN_DIR": """mkdir SCAN_DIR
        cp corridor_50/scan00?.pcd SCAN_DIR
        for poses in odometry groundtruth; do head -n 10 corridor_50/$poses.txt > SCAN_DIR/$poses.txt; done""",
    "OUT": "pcl_slam6d SCAN_DIR -o OUT",
    "OUT_DIR": "cp -r OUT OUT_DIR",
    "RUN_DIR": "cp -r OUT RUN_DIR",
    "kurt3d": "pcl_slam6d_convert scans SCAN_DIR -o kurt3d --format uos",
    "scan000.3d": "cp kurt3d/scan000.3d scan000.3d",
    "site.e57": "pcl_slam6d_convert scans SCAN_DIR -o site.e57",
    "tile.laz": "pcl_slam6d_convert scans SCAN_DIR/scan000.pcd -o tile.laz",
    "result.txt": "cp OUT/trajectory.kitti result.txt",
    "graph.g2o": "cp OUT/graph.g2o graph.g2o",
    "sphere2500.txt": "pcl_slam6d_graph convert OUT/graph.g2o -o sphere2500.txt --format toro",
    # A drive with a scan each 0.22 m, whose first 25 become a recording.
    "corridor_250": "pcl_slam6d_simulate corridor -o corridor_250 --scans 250 --resolution 3",
    "sweeps": """mkdir sweeps
        cp corridor_250/scan00?.pcd corridor_250/scan01?.pcd corridor_250/scan02[0-4].pcd sweeps
        head -n 25 corridor_250/odometry.txt > sweeps/odometry.txt""",
    "sweeps_xyz": "pcl_slam6d_convert scans sweeps -o sweeps_xyz --format xyz",
    # A room with four spheres. The second of twelve stops is at 0.93 0.25 0 0 0 30 of the first.
    "SITE": "pcl_slam6d_simulate room.json -o SITE --scans 1 --scanner terrestrial --resolution 0.3 --noise 0.002",
    "stops": "pcl_slam6d_simulate room.json -o stops --scans 12 --resolution 2",
    "SCAN_A": "cp stops/scan000.pcd SCAN_A",
    "SCAN_B": "cp stops/scan001.pcd SCAN_B",
}

SPHERES = ((2.5, 0.5, 1.4), (-2.2, 1.5, 1.7), (-0.5, -3, 1.2), (0.8, 3.4, 2))
SPHERE_RADIUS = 0.0725  # [m]
BOXES = (  # middles and sizes [m] of walls, floor, ceiling and furniture
    ((0, 5, 1.5), (12, 0.2, 3)), ((0, -5, 1.5), (12, 0.2, 3)), ((6, 0, 1.5), (0.2, 10, 3)),
    ((-6, 0, 1.5), (0.2, 10, 3)), ((0, 0, -0.1), (12, 10, 0.2)), ((0, 0, 3.1), (12, 10, 0.2)),
    ((4, 3, 0.5), (1, 1.5, 1)), ((-4, 2, 1), (0.8, 0.6, 2)), ((-3, -4, 0.4), (1.6, 0.8, 0.8)))


def write_room(path):
    """A room with spheres, and a way along a regular polygon of twelve sides of 1 m."""
    steps = [math.pi * k / 24 for k in range(25)]
    profile = [[max(1e-4, SPHERE_RADIUS * math.sin(a)), SPHERE_RADIUS * (1 - math.cos(a))] for a in steps]
    bodies = [{"type": "box", "material": "paint", "centre": c, "size": s} for c, s in BOXES]
    bodies += [{"type": "revolved", "material": "paint", "foot": [x, y, z - SPHERE_RADIUS],
                "profile": profile, "segments": 48} for x, y, z in SPHERES]
    radius = 0.5 / math.sin(math.pi / 12)
    way = [[radius * math.cos(math.pi * k / 6), radius * math.sin(math.pi * k / 6), 0] for k in range(12)]
    path.write_text(json.dumps({"name": "room", "max_range": 30, "materials": {"paint": {"reflectance": 0.6}},
                                "bodies": bodies, "waypoints": way}))


def write_control(path):
    """The centres of the spheres in large coordinates."""
    path.write_text("".join(f"P{k} {3000 + x} {5000 + y} {z}\n" for k, (x, y, z) in enumerate(SPHERES)))


def json_of(page):
    """The block of JSON in a page of share/doc."""
    path = pathlib.Path(__file__).resolve().parents[2] / "share/doc" / page
    return json.loads(re.findall(r"```json\n(.*?)```", path.read_text(), re.S)[0])


def write_rules(path):
    """The rules in planes.md."""
    path.write_text(json.dumps(json_of("planes.md")))


def write_suite(path):
    """The suite in benchmark.md, with small data and one run of each."""
    suite = json_of("benchmark.md")
    suite["repetitions"] = 1
    suite["data"]["flat"]["simulate"].update(scans=3, resolution=3)
    scans = path.parent / "SCAN_DIR"
    suite["data"]["street"].update(folder=str(scans), reference=str(scans / "groundtruth.txt"))
    path.write_text(json.dumps(suite))


def counted(data):
    """Bytes after their number."""
    return struct.pack("<I", len(data)) + data


def record(fields, data):
    """A record of a ROS 1 bag."""
    return counted(b"".join(counted(name.encode() + b"=" + value) for name, value in fields)) + counted(data)


def header_of_message(number, stamp, frame):
    """std_msgs/Header."""
    return struct.pack("<III", number, *stamp) + counted(frame)


def cloud_message(number, stamp, points):
    """sensor_msgs/PointCloud2 of x y z."""
    fields = b"".join(counted(name) + struct.pack("<IBI", 4 * k, 7, 1) for k, name in enumerate((b"x", b"y", b"z")))
    data = b"".join(struct.pack("<fff", *point) for point in points)
    return (header_of_message(number, stamp, b"base") + struct.pack("<III", 1, len(points), 3) + fields
            + struct.pack("<BII", 0, 12, len(data)) + counted(data) + b"\1")


def odometry_message(number, stamp, row):
    """nav_msgs/Odometry of a row of 12 numbers, turned about z only."""
    half = math.atan2(row[4], row[0]) / 2
    pose = (row[3], row[7], row[11], 0, 0, math.sin(half), math.cos(half))
    return header_of_message(number, stamp, b"odom") + counted(b"base") + struct.pack("<85d", *pose, *[0] * 78)


def write_bag(path):
    """A recording of clouds and odometry, of the scans in sweeps_xyz, ten a second."""
    sweeps = sorted((path.parent / "sweeps_xyz").glob("*.xyz"))
    rows = (path.parent / "sweeps/odometry.txt").read_text().splitlines()
    topics = ((b"/points", b"sensor_msgs/PointCloud2"), (b"/odom", b"nav_msgs/Odometry"))
    connections = b"".join(
        record([("op", b"\7"), ("conn", struct.pack("<I", k)), ("topic", topic)],
               b"".join(map(counted, (b"topic=" + topic, b"type=" + kind, b"md5sum=*", b"message_definition="))))
        for k, (topic, kind) in enumerate(topics))
    chunk, entries = connections, [b"", b""]
    for number, (sweep, row) in enumerate(zip(sweeps, rows)):
        stamp = (1600000000 + number // 10, number % 10 * 100000000)
        points = [[float(word) for word in line.split()[:3]] for line in sweep.read_text().splitlines()]
        messages = (cloud_message(number, stamp, points),
                    odometry_message(number, stamp, [float(word) for word in row.split()]))
        for k, message in enumerate(messages):
            time = struct.pack("<II", *stamp)
            entries[k] += time + struct.pack("<I", len(chunk))
            chunk += record([("op", b"\2"), ("conn", struct.pack("<I", k)), ("time", time)], message)
    path.write_bytes(bag_of(chunk, connections, entries))


def bag_of(chunk, connections, entries):
    """A bag of a single chunk, with its index."""
    start = 13 + 4096
    body = record([("op", b"\5"), ("compression", b"none"), ("size", struct.pack("<I", len(chunk)))], chunk)
    counts = b""
    for k, entry in enumerate(entries):
        numbers = struct.pack("<I", k), struct.pack("<I", len(entry) // 12)
        body += record([("op", b"\4"), ("ver", struct.pack("<I", 1)), ("conn", numbers[0]),
                        ("count", numbers[1])], entry)
        counts += b"".join(numbers)
    head = [("op", b"\3"), ("index_pos", struct.pack("<Q", start + len(body))),
            ("conn_count", struct.pack("<I", len(entries))), ("chunk_count", struct.pack("<I", 1))]
    info = [("op", b"\6"), ("ver", struct.pack("<I", 1)), ("chunk_pos", struct.pack("<Q", start)),
            ("start_time", bytes(8)), ("end_time", bytes(8)), ("count", struct.pack("<I", len(entries)))]
    padding = b" " * (4096 - len(record(head, b"")))
    return b"#ROSBAG V2.0\n" + record(head, padding) + body + connections + record(info, counts)


# Name: the inputs that it is made of, and the function that makes it.
PYTHON_MADE = {
    "room.json": ((), write_room),
    "control.csv": ((), write_control),
    "my_rules.json": ((), write_rules),
    "my_suite.json": (("SCAN_DIR",), write_suite),
    "drive.bag": (("sweeps_xyz", "sweeps"), write_bag),
    "camera.yml": ((), lambda path: camera_file(path, 640, 480, 525)),
    "tof.yml": ((), lambda path: camera_file(path, 176, 144, 240)),
    "frames": ((), depth_images),
    "phases": ((), phase_images),
    "amplitudes": ((), phase_images),
    "pictures": ((), lambda path: boards(path, {"board": 0})),
    "both": ((), lambda path: boards(path, {"left": 0, "right": 1})),
    "lefts": ((), lambda path: boards(path, {"board": 0})),
    "rights": ((), lambda path: boards(path, {"board": 1})),
    "left.png": ((), lambda path: textured_pair(path, 0)),
    "right.png": ((), lambda path: textured_pair(path, 1)),
}
