#!/usr/bin/env python3
"""Writes an elevation raster of hills with ripples: hills.py CELLS FILE.tif

CELLS x CELLS cells of 1 m in UTM 33N (EPSG:32633) around 50.0875 N, 14.4213 E, 32 bits, uncompressed. Heights, metres:
z = 220 + 20 sin(0.006 x) cos(0.005 y) + 3 sin(0.05 x + 0.03 y) + 0.15 sin(0.4 x) sin(0.37 y)
"""
import struct
import sys

import numpy as np

CENTRE_M = (458601.7085, 5548519.788)  # The place in UTM 33N, by GeographicLib.
SHORT, LONG, DOUBLE = 3, 4, 12  # Types of TIFF.


def heights(cells):
    y, x = np.mgrid[0:cells, 0:cells].astype(np.float32)
    hills = 20 * np.sin(0.006 * x) * np.cos(0.005 * y) + 3 * np.sin(0.05 * x + 0.03 * y)
    return (220 + hills + 0.15 * np.sin(0.4 * x) * np.sin(0.37 * y)).astype("<f4")


def geotiff(rows):
    """One strip, with the tags of GeoTIFF 1.1."""
    cells = len(rows)
    west, north = CENTRE_M[0] - cells / 2, CENTRE_M[1] + cells / 2
    keys = (1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32633)
    strip = 273
    tags = [(tag, LONG, 1, struct.pack("<I", value)) for tag, value in (
        (256, cells), (257, cells), (258, 32), (259, 1), (262, 1), (strip, 0), (277, 1), (278, cells),
        (279, rows.nbytes), (339, 3))]
    tags += [(33550, DOUBLE, 3, struct.pack("<3d", 1, 1, 0)),
             (33922, DOUBLE, 6, struct.pack("<6d", 0, 0, 0, west, north, 0)),
             (34735, SHORT, len(keys), struct.pack(f"<{len(keys)}H", *keys))]
    beside_at = 8 + 2 + 12 * len(tags) + 4
    cells_at = beside_at + sum(len(value) for *_, value in tags if len(value) > 4)
    entries, beside = b"", b""
    for tag, kind, count, value in tags:
        if tag == strip:
            value = struct.pack("<I", cells_at)
        if len(value) > 4:
            value, beside = struct.pack("<I", beside_at + len(beside)), beside + value
        entries += struct.pack("<HHI", tag, kind, count) + value.ljust(4, b"\0")
    header = b"II*\0" + struct.pack("<IH", 8, len(tags))
    return header + entries + bytes(4) + beside + rows.tobytes()


if __name__ == "__main__":
    if len(sys.argv) != 3 or not sys.argv[1].isdigit():
        sys.exit(__doc__)
    with open(sys.argv[2], "wb") as file:
        file.write(geotiff(heights(int(sys.argv[1]))))
