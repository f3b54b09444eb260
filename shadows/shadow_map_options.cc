#include "shadows/shadow_map_options.h"

#include <bit>
#include <string>

namespace pleinair::shadows {

MapContent ContentOf(const ShadowMapOptions& options) {
  const bool is_shortcut =
      options.method == ShadowMethod::kSunDisc && options.sun_disc_filter != SunDiscFilter::kFull;
  return is_shortcut ? MapContent::kDepth : TraitsOf(options.method).content;
}

Result<void> CheckShadowMapOptions(const ShadowMapOptions& options) {
  if (options.partitions < 1 || options.partitions > kMaxPartitions) {
    return InputError("shadows", std::to_string(options.partitions) + " partitions",
                      "choose 1 to 4");
  }
  for (int i = 0; i < options.partitions; ++i) {
    const int resolution = options.resolutions[i];
    const bool pyramid = ContentOf(options) == MapContent::kDepthBounds;
    if (resolution < 16 || resolution > 8192 ||
        (pyramid && !std::has_single_bit(static_cast<unsigned>(resolution)))) {
      return InputError("shadows", "a map of " + std::to_string(resolution) + " texels a side",
                        pyramid ? "choose a power of two from 16 to 8192" : "choose 16 to 8192");
    }
  }
  if (!(options.split_weight >= 0.0 && options.split_weight <= 1.0)) {
    return InputError("shadows", "a split weight outside 0 to 1", "0.5 is usual");
  }
  const double radius = options.sun_angular_radius.value();
  if (!(radius > 0.0 && radius < 0.1)) {
    return InputError("shadows", "an angular radius of the sun outside 0 to 0.1 rad",
                      "the real one is 0.00465");
  }
  return {};
}

ShadowMapOptions CommonOptions(ShadowMethod method, int resolution) {
  const ShadowMethodTraits& traits = TraitsOf(method);
  ShadowMapOptions options;
  options.method = method;
  options.partitions = traits.partitions;
  options.split_weight = traits.split_weight;

  options.resolutions.fill(resolution);
  if (traits.falling_resolution) {
    options.resolutions = {resolution, resolution / 2, resolution / 2, resolution / 4};
  }
  return options;
}

}  // namespace pleinair::shadows
