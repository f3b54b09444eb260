"""The places. A seed varies where and when, lens, camera, heading, colours, sizes, the object
and what the scene says of its sky; nothing in them is fitted to what the program does well."""
from dataclasses import dataclass, field
from datetime import datetime, timedelta
import math

import numpy as np

import patterns
import plants
import shapes
from objects import virtual_object
from sun_place import in_marker_frame, sun_place_deg


@dataclass
class Surface:
    """A real surface. `phantom`: the mesh that phantom.obj has for it; None: it has nothing."""

    name: str
    mesh: shapes.Mesh
    pattern: patterns.Pattern
    phantom: shapes.Mesh = None
    translucent: bool = False


@dataclass
class Sky:
    """`kind`: nishita or overcast. `sun_to_sky`: luminous, on level ground in the open."""

    kind: str
    sun_to_sky: float
    dust: float = 1.0
    tint: tuple = (1.0, 1.0, 1.0)
    words: str = ""  # What the scene says of it; nothing where empty.


@dataclass
class Place:
    name: str
    latitude_deg: float
    longitude_deg: float
    utc: str
    heading_deg: float
    sky: Sky
    ground_z: float  # Below the marker's face.
    square_m: float
    surfaces: list
    kind: str = ""
    mesh: shapes.Mesh = None
    albedo: np.ndarray = None
    focal_px: float = 0.0
    centre_px: tuple = (0.0, 0.0)
    views: list = field(default_factory=list)  # (eye, target) a frame
    cast: np.ndarray = None  # The camera's gain beside a neutral one, r g b
    brightness: float = 0.9  # What open level white paper would show, display-linear
    upright: bool = False  # The marker hangs on a wall that faces -y.

    @property
    def marker_from_level(self):
        """Rotation from the frame that everything here is built in (z up) to the marker's."""
        return np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]] if self.upright else np.eye(3), float)

    @property
    def sun_deg(self):
        return sun_place_deg(self.latitude_deg, self.longitude_deg, self.utc)

    @property
    def to_sun(self):
        return np.array(in_marker_frame(*self.sun_deg, self.heading_deg))


def when(random, latitudes, months, elevations_deg, before_noon=None):
    """Latitude, longitude and a time with the sun at one of `elevations_deg` = (low, high)."""
    for _ in range(1000):
        latitude, longitude = random.uniform(*latitudes), random.uniform(-20, 30)
        month = int(random.integers(*months, endpoint=True))
        day = datetime(2025, month, int(random.integers(1, 28)))
        minute = int(random.integers(0, 1440))
        utc = (day + timedelta(minutes=minute)).strftime("%Y-%m-%dT%H:%M:%SZ")
        azimuth, elevation = sun_place_deg(latitude, longitude, utc)
        right_half = before_noon is None or (azimuth < 180) == before_noon
        if elevations_deg[0] < elevation < elevations_deg[1] and right_half:
            return round(latitude, 4), round(longitude, 4), utc
    raise ValueError("no time with the sun at such a height")


def begun(random, name, days, heights_deg, sky, ground_z, square_m, before_noon=None):
    """A place with its time and a heading at which the sun comes from the side or from behind the
    camera, which stands on the marker's -y side. The second result: on which side (-1: left)."""
    latitude, longitude, utc = when(random, *days, heights_deg, before_noon)
    side = float(random.choice([-1.0, 1.0]))
    turn = side * random.uniform(65, 155)
    heading = round((sun_place_deg(latitude, longitude, utc)[0] - turn) % 360, 1)
    return Place(name, latitude, longitude, utc, heading, sky, ground_z, square_m, []), side


