#include "app/paths/colmap_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "app/paths/colmap_camera.h"
#include "app/paths/frames_of_others.h"
#include "app/paths/text_lines.h"

namespace pleinair::app {
namespace {

constexpr const char* kWhole = "mend the line, or get a whole copy of the file";

struct Picture {
  std::string where;
  std::string name;
  std::int64_t camera_id = 0;
  std::optional<std::int64_t> number;
  Transform<Reference, Camera> reference_from_camera;
};

/// The number that COLMAP states in a comment ("# Number of images: 2, mean …").
void ReadStatedCount(std::string_view comment, std::optional<std::int64_t>* count) {
  constexpr std::string_view kStart = "# Number of ";
  const std::size_t colon = comment.find(": ");
  if (!comment.starts_with(kStart) || colon == std::string_view::npos) return;
  std::int64_t number = 0;
  const char* last = comment.data() + comment.size();
  const auto [end, error] = std::from_chars(comment.data() + colon + 2, last, number);
  if (error == std::errc() && (end == last || *end == ',')) *count = number;
}

Result<void> CheckCount(const std::string& name, std::optional<std::int64_t> stated,
                        std::size_t found) {
  if (!stated || *stated == static_cast<std::int64_t>(found)) return {};
  return InputError(name, fmt::format("promises {} entries and has {}", *stated, found),
                    "get a whole copy of it");
}

Result<std::map<std::int64_t, CameraModel>> ParseCameras(std::string_view text,
                                                         const std::string& name) {
  std::map<std::int64_t, CameraModel> cameras;
  std::optional<std::int64_t> stated;
  TextLines lines(text, name);
  while (lines.NextOfAnyKind()) {
    if (lines.IsComment()) ReadStatedCount(lines.line(), &stated);
    if (lines.fields().empty()) continue;
    PLEINAIR_ASSIGN_OR_RETURN(const std::int64_t id, lines.Integer(0));
    PLEINAIR_ASSIGN_OR_RETURN(const std::int64_t width, lines.Integer(2));
    PLEINAIR_ASSIGN_OR_RETURN(const std::int64_t height, lines.Integer(3));
    ColmapCamera camera;
    camera.model = lines.fields()[1];
    // What is out of range is refused by its model, whatever it is cut to here.
    constexpr std::int64_t kTooLarge = 1'000'000;
    camera.width = static_cast<int>(std::clamp<std::int64_t>(width, 0, kTooLarge));
    camera.height = static_cast<int>(std::clamp<std::int64_t>(height, 0, kTooLarge));
    PLEINAIR_ASSIGN_OR_RETURN(camera.parameters, lines.Numbers(4, lines.fields().size() - 4));
    PLEINAIR_ASSIGN_OR_RETURN(const CameraModel model, CameraFromColmap(camera, lines.Where()));
    if (!cameras.emplace(id, model).second) {
      return InputError(lines.Where(), "has the number of another camera", kWhole);
    }
  }
  PLEINAIR_RETURN_IF_ERROR(CheckCount(name, stated, cameras.size()));
  return cameras;
}

std::optional<std::int64_t> NumberIn(const std::string& picture) {
  const std::string stem = std::filesystem::path(picture).stem().string();
  const std::size_t last_other = stem.find_last_not_of("0123456789");
  const char* first = stem.data() + (last_other == std::string::npos ? 0 : last_other + 1);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(first, stem.data() + stem.size(), number);
  constexpr std::int64_t kMost = 1'000'000'000;
  if (error != std::errc() || number > kMost) return std::nullopt;
  return number;
}

Result<std::vector<Picture>> ParseImages(std::string_view text, const std::string& name) {
  std::vector<Picture> pictures;
  std::optional<std::int64_t> stated;
  TextLines lines(text, name);
  while (lines.NextOfAnyKind()) {
    if (lines.IsComment()) ReadStatedCount(lines.line(), &stated);
    if (lines.fields().empty()) continue;
    Picture picture;
    picture.where = lines.Where();
    PLEINAIR_RETURN_IF_ERROR(lines.Integer(0));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> n, lines.Numbers(1, 7));
    const Quaternion turn{.x = n[1], .y = n[2], .z = n[3], .w = n[0]};
    PLEINAIR_ASSIGN_OR_RETURN(
        const auto camera_from_reference,
        (PoseFromFile<Camera, Reference>(picture.where, {n[4], n[5], n[6]}, turn)));
    picture.reference_from_camera = camera_from_reference.Inverse();
    PLEINAIR_ASSIGN_OR_RETURN(picture.camera_id, lines.Integer(8));
    picture.name = lines.Rest(9);
    if (picture.name.empty()) return InputError(picture.where, "names no picture", kWhole);
    picture.number = NumberIn(picture.name);
    pictures.push_back(std::move(picture));
    // What was seen in it, which may be nothing; a comment is no such line.
    if (lines.NextOfAnyKind() && (lines.IsComment() || lines.fields().size() % 3 != 0)) {
      return InputError(lines.Where(), "is not a picture's points: X Y POINT3D_ID …",
                        "a picture takes two lines, the second empty where nothing was seen");
    }
  }
  PLEINAIR_RETURN_IF_ERROR(CheckCount(name, stated, pictures.size()));
  return pictures;
}

Result<std::vector<PathPoint>> ParsePoints(std::string_view text, const std::string& name) {
  std::vector<PathPoint> points;
  std::optional<std::int64_t> stated;
  TextLines lines(text, name);
  while (lines.NextOfAnyKind()) {
    if (lines.IsComment()) ReadStatedCount(lines.line(), &stated);
    if (lines.fields().empty()) continue;
    PLEINAIR_RETURN_IF_ERROR(lines.Integer(0));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> n, lines.Numbers(1, 7));
    PathPoint point;
    point.place.xyz = {n[0], n[1], n[2]};
    PLEINAIR_RETURN_IF_ERROR(CheckPose(lines.Where(), point.place.xyz, Quaternion{}));
    for (std::size_t i = 0; i < 3; ++i) {
      if (n[3 + i] < 0.0 || n[3 + i] > 255.0) {
        return InputError(lines.Where(), "has a colour outside 0 to 255", kWhole);
      }
      point.rgb[i] = static_cast<std::uint8_t>(n[3 + i]);
    }
    point.error_px = n[6];
    if (lines.fields().size() % 2 != 0) {
      return InputError(lines.Where(), "has a track that ends in its middle", kWhole);
    }
    points.push_back(point);
  }
  PLEINAIR_RETURN_IF_ERROR(CheckCount(name, stated, points.size()));
  return points;
}

