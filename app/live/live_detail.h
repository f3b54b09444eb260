#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "session/scene_edit.h"

namespace pleinair::app {

/// Chooses the level of detail of a live session. It starts with the requested detail. When drawing
/// cannot keep up with the camera, it simplifies the shadow edges, then halves the resolution per
/// side. The detail never rises again by itself, so that the image does not flicker between two
/// levels.
class LiveDetail {
 public:
  /// Adds the drawing time of a frame and the frame period, both in milliseconds. Returns true if
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

  /// Returns the options to draw with for the requested ones.
  compositor::ComposerOptions Apply(const session::SceneEdit& edit) const {
    const session::Detail detail =
        edit.detail == session::Detail::kAutomatic ? detail_ : edit.detail;
    compositor::ComposerOptions options = edit.drawing;
    if (detail == session::Detail::kFine) return options;
    options.sun_disc_filter = shadows::SunDiscFilter::kBox;
    if (detail == session::Detail::kCoarse) options.supersampling = kCoarseSupersampling;
    return options;
  }

  /// The level in use when the detail is chosen automatically.
  session::Detail detail() const { return detail_; }

 private:
  // Max. share of the frame period for drawing.
  static constexpr double kBusy = 0.85;
  static constexpr double kCoarseSupersampling = 0.5;

  session::Detail detail_ = session::Detail::kFine;
  std::array<double, 9> shares_{};
  std::size_t count_ = 0;
};

}  // namespace pleinair::app
