#include "compositor/passes/scene_shadows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <glm/glm.hpp>
#include <utility>

#include "base/units.h"

namespace pleinair::compositor {
namespace {

// Side of the two finest maps where no size is given; the others have half of it.
constexpr int kMinMapWithoutSize_px = 1024, kMaxMapWithoutSize_px = 2048;
constexpr float kReachSlack = 1.25F, kReachTexels = 6.0F;

static_assert(std::tuple_size_v<decltype(ComposerOptions::fog)> == shadows::kMaxPartitions);

}  // namespace

shadows::ShadowMapOptions SceneShadows::MapOptions(const ComposerOptions& options, int picture_px) {
  shadows::ShadowMapOptions map_options;
  map_options.method = options.shadow_method;
  map_options.sun_disc_filter = options.sun_disc_filter;
  map_options.partitions = options.shadow_partitions;
  const int fine = std::clamp(static_cast<int>(std::bit_ceil(static_cast<unsigned>(picture_px))),
                              kMinMapWithoutSize_px, kMaxMapWithoutSize_px);
  for (std::size_t i = 0; i < options.shadow_sizes.size(); ++i) {
    const int open = i < 2 ? fine : fine / 2;
    map_options.resolutions[i] = options.shadow_sizes[i] > 0 ? options.shadow_sizes[i] : open;
  }
  map_options.split_weight = options.shadow_split_weight;
  map_options.blur_blocker_distance = Metres(options.shadow_blur_distance_m);
  return map_options;
}

Result<SceneShadows> SceneShadows::Create(const shadows::ShadowMapOptions& options) {
  SceneShadows shadows;
  for (int set = 0; set < kSets; ++set) {
    PLEINAIR_ASSIGN_OR_RETURN(auto maps, shadows::FadingShadowMaps::Create(options));
    shadows.sets_.push_back(std::move(maps));
  }
  return shadows;
}

/// Maps of moments are fitted to the view, as in the paper.
bool SceneShadows::FitsView() const {
  const shadows::MapContent content = shadows::ContentOf(options());
  return content == shadows::MapContent::kMoments || content == shadows::MapContent::kWarpedMoments;
}

Result<void> SceneShadows::Update(const SceneSurfaces& surfaces, Direction<Marker> to_sun,
                                  const shadows::View& view) {
  const std::array<std::span<const shadows::ShadowCaster>, kSets> casters{
      surfaces.placement().phantom_casters(), surfaces.placement().casters()};
  for (int set = 0; set < kSets; ++set) {
    shadows::FadingShadowMaps& maps = sets_[set];
    if (FitsView()) {
      PLEINAIR_RETURN_IF_ERROR(maps.UpdateForView(casters[set], to_sun, view));
    } else {
      // Fitted to the objects, independent of the camera: drawn once per light.
      PLEINAIR_RETURN_IF_ERROR(
          maps.UpdateForRegion(casters[set], to_sun, surfaces.placement().object_bounds()));
    }
    maps.Bind(set);
  }
  return {};
}

SunWindow SceneShadows::Window() const {
  // One of the two sun steps is enough: a window's margin is wider than a step moves it.
  const shadows::ShadowSliceUniforms& finest = maps().uniforms().slices[0];
  const glm::vec4& to_sun = maps().uniforms().to_sun;
  if (FitsView()) return SunWindow::Everywhere(to_sun);
  // A blocker's penumbra reaches as far as the disc's width, seen from the far end of the depth
  // range. Another quarter covers the sun between two steps. Texels: those that a lookup compares
  // beside its own.
  const float reach_m = kReachSlack * finest.size.w * to_sun.w +
                        kReachTexels * std::max(finest.size.x, finest.size.y);
  return {finest.u_from_marker, finest.v_from_marker, finest.size.z, to_sun, reach_m};
}

}  // namespace pleinair::compositor
