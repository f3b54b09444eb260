"""Renders a made recording with ground truth (README.md beside this file):

    blender -b --python tools/made_scenes/make_recording.py -- park --seed 3 -o park-3
"""
import argparse
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
import cv2
import numpy as np
from mathutils import Matrix

import daylight
import film as films
import pictures
import recording_files as files
import shapes
import surfaces
from camera import CURVES, Camera
from objects import SMOOTH
from places import PLACES

REPOSITORY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SENSOR_MM = 36.0


def asked():
    parser = argparse.ArgumentParser(prog="make_recording.py")
    parser.add_argument("place", choices=sorted(PLACES))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("-o", "--out", required=True)
    parser.add_argument("--frames", type=int, default=4)
    parser.add_argument("--frames-per-s", type=float, default=10.0)
    parser.add_argument("--key-frames", type=int, nargs="*", default=[1])
    parser.add_argument("--size", type=int, nargs=2, default=[480, 360])
    parser.add_argument(
        "--key-samples", type=int, default=192, help="a pixel about a key frame's object"
    )
    parser.add_argument("--samples", type=int, default=32, help="a pixel elsewhere")
    parser.add_argument(
        "--marker-of",
        help="recording whose marker.png is printed (of the bundled two: by the seed)",
    )
    parser.add_argument("--cloud", action="store_true", help="a cloud crosses the sun")
    parser.add_argument("--exposure", choices=films.EXPOSURES, default="locked")
    parser.add_argument("--white-balance-drifts", action="store_true")
    parser.add_argument("--curve", choices=sorted(CURVES), default="srgb", help="of the camera")
    parser.add_argument("--grain", type=float, default=0.0, help="codes of 255, at mid grey")
    parser.add_argument("--sharpening", type=float, default=0.0, help="share of detail added")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def the_marker(options):
    """(picture, what scene.json says of it)."""
    bundled = ("courtyard_midday", "courtyard_tag36h11")[options.seed % 2]
    folder = options.marker_of or os.path.join(REPOSITORY, "recordings", bundled)
    with open(os.path.join(folder, "scene.json")) as file:
        said = json.load(file)["marker"]
    said = {key: said.get(key, "") for key in ("edge_fraction", "what")}
    return os.path.join(folder, "marker.png"), said


def set_camera(place, size):
    """The camera, its lens as OpenCV's pinhole: (0, 0) is the first pixel's centre."""
    camera = bpy.data.cameras.new("camera")
    camera.sensor_width, camera.sensor_fit = SENSOR_MM, "HORIZONTAL"
    camera.lens = place.focal_px * SENSOR_MM / size[0]
    camera.shift_x = (size[0] / 2 - (place.centre_px[0] + 0.5)) / size[0]
    camera.shift_y = ((place.centre_px[1] + 0.5) - size[1] / 2) / size[0]
    camera.clip_start, camera.clip_end = 0.01, 1000.0
    stand = bpy.data.objects.new("camera", camera)
    bpy.context.scene.collection.objects.link(stand)
    bpy.context.scene.camera = stand
    bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = size
    return stand


def stand_at(stand, pose):
    """Blender's camera looks along -z with y up, OpenCV's along z with y down."""
    turn = pose[:, :3].T
    world = np.eye(4)
    world[:3, :3] = turn * (1, -1, -1)
    world[:3, 3] = -turn @ pose[:, 3]
    stand.matrix_world = Matrix(world.tolist())


def touched(place, pose, size):
    """Part of the picture that the object can change, left, top, right, bottom: itself and what it
    darkens on the ground, with a border of a sixth of the picture for its surroundings."""
    points = place.mesh.points
    foot = points * (1, 1, 0) + (0, 0, place.ground_z)
    seen = [points, foot]
    if place.sky.sun_to_sky > 0:
        seen.append(foot - (points - foot)[:, 2:] * (place.to_sun / place.to_sun[2] * (1, 1, 0)))
    at = np.concatenate(seen) @ pose[:, :3].T + pose[:, 3]
    at = at[at[:, 2] > 0.05]
    pixels = place.focal_px * at[:, :2] / at[:, 2:] + place.centre_px
    low = np.clip(pixels.min(axis=0) / size - 1 / 6, 0, 1)
    high = np.clip(pixels.max(axis=0) / size + 1 / 6, 0, 1)
    return (*low, *high)


def write_models(out, place, virtual):
    stand_ins = [s for s in place.surfaces if s.phantom is not None]
    of_marker = lambda mesh: shapes.Mesh(mesh.points @ place.marker_from_level.T, mesh.faces)
    parts = [(s.name, s.pattern.name, of_marker(s.phantom)) for s in stand_ins]
    files.write_obj(f"{out}/phantom.obj", "phantom.mtl", parts)
    albedos = {s.pattern.name: s.pattern.mean_albedo for s in stand_ins}
    files.write_mtl(f"{out}/phantom.mtl", albedos)
    normals = None
    if place.kind in SMOOTH:
        normals = np.array([v.normal for v in virtual.data.vertices]) @ place.marker_from_level.T
    parts = [("virtual", "object", of_marker(place.mesh))]
    files.write_obj(f"{out}/object.obj", "object.mtl", parts, normals)
    files.write_mtl(f"{out}/object.mtl", {"object": place.albedo})


