#include "shadows/fading_shadow_maps.h"

#include <algorithm>
#include <utility>

namespace pleinair::shadows {

Result<FadingShadowMaps> FadingShadowMaps::Create(const ShadowMapOptions& options) {
  FadingShadowMaps fading(options.sun_step.value());
  PLEINAIR_ASSIGN_OR_RETURN(ShadowMaps maps, ShadowMaps::Create(options));
  fading.maps_.push_back(std::move(maps));
  fading.suns_.emplace_back(0.0);
  return fading;
}

Result<std::size_t> FadingShadowMaps::MapsFor(const glm::dvec3& sun, std::size_t kept) {
  const auto found = std::find(suns_.begin(), suns_.end(), sun);
  if (found != suns_.end()) return static_cast<std::size_t>(found - suns_.begin());
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    if (i != kept) return i;
  }
  PLEINAIR_ASSIGN_OR_RETURN(ShadowMaps more, ShadowMaps::Create(options()));
  maps_.push_back(std::move(more));
  suns_.emplace_back(0.0);
  return maps_.size() - 1;
}

template <typename Update>
Result<int> FadingShadowMaps::UpdateSteps(Direction<Marker> to_sun, const Update& update) {
  const glm::dvec3 sun(to_sun.xyz.x, to_sun.xyz.y, to_sun.xyz.z);
  if (!(glm::length(sun) > 0.0)) return InputError("shadows", "the sun has no direction");
  const SunStep& step = steps_.Follow(glm::normalize(sun));
  fade_ = std::clamp((step.share - 0.5) / kFadeShare + 0.5, 0.0, 1.0);
  constexpr std::size_t kNone = ~std::size_t{0};
  int redrawn = 0;
  if (fade_ < 1.0) {
    PLEINAIR_ASSIGN_OR_RETURN(from_, MapsFor(step.from, kNone));
    PLEINAIR_ASSIGN_OR_RETURN(const int count, update(maps_[from_], step.from));
    suns_[from_] = step.from;
    redrawn += count;
  }
  if (fade_ > 0.0) {
    PLEINAIR_ASSIGN_OR_RETURN(to_, MapsFor(step.to, fade_ < 1.0 ? from_ : kNone));
    PLEINAIR_ASSIGN_OR_RETURN(const int count, update(maps_[to_], step.to));
    suns_[to_] = step.to;
    redrawn += count;
  }
  if (Fades()) maps_[to_].SetShare(fade_);
  return redrawn;
}

Result<int> FadingShadowMaps::UpdateForView(std::span<const ShadowCaster> casters,
                                            Direction<Marker> to_sun, const View& view) {
  return UpdateSteps(to_sun, [&](ShadowMaps& maps, const glm::dvec3& sun) {
    return maps.UpdateForView(casters, {{sun.x, sun.y, sun.z}}, view);
  });
}

Result<int> FadingShadowMaps::UpdateForRegion(std::span<const ShadowCaster> casters,
                                              Direction<Marker> to_sun, const Box& focus) {
  return UpdateSteps(to_sun, [&](ShadowMaps& maps, const glm::dvec3& sun) {
    return maps.UpdateForRegion(casters, {{sun.x, sun.y, sun.z}}, focus);
  });
}

void FadingShadowMaps::Bind(int set) const {
  if (!Fades()) {
    maps().Bind(set);
    return;
  }
  maps_[from_].Bind(2 * set);
  maps_[to_].Bind(2 * set + 1);
}

std::vector<std::string> FadingShadowMaps::ShaderDefines(const ShadowMapOptions& options, int sets,
                                                         bool fades) {
  std::vector<std::string> defines = ShadowMaps::ShaderDefines(options, fades ? 2 * sets : sets);
  if (fades) defines.emplace_back("SHADOW_CROSS_FADE");
  return defines;
}

}  // namespace pleinair::shadows
