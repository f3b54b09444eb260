#!/usr/bin/python3
"""Copies a made scene and develops its images again as another camera would: develop_again.py SCENE CURVE OUT

The images must be those of an sRGB camera. Light that it clipped stays clipped.
"""
import shutil
import sys
from pathlib import Path

import cv2
import numpy as np

from camera import CURVES, Camera


def linear(image):
    """Linear r g b of 8-bit sRGB b g r. IEC 61966-2-1."""
    code = image[..., ::-1].astype(float) / 255
    return np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)


def main():
    if len(sys.argv) != 4 or sys.argv[2] not in CURVES:
        sys.exit(f"{__doc__}\ncurves: {', '.join(CURVES)}")
    scene, curve, out = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    shutil.copytree(scene, out)
    camera = Camera(curve)
    for folder, kind in (("frames", "*.jpg"), ("key", "*.png")):
        for file in sorted((out / folder).glob(kind)):
            if "mask" in file.name or "shadow" in file.name:
                continue
            developed = camera.developed(linear(cv2.imread(str(file))))
            cv2.imwrite(str(file), developed, [cv2.IMWRITE_JPEG_QUALITY, 95] if kind == "*.jpg" else [])


if __name__ == "__main__":
    main()