def the_film(options, place, sun_level, sky_level):
    """Its random numbers are its own, so that the place is the same without a cloud."""
    random = np.random.default_rng([options.seed, 7])
    film = films.steady(options.frames)
    if options.cloud:
        films.under_cloud(random, film, options.frames_per_s)
    films.exposed(film, options.exposure, sun_level, sky_level, options.frames_per_s)
    if options.white_balance_drifts:
        films.drifting_white_balance(random, film)
    return film


class Shots:
    """Linear pictures of the place in the light of a frame. With a film whose sun and sky change
    apart, both are rendered apart and weighed."""

    def __init__(self, film):
        self.film = film
        self.apart = bool(np.ptp(film.sun) > 0 or np.ptp(film.sky) > 0)

    def __call__(self, frame, samples, seed, within=None):
        if not self.apart:
            return pictures.rendered(samples, seed, within)
        sun, sky = pictures.rendered_apart(samples, seed, within)
        return sun * self.film.sun[frame] + sky * self.film.sky[frame]


def key_frame(out, frame, background, truth, mask, camera):
    """Writes a key frame's pictures, without grain; what scene.json says of them."""
    shadow = pictures.darkened(truth, background, mask)
    stem = f"key/{frame:04d}_"
    cv2.imwrite(f"{out}/{stem}background.png", camera.developed(background))
    cv2.imwrite(f"{out}/{stem}truth.png", camera.developed(truth))
    cv2.imwrite(f"{out}/{stem}objmask.png", mask)
    cv2.imwrite(f"{out}/{stem}shadow.png", shadow)
    said = {"frame": frame, "background": stem + "background.png", "truth": stem + "truth.png"}
    said.update({"object_mask": stem + "objmask.png", "shadow": stem + "shadow.png"})
    said["stats"] = {"object_px": int((mask > 127).sum()), "shadow_px": int((shadow > 0).sum())}
    return said


def main():
    options = asked()
    out = os.path.abspath(options.out)
    for folder in ("frames", "key"):
        os.makedirs(f"{out}/{folder}", exist_ok=True)
    random = np.random.default_rng([options.seed, list(PLACES).index(options.place)])
    place = PLACES[options.place](random, options.frames, tuple(options.size))

    bpy.ops.wm.read_factory_settings(use_empty=True)
    pictures.set_up()
    sky, sun, level_sky, scale = daylight.light_place(place)
    for surface in place.surfaces:
        surfaces.add_surface(surface)
    marker_picture, marker = the_marker(options)
    board_m = place.square_m / marker["edge_fraction"]
    surfaces.add_marker(marker_picture, board_m, place.marker_from_level.T)
    virtual = surfaces.add_mesh(
        "virtual", place.mesh, surfaces.diffuse("object", place.albedo), smooth=place.kind in SMOOTH
    )
    stand = set_camera(place, options.size)

    sun_level = sun * place.to_sun[2]
    gain = place.cast * place.brightness * np.pi / (surfaces.PAPER * (level_sky + sun_level))
    film = the_film(options, place, sun_level, level_sky)
    shot = Shots(film)
    camera = Camera(options.curve, options.grain, options.sharpening)
    grain = np.random.default_rng([options.seed, 8])
    poses = [files.marker_to_camera(*view) for view in place.views]
    key_frames = []
    for frame, pose in enumerate(poses):
        stand_at(stand, pose)
        is_key = frame in options.key_frames
        exposed = gain * film.gain[frame]
        virtual.hide_render = True
        background = shot(frame, options.samples, frame)
        within = touched(place, pose, options.size)
        if is_key:
            fine = shot(frame, options.key_samples, frame, within)
            background = pictures.with_part(background, fine)
        pictures.write_jpeg(
            f"{out}/frames/{frame:04d}.jpg", camera.developed(background * exposed, grain)
        )
        if is_key:
            virtual.hide_render = False
            fine = shot(frame, options.key_samples, frame, within)
            truth = pictures.with_part(background, fine)
            mask = pictures.object_mask(virtual, within)
            key_frames.append(
                key_frame(out, frame, background * exposed, truth * exposed, mask, camera)
            )

    cv2.imwrite(f"{out}/sky_truth.exr", (sky * gain)[..., ::-1].astype(np.float32))
    cv2.imwrite(f"{out}/marker.png", cv2.imread(marker_picture))
    write_models(out, place, virtual)
    poses = [files.of_marker(pose, place) for pose in poses]
    files.write_truth(f"{out}/truth.tum", poses, options.frames_per_s)
    footage = files.Footage(tuple(options.size), options.frames_per_s, poses)
    files.write_recording(f"{out}/recording.json", place, footage)
    light = files.Light(sun * gain, level_sky * gain, gain, scale, film, camera)
    files.write_scene(f"{out}/scene.json", place, footage, marker, light, key_frames)


if __name__ == "__main__":
    main()
