#pragma once

// Internal: between .cc files.

#include <cstddef>
#include <optional>
#include <vector>

#include "compositor/photometry/changes/light_walk.h"
#include "compositor/photometry/changes/probe_fit.h"

namespace pleinair::compositor {

/// Light with which the fit begins.
struct LightStart {
  std::vector<std::size_t> reference;  ///< Frames in full sun, with enough readings.
  /// By frame: logarithms over the median of the reference frames.
  std::vector<LogLight> light;
};

/// Probes in the sun or in shade that a frame needs to show how bright they are.
inline constexpr std::size_t kMinStartProbes = 5;

/// Factors on sun and sky.
struct SunAndSky {
  double sun, sky;
};
/// Splits the factors on the light of sunlit probes (`bright`) and of shaded probes (`dark`) into
/// those on sun and sky. `in_sun` and `in_shade` are the sun's shares in the light of both. Returns
/// nothing if the shares are too much alike.
std::optional<SunAndSky> SplitLight(double bright, double dark, double in_sun, double in_shade);

/// Estimates the sun and the sky of each frame from two brightnesses: that of the probes that the
/// phantoms leave in the sun, and that of the others. A frame that does not show both has the ratio
/// of the frame before. Without a `reference` its frames are those with the deepest shadows.
LightStart StartLight(const std::vector<ProbeFit>& probes, std::size_t frame_count,
                      std::vector<std::size_t> reference);

}  // namespace pleinair::compositor
