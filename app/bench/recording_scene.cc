#include "app/bench/recording_scene.h"

#include <utility>

#include "devices/recordings/recording.h"
#include "scene/marker_heading.h"
#include "session/scene_renderer.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {
namespace {

glm::vec3 ToMarker(const compositor::PlacedModel& placed, const std::array<float, 3>& p) {
  const Vec3 v = placed.linear * Vec3{p[0], p[1], p[2]} + placed.translation_m;
  return {v.x, v.y, v.z};
}

}  // namespace

Result<shadows::BenchScene> RecordingScene(const std::filesystem::path& recording, double aspect) {
  auto opened = devices::OpenRecording(recording);
  if (!opened) {
    Error error = std::move(opened).error();
    error.remedy = "name a recording with --recording, or leave it out with --scenes";
    return tl::make_unexpected(std::move(error));
  }
  if (!opened->scene || opened->scene->objects.empty()) {
    return InputError(recording.string(), "has no virtual object", "name another recording");
  }
  const scene::SceneDescription& description = *opened->scene;
  shadows::BenchScene scene{"courtyard", "the recording's courtyard", {}, {}, {}, {}, {}};
  shadows::Box objects;
  const auto add = [&](const scene::ModelReference& reference, bool is_phantom) -> Result<void> {
    PLEINAIR_ASSIGN_OR_RETURN(const compositor::PlacedModel placed,
                              session::PlaceModel(reference, is_phantom, description.marker));
    for (const compositor::Mesh& mesh : placed.model->meshes) {
      shadows::BenchMesh& out = scene.meshes.emplace_back();
      for (const auto& p : mesh.positions) {
        out.positions.push_back(ToMarker(placed, p));
        if (!is_phantom) objects.Include(glm::dvec3(out.positions.back()));
      }
      out.indices = mesh.indices;
      const auto& color = placed.model->materials[mesh.material].base_color;
      out.albedo = {color[0], color[1], color[2]};
    }
    return {};
  };
  for (const auto& phantom : description.phantoms) PLEINAIR_RETURN_IF_ERROR(add(phantom, true));
  for (const auto& object : description.objects) PLEINAIR_RETURN_IF_ERROR(add(object, false));

  const sky::Observer observer{FromDegrees(description.place_time.latitude_deg),
                               FromDegrees(description.place_time.longitude_deg),
                               Metres(description.place_time.height_m)};
  const sky::SunPosition sun = sky::ComputeSunPosition(observer, description.place_time.start);
  const Vec3 to_sun = scene::MarkerFromWorld(description.marker) * sun.ToSun().xyz;
  scene.to_sun = {to_sun.x, to_sun.y, to_sun.z};
  if (scene.to_sun.z <= 0.02) {
    return InputError(recording.string(), "its sun stands too low to cast shadows",
                      "name a recording by day");
  }
  const glm::dvec3 centre = 0.5 * (objects.min + objects.max);
  scene.view = shadows::LookAt({centre.x - 2.1, centre.y - 2.1, centre.z + 1.4}, centre,
                               50 * kRadiansPerDegree, aspect);
  scene.view.near_m = 0.2;
  scene.view.far_m = 60.0;
  return scene;
}

}  // namespace pleinair::app
