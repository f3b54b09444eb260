#include "session/light_fade.h"

#include <algorithm>
#include <cstddef>

namespace pleinair::session {
namespace {

using compositor::LitMesh;

constexpr double kFade_s = 0.4;

/// Mixes `from` and `next`, of which empty light is black.
template <typename VertexLight>
void MixLight(const VertexLight& from, float weight, const VertexLight& next, VertexLight* mixed) {
  mixed->resize(std::max(from.size(), next.size()));
  for (std::size_t i = 0; i < mixed->size(); ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float was = i < from.size() ? from[i][channel] : 0.0F;
      const float is = i < next.size() ? next[i][channel] : 0.0F;
      (*mixed)[i][channel] = is + weight * (was - is);
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
  if (!HaveSameSurfaces(in_use, next)) {
    End();
    return;
  }
  // A fade that goes on is left where it is.
  if (!on() || start_) {
    const std::vector<LitMesh>& shown = on() ? mixed_ : in_use;
    from_.clear();
    from_.reserve(shown.size());
    for (const LitMesh& mesh : shown) {
      from_.push_back({mesh.ambient_with, mesh.ambient_without, mesh.sunlight.reflected_with,
                       mesh.sunlight.reflected_without});
    }
  }
  mixed_ = next;
  start_.reset();
}

const std::vector<LitMesh>* LightFade::At(UtcTime time, const std::vector<LitMesh>& next) {
  if (!on()) return nullptr;
  if (!start_) start_ = time;
  const double elapsed_s =
      static_cast<double>(time.nanoseconds_since_1970() - start_->nanoseconds_since_1970()) * 1e-9;
  // A recording that begins again goes back in time.
  if (elapsed_s < 0.0 || elapsed_s >= kFade_s) {
    End();
    return nullptr;
  }
  const auto weight = static_cast<float>(1.0 - elapsed_s / kFade_s);
  for (std::size_t i = 0; i < mixed_.size(); ++i) {
    const MeshLight& from = from_[i];
    LitMesh& mixed = mixed_[i];
    MixLight(from.with, weight, next[i].ambient_with, &mixed.ambient_with);
    MixLight(from.without, weight, next[i].ambient_without, &mixed.ambient_without);
    MixLight(from.reflected_with, weight, next[i].sunlight.reflected_with,
             &mixed.sunlight.reflected_with);
    MixLight(from.reflected_without, weight, next[i].sunlight.reflected_without,
             &mixed.sunlight.reflected_without);
  }
  return &mixed_;
}

void LightFade::End() {
  from_.clear();
  mixed_.clear();
  start_.reset();
}

}  // namespace pleinair::session
