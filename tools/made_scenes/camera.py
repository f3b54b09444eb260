"""From linear light to codes: tone curves, sharpening and grain of cameras."""
from dataclasses import dataclass

import cv2
import numpy as np


def srgb(x):
    """IEC 61966-2-1."""
    x = np.clip(x, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def rec709(x):
    """ITU-R BT.709-6, item 1.2."""
    x = np.clip(x, 0, 1)
    return np.where(x < 0.018, 4.5 * x, 1.099 * x**0.45 - 0.099)


def shoulder(x):
    """sRGB behind a shoulder: Reinhard et al. 2002, eq. 4, with white at 2.2."""
    return srgb(np.clip(x, 0, 2.2) * (1 + np.clip(x, 0, 2.2) / 2.2**2) / (1 + np.clip(x, 0, 2.2)) * 1.5)


def filmic(x):
    """Toe and shoulder: K. Narkowicz's fit of the ACES reference curve (2015), half a stop up."""
    x = np.clip(0.85 * x, 0, None)
    return srgb((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14))


def contrast(x):
    """An S of more contrast over sRGB, as picture styles have."""
    code = srgb(x)
    return 0.5 * code + 0.5 * code * code * (3 - 2 * code)


def flat(x):
    """Gamma 1.8 with raised blacks."""
    return 0.05 + 0.95 * np.clip(x, 0, 1) ** (1 / 1.8)


CURVES = {f.__name__: f for f in (srgb, rec709, shoulder, filmic, contrast, flat)}


@dataclass
class Camera:
    curve: str = "srgb"
    grain: float = 0.0  # Standard deviation of codes at mid grey, of 255.
    sharpening: float = 0.0  # Share of the detail below a pixel and a half that is added.

    def developed(self, linear, random=None):
        """8 bit as OpenCV wants it: b g r. Without `random` there is no grain."""
        linear = np.asarray(linear, float)
        if self.grain > 0 and random is not None:
            # Photon noise: its variance grows as the light does. A quarter of it is read noise.
            slope = (srgb(np.array(0.1801)) - srgb(np.array(0.1799))) / 0.0002
            sigma = self.grain / 255 / slope
            light = np.clip(linear, 0, None)
            variance = sigma**2 * (0.25 + 0.75 * light / 0.18)
            linear = linear + random.standard_normal(linear.shape) * np.sqrt(variance)
        code = CURVES[self.curve](linear)
        if self.sharpening > 0:
            code = code + self.sharpening * (code - cv2.GaussianBlur(code, (0, 0), 1.5))
        return (np.clip(code, 0, 1) * 255 + 0.5).astype(np.uint8)[..., ::-1].copy()
