#include "tracker/surf/described_keypoints.h"

namespace pleinair::tracker {

void DescribedKeypoints::Find(ImageView<const std::uint8_t> grey, bool double_size,
                              const Filter& unwanted, Unwanted places) {
  const bool replace = unwanted != nullptr && places == Unwanted::kReplace;
  surf_.Detect(grey, &keypoints_, double_size, replace ? unwanted : nullptr);
  if (unwanted != nullptr && !replace) std::erase_if(keypoints_, unwanted);
  surf_.Describe(&keypoints_, &descriptors_);
  Quantise(keypoints_, descriptors_, &quantised_);
}

}  // namespace pleinair::tracker