def finish(random, place, frames, spot, height_m, distance_m, size, lift_deg=(24, 38), aim=None):
    """Object, camera path and colours of the camera. `lift_deg`: range of the camera's elevation.
    `aim`: what it looks at; by default between marker and object."""
    place.kind, place.mesh, place.albedo = virtual_object(random, height_m, (*spot, place.ground_z))
    place.focal_px = round(size[0] * random.uniform(0.88, 1.15), 1)
    place.centre_px = tuple(
        round((n - 1) / 2 + random.uniform(-0.015, 0.015) * n, 1) for n in size
    )
    sun = place.to_sun
    shadow = -sun[:2] / sun[2] * height_m if place.sky.sun_to_sky > 0 else np.zeros(2)
    shadow *= min(1.0, height_m / max(np.linalg.norm(shadow), 1e-9))
    x, y = 0.5 * np.array(spot) + 0.25 * shadow
    target = np.array([x, y + 0.1 * distance_m, height_m * 0.25] if aim is None else aim)
    turn, lift = random.uniform(-0.5, 0.5), math.radians(random.uniform(*lift_deg))
    sweep = random.choice([-1.0, 1.0]) * 0.12 / max(frames - 1, 1)
    for frame in range(frames):
        a = turn + sweep * frame
        level = math.cos(lift)
        away = np.array([math.sin(a) * level, -math.cos(a) * level, math.sin(lift)])
        shake = random.standard_normal(3) * 0.004 * distance_m
        place.views.append((target + distance_m * away + shake, target + shake * 0.5))
    if place.cast is None:
        place.cast = random.uniform(0.95, 1.05, 3)
    return place


def solid(name, mesh, pattern):
    return Surface(name, mesh, pattern, mesh)


def ground(place, pattern, half_m, beyond):
    """Level ground with a phantom as far as `half_m`, and land of the pattern `beyond` outside."""
    z, h = place.ground_z, half_m
    near = shapes.rectangle(-h, -h, h, h, z)
    far = shapes.frame_around(-h, -h, h, h, 150.0, z)
    return [solid("ground", near, pattern), Surface("beyond", far, beyond)]


def terrace(random, frames, size):
    """A small object under a high sun: tiles, a plastered wall, a pot and a post."""
    sky = Sky("nishita", random.uniform(4.5, 6.5), random.uniform(0.5, 1.5))
    sky.words = str(random.choice(["", "clear"]))
    place, side = begun(random, "terrace", ((33, 44), (5, 7)), (66, 79), sky, -0.002, 0.16)
    z = place.ground_z
    fired = random.uniform(0.3, 0.5) * np.array([1.0, 0.86, 0.7])
    tiles = patterns.masonry(
        "tiles", random, fired, (0.28, 0.26, 0.24), 5, 5, 1.0, 0.006, 0.0, 0.05
    )
    pale = random.uniform(0.5, 0.7) * np.array([1, 0.95, 0.86])
    wall = patterns.plain("plaster", random, pale, 1.3)
    clay = patterns.plain("clay", random, (0.42, 0.17, 0.09), 0.5, 0.05)
    wood = patterns.boards("wood", random, (0.3, 0.19, 0.1), 8, 0.8)
    back = random.uniform(0.6, 0.85)
    profile = [(0.075, 0.0), (0.11, 0.19), (0.125, 0.19), (0.125, 0.23), (0.1, 0.23), (0.095, 0.19)]
    pot = shapes.turned_profile(profile, 32).moved((side * 0.34, random.uniform(0.2, 0.4), z))
    post = shapes.box(0.045, 0.045, 0.7).moved((side * 0.22, back - 0.12, z))
    crate = shapes.box(0.3, 0.2, 0.13).turned(random.uniform(0, 3))
    crate = crate.moved((-side * 0.55, back - 0.25, z))
    behind = shapes.box(4.0, 0.14, random.uniform(0.5, 0.9)).moved((0, back + 0.07, z))
    soil = patterns.plain("soil", random, (0.3, 0.26, 0.2), 2.0)
    place.surfaces = ground(place, tiles, 3.0, soil) + [
        solid("wall", behind, wall),
        solid("pot", pot, clay),
        solid("post", post, wood),
        solid("crate", crate, wood),
    ]
    spot = (-side * random.uniform(0.2, 0.3), random.uniform(0.0, 0.15))
    height, distance = random.uniform(0.15, 0.25), random.uniform(0.85, 1.1)
    return finish(random, place, frames, spot, height, distance, size)


