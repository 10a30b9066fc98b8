# SPDX-License-Identifier: BSD-3-Clause
"""Pictures for sh_block_inputs.py: chessboards, a textured wall, depth and phase images, as PNG of
one channel; and camera files of OpenCV."""
import math
import random
import struct
import zlib

WIDTH, HEIGHT, FOCAL = 320, 240, 310  # [px] of both cameras, without distortion
BASELINE = 0.06                       # [m] from the left to the right camera
COLUMNS, ROWS, SQUARE = 9, 6, 0.03    # inner corners of the board, [m]


def write_png(path, width, rows, bits=8):
    """A gray picture of 8 or 16 bits."""
    def part(kind, data):
        checked = kind + data
        return struct.pack(">I", len(data)) + checked + struct.pack(">I", zlib.crc32(checked))

    code = ">%d%s" % (width, "B" if bits == 8 else "H")
    data = b"".join(b"\0" + struct.pack(code, *row) for row in rows)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + part(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), bits, 0, 0, 0, 0))
                     + part(b"IDAT", zlib.compress(data)) + part(b"IEND", b""))


def turn_of(number):
    """Rows of the rotation of a board: the first towards its columns."""
    side = number * math.pi / 4
    w, x, y, z = 1, 0.25 * math.cos(side), 0.25 * math.sin(side), 0.03 * (number - 4)
    n = w * w + x * x + y * y + z * z
    return [[(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n],
            [2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n],
            [2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n]]


def board_picture(number, shift):
    """Rows of pixels of a board; the camera is shifted to the right [m]."""
    turn = turn_of(number)
    side = number * math.pi / 4
    middle = ((COLUMNS - 1) * SQUARE / 2, (ROWS - 1) * SQUARE / 2)
    away = (0.05 * math.sin(side), 0.03 * math.cos(side), 0.45 + 0.01 * (number % 4))
    start = [away[k] - turn[k][0] * middle[0] - turn[k][1] * middle[1] for k in range(3)]
    start[0] -= shift
    a, b, normal = ([turn[k][j] for k in range(3)] for j in range(3))
    far = sum(normal[k] * start[k] for k in range(3))
    rows = []
    for v in range(HEIGHT):
        row = []
        for u in range(WIDTH):
            x, y = (u - (WIDTH - 1) / 2) / FOCAL, (v - (HEIGHT - 1) / 2) / FOCAL
            depth = far / (normal[0] * x + normal[1] * y + normal[2])
            p = (depth * x - start[0], depth * y - start[1], depth - start[2])
            column = (p[0] * a[0] + p[1] * a[1] + p[2] * a[2]) / SQUARE
            line = (p[0] * b[0] + p[1] * b[1] + p[2] * b[2]) / SQUARE
            row.append(brightness(column, line))
        rows.append(row)
    return rows


def brightness(column, line):
    """Of the board, in squares from its first inner corner; edges are blurred."""
    if not (-1 < column < COLUMNS and -1 < line < ROWS):
        return 220
    wave = math.sin(math.pi * column) * math.sin(math.pi * line)
    return int(120 + 100 * max(-1.0, min(1.0, 8 * wave)))


def boards(folder, cameras):
    """Pictures of eight boards by each camera: the start of its file names, and 0: left, 1: right."""
    folder.mkdir()
    for number in range(8):
        for name, side in cameras.items():
            write_png(folder / f"{name}{number}.png", WIDTH, board_picture(number, (side - 0.5) * BASELINE))


def textured_pair(path, side):
    """A wall 1.03 m before both cameras: a disparity of 18 px."""
    dice = random.Random(1)
    wall = [[dice.randrange(256) for _ in range(WIDTH + 20)] for _ in range(HEIGHT)]
    write_png(path, WIDTH, [row[18 * side:18 * side + WIDTH] for row in wall])


def depth_images(folder):
    """Two images of a slanted wall, 16 bits [mm], some pixels without a measurement."""
    folder.mkdir()
    for number in range(2):
        rows = [[0 if (u + v) % 97 == 0 else 1500 + 100 * number + u for u in range(640)] for v in range(480)]
        write_png(folder / f"frame{number}.png", 640, rows, 16)


def phase_images(folder):
    """Two images of a time-of-flight camera, which are phases as well as amplitudes."""
    folder.mkdir()
    for number in range(2):
        rows = [[20000 + 500 * number + 10 * u for u in range(176)] for v in range(144)]
        write_png(folder / f"frame{number}.png", 176, rows, 16)


def camera_file(path, width, height, focal):
    """A camera without distortion."""
    numbers = [focal, 0, (width - 1) / 2, 0, focal, (height - 1) / 2, 0, 0, 1]

    def matrix(name, rows, columns, values):
        return (f"{name}: !!opencv-matrix\n   rows: {rows}\n   cols: {columns}\n   dt: d\n"
                f"   data: [ {', '.join(map(str, map(float, values)))} ]\n")

    path.write_text(f"%YAML:1.0\n---\nimage_width: {width}\nimage_height: {height}\n"
                    + matrix("M1", 3, 3, numbers) + matrix("D1", 1, 5, [0] * 5))
