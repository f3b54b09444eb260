#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tracker/surf/quantised_descriptor.h"

namespace pleinair::tracker {

/// One of the nearest descriptors in the other set.
struct DescriptorMatch {
  static constexpr std::int32_t kNone = -1;

  std::int32_t index = kNone;         ///< In the other set; kNone: it has fewer than k.
  std::int32_t squared_distance = 0;  ///< Squared distance of quantised descriptors: 0..4 * 127^2 *
                                      ///< 64.

  bool operator==(const DescriptorMatch&) const = default;
};

/// Exact k-nearest-neighbour search by exhaustive comparison, in both directions, between a fixed
/// set of template descriptors and those of a frame. Memory is reused between calls.
///
/// Only descriptors with the same sign of the Laplacian are compared (Bay et al. 2008, section
/// 4.3), which halves the cost.
class DescriptorMatcher {
 public:
  static constexpr int kMaxNeighbours = 8;

  void SetTemplates(std::span<const QuantisedDescriptor> templates);

  /// The `k` (1..kMaxNeighbours) nearest templates of each descriptor of the frame, at
  /// (*templates_of_frame)[frame * k ...], and the `k` nearest frame descriptors of each template,
  /// at (*frame_of_templates)[template * k ...] (unless nullptr). Nearest first; on equal distance
  /// the lower index first.
  void Match(std::span<const QuantisedDescriptor> frame, int k,
             std::vector<DescriptorMatch>* templates_of_frame,
             std::vector<DescriptorMatch>* frame_of_templates);

 private:
  /// Descriptors of one sign.
  struct Templates {
    std::vector<std::int32_t> indices;   ///< Index in the list given to SetTemplates().
    std::vector<float> values;           ///< [block][dimension][template in the block]
    std::vector<float> squared_lengths;  ///< Infinite for the padding of the last block.
  };
  struct Frame {
    std::vector<std::int32_t> indices;
    std::vector<float> values;  ///< [descriptor][dimension]
    std::vector<float> squared_lengths;
    std::vector<float> worst;  ///< Largest distance among the k nearest so far.
  };

  int template_count_ = 0;
  std::array<Templates, 2> templates_;  ///< Dark, bright.
  std::array<Frame, 2> frame_;
};

}  // namespace pleinair::tracker
