#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "session/scene_edit.h"

namespace pleinair::app {

/// Chooses how finely a live session draws: as asked while that keeps up with the camera, otherwise
/// with simpler shadows' edges, otherwise with half the pixels a side, too. It never goes back by
/// itself, lest the picture flicker between the two.
class LiveDetail {
 public:
  /// Notes how long a frame took to draw and how soon the next one comes, milliseconds. True where
  /// the detail was lowered.
  bool Add(double draw_ms, double period_ms) {
    if (detail_ == session::Detail::kCoarse || period_ms <= 0.0) return false;
    shares_[count_++ % shares_.size()] = draw_ms / period_ms;
    if (count_ < shares_.size()) return false;
    auto sorted = shares_;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    if (sorted[sorted.size() / 2] < kBusy) return false;
    detail_ = detail_ == session::Detail::kFine ? session::Detail::kFast : session::Detail::kCoarse;
    count_ = 0;
    return true;
  }

  /// What to draw by, for what was asked.
  compositor::ComposerOptions Apply(const session::SceneEdit& edit) const {
    const session::Detail detail =
        edit.detail == session::Detail::kAutomatic ? detail_ : edit.detail;
    compositor::ComposerOptions options = edit.drawing;
    if (detail == session::Detail::kFine) return options;
    options.sun_disc_filter = shadows::SunDiscFilter::kBox;
    if (detail == session::Detail::kCoarse) options.supersampling = kCoarseSupersampling;
    return options;
  }

  /// In use where it is chosen automatically.
  session::Detail detail() const { return detail_; }

 private:
  // Share of the time between frames that drawing may take.
  static constexpr double kBusy = 0.85;
  static constexpr double kCoarseSupersampling = 0.5;

  session::Detail detail_ = session::Detail::kFine;
  std::array<double, 9> shares_{};
  std::size_t count_ = 0;
};

}  // namespace pleinair::app
