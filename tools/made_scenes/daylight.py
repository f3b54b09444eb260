"""Sun and sky in Blender: Cycles' Nishita sky or the CIE overcast sky, a sun of its own beside it,
and what both give on level ground in the open."""
import math

import bpy
import numpy as np
from mathutils import Vector

from pictures import rendered

SUN_DIAMETER_DEG = 0.533
MAP = (256, 128)
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def _camera(name, width, height):
    camera = bpy.data.cameras.new(name)
    stand = bpy.data.objects.new(name, camera)
    bpy.context.scene.collection.objects.link(stand)
    bpy.context.scene.camera = stand
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y = width, height
    render.pixel_aspect_x = render.pixel_aspect_y = 1.0
    return camera, stand


def sky_map(north_rad):
    """The world alone, equirectangular: row 0 the zenith, the middle column north, azimuth to the
    right. `north_rad`: of north, anticlockwise from the marker's y axis."""
    camera, stand = _camera("sky_map", *MAP)
    camera.type = "PANO"
    camera.cycles.panorama_type = "EQUIRECTANGULAR"
    stand.rotation_euler = (math.pi / 2, 0.0, north_rad)
    picture = rendered(8, 0)
    bpy.data.objects.remove(stand)
    return picture


def level_irradiance(sky):
    """Of a sky_map, on ground facing up (radiance times steradians times cosine)."""
    rows = np.arange(MAP[1] // 2)
    up = math.pi / 2 - (rows + 0.5) / MAP[1] * math.pi
    weight = np.sin(up) * np.cos(up) * (math.pi / MAP[1]) * (2 * math.pi / MAP[0])
    return (sky[rows] * weight[:, None, None]).sum(axis=(0, 1))


def _sun_irradiance(to_sun):
    """Of the disc in the present world, facing it: what a narrow camera sees of it less the sky."""
    side = 64
    camera, stand = _camera("sun_picture", side, side)
    camera.angle = math.radians(0.9)
    stand.rotation_euler = Vector(to_sun).to_track_quat("-Z", "Y").to_euler()
    picture = rendered(16, 0)
    bpy.data.objects.remove(stand)
    around = np.median(picture[0], axis=0)
    return (picture - around).sum(axis=(0, 1)) * (camera.angle / side) ** 2


def _nishita(nodes, place, disc):
    azimuth_deg, elevation_deg = place.sun_deg
    sky = nodes.new("ShaderNodeTexSky")
    sky.sky_type = "NISHITA"
    sky.sun_disc = disc
    sky.sun_size = math.radians(SUN_DIAMETER_DEG)
    sky.sun_elevation = math.radians(elevation_deg)
    sky.sun_rotation = math.radians(azimuth_deg - place.heading_deg)
    sky.altitude = 200.0
    sky.dust_density = place.sky.dust
    return sky.outputs["Color"]


def _overcast(nodes, links, tint):
    """CIE overcast sky (ISO 15469): L = (1 + 2 sin(elevation)) / 3 of the zenith's."""
    where = nodes.new("ShaderNodeTexCoord")
    parts = nodes.new("ShaderNodeSeparateXYZ")
    links.new(where.outputs["Generated"], parts.inputs[0])
    up = nodes.new("ShaderNodeMath")
    up.operation = "MULTIPLY_ADD"
    up.use_clamp = True
    up.inputs[1].default_value = 2.0 / 3.0
    up.inputs[2].default_value = 1.0 / 3.0
    links.new(parts.outputs["Z"], up.inputs[0])
    colour = nodes.new("ShaderNodeMixRGB")
    colour.blend_type = "MULTIPLY"
    colour.inputs[0].default_value = 1.0
    colour.inputs[2].default_value = (*tint, 1.0)
    links.new(up.outputs[0], colour.inputs[1])
    return colour.outputs[0]


def _set_world(place, disc, strength):
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    world.use_nodes = True
    world.cycles.sampling_method = "MANUAL"
    world.cycles.sample_map_resolution = 256
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    if place.sky.kind == "nishita":
        colour = _nishita(nodes, place, disc)
    else:
        colour = _overcast(nodes, links, place.sky.tint)
    background = nodes.new("ShaderNodeBackground")
    background.inputs["Strength"].default_value = strength
    links.new(colour, background.inputs["Color"])
    links.new(background.outputs[0], nodes.new("ShaderNodeOutputWorld").inputs[0])


def light_place(place):
    """Sets world and sun of an empty scene. Returns (sky map, sun's irradiance facing it, sky's on
    level ground, radiance scale of the sky), in Blender's units."""
    north_rad = math.radians(place.heading_deg)
    if place.sky.kind == "overcast":
        _set_world(place, False, 1.0)
        sky = sky_map(north_rad)
        return sky, np.zeros(3), level_irradiance(sky), 1.0
    _set_world(place, True, 1.0)
    sun = _sun_irradiance(place.to_sun)
    _set_world(place, False, 1.0)
    sky = sky_map(north_rad)
    level_sun = sun @ LUMINANCE * place.to_sun[2]
    scale = level_sun / place.sky.sun_to_sky / (level_irradiance(sky) @ LUMINANCE)
    _set_world(place, False, scale)
    lamp = bpy.data.lights.new("sun", "SUN")
    lamp.angle = math.radians(SUN_DIAMETER_DEG)
    lamp.energy = float(sun.max())
    lamp.color = sun / sun.max()
    stand = bpy.data.objects.new("sun", lamp)
    stand.rotation_euler = Vector(place.to_sun).to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(stand)
    return sky * scale, sun, level_irradiance(sky) * scale, float(scale)
