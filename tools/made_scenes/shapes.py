"""Meshes as lists of points and faces, in the marker's frame (metres). Faces wind anticlockwise
seen from outside."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Mesh:
    points: np.ndarray  # n x 3
    faces: list  # tuples of indices

    def moved(self, by):
        return Mesh(self.points + np.asarray(by, float), self.faces)

    def turned(self, angle_rad):
        """About the vertical."""
        c, s = np.cos(angle_rad), np.sin(angle_rad)
        return Mesh(self.points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), self.faces)

    def scaled(self, factor):
        return Mesh(self.points * factor, self.faces)


def joined(meshes):
    points, faces, first = [], [], 0
    for mesh in meshes:
        points.append(mesh.points)
        faces += [tuple(i + first for i in face) for face in mesh.faces]
        first += len(mesh.points)
    return Mesh(np.concatenate(points), faces)


def rectangle(x0, y0, x1, y1, z):
    """Level, facing up."""
    points = [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]
    return Mesh(np.array(points, float), [(0, 1, 2, 3)])


def frame_around(x0, y0, x1, y1, reach, z):
    """Level ground around a rectangle, as far as `reach` from the origin."""
    return joined(
        [
            rectangle(-reach, -reach, reach, y0, z),
            rectangle(-reach, y1, reach, reach, z),
            rectangle(-reach, y0, x0, y1, z),
            rectangle(x1, y0, reach, y1, z),
        ]
    )


def box(width, depth, height):
    """Standing on the origin's level, centred about the vertical."""
    w, d = width / 2, depth / 2
    points = [(x, y, z) for z in (0, height) for y in (-d, d) for x in (-w, w)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return Mesh(np.array(points, float), faces)


def turned_profile(profile, sides):
    """A body of revolution about the vertical, from (radius, height) from the bottom up, closed."""
    angles = np.arange(sides) * 2 * np.pi / sides
    points = [(r * np.cos(a), r * np.sin(a), z) for r, z in profile for a in angles]
    faces = []
    for ring in range(len(profile) - 1):
        a, b = ring * sides, (ring + 1) * sides
        faces += [(a + i, a + (i + 1) % sides, b + (i + 1) % sides, b + i) for i in range(sides)]
    faces.append(tuple(range(sides))[::-1])
    faces.append(tuple(range((len(profile) - 1) * sides, len(profile) * sides)))
    return Mesh(np.array(points, float), faces)


def cylinder(radius, height, sides=24):
    return turned_profile([(radius, 0.0), (radius, height)], sides)


def tube(start, end, radius_start, radius_end, sides=7):
    """Between two points, open at both ends: a branch."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    axis = (end - start) / np.linalg.norm(end - start)
    side = np.cross(axis, (1.0, 0.0, 0.0) if abs(axis[0]) < 0.7 else (0.0, 1.0, 0.0))
    side /= np.linalg.norm(side)
    other = np.cross(axis, side)
    angles = np.arange(sides) * 2 * np.pi / sides
    ring = np.cos(angles)[:, None] * side + np.sin(angles)[:, None] * other
    points = np.concatenate([start + radius_start * ring, end + radius_end * ring])
    faces = [(i, (i + 1) % sides, sides + (i + 1) % sides, sides + i) for i in range(sides)]
    return Mesh(points, faces)


def closed_tube(centre_line, radius, sides):
    """Around a closed line (n x 3): a knot. Frames by the line's tangent and the origin."""
    line = np.asarray(centre_line, float)
    tangent = np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    outward = line - (line * tangent).sum(axis=1, keepdims=True) * tangent
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    other = np.cross(tangent, outward)
    angles = np.arange(sides) * 2 * np.pi / sides
    rings = (
        line[:, None]
        + radius * np.cos(angles)[None, :, None] * outward[:, None]
        + radius * np.sin(angles)[None, :, None] * other[:, None]
    )
    n = len(line)
    faces = []
    for ring in range(n):
        a, b = ring * sides, (ring + 1) % n * sides
        faces += [(a + i, a + (i + 1) % sides, b + (i + 1) % sides, b + i) for i in range(sides)]
    return Mesh(rings.reshape(-1, 3), faces)