def yard(random, frames, size):
    """Overcast, coloured walls close by, a camera without white balance."""
    tint = (1.0, random.uniform(0.97, 1.06), random.uniform(1.0, 1.3))
    sky = Sky("overcast", 0.0, tint=tint, words=str(random.choice(["", "overcast"])))
    place, side = begun(random, "yard", ((42, 56), (3, 10)), (20, 50), sky, -0.004, 0.4)
    z = place.ground_z
    grey = random.uniform(0.25, 0.4) * np.array([1, 0.97, 0.9])
    slabs = patterns.masonry(
        "slabs", random, grey, (0.15, 0.14, 0.12), 4, 4, 1.6, 0.01, 0.5, 0.06
    )
    brick = patterns.masonry(
        "brick", random, (0.36, 0.14, 0.09), (0.4, 0.38, 0.34), 4, 14, 1.0, 0.01, 0.5, 0.12
    )
    ochre = patterns.plain("ochre", random, (0.62, 0.42, 0.12), 1.5)
    stone = patterns.plain("stone", random, (0.46, 0.42, 0.34), 1.0, 0.09)
    blue = patterns.flat("barrel", (0.05, 0.12, 0.3))
    back, beside = random.uniform(1.3, 1.7), random.uniform(1.2, 1.6)
    walls = [shapes.box(7.0, 0.3, 2.4).moved((0, back + 0.15, z))]
    walls.append(shapes.box(0.3, 3.0, 2.2).moved((side * (beside + 0.15), back - 1.5, z)))
    soil = patterns.plain("soil", random, (0.16, 0.17, 0.1), 2.0)
    place.surfaces = ground(place, slabs, 4.5, soil) + [
        solid("brick_wall", walls[0], brick),
        solid("ochre_wall", walls[1], ochre),
        solid("block", shapes.box(0.6, 0.4, 0.35).turned(0.3).moved((-side * 1.1, 0.9, z)), stone),
        solid("barrel", shapes.cylinder(0.25, 0.7).moved((side * 0.55, back - 0.4, z)), blue),
    ]
    place.cast = np.array([random.uniform(1.0, 1.3), 1.0, random.uniform(0.65, 0.9)])
    if random.random() < 0.5:
        place.cast = place.cast[::-1].copy()
    spot = (side * random.uniform(0.55, 0.7), random.uniform(-0.1, 0.3))
    height, distance = random.uniform(0.45, 0.8), random.uniform(2.2, 2.6)
    return finish(random, place, frames, spot, height, distance, size)


def morning(random, frames, size):
    """A low sun in haze: long shadows of a pole, a bench and a step."""
    sky = Sky("nishita", random.uniform(0.6, 1.5), random.uniform(3.0, 6.0))
    sky.words = str(random.choice(["", "hazy"]))
    place, side = begun(random, "morning", ((42, 56), (4, 9)), (12, 23), sky, -0.004, 0.45, True)
    z, sun = place.ground_z, place.to_sun
    grey = random.uniform(0.24, 0.4) * np.array([1, 0.95, 0.88])
    cobbles = patterns.masonry(
        "cobbles", random, grey, (0.18, 0.16, 0.13), 10, 10, 1.2, 0.012, 0.5, 0.1
    )
    sandstone = patterns.plain("sandstone", random, (0.5, 0.42, 0.28), 1.2, 0.08)
    concrete = patterns.plain("concrete", random, (0.36, 0.35, 0.32), 1.5)
    wood = patterns.boards("wood", random, (0.32, 0.18, 0.08), 6, 0.8)
    metal = patterns.flat("metal", (0.2, 0.21, 0.23))
    flat_sun = sun[:2] / np.linalg.norm(sun[:2])
    past = random.uniform(-0.6, 0.6) * np.array([-flat_sun[1], flat_sun[0]])
    pole = shapes.cylinder(0.045, 3.0, 32).moved((*(flat_sun * random.uniform(1.6, 2.3) + past), z))
    bench = shapes.joined(
        [shapes.box(1.3, 0.4, 0.05).moved((0, 0, 0.42))]
        + [shapes.box(0.08, 0.36, 0.42).moved((x, 0, 0)) for x in (-0.55, 0.55)]
    )
    back = random.uniform(1.8, 2.4)
    behind = shapes.box(8.0, 0.3, random.uniform(0.6, 1.6)).moved((0, back + 0.15, z))
    grassland = patterns.plain("grassland", random, (0.1, 0.15, 0.05), 3.0, 0.15)
    place.surfaces = ground(place, cobbles, 6.0, grassland) + [
        solid("wall", behind, sandstone),
        solid("step", shapes.box(2.0, 0.5, 0.16).moved((-side * 0.8, back - 0.25, z)), concrete),
        solid("pole", pole, metal),
        solid("bench", bench.turned(random.uniform(-0.4, 0.4)).moved((side * 1.2, 1.15, z)), wood),
    ]
    spot = (-side * random.uniform(0.6, 0.8), random.uniform(0.0, 0.3))
    height, distance = random.uniform(0.5, 0.85), random.uniform(2.4, 2.8)
    return finish(random, place, frames, spot, height, distance, size)


