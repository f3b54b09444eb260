#include "session/light_fade.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace pleinair::session {
namespace {

using compositor::LitMesh;

constexpr double kFade_s = 0.4;

using VertexLight = std::vector<std::array<float, 3>>;

/// Empty light is black.
void MixInto(const VertexLight& from, float weight, VertexLight* to) {
  if (from.empty() && to->empty()) return;
  to->resize(std::max(from.size(), to->size()));
  for (std::size_t i = 0; i < to->size(); ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float was = i < from.size() ? from[i][channel] : 0.0F;
      float& is = (*to)[i][channel];
      is += weight * (was - is);
    }
  }
}

bool HaveSameSurfaces(const std::vector<LitMesh>& a, const std::vector<LitMesh>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.geometry != 0 && x.geometry == y.geometry;
  });
}

}  // namespace

void LightFade::Begin(const std::vector<LitMesh>& in_use, const std::vector<LitMesh>& next) {
  // A fade that goes on is left where it is.
  const std::vector<LitMesh>& shown = mixed_.empty() ? in_use : mixed_;
  from_ = HaveSameSurfaces(shown, next) ? shown : std::vector<LitMesh>();
  mixed_.clear();
  start_.reset();
}

std::optional<std::vector<LitMesh>> LightFade::At(UtcTime time, const std::vector<LitMesh>& next) {
  if (from_.empty()) return std::nullopt;
  if (!start_) start_ = time;
  const double elapsed_s =
      static_cast<double>(time.nanoseconds_since_1970() - start_->nanoseconds_since_1970()) * 1e-9;
  // A recording that begins again goes back in time.
  if (elapsed_s < 0.0 || elapsed_s >= kFade_s) {
    from_.clear();
    mixed_.clear();
    return std::nullopt;
  }
  const auto weight = static_cast<float>(1.0 - elapsed_s / kFade_s);
  mixed_ = next;
  for (std::size_t i = 0; i < mixed_.size(); ++i) {
    MixInto(from_[i].ambient_with, weight, &mixed_[i].ambient_with);
    MixInto(from_[i].ambient_without, weight, &mixed_[i].ambient_without);
    MixInto(from_[i].sunlight.reflected_with, weight, &mixed_[i].sunlight.reflected_with);
    MixInto(from_[i].sunlight.reflected_without, weight, &mixed_[i].sunlight.reflected_without);
  }
  return mixed_;
}

}  // namespace pleinair::session
