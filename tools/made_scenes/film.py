"""What changes from frame to frame of a film: sun, sky, exposure and white balance. Nothing in it
comes from the estimates that the films test."""
from dataclasses import dataclass

import numpy as np

EXPOSURES = ("locked", "follow", "jump")
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


@dataclass
class Film:
    """Factors of the light and of the camera's gain, frames x 3 (red, green, blue)."""

    sun: np.ndarray
    sky: np.ndarray
    gain: np.ndarray


def steady(frames):
    return Film(np.ones((frames, 3)), np.ones((frames, 3)), np.ones((frames, 3)))


def under_cloud(random, film, frames_per_s):
    """A cumulus crosses the sun once: a twentieth to a third of the sunlight remains for a third to
    half of the film. The sky gains 5 to 35 %, less in blue, because the cloud's side is white."""
    frames = len(film.sun)
    seconds = np.arange(frames) / frames_per_s
    length = frames / frames_per_s
    edge_s = random.uniform(0.4, 1.2)
    start = random.uniform(0.2, 0.35) * length
    end = start + random.uniform(0.33, 0.5) * length
    smooth = lambda x: np.clip(x, 0, 1) ** 2 * (3 - 2 * np.clip(x, 0, 1))
    covered = smooth((seconds - start) / edge_s) * smooth((end - seconds) / edge_s)
    left = random.uniform(0.05, 0.33)
    film.sun = film.sun * (left**covered)[:, None]
    gain = random.uniform(0.05, 0.35) * np.array([1.0, 0.92, 0.8])
    film.sky = film.sky * (1.0 + covered[:, None] * gain)


def exposed(film, kind, sun_level, sky_level, frames_per_s):
    """`follow`: the camera corrects 80 % of the brightness change of level paper within a few tenths
    of a second. `jump`: a third more light from the middle of the film on."""
    if kind == "follow":
        light = (film.sun * sun_level + film.sky * sky_level) @ LUMINANCE
        wanted = (light / light[0]) ** -0.8
        step = 1.0 - np.exp(-1.0 / (0.3 * frames_per_s))
        gain = np.ones(len(wanted))
        for frame in range(1, len(wanted)):
            gain[frame] = gain[frame - 1] * (wanted[frame] / gain[frame - 1]) ** step
        film.gain = film.gain * gain[:, None]
    elif kind == "jump":
        film.gain = film.gain * np.where(np.arange(len(film.gain)) * 2 < len(film.gain), 1, 1.35)[:, None]


def drifting_white_balance(random, film):
    """Red and blue drift in opposite directions over the film, by 4 to 10 % each."""
    way = np.linspace(0.0, 1.0, len(film.gain))
    red, blue = random.uniform(0.04, 0.1, 2) * random.choice([-1.0, 1.0])
    film.gain = film.gain * np.stack([1 + red * way, np.ones_like(way), 1 - blue * way], axis=1)
