"""Rendering in Blender, and the pictures of a key frame."""
import os
import tempfile

os.environ.setdefault("OPENCV_IO_ENABLE_OPENEXR", "1")

import bpy
import cv2
import numpy as np

from surfaces import glow


def set_up():
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.use_persistent_data = True
    cycles = scene.cycles
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = 5
    cycles.transmission_bounces = cycles.transparent_max_bounces = 6
    cycles.sample_clamp_indirect = 0.0
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"


def rendered(samples, seed, within=None):
    """What the scene's camera sees: height x width x 3, linear Rec.709, the top row first.
    `within`: (left, top, right, bottom) in parts of the picture; black outside."""
    scene = bpy.context.scene
    scene.render.use_border = within is not None
    if within is not None:
        scene.render.border_min_x, scene.render.border_max_x = within[0], within[2]
        scene.render.border_min_y, scene.render.border_max_y = 1.0 - within[3], 1.0 - within[1]
    scene.cycles.samples, scene.cycles.seed = samples, seed
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "picture.exr")
        bpy.ops.render.render(write_still=True)
        return cv2.imread(scene.render.filepath, cv2.IMREAD_UNCHANGED)[..., ::-1].astype(np.float64)


def rendered_apart(samples, seed, within=None):
    """(sun, sky): as rendered(), once by the lamps alone and once by the world alone."""
    lamps = [o for o in bpy.data.objects if o.type == "LIGHT"]
    nodes = bpy.context.scene.world.node_tree.nodes
    world = next(n for n in nodes if n.type == "BACKGROUND").inputs["Strength"]
    strength = world.default_value
    world.default_value = 0.0
    sun = rendered(samples, seed, within)
    world.default_value = strength
    for lamp in lamps:
        lamp.hide_render = True
    sky = rendered(samples, seed, within)
    for lamp in lamps:
        lamp.hide_render = False
    return sun, sky


def with_part(picture, part):
    """`picture` where `part` is black, else `part`."""
    return np.where(part.max(axis=2, keepdims=True) > 0, part, picture)


def write_jpeg(path, picture):
    cv2.imwrite(path, picture, [cv2.IMWRITE_JPEG_QUALITY, 95])  # OpenCV's default: 4:2:0.


def object_mask(virtual, within, samples=16):
    """Coverage by the object alone, 0..255: it glows, everything else is black."""
    kept, world = {}, bpy.context.scene.world
    bpy.context.scene.world = bpy.data.worlds.new("black")
    bpy.context.scene.world.color = (0, 0, 0)
    lamps = [o for o in bpy.data.objects if o.type == "LIGHT"]
    for lamp in lamps:
        lamp.hide_render = True
    for thing in bpy.data.objects:
        if thing.type == "MESH":
            kept[thing.name] = thing.data.materials[0]
            thing.data.materials[0] = glow(1.0 if thing == virtual else 0.0)
    mask = rendered(samples, 0, within)[..., 1]
    for name, material in kept.items():
        bpy.data.objects[name].data.materials[0] = material
    for lamp in lamps:
        lamp.hide_render = False
    bpy.context.scene.world = world
    return (np.clip(mask, 0, 1) * 255 + 0.5).astype(np.uint8)


def darkened(truth, background, mask):
    """Where the object takes more than 4 % of the light, 128: the luminances of a few pixels about
    each compared, the object's own left out, so that grain does not count."""
    clear = (mask == 0).astype(np.float64)
    weight = np.array([0.2126, 0.7152, 0.0722])
    near = lambda picture: cv2.GaussianBlur(picture @ weight * clear, (0, 0), 1.6)
    ratio = near(truth) / np.maximum(near(background), 1e-9)
    shadow = np.where((ratio < 0.96) & (mask < 128), 128, 0).astype(np.uint8)
    return cv2.medianBlur(shadow, 3)
