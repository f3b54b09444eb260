#include "session/scene_edit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "compositor/models/placed_model.h"
#include "sky/sky_model.h"

namespace pleinair::session {
Mat3 RotationXyz(Vec3 degrees) {
  const auto about = [](int axis, double angle_deg) {
    const double c = std::cos(angle_deg * kRadiansPerDegree);
    const double s = std::sin(angle_deg * kRadiansPerDegree);
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    Mat3 rotation;
    rotation(i, i) = c;
    rotation(i, j) = -s;
    rotation(j, i) = s;
    rotation(j, j) = c;
    return rotation;
  };
  return about(2, degrees.z) * about(1, degrees.y) * about(0, degrees.x);
}

Mat3 LinearOf(const ObjectPlace& place) {
  Mat3 linear = RotationXyz(place.rotation_deg);
  for (double& element : linear.m) element *= place.scale;
  return linear;
}

void MoveTo(const ObjectPlace& place, compositor::PlacedModel* model) {
  model->linear = LinearOf(place);
  model->translation_m = place.translation_m + model->linear * model->model->origin_m;
}

SceneEdit UneditedScene(const scene::SceneDescription& scene,
                        const compositor::ComposerOptions& drawing, double convergence) {
  SceneEdit edit;
  edit.convergence = convergence;
  edit.latitude_deg = scene.place_time.latitude_deg;
  edit.longitude_deg = scene.place_time.longitude_deg;
  edit.drawing = drawing;
  for (const scene::ModelReference& object : scene.objects) {
    edit.objects.push_back({object.translation_m, object.rotation_deg, object.scale});
  }
  for (const scene::ModelReference& phantom : scene.phantoms) {
    SurfacePlace& place = edit.phantoms.emplace_back();
    place.translation_m = phantom.translation_m;
    if (phantom.surface && phantom.surface->kind == scene::SurfaceKind::kWall) {
      place.corners_m = phantom.surface->polygons.at(0);
    }
  }
  return edit;
}

scene::SceneDescription WithEdit(const scene::SceneDescription& scene, const SceneEdit& edit) {
  scene::SceneDescription edited = scene;
  edited.place_time.latitude_deg = edit.latitude_deg;
  edited.place_time.longitude_deg = edit.longitude_deg;
  if (edit.heading_deg) edited.marker.heading = FromDegrees(*edit.heading_deg);
  const std::size_t count = std::min(edited.objects.size(), edit.objects.size());
  for (std::size_t i = 0; i < count; ++i) {
    edited.objects[i].translation_m = edit.objects[i].translation_m;
    edited.objects[i].rotation_deg = edit.objects[i].rotation_deg;
    edited.objects[i].scale = edit.objects[i].scale;
  }
  for (std::size_t i = 0; i < std::min(edited.phantoms.size(), edit.phantoms.size()); ++i) {
    std::optional<scene::DescribedSurface>& surface = edited.phantoms[i].surface;
    if (!surface) continue;
    edited.phantoms[i].translation_m = edit.phantoms[i].translation_m;
    if (!edit.phantoms[i].corners_m.empty()) surface->polygons = {edit.phantoms[i].corners_m};
  }
  return edited;
}

SceneEdit::Sky DescribedAir(const scene::SceneDescription& scene) {
  // As in sky/daylight.h.
  constexpr double kHazyTurbidity = 3.2, kPartlyCloudyCover = 0.6;
  SceneEdit::Sky air{sky::kDefaultTurbidity, 0.0};
  switch (scene.cloudiness) {
    case scene::Cloudiness::kClear:
      break;
    case scene::Cloudiness::kHazy:
      air.turbidity = kHazyTurbidity;
      break;
    case scene::Cloudiness::kPartlyCloudy:
      air.cloud_cover = kPartlyCloudyCover;
      break;
    case scene::Cloudiness::kOvercast:
      air.cloud_cover = 1.0;
      break;
  }
  if (scene.turbidity) air.turbidity = *scene.turbidity;
  return air;
}

}  // namespace pleinair::session
