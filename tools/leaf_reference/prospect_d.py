#!/usr/bin/env python3
"""Computes a leaf by PROSPECT-D in numpy: an independent program to compare `pleinair leaf` with.

    python3 tools/leaf_reference/prospect_d.py prospect_d_spectra.txt build/release/pleinair

The first file has the published coefficients, as in jgomezdans/prosail: columns of nm, n,
chlorophyll, carotenoids, anthocyanins, brown pigments, water and dry matter. Prints the largest
difference of reflectance and transmittance, and the median time of a spectrum. Equations:
docs/method/leaves.md. Needs numpy and scipy.
"""
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.special import exp1

LEAF = {"chlorophyll": 30, "carotenoids": 10, "anthocyanins": 1, "brown": 0.1, "water": 0.015, "dry": 0.009}
STRUCTURE = 1.7


def mean_transmittance(cone_deg, index):
    """Of a surface, for unpolarized light from within a cone: Fresnel's equations, integrated."""
    steps = 4000
    angle = np.radians(cone_deg) * (np.arange(steps) + 0.5) / steps
    total = np.zeros_like(index)
    for theta in angle:
        c, s = np.cos(theta), np.sin(theta)
        inside = np.sqrt(1 - (s / index) ** 2)
        across = ((c - index * inside) / (c + index * inside)) ** 2
        along = ((inside - index * c) / (inside + index * c)) ** 2
        total += (1 - (across + along) / 2) * np.sin(2 * theta)
    return total / np.sum(np.sin(2 * angle))


class ProspectD:
    def __init__(self, coefficients):
        self.index = coefficients[:, 1]
        self.absorption = coefficients[:, 2:8]
        self.first = mean_transmittance(40.0, self.index)
        self.other = mean_transmittance(90.0, self.index)

    def spectrum(self, contents, structure):
        """Reflectance and transmittance of `structure` plates."""
        k = self.absorption @ contents / structure
        inner = np.ones_like(k)
        some = k > 0
        inner[some] = (1 - k[some]) * np.exp(-k[some]) + k[some] ** 2 * exp1(k[some])
        n2 = self.index**2
        passed = self.other / n2  # From inside.
        echo = (1 - passed) * inner
        t_first, t = (enters * inner * passed / (1 - echo**2) for enters in (self.first, self.other))
        r_first, r = 1 - self.first + echo * t_first, 1 - self.other + echo * t
        root = np.sqrt((1 + r + t) * (1 + r - t) * (1 - r + t) * (1 - r - t))
        a, b = (1 + r**2 - t**2 + root) / (2 * r), (1 - r**2 + t**2 + root) / (2 * t)
        power = b ** (structure - 1)
        below = a**2 * power**2 - 1
        r_rest, t_rest = a * (power**2 - 1) / below, power * (a**2 - 1) / below
        between = 1 - r_rest * r
        return r_first + t_first * r_rest * t / between, t_first * t_rest / between


def main():
    model = ProspectD(np.loadtxt(sys.argv[1], encoding="latin1"))
    contents = np.array(list(LEAF.values()), dtype=float)
    times = []
    for _ in range(200):
        begin = time.perf_counter()
        ours = model.spectrum(contents, STRUCTURE)
        times.append(time.perf_counter() - begin)
    print(f"{np.median(times) * 1e6:.0f} us a spectrum of {len(ours[0])} nm")
    with tempfile.NamedTemporaryFile(suffix=".csv") as file:
        options = [word for name, value in LEAF.items() for word in (f"--{name}", str(value))]
        subprocess.run([sys.argv[2], "leaf", *options, "--structure", str(STRUCTURE), "--spectra", file.name],
                       check=True, stdout=subprocess.DEVNULL)
        theirs = np.genfromtxt(file.name, delimiter=",", names=True, dtype=None, encoding=None)
    print(f"largest difference {max(np.abs(theirs['reflectance'] - ours[0]).max(), np.abs(theirs['transmittance'] - ours[1]).max()):.1e}")


if __name__ == "__main__":
    main()
