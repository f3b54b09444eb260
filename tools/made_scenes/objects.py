"""The virtual objects: the shapes that a seed chooses from, standing on the marker's ground."""
import numpy as np

from shapes import Mesh, box, closed_tube, joined, turned_profile


def knot(random):
    """A torus knot standing on its lowest point."""
    t = np.arange(180) * 2 * np.pi / 180
    p, q = (2, 3) if random.random() < 0.5 else (3, 2)
    ring = 1.0 + 0.42 * np.cos(q * t)
    line = np.stack([ring * np.cos(p * t), 0.42 * np.sin(q * t), ring * np.sin(p * t)], axis=1)
    return closed_tube(line, random.uniform(0.16, 0.22), 20)


def vase(random):
    heights = np.linspace(0.0, 1.0, 24)
    belly, neck = random.uniform(0.25, 0.36), random.uniform(0.1, 0.2)
    radius = neck + (belly - neck) * np.exp(-(((heights - 0.35) / 0.22) ** 2))
    radius += 0.08 * np.clip(heights - 0.85, 0, 1) / 0.15
    return turned_profile(list(zip(radius, heights)), 40)


def blocks(random):
    """Boxes on top of each other, each turned."""
    parts, height = [], 0.0
    for width in (0.55, 0.42, 0.3):
        tall = random.uniform(0.22, 0.36)
        block = box(width, width * random.uniform(0.7, 1.0), tall)
        parts.append(block.turned(random.uniform(0, np.pi)).moved((0, 0, height)))
        height += tall
    return joined(parts)


def chair(random):
    seat, back, leg = random.uniform(0.4, 0.5), random.uniform(0.85, 1.0), 0.05
    rest = box(0.46, 0.04, back - seat - 0.04).moved((0, 0.21, 0.04))
    parts = [part.moved((0, 0, seat)) for part in (box(0.46, 0.46, 0.04), rest)]
    for x in (-0.2, 0.2):
        for y in (-0.2, 0.2):
            parts.append(box(leg, leg, seat).moved((x, y, 0)))
    return joined(parts)


def figure(random):
    """A body with a head and a bowl beside it: round and concave parts."""
    heights = np.linspace(0.0, 0.72, 18)
    waist = 0.24 - 0.2 * heights + 0.03 * np.sin(14 * heights)
    body = turned_profile(list(zip(waist, heights)), 36)
    angle = np.linspace(-np.pi / 2 + 0.05, np.pi / 2 - 0.05, 14)
    head = turned_profile(list(zip(0.15 * np.cos(angle), 0.84 + 0.15 * np.sin(angle))), 36)
    inside = [(0.06, 0.03), (0.2, 0.1), (0.24, 0.22)]
    outside = [(0.05, 0.0), (0.22, 0.08), (0.27, 0.22)]
    bowl = turned_profile(outside + inside[::-1], 36).moved((0.5, 0.0, 0.0))
    return joined([body, head, bowl])


SHAPES = {"knot": knot, "vase": vase, "blocks": blocks, "chair": chair, "figure": figure}
SMOOTH = {"knot", "vase"}


def virtual_object(random, height_m, place):
    """(kind, mesh, albedo): a shape scaled to `height_m`, turned, with its foot at `place`."""
    kind = str(random.choice(sorted(SHAPES)))
    mesh = SHAPES[kind](random).turned(random.uniform(0, 2 * np.pi))
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    middle = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])
    scale = height_m / (high[2] - low[2])
    albedo = random.uniform(0.12, 0.7) * (0.3 + 0.7 * random.dirichlet((1.5, 1.5, 1.5)) * 1.8)
    points = (mesh.points - middle) * scale + np.asarray(place, float)
    return kind, Mesh(points, mesh.faces), np.clip(albedo, 0.05, 0.75)
