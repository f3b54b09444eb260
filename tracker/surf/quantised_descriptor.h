#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tracker/surf/surf_descriptor.h"
#include "tracker/surf/surf_keypoint.h"

namespace pleinair::tracker {

/// A SURF descriptor in 64 bytes, scaled so that unit length is kUnit. Larger values saturate at
/// 127 / 256, just below one half; a component of a descriptor is rarely larger than 0.4.
struct QuantisedDescriptor {
  static constexpr float kUnit = 256.0f;

  std::array<std::int8_t, 64> values = {};
  bool bright = false;  ///< Sign of the Laplacian: only equal signs match.
};

/// Scales `descriptor` to unit length and rounds; zero stays zero.
QuantisedDescriptor Quantise(const SurfDescriptor& descriptor, bool bright);

/// Quantises descriptors[i] with the sign of keypoints[i]; both have the same size.
void Quantise(std::span<const SurfKeypoint> keypoints, std::span<const SurfDescriptor> descriptors,
              std::vector<QuantisedDescriptor>* quantised);

}  // namespace pleinair::tracker
