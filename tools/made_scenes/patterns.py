"""Procedural materials: periodic pictures of linear albedo and of height. The mean of a picture is
the mean albedo of its surface, which is what phantom.mtl says."""
from dataclasses import dataclass

import numpy as np

PIXELS = 768


@dataclass
class Pattern:
    """A square of a surface, repeated over it."""

    name: str
    albedo: np.ndarray  # PIXELS x PIXELS x 3, linear Rec.709
    height: np.ndarray  # PIXELS x PIXELS, metres
    side_m: float

    @property
    def mean_albedo(self):
        return self.albedo.mean(axis=(0, 1))


def clouded(random, roughness):
    """Periodic noise of mean 0 and variance 1 whose amplitudes fall as frequency^-roughness."""
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(PIXELS), np.fft.fftfreq(PIXELS)))
    frequency[0, 0] = 1.0
    spectrum = np.fft.fft2(random.standard_normal((PIXELS, PIXELS))) * frequency**-roughness
    spectrum[0, 0] = 0.0
    noise = np.fft.ifft2(spectrum).real
    return noise / noise.std()


def tinted(value, colour):
    return np.clip(value[..., None] * np.asarray(colour, float), 0.01, 0.9)


def plain(name, random, colour, side_m, contrast=0.06, depth_m=0.0006, roughness=1.1):
    """Plaster, concrete, gravel, soil: noise without a pattern."""
    noise = clouded(random, roughness)
    return Pattern(name, tinted(1.0 + contrast * noise, colour), depth_m * noise, side_m)


def masonry(name, random, colour, joint_colour, columns, rows, side_m, joint_m, shift, contrast):
    """Bricks or slabs: `columns` x `rows` to a side, every second row moved by `shift` of a slab;
    each has a brightness of its own, and noise on top."""
    x, y = np.meshgrid((np.arange(PIXELS) + 0.5) / PIXELS, (np.arange(PIXELS) + 0.5) / PIXELS)
    row = (y * rows).astype(int)
    across = (x * columns + shift * (row % 2)) % columns
    column = across.astype(int)
    brightness = 1.0 + contrast * random.standard_normal((rows, columns))[row, column]
    from_joint_m = np.minimum(
        (0.5 - abs(across - column - 0.5)) * side_m / columns,
        (0.5 - abs(y * rows - row - 0.5)) * side_m / rows,
    )
    slab = np.clip((from_joint_m - joint_m / 2) / 0.002 + 0.5, 0.0, 1.0)
    noise = clouded(random, 1.0)
    albedo = tinted(brightness * (1.0 + 0.05 * noise), colour)
    joints = tinted(1.0 + 0.08 * clouded(random, 0.6), joint_colour)
    height = 0.003 * (slab - 1.0) + 0.0004 * noise
    slab = slab[..., None]
    return Pattern(name, slab * albedo + (1.0 - slab) * joints, height, side_m)


def boards(name, random, colour, count, side_m):
    """Planks along x with a grain."""
    y = (np.arange(PIXELS) + 0.5) / PIXELS * count
    plank = y.astype(int)
    grain = np.repeat(clouded(random, 0.7).mean(axis=1, keepdims=True), PIXELS, axis=1)
    grain = 0.6 * grain / grain.std() + 0.4 * clouded(random, 1.0)
    brightness = (1.0 + 0.08 * random.standard_normal(count))[plank][:, None]
    gap = np.clip((0.5 - abs(y - plank - 0.5)) * side_m / count / 0.002, 0.15, 1.0)[:, None]
    albedo = tinted(brightness * (1 + 0.07 * grain) * gap, colour)
    return Pattern(name, albedo, np.broadcast_to(0.002 * gap, grain.shape), side_m)


def flat(name, colour):
    """One colour: what has no pattern at this size (painted metal, leaves)."""
    albedo = np.broadcast_to(np.asarray(colour, float), (PIXELS, PIXELS, 3))
    return Pattern(name, albedo, np.zeros((PIXELS, PIXELS)), 1.0)