def park(random, frames, size, tree_phantom=None):
    """Haze under a leafy tree whose shade dapples marker and ground. `tree_phantom`: none, trunk,
    or leafy, a reconstruction's fewer and larger leaves; None: the seed chooses."""
    sky = Sky("nishita", random.uniform(1.4, 2.6), random.uniform(2.0, 5.0))
    sky.words = str(random.choice(["", "hazy"]))
    place, side = begun(random, "park", ((42, 56), (5, 9)), (35, 55), sky, -0.004, 0.45)
    z, sun = place.ground_z, place.to_sun
    grey = random.uniform(0.3, 0.45) * np.array([1, 0.92, 0.78])
    gravel = patterns.plain("gravel", random, grey, 1.5, 0.1, 0.001, 0.6)
    turf = patterns.plain("turf", random, (0.09, 0.14, 0.035), 1.5, 0.2, 0.002, 0.8)
    blades = patterns.flat("blades", (0.1, 0.18, 0.04))
    wood = patterns.boards("wood", random, (0.3, 0.17, 0.08), 5, 0.6)
    stone = patterns.plain("stone", random, (0.45, 0.42, 0.36), 1.0, 0.08)
    bark = patterns.plain("bark", random, (0.14, 0.1, 0.07), 0.6, 0.2)
    leaf = patterns.flat("leaves", random.uniform(0.8, 1.2) * np.array([0.08, 0.16, 0.03]))
    edge = random.uniform(1.1, 1.5)
    lawn = shapes.rectangle(-4.5, edge, 4.5, 4.5, z + 0.002)
    tall, radius = random.uniform(4.5, 6.0), random.uniform(1.3, 1.9)
    shaded = np.array([random.uniform(-0.6, 0.6), random.uniform(-0.3, 0.6)])
    foot = shaded + sun[:2] / sun[2] * (tall - radius)
    trunk, leaves = plants.tree(
        random, (*foot, z), tall, radius, int(random.uniform(2500, 5500) * radius**2), 0.05
    )
    if tree_phantom is None:
        tree_phantom = str(random.choice(["none", "trunk", "leafy"]))
    post = shapes.box(0.1, 0.1, 0.9).moved((side * random.uniform(0.7, 1.0), 0.75, z))
    block = shapes.box(0.7, 0.45, 0.4).turned(random.uniform(-0.5, 0.5))
    block = block.moved((-side * 1.0, edge - 0.1, z))
    blade_mesh = plants.grass(random, -2.5, edge, 2.5, 3.2, z, 2500, 0.05)
    few = plants.some_leaves(random, leaves, 0.2, 2.2) if tree_phantom == "leafy" else None
    place.surfaces = ground(place, gravel, 4.5, turf) + [
        solid("lawn", lawn, turf),
        Surface("blades", blade_mesh, blades, translucent=True),
        solid("post", post, wood),
        solid("block", block, stone),
        Surface("trunk", trunk, bark, None if tree_phantom == "none" else trunk),
        Surface("leaves", leaves, leaf, few, True),
    ]
    spot = (-side * random.uniform(0.6, 0.8), random.uniform(-0.1, 0.3))
    place.brightness = 1.1
    height, distance = random.uniform(0.5, 0.85), random.uniform(2.3, 2.8)
    return finish(random, place, frames, spot, height, distance, size)