/// Their camera's number; errors: not one, or not there.
Result<CameraModel> CameraOf(const std::vector<Picture>& pictures,
                             const std::map<std::int64_t, CameraModel>& cameras) {
  const std::int64_t id = pictures.front().camera_id;
  for (const Picture& picture : pictures) {
    if (picture.camera_id != id) {
      return InputError(picture.where, "was taken with another camera than the first picture",
                        "leave the pictures of one camera in images.txt, or reconstruct with "
                        "--ImageReader.single_camera 1");
    }
  }
  const auto camera = cameras.find(id);
  if (camera == cameras.end()) {
    return InputError(pictures.front().where,
                      fmt::format("was taken with camera {}, which cameras.txt has not", id),
                      "get whole copies of both files");
  }
  return camera->second;
}

}  // namespace

Result<CameraPath> ParseColmap(const ColmapTexts& texts, const std::string& folder,
                               double frame_rate_hz) {
  const auto in_folder = [&](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  PLEINAIR_ASSIGN_OR_RETURN(const auto cameras,
                            ParseCameras(texts.cameras, in_folder("cameras.txt")));
  PLEINAIR_ASSIGN_OR_RETURN(std::vector<Picture> pictures,
                            ParseImages(texts.images, in_folder("images.txt")));
  CameraPath path;
  PLEINAIR_ASSIGN_OR_RETURN(path.points, ParsePoints(texts.points3d, in_folder("points3D.txt")));
  if (pictures.empty()) {
    return InputError(in_folder("images.txt"), "holds no pictures", "get a whole copy of it");
  }
  PLEINAIR_ASSIGN_OR_RETURN(path.camera, CameraOf(pictures, cameras));
  const bool numbered = std::all_of(pictures.begin(), pictures.end(),
                                    [](const Picture& picture) { return picture.number; });
  std::stable_sort(pictures.begin(), pictures.end(), [&](const Picture& a, const Picture& b) {
    return numbered ? *a.number < *b.number : a.name < b.name;
  });
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    Picture& picture = pictures[i];
    if (i > 0 && (numbered ? picture.number == pictures[i - 1].number
                           : picture.name == pictures[i - 1].name)) {
      return InputError(picture.where,
                        "has the number or name of another picture, so that nobody can tell "
                        "their times",
                        "leave one of them in images.txt");
    }
    PathPose pose;
    const double index = numbered ? static_cast<double>(*picture.number) : static_cast<double>(i);
    constexpr double kMostSeconds = 9e9;
    if (!(index / frame_rate_hz <= kMostSeconds)) {
      return InputError(picture.where, "lies centuries after the first picture",
                        "give the frame rate that the pictures were taken with");
    }
    pose.timestamp_ns = std::llround(index / frame_rate_hz * 1e9);
    pose.reference_from_camera = picture.reference_from_camera;
    pose.picture = std::move(picture.name);
    PLEINAIR_RETURN_IF_ERROR(AddPose(picture.where, std::move(pose), &path));
  }
  return path;
}

