#!/usr/bin/env python3
"""Joins the front views of the sheets of make_models.py, with their names.

  tools/model_samples/join_sheets.py FOLDER IMAGE

Needs OpenCV for Python (Debian: python3-opencv).
"""
import os
import sys

import cv2
import numpy as np

COLUMNS = 5
LEFT, RIGHT, TOP, BOTTOM = 110, 422, 96, 424  # Of the view: the model without the person.


def front(file):
    """The model in the upper left quarter of a sheet."""
    sheet = cv2.imread(file)
    if sheet is None:
        sys.exit(file + ": not an image")
    view = sheet[TOP:BOTTOM, LEFT:RIGHT].copy()
    name = os.path.splitext(os.path.basename(file))[0].replace("_", " ")
    for color, width in (((255, 255, 255), 3), ((0, 0, 0), 1)):
        cv2.putText(view, name, (10, 24), cv2.FONT_HERSHEY_SIMPLEX, 0.55, color, width, cv2.LINE_AA)
    return view


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    files = sorted(f for f in os.listdir(sys.argv[1]) if f.endswith(".png"))
    views = [front(os.path.join(sys.argv[1], f)) for f in files]
    views += [np.full_like(views[0], 255)] * (-len(views) % COLUMNS)
    rows = [np.hstack(views[i:i + COLUMNS]) for i in range(0, len(views), COLUMNS)]
    cv2.imwrite(sys.argv[2], np.vstack(rows), [cv2.IMWRITE_JPEG_QUALITY, 88])


if __name__ == "__main__":
    main()
