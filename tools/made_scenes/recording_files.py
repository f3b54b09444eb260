"""The files of a recording beside its pictures: scene.json, recording.json, truth.tum, models."""
from dataclasses import dataclass
import json
import math

import cv2
import numpy as np

from sun_place import in_marker_frame


@dataclass
class Footage:
    size: tuple  # pixels, width and height
    frames_per_s: float
    poses: list  # 3x4 a frame, camera from marker


@dataclass
class Light:
    """The true light in the pictures' units: irradiance times gain."""

    sun: np.ndarray  # facing it
    sky: np.ndarray  # on level ground in the open
    gain: np.ndarray
    radiance_scale: float  # of Cycles' sky
    film: object  # film.Film: factors of all this by frame
    camera: object  # camera.Camera


def write_obj(path, library, parts, normals=None):
    """`parts`: (name, material, mesh). `normals`: one a point, for the one part there is."""
    with open(path, "w") as file:
        file.write(f"# marker coordinates, metres\nmtllib {library}\n")
        first = 1
        for name, material, mesh in parts:
            file.write(f"o {name}\nusemtl {material}\n")
            for p in mesh.points:
                file.write("v %.5f %.5f %.5f\n" % tuple(p))
            for n in [] if normals is None else normals:
                file.write("vn %.5f %.5f %.5f\n" % tuple(n))
            for face in mesh.faces:
                numbers = [first + i for i in face]
                if normals is None:
                    file.write("f " + " ".join(map(str, numbers)) + "\n")
                else:
                    file.write("f " + " ".join(f"{i}//{i}" for i in numbers) + "\n")
            first += len(mesh.points)


def write_mtl(path, albedos):
    with open(path, "w") as file:
        for name, albedo in albedos.items():
            file.write(f"newmtl {name}\n# Kd is linear Rec.709 mean albedo\n")
            file.write("Kd %.4f %.4f %.4f\nillum 1\n" % tuple(albedo))


def marker_to_camera(eye, target):
    """3x4: OpenCV's camera axes at `eye`, looking at `target`, level."""
    forward = np.asarray(target) - np.asarray(eye)
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    turn = np.stack([right, np.cross(forward, right), forward])
    return np.hstack([turn, (-turn @ np.asarray(eye))[:, None]])


def of_marker(pose, place):
    """A pose of the level frame as one of the marker's."""
    return np.hstack([pose[:, :3] @ place.marker_from_level.T, pose[:, 3:]])


def _by_frame(light):
    """Factors of sun, sky and gain, a frame each; nothing where none changes."""
    film = light.film
    if all(np.ptp(x) == 0 for x in (film.sun, film.sky, film.gain)):
        return None
    return {key: getattr(film, key).round(6).tolist() for key in ("sun", "sky", "gain")}


def _quaternion(turn):
    vector = cv2.Rodrigues(turn)[0].ravel()
    angle = np.linalg.norm(vector)
    return (*(math.sin(angle / 2) * vector / max(angle, 1e-12)), math.cos(angle / 2))


def write_truth(path, poses, frames_per_s):
    with open(path, "w") as file:
        file.write("# camera in the marker frame: t_s tx ty tz qx qy qz qw\n")
        for frame, pose in enumerate(poses):
            turn = pose[:, :3].T
            values = (*(-turn @ pose[:, 3]), *_quaternion(turn))
            file.write(f"{frame / frames_per_s:.6f} " + " ".join(f"{v:.8f}" for v in values) + "\n")


def intrinsics(place):
    return {
        "model": "pinhole",
        "fx": place.focal_px,
        "fy": place.focal_px,
        "cx": place.centre_px[0],
        "cy": place.centre_px[1],
        "dist": [0, 0, 0, 0, 0],
    }