def square(random, frames, size):
    """Bare paving under a sun in haze. The only shadow in view is that of a column which no phantom
    stands for; it crosses the marker."""
    sky = Sky("nishita", random.uniform(1.0, 3.5), random.uniform(1.5, 4.0))
    sky.words = str(random.choice(["", "clear", "hazy"]))
    place, side = begun(random, "square", ((42, 56), (4, 9)), (25, 45), sky, -0.004, 0.45)
    z, sun = place.ground_z, place.to_sun
    grey = random.uniform(0.25, 0.4) * np.array([1, 0.95, 0.88])
    slabs = patterns.masonry(
        "slabs", random, grey, (0.15, 0.14, 0.12), 4, 4, 1.6, 0.01, 0.5, 0.06
    )
    stone = patterns.plain("stone", random, (0.46, 0.42, 0.34), 1.0, 0.09)
    grassland = patterns.plain("grassland", random, (0.1, 0.15, 0.05), 3.0, 0.15)
    flat_sun = sun[:2] / np.linalg.norm(sun[:2])
    past = random.uniform(-0.1, 0.1) * np.array([-flat_sun[1], flat_sun[0]])
    foot = flat_sun * random.uniform(1.0, 1.6) + past
    column = shapes.cylinder(random.uniform(0.09, 0.15), 2.5, 48).moved((*foot, z))
    place.surfaces = ground(place, slabs, 6.0, grassland) + [Surface("column", column, stone)]
    across = np.array([-flat_sun[1], flat_sun[0]]) * random.choice([-1.0, 1.0])
    spot = across * random.uniform(0.7, 0.9)
    height, distance = random.uniform(0.4, 0.7), random.uniform(2.3, 2.8)
    return finish(random, place, frames, tuple(spot), height, distance, size)


def canyon(random, frames, size):
    """A street between two rows of tall houses that hide most of the sky. A low sun reaches marker
    and object through a gap; one row is sunlit and reflects."""
    sky = Sky("nishita", random.uniform(2.0, 4.5), random.uniform(1.0, 3.0))
    sky.words = str(random.choice(["", "clear"]))
    place, side = begun(random, "canyon", ((40, 56), (4, 9)), (22, 38), sky, -0.004, 0.45)
    z, sun = place.ground_z, place.to_sun
    grey = random.uniform(0.2, 0.32) * np.array([1, 0.97, 0.92])
    slabs = patterns.masonry(
        "slabs", random, grey, (0.12, 0.11, 0.1), 4, 4, 1.6, 0.01, 0.5, 0.08
    )
    warm = random.uniform(0.45, 0.6) * np.array([1.0, 0.84, 0.62])
    facade = patterns.masonry(
        "facade", random, warm, (0.35, 0.32, 0.28), 3, 8, 1.8, 0.012, 0.5, 0.06
    )
    brick = patterns.masonry(
        "brick", random, (0.34, 0.13, 0.09), (0.4, 0.38, 0.34), 4, 14, 1.0, 0.01, 0.5, 0.12
    )
    metal = patterns.flat("metal", (0.2, 0.21, 0.23))
    stone = patterns.plain("stone", random, (0.45, 0.42, 0.36), 1.0, 0.08)
    half = random.uniform(3.2, 4.5)  # Half of the street's width; it runs along y.
    sunny = float(np.sign(sun[0]))  # The row on this side stands towards the sun.
    # The gap lies where the sun's rays through the middle of the scene cross that row.
    way = half / max(abs(sun[0]), 0.2)
    gap, width = sun[1] * way, random.uniform(4.0, 5.5)
    tall = random.uniform(9.0, 14.0)
    row = shapes.joined(
        [
            shapes.box(5.0, 40.0, tall).moved((sunny * (half + 2.5), gap + width / 2 + 20.0, z)),
            shapes.box(5.0, 40.0, tall * 0.8).moved((sunny * (half + 2.5), gap - width / 2 - 20.0, z)),
        ]
    )
    across = shapes.box(5.0, 80.0, tall * 0.9).moved((-sunny * (half + 2.5), 0.0, z))
    bollard = shapes.cylinder(0.07, 0.9, 24).moved((side * random.uniform(0.8, 1.1), 1.1, z))
    kerb = shapes.box(0.3, 8.0, 0.15).moved((-sunny * (half - 1.2), 0.0, z))
    dark = patterns.plain("asphalt", random, (0.1, 0.1, 0.1), 2.0)
    place.surfaces = ground(place, slabs, 12.0, dark) + [
        solid("row", row, brick),
        solid("across", across, facade),
        solid("bollard", bollard, metal),
        solid("kerb", kerb, stone),
    ]
    spot = (-side * random.uniform(0.6, 0.8), random.uniform(0.0, 0.3))
    place.brightness = 1.5  # Exposed for the street, which sees little sky.
    height, distance = random.uniform(0.5, 0.85), random.uniform(2.3, 2.8)
    return finish(random, place, frames, spot, height, distance, size)


