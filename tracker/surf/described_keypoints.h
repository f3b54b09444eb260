#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/image.h"
#include "tracker/surf/quantised_descriptor.h"
#include "tracker/surf/surf.h"

namespace pleinair::tracker {

/// SURF keypoints of a sequence of images, with their descriptors in the form that
/// DescriptorMatcher takes. Memory is reused between calls. One thread.
class DescribedKeypoints {
 public:
  using Filter = std::function<bool(const SurfKeypoint&)>;
  /// Handling of unwanted keypoints: drop them, or replace them by weaker ones.
  enum class Unwanted { kDrop, kReplace };

  explicit DescribedKeypoints(const SurfOptions& options) : surf_(options) {}

  /// Detects and describes keypoints; `double_size` false disables the doubled image of the
  /// options.
  void Find(ImageView<const std::uint8_t> grey, bool double_size = true,
            const Filter& unwanted = nullptr, Unwanted places = Unwanted::kDrop);

  /// Strongest first, without the dropped ones.
  const std::vector<SurfKeypoint>& keypoints() const { return keypoints_; }
  /// One for each keypoint.
  const std::vector<QuantisedDescriptor>& descriptors() const { return quantised_; }

 private:
  Surf surf_;
  std::vector<SurfKeypoint> keypoints_;
  std::vector<SurfDescriptor> descriptors_;
  std::vector<QuantisedDescriptor> quantised_;
};

}  // namespace pleinair::tracker
