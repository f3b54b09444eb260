#include "tracker/surf/descriptor_matcher.h"

#include <algorithm>
#include <limits>

#include "base/check.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf/descriptor_matcher.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PLEINAIR_TRACKER_SURF_MATCHER_BLOCKS
#define PLEINAIR_TRACKER_SURF_MATCHER_BLOCKS
namespace pleinair::tracker {
namespace {

constexpr int kDimensions = 64;
constexpr int kBlock = 32;      ///< Templates that are adjacent in memory.
constexpr int kFrameBlock = 4;  ///< Descriptors of the frame that are processed together.

/// Task: match a block of templates against all descriptors of the frame.
struct MatchTask {
  const float* block;                  ///< [dimension][kBlock]
  const float* block_squared_lengths;  ///< [kBlock]
  const std::int32_t* block_indices;   ///< [kBlock]
  const float* frame;                  ///< [frame_size, in whole frame blocks][dimension]
  const float* frame_squared_lengths;
  const std::int32_t* frame_indices;
  int frame_size;
  int k;
  float* frame_worst;  ///< [frame_size]: distance of the worst of the k nearest so far.
  DescriptorMatch* templates_of_frame;
  float* nearest_distances;       ///< [k][kBlock]: of the templates, nearest first.
  std::int32_t* nearest_indices;  ///< [k][kBlock]: of the frame.
};

/// Inserts a match into the k nearest, after equal ones; returns the distance of the last of them.
inline float Insert(std::int32_t index, float distance, int k, DescriptorMatch* nearest) {
  const auto squared_distance = static_cast<std::int32_t>(distance);
  int place = k - 1;
  while (place > 0 && (nearest[place - 1].index == DescriptorMatch::kNone ||
                       nearest[place - 1].squared_distance > squared_distance)) {
    nearest[place] = nearest[place - 1];
    --place;
  }
  nearest[place] = {index, squared_distance};
  const DescriptorMatch& last = nearest[k - 1];
  return last.index == DescriptorMatch::kNone ? std::numeric_limits<float>::infinity()
                                              : static_cast<float>(last.squared_distance);
}

}  // namespace
}  // namespace pleinair::tracker
#endif

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// distances[j][t] = |frame - template|^2 = |frame|^2 + |template|^2 - 2 frame . template. Products
/// of 8-bit values and sums of 64 of them are integers below 2^24: exact in floats.
void Distances(const MatchTask& task, int first, float (*distances)[kBlock]) {
  const hn::CappedTag<float, 16> d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(d));
  const float* const f0 = task.frame + static_cast<std::ptrdiff_t>(first) * kDimensions;
  const float* const f1 = f0 + kDimensions;
  const float* const f2 = f1 + kDimensions;
  const float* const f3 = f2 + kDimensions;
  for (int t = 0; t < kBlock; t += 2 * kLanes) {
    auto a0 = hn::Zero(d), a1 = hn::Zero(d), a2 = hn::Zero(d), a3 = hn::Zero(d);
    auto b0 = hn::Zero(d), b1 = hn::Zero(d), b2 = hn::Zero(d), b3 = hn::Zero(d);
    for (int dimension = 0; dimension < kDimensions; ++dimension) {
      const auto a = hn::LoadU(d, task.block + dimension * kBlock + t);
      const auto b = hn::LoadU(d, task.block + dimension * kBlock + t + kLanes);
      const auto v0 = hn::Set(d, f0[dimension]), v1 = hn::Set(d, f1[dimension]);
      const auto v2 = hn::Set(d, f2[dimension]), v3 = hn::Set(d, f3[dimension]);
      a0 = hn::MulAdd(a, v0, a0);
      b0 = hn::MulAdd(b, v0, b0);
      a1 = hn::MulAdd(a, v1, a1);
      b1 = hn::MulAdd(b, v1, b1);
      a2 = hn::MulAdd(a, v2, a2);
      b2 = hn::MulAdd(b, v2, b2);
      a3 = hn::MulAdd(a, v3, a3);
      b3 = hn::MulAdd(b, v3, b3);
    }
    const auto minus_two = hn::Set(d, -2.0f);
    const auto lengths_a = hn::LoadU(d, task.block_squared_lengths + t);
    const auto lengths_b = hn::LoadU(d, task.block_squared_lengths + t + kLanes);
    const auto store = [&](int j, auto a, auto b) {
      const auto length = hn::Set(d, task.frame_squared_lengths[first + j]);
      hn::StoreU(hn::MulAdd(a, minus_two, hn::Add(lengths_a, length)), d, distances[j] + t);
      hn::StoreU(hn::MulAdd(b, minus_two, hn::Add(lengths_b, length)), d,
                 distances[j] + t + kLanes);
    };
    store(0, a0, b0);
    store(1, a1, b1);
    store(2, a2, b2);
    store(3, a3, b3);
  }
}

