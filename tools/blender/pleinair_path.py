# Brings a camera path of pleinair's (camera.glb) into Blender 3.4 or later: an animated camera that
# sees what the real one saw, pixel by pixel, the marker as a shadow catcher, the points of a
# reconstruction, and the recorded frames behind it all. docs/guide/trajectories.md tells how to use it.
#
#   blender --python pleinair_path.py -- camera.glb --frames frames/
#   python3 pleinair_path.py camera.glb        prints what it would set, as JSON, without Blender
import argparse
import json
import math
import os
import struct
import sys

SENSOR_WIDTH_MM = 36.0  # Blender's own; only its ratio to the focal length counts.


def read_glb(path):
    """JSON and binary chunk of a .glb file (glTF 2.0, section 4)."""
    with open(path, "rb") as file:
        data = file.read()
    if len(data) < 20 or data[:4] != b"glTF" or struct.unpack_from("<I", data, 8)[0] != len(data):
        raise ValueError(f"{path}: is no whole .glb file")
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def floats(gltf, binary, accessor):
    """The vectors of an accessor of floats."""
    about = gltf["accessors"][accessor]
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[about["type"]]
    start = gltf["bufferViews"][about["bufferView"]].get("byteOffset", 0)
    values = struct.unpack_from(f"<{about['count'] * width}f", binary, start)
    return [values[i : i + width] for i in range(0, len(values), width)]


def z_up(vector):
    """glTF's scene has y up, Blender's z: a quarter turn about x."""
    return (vector[0], -vector[2], vector[1])


def z_up_turn(quaternion):
    """The same for a turn x, y, z, w of glTF's; Blender's order is w, x, y, z. Cameras look along
    their own -z in both, so that nothing else changes."""
    x, y, z, w = quaternion
    h = math.sqrt(0.5)  # The quarter turn (h, 0, 0, h) times the turn.
    return (h * (w - x), h * (x + w), h * (y - z), h * (y + z))


def lens_of(camera):
    """Blender's settings of a camera whose pixels are ours: (0, 0) is the first pixel's centre."""
    own = camera["extras"]["pleinair"]
    width, height = own["width"], own["height"]
    aspect_y = own["fx"] / own["fy"]
    return {
        "resolution": [width, height],
        "pixel_aspect_y": aspect_y,
        "lens_mm": own["fx"] * SENSOR_WIDTH_MM / width,
        # In widths of the sensor; a positive shift moves the window right and up.
        "shift_x": (width / 2 - (own["cx"] + 0.5)) / width,
        "shift_y": ((own["cy"] + 0.5) - height / 2) * aspect_y / width,
        "distorted": any(own["distortion_k1_k2_p1_p2_k3_k4_k5_k6"]),
    }


