#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/image.h"
#include "tracker/surf/quantised_descriptor.h"
#include "tracker/surf/surf.h"

namespace pleinair::tracker {

/// The SURF keypoints of one image after another, with their descriptors as DescriptorMatcher takes
/// them. Keeps its memory between calls. One thread.
class DescribedKeypoints {
 public:
  using Filter = std::function<bool(const SurfKeypoint&)>;
  /// What becomes of the places of keypoints that are not wanted: nothing, or weaker ones.
  enum class Unwanted { kDrop, kReplace };

  explicit DescribedKeypoints(const SurfOptions& options) : surf_(options) {}

  /// Detects and describes; `double_size` false leaves out the doubled image of the options.
  void Find(ImageView<const std::uint8_t> grey, bool double_size = true,
            const Filter& unwanted = nullptr, Unwanted places = Unwanted::kDrop);

  /// Strongest first, but for those that were dropped.
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
