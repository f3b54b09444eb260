#include "app/replay/placement_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "app/output/length_text.h"
#include "base/frames.h"
#include "base/quantile.h"
#include "base/vector.h"
#include "compositor/models/model_frame.h"

namespace pleinair::app {
namespace {

using compositor::ModelBounds;
using compositor::PlacedModel;

constexpr double kFarFromMarker_m = 1000.0;
// Size of a model over the camera's distance from the marker.
constexpr double kTooLarge = 100.0, kTooSmall = 1e-3;
// Frames and points that are tested for phantoms in front of an object.
constexpr std::size_t kMaxFrames = 24, kMaxPoints = 96;
// By how much the lens may widen the view against a pinhole.
constexpr double kDistortionMargin = 1.5;
// Share of a point's distance: phantoms nearer than this hide the point.
constexpr double kInFront = 0.995;

Vec3 Placed(const PlacedModel& placed, Vec3 in_model) {
  return placed.linear * in_model + placed.translation_m;
}

/// Corners of a model's box, marker coordinates.
std::array<Vec3, 8> CornersOf(const PlacedModel& placed) {
  // PlacedModel::translation_m includes the model's origin.
  const ModelBounds box = BoundsOf(*placed.model);
  const Vec3 low = box.min_m - placed.model->origin_m, high = box.max_m - placed.model->origin_m;
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[static_cast<std::size_t>(i)] =
        Placed(placed, {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                        (i & 4) != 0 ? high.z : low.z});
  }
  return corners;
}

/// Median distance of the camera from the marker; nothing without poses.
std::optional<double> ViewingDistance(const std::vector<session::Observation>& path) {
  std::vector<double> distances_m;
  distances_m.reserve(path.size());
  for (const session::Observation& view : path) {
    distances_m.push_back(Norm(view.camera_from_marker.translation_m));
  }
  if (distances_m.empty()) return std::nullopt;
  return Median(std::move(distances_m));
}

/// Returns whether a box may be in view: no side of the view has all its corners outside.
bool MayBeInView(const CameraModel& camera, const Transform<Camera, Marker>& camera_from_marker,
                 const std::array<Vec3, 8>& corners) {
  if (camera.distortion_model == DistortionModel::kEquidistant) return true;  // 180° and more.
  const double left = (camera.cx + 0.5) / camera.fx * kDistortionMargin;
  const double right = (camera.width - 0.5 - camera.cx) / camera.fx * kDistortionMargin;
  const double top = (camera.cy + 0.5) / camera.fy * kDistortionMargin;
  const double bottom = (camera.height - 0.5 - camera.cy) / camera.fy * kDistortionMargin;
  const std::array<Vec3, 5> outside{
      {{0, 0, -1}, {-1, 0, -left}, {1, 0, -right}, {0, -1, -top}, {0, 1, -bottom}}};
  return std::ranges::none_of(outside, [&](Vec3 direction) {
    return std::ranges::all_of(corners, [&](Vec3 corner) {
      return Dot((camera_from_marker * Point<Marker>{corner}).xyz, direction) > 0.0;
    });
  });
}

/// Returns whether the camera is inside a model's box.
bool Surrounds(const PlacedModel& placed, Point<Marker> eye) {
  const ModelBounds box = BoundsOf(*placed.model);
  // The linear part is a rotation times one scale.
  const Mat3 transposed = placed.linear.Transposed();
  const double scale = Norm(transposed * Vec3{1, 0, 0});
  const Vec3 in_model = transposed * (eye.xyz - placed.translation_m) * (1.0 / (scale * scale));
  const Vec3 low = in_model - (box.min_m - placed.model->origin_m);
  const Vec3 high = (box.max_m - placed.model->origin_m) - in_model;
  return std::min({low.x, low.y, low.z, high.x, high.y, high.z}) > 0.0;
}

/// Vertices spread over a model, marker coordinates.
std::vector<Vec3> PointsOf(const PlacedModel& placed) {
  std::size_t count = 0;
  for (const compositor::Mesh& mesh : placed.model->meshes) count += mesh.indices.size();
  const std::size_t step = std::max<std::size_t>(1, count / kMaxPoints);
  std::vector<Vec3> points;
  std::size_t next = 0, first = 0;
  for (const compositor::Mesh& mesh : placed.model->meshes) {
    for (; next < first + mesh.indices.size(); next += step) {
      const auto& p = mesh.positions[mesh.indices[next - first]];
      points.push_back(Placed(placed, {p[0], p[1], p[2]}));
    }
    first += mesh.indices.size();
  }
  return points;
}

/// Returns whether phantoms hide every point of an object that is in view.
bool IsHidden(const PlacedModel& placed, const RecordedViews& views,
              const compositor::PhantomRays& phantoms) {
  const std::vector<Vec3> points = PointsOf(placed);
  const std::size_t step = std::max<std::size_t>(1, views.path.size() / kMaxFrames);
  bool in_view = false;
  for (std::size_t frame = 0; frame < views.path.size(); frame += step) {
    const auto& camera_from_marker = views.path[frame].camera_from_marker;
    const Point<Marker> eye = camera_from_marker.Inverse() * Point<Camera>{};
    for (const Vec3& point : points) {
      const Point<Camera> seen = camera_from_marker * Point<Marker>{point};
      if (seen.xyz.z <= 0.0) continue;
      const Vec2 pixel = ProjectToPixel(views.camera, seen);
      if (!(pixel.x > -0.5 && pixel.y > -0.5 && pixel.x < views.camera.width - 0.5 &&
            pixel.y < views.camera.height - 0.5)) {
        continue;
      }
      in_view = true;
      const double distance_m = Norm(point - eye.xyz);
      const auto hit = phantoms.First(eye, (point - eye.xyz) * (1.0 / distance_m));
      if (!hit || hit->is_foliage || Norm(hit->point.xyz - eye.xyz) > kInFront * distance_m) {
        return false;
      }
    }
  }
  return in_view;
}

class PlacementCheck {
 public:
  PlacementCheck(const scene::SceneDescription& scene, const RecordedViews& views,
                 const compositor::PhantomRays* phantoms)
      : upright_(scene.marker.upright),
        views_(views),
        phantoms_(phantoms),
        viewing_m_(ViewingDistance(views.path)) {}