def write_recording(path, place, footage):
    lens, (width, height) = intrinsics(place), footage.size
    calibration = {"image_width": width, "image_height": height, "model": "opencv-radtan"}
    calibration.update({k: lens[k] for k in ("fx", "fy", "cx", "cy")})
    calibration["distortion_k1_k2_p1_p2_k3"] = lens["dist"]
    about = {
        "format": 1,
        "frames": "frames",
        "frame_count": len(footage.poses),
        "frame_rate_hz": footage.frames_per_s,
        "timestamps_s": [round(i / footage.frames_per_s, 6) for i in range(len(footage.poses))],
        "calibration": calibration,
        "latitude_deg": place.latitude_deg,
        "longitude_deg": place.longitude_deg,
        "utc": place.utc,
        "marker": {"size_m": place.square_m, "heading_deg": place.heading_deg},
        "truth": "truth.tum",
    }
    with open(path, "w") as file:
        json.dump(about, file, indent=1)


def write_scene(path, place, footage, marker, light, key_frames):
    """`marker`: what, edge_fraction."""
    azimuth, elevation = place.sun_deg
    turned = lambda v: list(place.marker_from_level @ np.asarray(v))
    board = place.square_m / marker["edge_fraction"]
    corners = [(-1, 1), (1, 1), (1, -1), (-1, -1)]
    about = {
        "name": "place",  # Says nothing of the sky: words in a name would be believed.
        "format": 1,
        "units": "metres; angles in degrees",
        "image": {
            "width": footage.size[0],
            "height": footage.size[1],
            "fps": footage.frames_per_s,
            "frames": "frames/%04d.jpg",
            "frame_count": len(footage.poses),
            "encoding": f"8 bit {light.camera.curve}, JPEG q95 4:2:0; key/*.png losslessly",
        },
        "intrinsics": intrinsics(place),
        "marker": {
            "image": "marker.png",
            "board_size_m": board,
            "black_square_side_m": place.square_m,
            "edge_fraction": marker["edge_fraction"],
            "what": marker["what"],
            "albedo_black": 0.04,
            "albedo_white": 0.8,
            "board_corners_marker_xyz": [[x * board / 2, y * board / 2, 0] for x, y in corners],
            "heading_deg": place.heading_deg,
            "face_height_above_ground_m": -place.ground_z,
        },
        "place_time": {
            "latitude_deg": place.latitude_deg,
            "longitude_deg": place.longitude_deg,
            "height_m": 200,
            "utc": place.utc,
        },
        "directions_in_marker_frame": {
            "up": turned([0.0, 0.0, 1.0]),
            "north": turned(in_marker_frame(0.0, 0.0, place.heading_deg)),
            "east": turned(in_marker_frame(90.0, 0.0, place.heading_deg)),
            "to_sun": turned(place.to_sun),
        },
        "sun": {
            "azimuth_deg": azimuth,
            "elevation_deg": elevation,
            "visible": place.sky.sun_to_sky > 0,
        },
        "light_truth_display_units": {
            "sun_normal_irradiance_rgb": list(light.sun),
            "sky_horizontal_irradiance_rgb": list(light.sky),
            "sun_to_sky": place.sky.sun_to_sky,
            "sky_map": "sky_truth.exr",
            "dust_density": place.sky.dust,
            "radiance_scale": light.radiance_scale,
            "factors_by_frame": _by_frame(light),
        },
        "exposure": {
            "gain_rgb": list(light.gain),
            "constant_over_sequence": bool(np.ptp(light.film.gain) == 0),
        },
        "camera": vars(light.camera),
        "virtual_object": {
            "file": "object.obj",
            "kind": place.kind,
            "albedo_linear_rec709": list(place.albedo),
        },
        "real_geometry": {"file": "phantom.obj"},
        "key_frames": key_frames,
        "poses_marker_to_camera": [pose.tolist() for pose in footage.poses],
    }
    if place.upright:
        about["marker"]["upright"] = True
        del about["marker"]["face_height_above_ground_m"]
    if place.sky.words:
        about["sky"] = {"condition": place.sky.words}
    with open(path, "w") as file:
        json.dump(about, file, indent=1)
