#include "tracker/surf/quantised_descriptor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/check.h"

namespace pleinair::tracker {

QuantisedDescriptor Quantise(const SurfDescriptor& descriptor, bool bright) {
  float squared_length = 0;
  for (const float value : descriptor) squared_length += value * value;
  const float factor =
      squared_length > 0 ? QuantisedDescriptor::kUnit / std::sqrt(squared_length) : 0;
  QuantisedDescriptor quantised;
  quantised.bright = bright;
  for (std::size_t i = 0; i < descriptor.size(); ++i) {
    const float value = std::clamp(descriptor[i] * factor, -127.0f, 127.0f);
    // Rounds half away from zero, without a library call.
    quantised.values[i] = static_cast<std::int8_t>(value + std::copysign(0.5f, value));
  }
  return quantised;
}

void Quantise(std::span<const SurfKeypoint> keypoints, std::span<const SurfDescriptor> descriptors,
              std::vector<QuantisedDescriptor>* quantised) {
  CHECK_EQ(keypoints.size(), descriptors.size());
  quantised->resize(descriptors.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    (*quantised)[i] = Quantise(descriptors[i], keypoints[i].bright);
  }
}

}  // namespace pleinair::tracker
