#include "app/drape/scene_ink.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>

#include "app/drape/ink_shapes.h"
#include "app/drape/map_lines.h"
#include "app/drape/phantom_surface.h"
#include "scene/marker_heading.h"
#include "session/pipeline.h"
#include "session/scene_renderer.h"

namespace pleinair::app {
namespace {

using Clock = std::chrono::steady_clock;

// Ink farther above its surface is not seen as lying on it (shaders/ink_coverage.glsl).
constexpr double kOnSurface_m = 0.03;

}  // namespace

Result<std::shared_ptr<SceneInk>> SceneInk::Read(const scene::SceneDescription& scene) {
  auto ink = std::make_shared<SceneInk>();
  ink->scene_ = scene;
  for (const scene::DrapeDescription& drape : scene.drapes) {
    PLEINAIR_ASSIGN_OR_RETURN(std::vector<content::VectorLayer> layers, ReadMap(drape));
    ink->maps_.push_back(std::move(layers));
  }
  return ink;
}

void SceneInk::Warn(const std::string& file, const std::string& warning) {
  std::string text = file + ": " + warning;
  if (std::find(warnings_.begin(), warnings_.end(), text) == warnings_.end()) {
    warnings_.push_back(std::move(text));
  }
}

Result<std::vector<compositor::InkShape>> SceneInk::Lay(
    std::span<const compositor::PlacedModel> phantoms, const scene::MarkerDescription& marker) {
  scene_.marker = marker;
  facts_.clear();
  PLEINAIR_ASSIGN_OR_RETURN(
      const content::SurfaceIndex surface,
      SurfaceOfPhantoms({phantoms.begin(), phantoms.end()}, scene::MarkerFromWorld(marker)));
  std::vector<compositor::InkShape> shapes;
  std::uint32_t first_feature = 0;
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const auto start = Clock::now();
    const scene::DrapeDescription& drape = scene_.drapes[i];
    const std::string file = drape.source.file.string();
    PLEINAIR_ASSIGN_OR_RETURN(const MapLines map,
                              PlaceMap(scene_, drape, maps_[i], surface, first_feature));
    PLEINAIR_ASSIGN_OR_RETURN(const content::DrapedLayer layer,
                              content::DrapeExactly(map.lines, surface, map.options, file));
    for (const std::string& warning : map.warnings) Warn(file, warning);
    const bool in_air = std::any_of(map.lines.begin(), map.lines.end(), [](const auto& line) {
      return std::fabs(line.above_m) > kOnSurface_m;
    });
    if (in_air || map.options.own_heights) {
      Warn(file,
           "pictures show ink where it lies on a phantom; lines above or below it are not drawn. "
           "pleinair drape writes them");
    }
    if (drape.ink.hidden == scene::HiddenInk::kGhost) {
      Warn(file, "hidden = \"ghost\" has no effect on pictures: hidden ink is not drawn");
    }
    if (drape.search == scene::DrapeSearch::kScreen) {
      Warn(file, "live = \"screen\" has no effect: ink is draped exactly");
    }
    std::vector<compositor::InkShape> ink =
        InkShapesOf(layer, drape.ink, map.colors, first_feature);
    facts_.push_back({file, map.crs, map.features, ink.size(), layer.report,
                      std::chrono::duration<double, std::milli>(Clock::now() - start).count()});
    std::move(ink.begin(), ink.end(), std::back_inserter(shapes));
    first_feature += static_cast<std::uint32_t>(map.features);
  }
  return shapes;
}

Result<std::shared_ptr<SceneInk>> DrawMaps(const scene::SceneDescription& scene,
                                           session::Pipeline* pipeline) {
  if (scene.drapes.empty()) return nullptr;
  PLEINAIR_ASSIGN_OR_RETURN(std::shared_ptr<SceneInk> ink, SceneInk::Read(scene));
  session::SceneRenderer& renderer = pipeline->renderer();
  const auto lay = [ink](std::span<const compositor::PlacedModel> phantoms,
                         const scene::MarkerDescription& marker) {
    return ink->Lay(phantoms, marker);
  };
  PLEINAIR_RETURN_IF_ERROR(
      lay(std::span(renderer.placed()).first(scene.phantoms.size()), scene.marker));
  renderer.SetInk(lay);
  return ink;
}

}  // namespace pleinair::app
