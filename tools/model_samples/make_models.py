#!/usr/bin/env python3
"""Writes a glTF file for each feature of materials and shapes that pleinair draws.

  tools/model_samples/make_models.py FOLDER
  pleinair model FOLDER/*.gltf -o FOLDER/
  tools/model_samples/join_sheets.py FOLDER docs/images/model_features.jpg

docs/guide/models.md shows the image. Needs nothing but Python.
"""
import base64
import json
import math
import os
import struct
import sys
import zlib

FLOAT, SHORT, BYTE = 5126, 5123, 5121  # Integers without a sign.


def png(width, height, color):
    """An 8-bit picture; color(x, y) gives RGB or RGBA from 0 to 1."""
    rows = b"".join(
        b"\0" + bytes(round(255 * min(max(v, 0), 1)) for x in range(width) for v in color(x, y))
        for y in range(height))

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 6 if len(color(0, 0)) == 4 else 2,
                         0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) +
            chunk(b"IEND", b""))


class Gltf:
    """A file with one buffer, written beside its text."""

    def __init__(self):
        self.data = b""
        self.json = {"asset": {"version": "2.0", "generator": "model_samples"}, "scene": 0,
                     "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [],
                     "accessors": [], "bufferViews": [], "materials": []}

    def view(self, data):
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, rows, kind, component=FLOAT):
        flat = [v for row in rows for v in (row if isinstance(row, (tuple, list)) else (row,))]
        letter = {FLOAT: "f", SHORT: "H", BYTE: "B"}[component]
        view = self.view(struct.pack("<%d%s" % (len(flat), letter), *flat))
        accessor = {"bufferView": view, "componentType": component, "count": len(rows),
                    "type": kind}
        if kind == "VEC3" and component == FLOAT:
            accessor["min"] = [min(r[c] for r in rows) for c in range(3)]
            accessor["max"] = [max(r[c] for r in rows) for c in range(3)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def texture(self, picture):
        view = self.view(picture)
        self.json.setdefault("images", []).append({"bufferView": view, "mimeType": "image/png"})
        self.json.setdefault("textures", []).append({"source": len(self.json["images"]) - 1})
        return len(self.json["textures"]) - 1

    def mesh(self, attributes, indices, material):
        self.json["materials"].append(material)
        primitive = {"attributes": attributes, "indices": self.accessor(indices, "SCALAR", SHORT),
                     "material": len(self.json["materials"]) - 1}
        if not self.json["meshes"]:
            self.json["meshes"].append({"primitives": []})
        self.json["meshes"][0]["primitives"].append(primitive)
        used = set(material.get("extensions", {}))
        if "KHR_texture_transform" in json.dumps(material):
            used.add("KHR_texture_transform")
        if used:
            self.json["extensionsUsed"] = sorted(used)
        return primitive

    def write(self, file):
        self.json["buffers"] = [{"byteLength": len(self.data),
                                 "uri": "data:application/octet-stream;base64," +
                                        base64.b64encode(self.data).decode()}]
        with open(file, "w", encoding="ascii") as out:
            json.dump(self.json, out)


def ball(radius=0.5, columns=64, rows=32):
    """A sphere that stands on y = 0: positions, normals, texture coordinates, indices."""
    positions, normals, uvs, indices = [], [], [], []
    for row in range(rows + 1):
        polar = math.pi * row / rows
        for column in range(columns + 1):
            turn = 2 * math.pi * column / columns
            normal = (-math.sin(polar) * math.sin(turn), math.cos(polar),
                      -math.sin(polar) * math.cos(turn))
            normals.append(normal)
            positions.append((radius * normal[0], radius * (normal[1] + 1), radius * normal[2]))
            uvs.append((column / columns, row / rows))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b = a + columns + 1
            indices += [a, b, a + 1, a + 1, b, b + 1]
    return positions, normals, uvs, indices


def ball_file(material, more=lambda gltf, attributes, shape: None):
    gltf = Gltf()
    shape = ball()
    attributes = {"POSITION": gltf.accessor(shape[0], "VEC3"),
                  "NORMAL": gltf.accessor(shape[1], "VEC3"),
                  "TEXCOORD_0": gltf.accessor(shape[2], "VEC2")}
    more(gltf, attributes, shape)
    gltf.mesh(attributes, shape[3], material(gltf) if callable(material) else material)
    return gltf


def paint(color, roughness=0.6, metallic=0.0, **more):
    return {"pbrMetallicRoughness": {"baseColorFactor": list(color) + [1], "metallicFactor": metallic,
                                     "roughnessFactor": roughness}, **more}


def dimples(x, y):
    """A normal map of round bumps."""
    dx, dy = (x % 32 - 15.5) / 16, (y % 32 - 15.5) / 16
    inside = 1.0 if dx * dx + dy * dy < 0.8 else 0.0
    nx, ny = 0.75 * inside * dx, -0.75 * inside * dy
    return 0.5 + 0.5 * nx, 0.5 + 0.5 * ny, 0.5 + 0.5 * math.sqrt(max(1 - nx * nx - ny * ny, 0))


def normal_map(gltf):
    texture = gltf.texture(png(512, 256, dimples))
    return paint((0.55, 0.5, 0.42), normalTexture={"index": texture})


def emission(gltf):
    texture = gltf.texture(png(64, 64, lambda x, y: (1, 1, 1) if y // 8 % 2 else (0, 0, 0)))
    return paint((0.05, 0.05, 0.05), emissiveFactor=[1, 0.45, 0.1],
                 emissiveTexture={"index": texture},
                 extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 12000}})


def vertex_colors(gltf, attributes, shape):
    attributes["COLOR_0"] = gltf.accessor(
        [(0.5 + 0.5 * n[0], 0.5 + 0.5 * n[1], 0.5 + 0.5 * n[2], 1.0) for n in shape[1]], "VEC4")


def two_sets(gltf, attributes, shape):
    """A second set of coordinates that turns once from pole to pole."""
    attributes["TEXCOORD_1"] = gltf.accessor([(3 * (u + v), 2 * v) for u, v in shape[2]], "VEC2")


def transformed(gltf):
    squares = gltf.texture(png(64, 64, lambda x, y: (0.8, 0.75, 0.7) if (x // 32 + y // 32) % 2
                               else (0.15, 0.3, 0.35)))
    stripes = gltf.texture(png(64, 8, lambda x, y: (0, 0.15 if x < 32 else 0.9, 0)))
    material = paint((1, 1, 1), 1.0)
    material["pbrMetallicRoughness"]["baseColorTexture"] = {
        "index": squares, "extensions": {"KHR_texture_transform": {"scale": [8, 4],
                                                                   "rotation": 0.4}}}
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {"index": stripes, "texCoord": 1}
    return material


def metal(gltf):
    """Stripes of matt paint and of metal, rougher from top to bottom."""
    texture = gltf.texture(png(64, 64, lambda x, y: (0, 0.15 + 0.75 * y / 63,
                                                     1 if x // 8 % 2 else 0)))
    material = paint((0.7, 0.45, 0.25), 1.0, 1.0)
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {"index": texture}
    return material


def holes(gltf):
    """Round holes by the alpha of a texture."""
    texture = gltf.texture(png(128, 64, lambda x, y: (
        0.75, 0.6, 0.2, 0.0 if (x % 16 - 7.5) ** 2 + (y % 16 - 7.5) ** 2 < 24 else 1.0)))
    material = paint((1, 1, 1), 0.7)
    material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": texture}
    return {**material, "alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": True}


def quantized():
    """A ball whose positions are whole numbers, scaled by its node."""
    gltf = Gltf()
    positions, normals, _, indices = ball()
    steps = 4000
    gltf.json["nodes"] = [{"mesh": 0, "scale": [1 / steps] * 3, "translation": [-0.5, 0, -0.5]}]
    whole = [tuple(round(steps * (v + 0.5 * (c != 1))) for c, v in enumerate(p)) + (0,)
             for p in positions]
    view = gltf.view(struct.pack("<%dH" % (4 * len(whole)), *(v for p in whole for v in p)))
    gltf.json["bufferViews"][view]["byteStride"] = 8
    gltf.json["accessors"].append({
        "bufferView": view, "componentType": SHORT, "count": len(whole), "type": "VEC3",
        "min": [min(p[c] for p in whole) for c in range(3)],
        "max": [max(p[c] for p in whole) for c in range(3)]})
    position = len(gltf.json["accessors"]) - 1
    gltf.mesh({"POSITION": position, "NORMAL": gltf.accessor(normals, "VEC3")}, indices,
              paint((0.3, 0.4, 0.5)))
    gltf.json["extensionsUsed"] = gltf.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    return gltf


def bent_leaf():
    """A bent sheet that lets light through."""
    gltf = Gltf()
    positions, indices = [], []
    columns = 24
    for row in (0.02, 1.0):
        for column in range(columns + 1):
            turn = math.radians(-60 + 120 * column / columns)
            positions.append((0.5 * math.sin(turn), row, 0.35 * math.cos(turn) - 0.2))
    for column in range(columns):
        a, b = column, column + columns + 1
        indices += [a, a + 1, b, a + 1, b + 1, b]
    gltf.mesh({"POSITION": gltf.accessor(positions, "VEC3")}, indices,
              {**paint((0.2, 0.35, 0.08)), "doubleSided": True, "extensions": {
                  "KHR_materials_diffuse_transmission": {
                      "diffuseTransmissionFactor": 0.5,
                      "diffuseTransmissionColorFactor": [0.45, 0.7, 0.1]}}})
    return gltf


def pane():
    """A pane of glass on edge, before a ball."""
    gltf = ball_file(paint((0.6, 0.1, 0.08)))
    corners = [(x, y, z) for x in (-0.7, 0.7) for y in (0.0, 1.2) for z in (0.75, 0.77)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    positions, indices = [], []
    for face in faces:
        first = len(positions)
        positions += [corners[i] for i in face]
        indices += [first, first + 1, first + 2, first, first + 2, first + 3]
    gltf.mesh({"POSITION": gltf.accessor(positions, "VEC3")}, indices,
              paint((0.95, 1.0, 0.97), 0.05,
                    extensions={"KHR_materials_transmission": {"transmissionFactor": 1.0}}))
    return gltf


def bent():
    """A column whose skin has three joints, each turned by 25 degrees."""
    gltf = Gltf()
    positions, normals, joints, weights, indices = [], [], [], [], []
    columns, rows, height = 32, 48, 1.5
    for row in range(rows + 1):
        level = 3 * row / rows
        for column in range(columns + 1):
            turn = 2 * math.pi * column / columns
            positions.append((0.2 * math.sin(turn), height * row / rows, 0.2 * math.cos(turn)))
            normals.append((math.sin(turn), 0.0, math.cos(turn)))
            below = min(int(level), 2)
            share = min(level - below, 1.0) if below < 2 else 0.0
            joints.append((below, min(below + 1, 2), 0, 0))
            weights.append((1 - share, share, 0.0, 0.0))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b = a + columns + 1
            indices += [a, a + 1, b, a + 1, b + 1, b]
    step = height / 3
    q = [0, 0, math.sin(math.radians(-12.5)), math.cos(math.radians(-12.5))]
    gltf.json["nodes"] = [
        {"mesh": 0, "skin": 0},
        {"children": [2], "rotation": [0, 0, 0, 1]},
        {"children": [3], "translation": [0, step, 0], "rotation": q},
        {"translation": [0, step, 0], "rotation": q}]
    gltf.json["scenes"] = [{"nodes": [0, 1]}]
    binds = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -step * i, 0, 1] for i in range(3)]
    gltf.json["skins"] = [{"joints": [1, 2, 3],
                           "inverseBindMatrices": gltf.accessor(binds, "MAT4")}]
    gltf.mesh({"POSITION": gltf.accessor(positions, "VEC3"),
               "NORMAL": gltf.accessor(normals, "VEC3"),
               "JOINTS_0": gltf.accessor(joints, "VEC4", BYTE),
               "WEIGHTS_0": gltf.accessor(weights, "VEC4")}, indices, paint((0.2, 0.45, 0.3)))
    return gltf


def morphed():
    """A ball that a morph target pulls up to an egg."""
    gltf = ball_file(paint((0.75, 0.6, 0.4)))
    shape = ball()
    deltas = [(-0.15 * x, 0.35 * y * y, -0.15 * z) for x, y, z in shape[0]]
    turned = []
    for (_, y, _), n in zip(shape[0], shape[1]):
        egg = (n[0] / 0.85, n[1] / (1 + 0.7 * y), n[2] / 0.85)
        size = math.sqrt(sum(v * v for v in egg))
        turned.append(tuple(v / size - n[c] for c, v in enumerate(egg)))
    gltf.json["meshes"][0]["primitives"][0]["targets"] = [
        {"POSITION": gltf.accessor(deltas, "VEC3"), "NORMAL": gltf.accessor(turned, "VEC3")}]
    gltf.json["meshes"][0]["weights"] = [1.0]
    return gltf


def samples():
    extension = lambda name, **values: {"KHR_materials_" + name: values}
    yield "normal_map", ball_file(normal_map)
    yield "emission", ball_file(emission)
    yield "vertex_colors", ball_file(paint((0.9, 0.9, 0.9)), vertex_colors)
    yield "texture_sets", ball_file(transformed, two_sets)
    yield "clearcoat", ball_file(paint((0.45, 0.02, 0.02), 0.7, extensions=extension(
        "clearcoat", clearcoatFactor=1.0, clearcoatRoughnessFactor=0.05)))
    yield "sheen", ball_file(paint((0.02, 0.03, 0.12), 1.0, extensions=extension(
        "sheen", sheenColorFactor=[0.7, 0.75, 1.0], sheenRoughnessFactor=0.35)))
    yield "specular", ball_file(paint((0.02, 0.02, 0.02), 0.15, extensions={
        **extension("ior", ior=2.2),
        **extension("specular", specularColorFactor=[1.0, 0.75, 0.3])}))
    yield "unlit", ball_file(paint((0.1, 0.5, 0.6), extensions=extension("unlit")))
    yield "metallic_roughness", ball_file(metal)
    yield "alpha_mask", ball_file(holes)
    yield "quantization", quantized()
    yield "transmission", pane()
    yield "diffuse_transmission", bent_leaf()
    yield "skin", bent()
    yield "morph_target", morphed()


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    os.makedirs(sys.argv[1], exist_ok=True)
    for name, gltf in samples():
        gltf.write(os.path.join(sys.argv[1], name + ".gltf"))


if __name__ == "__main__":
    main()
