#!/usr/bin/env python3
"""Makes a maize plant for pleinair: model, structure image of a blade, and a scene.

    python3 docs/examples/maize/maize.py out/maize
    pleinair replay recordings/courtyard_midday --scene out/maize/scene.toml -o out/maize/replay

A blade is a bent strip that narrows to its tip; u runs across it, with the main vein in the middle, v
from the stem to the tip. Needs nothing but Python.
"""
import argparse
import math
import os
import pathlib
import random
import struct
import zlib

HEIGHT_M = 0.55  # Of a plant with nine leaves, in pot size for a courtyard.
BLADES = 9
ALONG, ACROSS = 24, 6  # Parts of a blade.
# Date, chlorophyll and carotenoids in µg/cm², brown pigments.
SEASON = [
    ("2025-05-15", 18, 5, 0.0),
    ("2025-07-10", 55, 11, 0.0),
    ("2025-09-10", 30, 9, 0.0),
    ("2025-10-10", 2, 8, 0.8),
]


def write_png(path, width, height, pixel):
    """Writes an RGB image; pixel(x, y) gives three numbers of 0 to 255."""
    rows = b"".join(
        b"\0" + bytes(value for x in range(width) for value in pixel(x, y)) for y in range(height)
    )

    def chunk(name, data):
        body = name + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + data)


def structure(x, y, width):
    """Red: main vein; green: secondary veins, parallel in grasses; blue: mesophyll."""
    across = abs((x + 0.5) / width - 0.5)
    main = max(0.0, 1.0 - across / 0.035)
    secondary = 0.6 if x % 8 == 0 else 0.0
    secondary *= 1.0 - main
    mesophyll = 1.0 - main - secondary
    return tuple(round(255 * share) for share in (main, secondary, mesophyll))


class Obj:
    def __init__(self):
        self.lines, self.count = ["mtllib maize.mtl"], 0

    def grid(self, material, point, rows, columns):
        """Adds a surface of rows x columns parts; point(u, v) with u and v of 0 to 1."""
        first = self.count + 1
        self.lines.append(f"usemtl {material}")
        for row in range(rows + 1):
            for column in range(columns + 1):
                u, v = column / columns, row / rows
                x, y, z = point(u, v)
                self.lines.append(f"v {x:.5f} {y:.5f} {z:.5f}")
                self.lines.append(f"vt {u:.4f} {v:.4f}")
                self.count += 1
        for row in range(rows):
            for column in range(columns):
                a = first + row * (columns + 1) + column
                b, c, d = a + 1, a + columns + 2, a + columns + 1
                self.lines.append("f " + " ".join(f"{i}/{i}" for i in (a, b, c, d)))


def blade(rng, index):
    azimuth = math.radians(180.0 * index + rng.uniform(-25, 25))  # Two rows, as maize has.
    start = HEIGHT_M * (0.12 + 0.72 * index / BLADES)
    length = HEIGHT_M * (0.75 + 0.5 * math.sin(math.pi * (index + 1) / (BLADES + 1)))
    width = 0.075 * length
    rise = math.radians(rng.uniform(60, 72))
    droop = math.radians(rng.uniform(95, 135))
    waves = rng.uniform(0, 2 * math.pi)

    def point(u, v):
        # The middle line: an arc whose slope falls from `rise` by `droop`.
        out = up = 0.0
        steps = 40
        for i in range(round(steps * v)):
            slope = rise - droop * ((i + 0.5) / steps) ** 1.5
            out += math.cos(slope) * length / steps
            up += math.sin(slope) * length / steps
        side = (u - 0.5) * width * 2 * min(1.0, 0.55 + 2.5 * v) * (1 - v**2.2)
        fold = abs(u - 0.5) * width * 0.7 * (1 - v)  # V-shaped near the stem.
        fold += 0.006 * math.sin(9 * v + waves) * (u - 0.5)
        x = 0.008 + out
        return (
            x * math.cos(azimuth) - side * math.sin(azimuth),
            x * math.sin(azimuth) + side * math.cos(azimuth),
            start + up + fold,
        )

    return point


def stem(u, v):
    radius = 0.009 * (1 - 0.6 * v)
    angle = 2 * math.pi * u
    return radius * math.cos(angle), radius * math.sin(angle), HEIGHT_M * 0.95 * v


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--chlorophyll", type=float, default=45.0, help="µg/cm²; default 45")
    parser.add_argument("--carotenoids", type=float, default=9.0, help="µg/cm²; default 9")
    parser.add_argument("--season", action="store_true", help="the contents from May to October")
    parser.add_argument("--opaque", action="store_true", help="a scene of opaque twins")
    arguments = parser.parse_args()
    folder = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)

    rng = random.Random(1)
    obj = Obj()
    obj.grid("stem", stem, 8, 8)
    for index in range(BLADES):
        obj.grid("blade", blade(rng, index), ALONG, ACROSS)
    (folder / "maize.obj").write_text("\n".join(obj.lines) + "\n")
    (folder / "maize.mtl").write_text(
        "newmtl stem\nKd 0.09 0.15 0.04\nnewmtl blade\nKd 0.06 0.12 0.035\n"
    )
    width, height = 128, 256
    write_png(folder / "structure.png", width, height, lambda x, y: structure(x, y, width))

    courtyard = pathlib.Path(__file__).resolve().parents[3] / "recordings" / "courtyard_midday"
    phantom = os.path.relpath(courtyard / "phantom.obj", folder.resolve())
    scene = (
        "# Place, time and marker are the recording's.\n"
        f'[[phantom]]\nfile = "{phantom}"\n\n'
        '[[object]]\nfile = "maize.obj"\nshading = "smooth"\ntranslation_m = [0.55, 0.35, 0]\n'
    )
    if not arguments.opaque:
        scene += (
            '\n[[leaf]]\nmaterials = ["blade"]\n'
            f"chlorophyll_ug_cm2 = {arguments.chlorophyll}\n"
            f"carotenoids_ug_cm2 = {arguments.carotenoids}\n"
            'water_cm = 0.012\ndry_g_cm2 = 0.005\nstructure_map = "structure.png"\n'
        )
        if arguments.season:
            for date, chlorophyll, carotenoids, brown in SEASON:
                scene += (
                    f"\n[[leaf.stage]]\ndate = {date}\nchlorophyll_ug_cm2 = {chlorophyll}\n"
                    f"carotenoids_ug_cm2 = {carotenoids}\nbrown = {brown}\n"
                )
    (folder / "scene.toml").write_text(scene)


if __name__ == "__main__":
    main()