/// Inserts one descriptor of the frame into the k nearest of each of a vector of templates, after
/// equal ones; more distant ones move down by one.
template <class D, class V>
void InsertIntoTemplates(D d, const MatchTask& task, int t, V distance, std::int32_t frame_index) {
  const hn::RebindToSigned<D> di;
  auto index = hn::Set(di, frame_index);
  auto moves = hn::FirstN(d, 0);
  for (int rank = 0; rank < task.k; ++rank) {
    float* const distances = task.nearest_distances + rank * kBlock + t;
    std::int32_t* const indices = task.nearest_indices + rank * kBlock + t;
    const auto old_distance = hn::LoadU(d, distances);
    const auto old_index = hn::LoadU(di, indices);
    moves = hn::Or(moves, hn::Lt(distance, old_distance));
    const auto moves_index = hn::RebindMask(di, moves);
    hn::StoreU(hn::IfThenElse(moves, distance, old_distance), d, distances);
    hn::StoreU(hn::IfThenElse(moves_index, index, old_index), di, indices);
    distance = hn::IfThenElse(moves, old_distance, distance);
    index = hn::IfThenElse(moves_index, old_index, index);
  }
}

void MatchBlock(const MatchTask& task) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const float* const worst_of_block = task.nearest_distances + (task.k - 1) * kBlock;
  for (int first = 0; first < task.frame_size; first += kFrameBlock) {
    alignas(64) float distances[kFrameBlock][kBlock];
    Distances(task, first, distances);
    const int count = HWY_MIN(kFrameBlock, task.frame_size - first);
    for (int j = 0; j < count; ++j) {
      const int frame = first + j;
      const std::int32_t frame_index = task.frame_indices[frame];
      for (int t = 0; t < kBlock; t += lanes) {
        const auto distance = hn::LoadU(d, distances[j] + t);
        if (!hn::AllFalse(d, hn::Lt(distance, hn::LoadU(d, worst_of_block + t)))) {
          InsertIntoTemplates(d, task, t, distance, frame_index);
        }
        const auto nearer = hn::Lt(distance, hn::Set(d, task.frame_worst[frame]));
        if (HWY_LIKELY(hn::AllFalse(d, nearer))) continue;
        alignas(64) std::int32_t places[kBlock];
        const auto found = static_cast<int>(
            hn::CompressStore(hn::Iota(di, t), hn::RebindMask(di, nearer), di, places));
        for (int n = 0; n < found; ++n) {
          const float value = distances[j][places[n]];
          if (value < task.frame_worst[frame]) {
            task.frame_worst[frame] = Insert(task.block_indices[places[n]], value, task.k,
                                             task.templates_of_frame + frame_index * task.k);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {

HWY_EXPORT(MatchBlock);

float SquaredLength(const QuantisedDescriptor& descriptor) {
  int sum = 0;
  for (const std::int8_t value : descriptor.values) sum += value * value;
  return static_cast<float>(sum);
}

std::size_t RoundUp(std::size_t size, std::size_t multiple) {
  return (size + multiple - 1) / multiple * multiple;
}

}  // namespace

void DescriptorMatcher::SetTemplates(std::span<const QuantisedDescriptor> templates) {
  template_count_ = static_cast<int>(templates.size());
  for (const bool bright : {false, true}) {
    Templates& group = templates_[bright ? 1 : 0];
    group.indices.clear();
    for (std::size_t i = 0; i < templates.size(); ++i) {
      if (templates[i].bright == bright) group.indices.push_back(static_cast<std::int32_t>(i));
    }
    const std::size_t size = group.indices.size();
    const std::size_t padded = RoundUp(size, kBlock);
    group.values.assign(padded * kDimensions, 0.0f);
    group.squared_lengths.assign(padded, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < size; ++i) {
      const QuantisedDescriptor& descriptor = templates[group.indices[i]];
      float* const first = group.values.data() + i / kBlock * kBlock * kDimensions + i % kBlock;
      for (int n = 0; n < kDimensions; ++n) first[n * kBlock] = descriptor.values[n];
      group.squared_lengths[i] = SquaredLength(descriptor);
    }
    group.indices.resize(padded, DescriptorMatch::kNone);
  }
}

void DescriptorMatcher::Match(std::span<const QuantisedDescriptor> frame, int k,
                              std::vector<DescriptorMatch>* templates_of_frame,
                              std::vector<DescriptorMatch>* frame_of_templates) {
  CHECK_GE(k, 1);
  CHECK_LE(k, kMaxNeighbours);
  templates_of_frame->assign(frame.size() * k, DescriptorMatch{});
  if (frame_of_templates != nullptr) {
    frame_of_templates->assign(static_cast<std::size_t>(template_count_) * k, DescriptorMatch{});
  }
  for (const bool bright : {false, true}) {
    Frame& group = frame_[bright ? 1 : 0];
    group.indices.clear();
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (frame[i].bright == bright) group.indices.push_back(static_cast<std::int32_t>(i));
    }
    const std::size_t size = group.indices.size();
    group.values.resize(RoundUp(size, kFrameBlock) * kDimensions);
    group.squared_lengths.resize(RoundUp(size, kFrameBlock));
    for (std::size_t i = 0; i < size; ++i) {
      const QuantisedDescriptor& descriptor = frame[group.indices[i]];
      std::copy(descriptor.values.begin(), descriptor.values.end(),
                group.values.begin() + static_cast<std::ptrdiff_t>(i * kDimensions));
      group.squared_lengths[i] = SquaredLength(descriptor);
    }
    group.worst.assign(size, std::numeric_limits<float>::infinity());

    const Templates& templates = templates_[bright ? 1 : 0];
    for (std::size_t first = 0; first < templates.indices.size(); first += kBlock) {
      alignas(64) float distances[kMaxNeighbours * kBlock];
      alignas(64) std::int32_t indices[kMaxNeighbours * kBlock];
      // If no output of the templates' nearest is requested, no distance is small enough.
      std::fill_n(distances, k * kBlock,
                  frame_of_templates != nullptr ? std::numeric_limits<float>::infinity() : -1.0f);
      std::fill_n(indices, k * kBlock, DescriptorMatch::kNone);
      HWY_DYNAMIC_DISPATCH(MatchBlock)
      ({.block = templates.values.data() + first * kDimensions,
        .block_squared_lengths = templates.squared_lengths.data() + first,
        .block_indices = templates.indices.data() + first,
        .frame = group.values.data(),
        .frame_squared_lengths = group.squared_lengths.data(),
        .frame_indices = group.indices.data(),
        .frame_size = static_cast<int>(size),
        .k = k,
        .frame_worst = group.worst.data(),
        .templates_of_frame = templates_of_frame->data(),
        .nearest_distances = distances,
        .nearest_indices = indices});
      if (frame_of_templates == nullptr) continue;
      for (int t = 0; t < kBlock; ++t) {
        const std::int32_t template_index = templates.indices[first + t];
        if (template_index == DescriptorMatch::kNone) break;
        for (int rank = 0; rank < k; ++rank) {
          const std::int32_t index = indices[rank * kBlock + t];
          if (index == DescriptorMatch::kNone) break;
          (*frame_of_templates)[static_cast<std::size_t>(template_index) * k + rank] = {
              index, static_cast<std::int32_t>(distances[rank * kBlock + t])};
        }
      }
    }
  }
}

}  // namespace pleinair::tracker
#endif
