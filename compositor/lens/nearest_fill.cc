#include "compositor/lens/nearest_fill.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/check.h"

namespace pleinair::compositor {
namespace {

/// Values times their weights, with the weight as the last channel.
using Weighted = Image<float>;

Weighted HalfOf(const Weighted& fine) {
  const int channels = fine.channels();
  Weighted half((fine.width() + 1) / 2, (fine.height() + 1) / 2, channels);
  for (int y = 0; y < fine.height(); ++y) {
    for (int x = 0; x < fine.width(); ++x) {
      for (int c = 0; c < channels; ++c) half(x / 2, y / 2, c) += fine(x, y, c);
    }
  }
  // A weight above 1 counts as full. The value keeps its share of it.
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      const float weight = half(x, y, channels - 1);
      if (weight <= 1.0F) continue;
      for (int c = 0; c < channels; ++c) half(x, y, c) /= weight;
    }
  }
  return half;
}

/// Adds to each pixel what its weight lacks, from the coarser level, bilinearly.
void FillFrom(const Weighted& coarse, Weighted* fine) {
  const int channels = fine->channels();
  for (int y = 0; y < fine->height(); ++y) {
    const int y0 = y / 2;
    const int y1 = std::clamp(y0 + (y % 2 == 0 ? -1 : 1), 0, coarse.height() - 1);
    for (int x = 0; x < fine->width(); ++x) {
      const float lacks = 1.0F - (*fine)(x, y, channels - 1);
      if (lacks <= 0.0F) continue;
      const int x0 = x / 2, x1 = std::clamp(x0 + (x % 2 == 0 ? -1 : 1), 0, coarse.width() - 1);
      for (int c = 0; c < channels; ++c) {
        const float mean = 0.5625F * coarse(x0, y0, c) +
                           0.1875F * (coarse(x1, y0, c) + coarse(x0, y1, c)) +
                           0.0625F * coarse(x1, y1, c);
        (*fine)(x, y, c) += lacks * mean;
      }
    }
  }
}

}  // namespace

Image<float> FillFromNearest(const Image<float>& values, const Image<float>& weights) {
  CHECK_EQ(values.width(), weights.width());
  CHECK_EQ(values.height(), weights.height());
  const int channels = values.channels();
  Weighted first(values.width(), values.height(), channels + 1);
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      const float weight = std::clamp(weights(x, y), 0.0F, 1.0F);
      for (int c = 0; c < channels; ++c) first(x, y, c) = weight * values(x, y, c);
      first(x, y, channels) = weight;
    }
  }
  std::vector<Weighted> levels;
  levels.push_back(std::move(first));
  while (levels.back().width() > 1 || levels.back().height() > 1) {
    levels.push_back(HalfOf(levels.back()));
  }
  // The coarsest level divides by its own weight, so that it fills all.
  Weighted& last = levels.back();
  if (last.size() > 0 && last(0, 0, channels) > 0.0F) {
    for (int c = 0; c < channels; ++c) last(0, 0, c) /= last(0, 0, channels);
    last(0, 0, channels) = 1.0F;
  }
  for (std::size_t level = levels.size() - 1; level > 0; --level) {
    FillFrom(levels[level], &levels[level - 1]);
  }
  Image<float> filled(values.width(), values.height(), channels);
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      for (int c = 0; c < channels; ++c) filled(x, y, c) = levels[0](x, y, c);
    }
  }
  return filled;
}

}  // namespace pleinair::compositor