def snow(random, frames, size):
    """Snow under a low winter sun: the ground lights everything from below."""
    sky = Sky("nishita", random.uniform(1.5, 4.0), random.uniform(0.5, 1.5))
    sky.words = str(random.choice(["", "clear"]))
    place, side = begun(random, "snow", ((45, 60), (1, 3)), (14, 32), sky, -0.004, 0.45)
    z = place.ground_z
    white = random.uniform(0.74, 0.86) * np.array([0.99, 1.0, 1.02])
    cover = patterns.plain("snow", random, white, 2.0, 0.02, 0.0008, 1.4)
    wood = patterns.boards("wood", random, (0.26, 0.17, 0.1), 6, 0.8)
    stone = patterns.plain("stone", random, (0.36, 0.34, 0.31), 1.0, 0.09)
    red = patterns.flat("post", (0.4, 0.04, 0.03))
    back = random.uniform(1.8, 2.6)
    fence = shapes.joined(
        [shapes.box(6.0, 0.04, 0.12).moved((0, 0, h)) for h in (0.3, 0.7)]
        + [shapes.box(0.1, 0.1, 1.0).moved((x, 0.07, 0)) for x in (-2.0, -0.7, 0.6, 1.9)]
    )
    place.surfaces = ground(place, cover, 8.0, cover) + [
        solid("fence", fence.moved((0, back, z)), wood),
        solid("post", shapes.cylinder(0.05, 1.1).moved((side * random.uniform(0.7, 1.0), 0.9, z)), red),
        solid("block", shapes.box(0.6, 0.4, 0.35).turned(0.4).moved((-side * 1.2, 1.0, z)), stone),
    ]
    spot = (-side * random.uniform(0.6, 0.8), random.uniform(-0.1, 0.3))
    height, distance = random.uniform(0.5, 0.85), random.uniform(2.3, 2.8)
    place.brightness = 0.8
    return finish(random, place, frames, spot, height, distance, size)


def wall(random, frames, size):
    """The marker hangs on a sunlit wall above paving; the object stands on the paving."""
    sky = Sky("nishita", random.uniform(2.0, 5.0), random.uniform(0.8, 2.5))
    sky.words = str(random.choice(["", "clear"]))
    z = -random.uniform(0.9, 1.2)
    place, side = begun(random, "wall", ((36, 56), (4, 9)), (25, 50), sky, z, 0.35)
    place.upright = True
    # The sun stands before the wall, on either side.
    azimuth = place.sun_deg[0]
    place.heading_deg = round((azimuth + 180 + random.uniform(-50, 50)) % 360, 1)
    pale = random.uniform(0.45, 0.65) * np.array([1, 0.93, 0.8])
    plaster = patterns.plain("plaster", random, pale, 1.5, 0.05)
    grey = random.uniform(0.25, 0.38) * np.array([1, 0.96, 0.9])
    slabs = patterns.masonry(
        "slabs", random, grey, (0.15, 0.14, 0.12), 4, 4, 1.6, 0.01, 0.5, 0.06
    )
    stone = patterns.plain("stone", random, (0.46, 0.42, 0.34), 1.0, 0.09)
    metal = patterns.flat("metal", (0.2, 0.21, 0.23))
    behind = shapes.box(9.0, 0.3, 3.2).moved((0, 0.154, z))
    pole = shapes.cylinder(0.04, 2.4).moved((side * random.uniform(0.9, 1.3), -0.5, z))
    bench = shapes.box(1.0, 0.35, 0.42).moved((-side * 1.4, -0.25, z))
    grass = patterns.plain("grassland", random, (0.1, 0.15, 0.05), 3.0, 0.15)
    place.surfaces = ground(place, slabs, 6.0, grass) + [
        solid("wall", behind, plaster),
        solid("bench", bench, stone),
        solid("pole", pole, metal),
    ]
    spot = (side * random.uniform(0.3, 0.5), -random.uniform(0.45, 0.7))
    height, distance = random.uniform(0.45, 0.7), random.uniform(2.6, 3.1)
    aim = (spot[0] * 0.4, 0.0, 0.5 * z)
    return finish(random, place, frames, spot, height, distance, size, (6, 16), aim)


# In an order that seeds are made of: further ones follow the last.
PLACES = {
    "morning": morning,
    "park": park,
    "terrace": terrace,
    "yard": yard,
    "square": square,
    "canyon": canyon,
    "snow": snow,
    "wall": wall,
}
