"""What grows: grass of single blades and trees of single leaves."""
import numpy as np

from shapes import Mesh, joined, tube


def grass(random, x0, y0, x1, y1, z, blades_per_m2, height_m):
    """Blades of two triangles, bent over, on a rectangle."""
    count = int((x1 - x0) * (y1 - y0) * blades_per_m2)
    x, y = random.uniform(x0, x1, count), random.uniform(y0, y1, count)
    foot = np.stack([x, y, np.full(count, z)], axis=1)
    turn, lean = random.uniform(0, 2 * np.pi, count), random.uniform(0.05, 0.9, count)
    tall = height_m * random.uniform(0.5, 1.2, count)
    along = np.stack([np.cos(turn), np.sin(turn), np.zeros(count)], axis=1)
    across = np.stack([-np.sin(turn), np.cos(turn), np.zeros(count)], axis=1) * 0.0025
    up = np.array([0.0, 0.0, 1.0])
    middle = foot + tall[:, None] * (0.55 * up + (0.25 * lean)[:, None] * along)
    tip = foot + tall[:, None] * ((1.0 - 0.4 * lean)[:, None] * up + lean[:, None] * along)
    points = np.stack([foot - across, foot + across, middle + across, middle - across, tip], axis=1)
    faces = []
    for i in range(0, 5 * count, 5):
        faces += [(i, i + 1, i + 2, i + 3), (i + 3, i + 2, i + 4)]
    return Mesh(points.reshape(-1, 3), faces)


def tree(random, foot, height_m, crown_radius_m, leaf_count, leaf_m):
    """(wood, leaves): a trunk, branches, and leaves in clumps at the branches' ends. A leaf is a
    lozenge folded along its middle, so that its halves take the light apart."""
    foot = np.asarray(foot, float)
    crown = foot + (0, 0, height_m - crown_radius_m)
    fork = foot + (0, 0, max(height_m - 2 * crown_radius_m, 0.35 * height_m))
    wood = [tube(foot, fork, 0.035 * height_m, 0.025 * height_m, 10)]
    clumps = []
    for _ in range(34):
        direction = random.standard_normal(3)
        direction /= np.linalg.norm(direction)
        end = crown + direction * (1, 1, 0.8) * crown_radius_m * random.uniform(0.3, 1.0)
        wood.append(tube(fork, end, 0.010 * height_m, 0.002 * height_m))
        clumps.append(end)
    centre = np.array(clumps)[random.integers(0, len(clumps), leaf_count)]
    middle = centre + random.standard_normal((leaf_count, 3)) * 0.17 * crown_radius_m
    axis = random.standard_normal((leaf_count, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    normal = random.standard_normal((leaf_count, 3)) + (0, 0, 1.2)  # Leaves face the sky.
    side = np.cross(axis, normal)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    lift = np.cross(side, axis)
    size = leaf_m * random.uniform(0.7, 1.3, leaf_count)[:, None]
    points = np.stack(
        [
            middle - size * axis,
            middle + size * (0.5 * side + 0.15 * lift),
            middle + size * axis,
            middle + size * (-0.5 * side + 0.15 * lift),
        ],
        axis=1,
    )
    faces = [f for i in range(0, 4 * leaf_count, 4) for f in ((i, i + 1, i + 2), (i, i + 2, i + 3))]
    return joined(wood), Mesh(points.reshape(-1, 3), faces)


def some_leaves(random, leaves, share, wider):
    """Fewer leaves, each `wider` times larger: a tree as a reconstruction has it."""
    quads = leaves.points.reshape(-1, 4, 3)
    quads = quads[random.random(len(quads)) < share]
    middle = quads.mean(axis=1, keepdims=True)
    points = (middle + wider * (quads - middle)).reshape(-1, 3)
    faces = [f for i in range(0, len(points), 4) for f in ((i, i + 1, i + 2), (i, i + 2, i + 3))]
    return Mesh(points, faces)