def frame_rate_of(times_s):
    """The rate of the recording: that of the usual step between poses."""
    steps = sorted(b - a for a, b in zip(times_s, times_s[1:]))
    if not steps:
        return 24.0
    rate = 1.0 / steps[len(steps) // 2]
    return float(round(rate)) if abs(rate - round(rate)) < 5e-4 * rate else rate


def describe(path, frame_rate=None):
    """All that a .glb of pleinair's says, in Blender's terms."""
    gltf, binary = read_glb(path)
    samplers = gltf["animations"][0]["samplers"]
    times = [t[0] for t in floats(gltf, binary, samplers[0]["input"])]
    places = floats(gltf, binary, samplers[0]["output"])
    turns = floats(gltf, binary, samplers[1]["output"])
    rate = frame_rate or frame_rate_of(times)
    # Poses count from the recording's start; stamps of a clock count from the first pose instead.
    start = gltf["cameras"][0]["extras"]["pleinair"]["first_timestamp_ns"] * 1e-9
    start = start if 0 <= start < 86400 else 0.0
    keys = [
        {"frame": 1 + (start + t) * rate, "location": z_up(p), "rotation_wxyz": z_up_turn(q)}
        for t, p, q in zip(times, places, turns)
    ]
    result = {**lens_of(gltf["cameras"][0]), "frame_rate": rate, "keys": keys}
    for mesh in gltf.get("meshes", []):
        where = mesh["primitives"][0]["attributes"]["POSITION"]
        result[mesh["name"]] = [z_up(p) for p in floats(gltf, binary, where)]
    return result


def add_camera(bpy, scene, path):
    data = bpy.data.cameras.new("pleinair")
    data.sensor_fit = "HORIZONTAL"
    data.sensor_width = SENSOR_WIDTH_MM
    data.lens = path["lens_mm"]
    data.shift_x, data.shift_y = path["shift_x"], path["shift_y"]
    data.clip_start = 0.01
    camera = bpy.data.objects.new("pleinair", data)
    camera.rotation_mode = "QUATERNION"
    scene.collection.objects.link(camera)
    for key in path["keys"]:
        camera.location = key["location"]
        camera.rotation_quaternion = key["rotation_wxyz"]
        for channel in ("location", "rotation_quaternion"):
            camera.keyframe_insert(channel, frame=key["frame"])
    for curve in camera.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    scene.camera = camera
    return camera


def add_mesh(bpy, scene, name, vertices, faces):
    mesh = bpy.data.meshes.new("pleinair " + name)
    mesh.from_pydata(vertices, [], faces)
    thing = bpy.data.objects.new("pleinair " + name, mesh)
    scene.collection.objects.link(thing)
    return thing


def add_frames(bpy, scene, camera, folder):
    pictures = sorted(f for f in os.listdir(folder) if f.lower().endswith((".png", ".jpg")))
    if not pictures:
        raise ValueError(f"{folder}: holds no pictures")
    image = bpy.data.images.load(os.path.join(os.path.abspath(folder), pictures[0]))
    image.source = "SEQUENCE"
    digits = "".join(c for c in os.path.splitext(pictures[0])[0][::-1] if c.isdigit())[::-1]
    behind = camera.data.background_images.new()
    behind.image = image
    behind.alpha = 1.0
    behind.image_user.frame_duration = len(pictures)
    behind.image_user.frame_start = 1
    behind.image_user.frame_offset = int(digits) - 1
    camera.data.show_background_images = True
    scene.frame_end = max(scene.frame_end, len(pictures))


def build(bpy, path, frames=None):
    """Adds everything to the scene that is open; gives the camera."""
    scene = bpy.context.scene
    render = scene.render
    render.resolution_x, render.resolution_y = path["resolution"]
    render.resolution_percentage = 100
    # Blender takes no aspect below 1: the wider side is the one that is stretched.
    aspect_y = path["pixel_aspect_y"]
    render.pixel_aspect_x, render.pixel_aspect_y = max(1.0, 1 / aspect_y), max(1.0, aspect_y)
    render.fps = max(1, round(path["frame_rate"]))
    render.fps_base = render.fps / path["frame_rate"]
    render.film_transparent = True
    scene.frame_start = 1
    scene.frame_end = max(1, math.ceil(path["keys"][-1]["frame"] - 1e-3))
    camera = add_camera(bpy, scene, path)
    if "marker" in path:
        marker = add_mesh(bpy, scene, "marker", path["marker"], [(0, 1, 3, 2)])
        marker.is_shadow_catcher = True
    if "points" in path:
        add_mesh(bpy, scene, "points", path["points"], [])
    if frames:
        add_frames(bpy, scene, camera, frames)
    if path["distorted"]:
        print("pleinair: the lens bends straight lines and Blender's camera does not: undistort the "
              "frames, or add the distortion with a Movie Distortion node (docs/guide/trajectories.md)")
    return camera


def main():
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    parser = argparse.ArgumentParser(description="Brings camera.glb of pleinair's into Blender.")
    parser.add_argument("glb", help="camera.glb, as `pleinair replay --export gltf` writes it")
    parser.add_argument("--frames", help="folder of the recorded frames, shown behind the scene")
    parser.add_argument("--frame-rate", type=float, help="of the scene; else the recording's")
    arguments = parser.parse_args(words)
    path = describe(arguments.glb, arguments.frame_rate)
    try:
        import bpy
    except ImportError:
        print(json.dumps(path))
        return
    build(bpy, path, arguments.frames)


if __name__ == "__main__":
    main()
