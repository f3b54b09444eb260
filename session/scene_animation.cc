#include "session/scene_animation.h"

#include <cstddef>
#include <cstdint>

namespace pleinair::session {
namespace {

/// Whole seconds and the rest apart: the difference in nanoseconds may exceed 64 bits.
double SecondsBetween(UtcTime from, UtcTime to) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std::int64_t a = from.nanoseconds_since_1970(), b = to.nanoseconds_since_1970();
  const std::int64_t seconds = b / kSecond_ns - a / kSecond_ns;
  const std::int64_t rest_ns = b % kSecond_ns - a % kSecond_ns;
  return static_cast<double>(seconds) + static_cast<double>(rest_ns) * 1e-9;
}

}  // namespace

void PlayAnimations(const std::vector<compositor::PlacedModel>& placed, UtcTime begin, UtcTime time,
                    compositor::Composer* composer) {
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const compositor::Playback& playback = placed[i].playback;
    if (!playback.animation) continue;
    composer->SetShape(static_cast<int>(i),
                       playback.animation->At(playback.MomentAt(SecondsBetween(begin, time))));
  }
}

}  // namespace pleinair::session