Result<ColmapTexts> ColmapFromPath(const CameraPath& path) {
  if (!path.camera) {
    return InputError("", "a COLMAP model needs the camera's lens, which the path has not",
                      "give it with --calibration");
  }
  ColmapTexts texts;
  const ColmapCamera camera = ColmapFromCamera(*path.camera);
  texts.cameras = fmt::format(
      "# Camera list with one line of data per camera:\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, "
      "PARAMS[]\n# Number of cameras: 1\n1 {} {} {}",
      camera.model, camera.width, camera.height);
  for (const double parameter : camera.parameters) texts.cameras += fmt::format(" {}", parameter);
  texts.cameras += '\n';
  texts.images = fmt::format(
      "# Image list with two lines of data per image:\n#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, "
      "CAMERA_ID, NAME\n#   POINTS2D[] as (X, Y, POINT3D_ID)\n# Number of images: {}, mean "
      "observations per image: 0\n",
      path.poses.size());
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const PathPose& pose = path.poses[i];
    const Transform<Camera, Reference> camera_from_reference = pose.reference_from_camera.Inverse();
    const Quaternion q = QuaternionOf(camera_from_reference.rotation);
    const Vec3 t = camera_from_reference.translation_m;
    const std::string name =
        pose.picture.empty() ? fmt::format("frames/{:04}.png", i) : pose.picture;
    texts.images +=
        fmt::format("{} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} 1 {}\n\n", i + 1,
                    q.w, q.x, q.y, q.z, t.x, t.y, t.z, name);
  }
  texts.points3d = fmt::format(
      "# 3D point list with one line of data per point:\n#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, "
      "TRACK[] as (IMAGE_ID, POINT2D_IDX)\n# Number of points: {}, mean track length: 0\n",
      path.points.size());
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint& point = path.points[i];
    const Vec3 at = point.place.xyz;
    texts.points3d += fmt::format("{} {:.12g} {:.12g} {:.12g} {} {} {} {:.6g}\n", i + 1, at.x, at.y,
                                  at.z, point.rgb[0], point.rgb[1], point.rgb[2], point.error_px);
  }
  return texts;
}

}  // namespace pleinair::app