  /// Returns the first warning that applies to a model, or nothing.
  std::optional<std::string> Warning(const PlacedModel& placed,
                                     const scene::ModelReference& reference) const {
    const std::string name = reference.file.string();
    const char* table = placed.is_phantom ? "[[phantom]]" : "[[object]]";
    const std::array<Vec3, 8> corners = CornersOf(placed);
    const double size_m = Norm(corners[7] - corners[0]);
    const Vec3 centre = (corners[0] + corners[7]) * 0.5;
    if (Norm(placed.model->origin_m) > 0.0 && Norm(centre) > kFarFromMarker_m + size_m) {
      return fmt::format(
          "{} lies {} from the marker, as if in survey coordinates: add origin = \"bottom centre\" "
          "to its {}, or the opposite of its coordinates as translation_m.",
          name, LengthText(Norm(centre)), table);
    }
    if (viewing_m_ && !reference.unit_m && !placed.is_phantom) {
      if (size_m > kTooLarge * *viewing_m_) {
        return fmt::format(
            "{} is {} large, and the camera {} from the marker: if its file is in millimetres, add "
            "unit = \"mm\" to its {}; unit = \"m\" if it is meant so.",
            name, LengthText(size_m), LengthText(*viewing_m_), table);
      }
      if (size_m < kTooSmall * *viewing_m_) {
        return fmt::format(
            "{} is only {} large, and the camera {} from the marker: enlarge it by scale = 1000, "
            "or add unit = \"m\" to its {} if it is meant so.",
            name, LengthText(size_m), LengthText(*viewing_m_), table);
      }
    }
    if (viewing_m_ && !reference.unit_m && !placed.is_phantom && SurroundsCamera(placed)) {
      return fmt::format(
          "{} is {} large and surrounds the camera, which is {} from the marker: state its unit, "
          "reduce it by scale or move it by translation_m; add unit = \"m\" to its {} if it is "
          "meant so.",
          name, LengthText(size_m), LengthText(*viewing_m_), table);
    }
    if (!reference.up && !upright_ && reference.rotation_deg == Vec3{} && LooksYUp(*placed.model)) {
      return fmt::format(
          "{} is probably modelled with y up, and lies on its back: add up = \"y\" to its {}, or "
          "up = \"z\" if it is meant so.",
          name, table);
    }
    if (placed.is_phantom || views_.path.empty()) return std::nullopt;
    if (std::ranges::none_of(views_.path, [&](const session::Observation& view) {
          return MayBeInView(views_.camera, view.camera_from_marker, corners);
        })) {
      return fmt::format(
          "{} is in view in no frame: it is {} large and its centre lies at [{:.2f}, {:.2f}, "
          "{:.2f}], {} from the marker. Check translation_m, scale and unit of its {}.",
          name, LengthText(size_m), centre.x, centre.y, centre.z, LengthText(Norm(centre)), table);
    }
    if (phantoms_ != nullptr && IsHidden(placed, views_, *phantoms_)) {
      return fmt::format(
          "{} is hidden by phantoms in every frame: it lies inside or behind them, its lowest "
          "point {} above the marker. Move it by translation_m, or correct the phantoms.",
          name, SignedHeight(corners));
    }
    return std::nullopt;
  }

 private:
  bool SurroundsCamera(const PlacedModel& placed) const {
    const auto inside = std::ranges::count_if(views_.path, [&](const session::Observation& view) {
      return Surrounds(placed, view.camera_from_marker.Inverse() * Point<Camera>{});
    });
    return inside > 0 && 2 * inside >= std::ssize(views_.path);
  }

  std::string SignedHeight(const std::array<Vec3, 8>& corners) const {
    double lowest_m = upright_ ? corners[0].y : corners[0].z;
    for (const Vec3& corner : corners) {
      lowest_m = std::min(lowest_m, upright_ ? corner.y : corner.z);
    }
    return fmt::format("{:.2f} m", lowest_m);
  }

  bool upright_;
  const RecordedViews& views_;
  const compositor::PhantomRays* phantoms_;
  std::optional<double> viewing_m_;  ///< From the marker; nothing without poses.
};

}  // namespace

std::vector<std::string> PlacementWarnings(const std::vector<PlacedModel>& models,
                                           const scene::SceneDescription& scene,
                                           const RecordedViews& views,
                                           const compositor::PhantomRays* phantoms) {
  const PlacementCheck check(scene, views, phantoms);
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const std::size_t count = scene.phantoms.size();
    const scene::ModelReference& reference =
        i < count ? scene.phantoms[i] : scene.objects[i - count];
    if (reference.surface) continue;  // By its corners: it lies where the scene says.
    if (auto warning = check.Warning(models[i], reference)) warnings.push_back(*std::move(warning));
  }
  return warnings;
}

}  // namespace pleinair::app
