"""The scene's meshes and materials in Blender."""
import bpy
import cv2
import numpy as np

from shapes import rectangle

INK, PAPER = 0.04, 0.80  # Albedo of printed black and white, as in the other recordings.


def _image(name, values):
    """A picture of linear values (rows from the top) as Blender keeps it."""
    height, width = values.shape[:2]
    image = bpy.data.images.new(name, width, height, alpha=False, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    rgba = np.ones((height, width, 4), np.float32)
    rgba[..., :3] = values if values.ndim == 3 else values[..., None]
    image.pixels.foreach_set(rgba[::-1].ravel())
    image.pack()
    return image


def _texture(material, image):
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    return node.outputs["Color"]


def _material(name):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    output = material.node_tree.nodes.new("ShaderNodeOutputMaterial")
    return material, output.inputs["Surface"]


def diffuse(name, albedo, height=None, translucent=False):
    """Lambertian. `albedo`: a colour, or a picture with one of `height` (metres) for its bumps.
    `translucent`: three tenths of the light come through instead (leaves)."""
    material, surface = _material(name)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    body = nodes.new("ShaderNodeBsdfDiffuse")
    if np.ndim(albedo) == 1:
        body.inputs["Color"].default_value = (*albedo, 1.0)
    else:
        links.new(_texture(material, _image(name, albedo)), body.inputs["Color"])
    if height is not None and np.ptp(height) > 0:
        bump = nodes.new("ShaderNodeBump")
        bump.inputs["Distance"].default_value = 1.0
        links.new(_texture(material, _image(name + "_height", height)), bump.inputs["Height"])
        links.new(bump.outputs[0], body.inputs["Normal"])
    if not translucent:
        links.new(body.outputs[0], surface)
        return material
    through, mix = nodes.new("ShaderNodeBsdfTranslucent"), nodes.new("ShaderNodeMixShader")
    through.inputs["Color"].default_value = (*albedo, 1.0)
    mix.inputs[0].default_value = 0.3
    links.new(body.outputs[0], mix.inputs[1])
    links.new(through.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], surface)
    return material


def glow(strength):
    material, surface = _material("glow")
    light = material.node_tree.nodes.new("ShaderNodeEmission")
    light.inputs["Strength"].default_value = strength
    material.node_tree.links.new(light.outputs[0], surface)
    return material


def add_mesh(name, mesh, material, texture_m=None, smooth=False):
    """`texture_m`: side of the material's picture, laid on by the axis that a face looks along."""
    data = bpy.data.meshes.new(name)
    data.from_pydata([tuple(p) for p in mesh.points], [], mesh.faces)
    data.materials.append(material)
    if texture_m:
        uv = data.uv_layers.new()
        axes = {0: (1, 2), 1: (0, 2), 2: (0, 1)}
        for face in data.polygons:
            u, v = axes[int(np.argmax(np.abs(face.normal)))]
            for corner in face.loop_indices:
                p = data.vertices[data.loops[corner].vertex_index].co
                uv.data[corner].uv = (p[u] / texture_m, p[v] / texture_m)
    if smooth:
        data.polygons.foreach_set("use_smooth", [True] * len(data.polygons))
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def add_surface(surface):
    pattern = surface.pattern
    one_colour = np.ptp(pattern.albedo, axis=(0, 1)).max() == 0
    if one_colour:
        material = diffuse(pattern.name, pattern.mean_albedo, None, surface.translucent)
        return add_mesh(surface.name, surface.mesh, material)
    material = diffuse(pattern.name, pattern.albedo, pattern.height)
    return add_mesh(surface.name, surface.mesh, material, pattern.side_m)


def add_marker(path, board_m, level_from_marker):
    """The printed sheet in its own x-y plane, its centre the origin."""
    grey = cv2.imread(path, cv2.IMREAD_COLOR)[..., ::-1] / 255.0
    linear = np.where(grey <= 0.04045, grey / 12.92, ((grey + 0.055) / 1.055) ** 2.4)
    sheet = rectangle(-board_m / 2, -board_m / 2, board_m / 2, board_m / 2, 0.0)
    sheet.points = sheet.points @ level_from_marker.T
    thing = add_mesh("marker", sheet, diffuse("marker", INK + (PAPER - INK) * linear))
    uv = thing.data.uv_layers.new()
    for corner, place in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))):
        uv.data[corner].uv = place
    return thing
