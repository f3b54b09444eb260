#include "export/trajectories/colmap_text.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "export/trajectories/colmap_camera.h"
#include "export/trajectories/text_lines.h"

namespace pleinair::exports {
namespace {

constexpr const char* kWhole = "correct it, or get a whole copy of the file";

/// Parses the count in a COLMAP comment ("# Number of images: 2, mean …").
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
    ColmapCamera camera;
    PLEINAIR_ASSIGN_OR_RETURN(camera.width, lines.Integer(2));
    PLEINAIR_ASSIGN_OR_RETURN(camera.height, lines.Integer(3));
    camera.model = lines.fields()[1];
    PLEINAIR_ASSIGN_OR_RETURN(camera.parameters, lines.Numbers(4, lines.fields().size() - 4));
    PLEINAIR_ASSIGN_OR_RETURN(const CameraModel model, CameraFromColmap(camera, lines.Where()));
    if (!cameras.emplace(id, model).second) {
      return InputError(lines.Where(), "has the number of another camera", kWhole);
    }
  }
  PLEINAIR_RETURN_IF_ERROR(CheckCount(name, stated, cameras.size()));
  return cameras;
}

Result<std::vector<ColmapPicture>> ParseImages(std::string_view text, const std::string& name) {
  std::vector<ColmapPicture> pictures;
  std::optional<std::int64_t> stated;
  TextLines lines(text, name);
  while (lines.NextOfAnyKind()) {
    if (lines.IsComment()) ReadStatedCount(lines.line(), &stated);
    if (lines.fields().empty()) continue;
    ColmapPicture picture;
    picture.where = lines.Where();
    PLEINAIR_RETURN_IF_ERROR(lines.Integer(0));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> n, lines.Numbers(1, 7));
    const Quaternion turn{.x = n[1], .y = n[2], .z = n[3], .w = n[0]};
    PLEINAIR_ASSIGN_OR_RETURN(
        picture.camera_from_reference,
        (PoseFromFile<Camera, Reference>(picture.where, {n[4], n[5], n[6]}, turn)));
    PLEINAIR_ASSIGN_OR_RETURN(picture.camera_id, lines.Integer(8));
    picture.name = lines.Rest(9);
    if (picture.name.empty()) return InputError(picture.where, "names no image", kWhole);
    pictures.push_back(std::move(picture));
    // The 2D points of the image, possibly none; a comment is not such a line.
    if (lines.NextOfAnyKind() && (lines.IsComment() || lines.fields().size() % 3 != 0)) {
      return InputError(lines.Where(), "is not an image's points: X Y POINT3D_ID …",
                        "an image takes two lines, the second empty where nothing was seen");
    }
  }
  PLEINAIR_RETURN_IF_ERROR(CheckCount(name, stated, pictures.size()));
  return pictures;
}

Result<std::vector<TrajectoryPoint>> ParsePoints(std::string_view text, const std::string& name) {
  std::vector<TrajectoryPoint> points;
  std::optional<std::int64_t> stated;
  TextLines lines(text, name);
  while (lines.NextOfAnyKind()) {
    if (lines.IsComment()) ReadStatedCount(lines.line(), &stated);
    if (lines.fields().empty()) continue;
    PLEINAIR_RETURN_IF_ERROR(lines.Integer(0));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> n, lines.Numbers(1, 7));
    TrajectoryPoint point;
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

}  // namespace

Result<ColmapModel> ParseColmapText(const ColmapFiles& files, const std::string& folder) {
  const auto in_folder = [&](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  ColmapModel model;
  model.images_file = in_folder("images.txt");
  PLEINAIR_ASSIGN_OR_RETURN(model.cameras, ParseCameras(files.cameras, in_folder("cameras.txt")));
  PLEINAIR_ASSIGN_OR_RETURN(model.pictures, ParseImages(files.images, model.images_file));
  PLEINAIR_ASSIGN_OR_RETURN(model.points, ParsePoints(files.points3d, in_folder("points3D.txt")));
  return model;
}

ColmapFiles ColmapText(const ColmapModel& model) {
  ColmapFiles files;
  files.cameras = fmt::format(
      "# Camera list with one line of data per camera:\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, "
      "PARAMS[]\n# Number of cameras: {}\n",
      model.cameras.size());
  for (const auto& [id, lens] : model.cameras) {
    const ColmapCamera camera = ColmapFromCamera(lens);
    files.cameras += fmt::format("{} {} {} {}", id, camera.model, camera.width, camera.height);
    for (const double parameter : camera.parameters) files.cameras += fmt::format(" {}", parameter);
    files.cameras += '\n';
  }
  files.images = fmt::format(
      "# Image list with two lines of data per image:\n#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, "
      "CAMERA_ID, NAME\n#   POINTS2D[] as (X, Y, POINT3D_ID)\n# Number of images: {}, mean "
      "observations per image: 0\n",
      model.pictures.size());
  for (std::size_t i = 0; i < model.pictures.size(); ++i) {
    const ColmapPicture& picture = model.pictures[i];
    const Quaternion q = QuaternionOf(picture.camera_from_reference.rotation);
    const Vec3 t = picture.camera_from_reference.translation_m;
    files.images +=
        fmt::format("{} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {} {}\n\n", i + 1,
                    q.w, q.x, q.y, q.z, t.x, t.y, t.z, picture.camera_id, picture.name);
  }
  files.points3d = fmt::format(
      "# 3D point list with one line of data per point:\n#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, "
      "TRACK[] as (IMAGE_ID, POINT2D_IDX)\n# Number of points: {}, mean track length: 0\n",
      model.points.size());
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const TrajectoryPoint& point = model.points[i];
    const Vec3 at = point.place.xyz;
    files.points3d += fmt::format("{} {:.12g} {:.12g} {:.12g} {} {} {} {:.6g}\n", i + 1, at.x, at.y,
                                  at.z, point.rgb[0], point.rgb[1], point.rgb[2], point.error_px);
  }
  return files;
}

}  // namespace pleinair::exports
