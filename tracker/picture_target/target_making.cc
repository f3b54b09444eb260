#include "tracker/picture_target/target_making.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/srgb.h"
#include "tracker/picture_target/target_quality.h"
#include "tracker/picture_target/target_views.h"

namespace pleinair::tracker {
namespace {

constexpr double kMaxAspect = 6.0;

/// The pixels of a side of `from` pixels that one pixel of a side of `to` pixels covers.
struct Share {
  int first = 0;
  std::vector<double> weights;
};

std::vector<Share> SharesOf(int from, int to) {
  std::vector<Share> shares(to);
  const double step = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    const double begin = i * step, end = std::min<double>(from, (i + 1) * step);
    shares[i].first = std::min(from - 1, static_cast<int>(begin));
    for (int k = shares[i].first; k < from && k < end; ++k) {
      shares[i].weights.push_back((std::min(k + 1.0, end) - std::max<double>(k, begin)) / step);
    }
  }
  return shares;
}

/// Reduces the image by area means in linear light.
GreyImage Reduced(ImageView<const std::uint8_t> grey, int width, int height) {
  const auto& linear = LinearFromSrgb8();
  const std::vector<Share> columns = SharesOf(grey.width(), width);
  const std::vector<Share> rows = SharesOf(grey.height(), height);
  GreyImage reduced(width, height);
  std::vector<double> line(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    std::fill(line.begin(), line.end(), 0.0);
    for (std::size_t j = 0; j < rows[y].weights.size(); ++j) {
      const std::uint8_t* from = grey.row(rows[y].first + static_cast<int>(j));
      for (int x = 0; x < width; ++x) {
        double sum = 0.0;
        for (std::size_t i = 0; i < columns[x].weights.size(); ++i) {
          sum += columns[x].weights[i] * linear[from[columns[x].first + i]];
        }
        line[x] += rows[y].weights[j] * sum;
      }
    }
    for (int x = 0; x < width; ++x) reduced(x, y) = Srgb8FromLinear(line[x]);
  }
  return reduced;
}

}  // namespace

bool IsTargetName(const std::string& name) {
  if (name.empty() || name.size() > kMaxTargetName) return false;
  int more = 0;  // Number of continuation bytes that must follow.
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (more > 0) {
      if ((byte & 0xC0U) != 0x80U) return false;
      --more;
    } else if (byte < 0x20U || byte == 0x7FU) {
      return false;
    } else if (byte >= 0x80U) {
      if (byte >= 0xC2U && byte <= 0xDFU) {
        more = 1;
      } else if ((byte & 0xF0U) == 0xE0U) {
        more = 2;
      } else if (byte >= 0xF0U && byte <= 0xF4U) {
        more = 3;
      } else {
        return false;
      }
    }
  }
  return more == 0;
}

Result<PictureTarget> MakePictureTarget(ImageView<const std::uint8_t> grey, Metres width,
                                        const std::string& name) {
  const double longer = std::max(grey.width(), grey.height());
  const double shorter = std::min(grey.width(), grey.height());
  if (grey.empty() || grey.channels() != 1) {
    return InputError("", "the picture is empty or not grey", "give a picture of one channel");
  }
  if (!(width.value() > 0.0) || !std::isfinite(width.value())) {
    return InputError("", "the width must be positive", "give the printed picture's width");
  }
  const double height_m = width.value() * grey.height() / grey.width();
  for (const double side_m : {width.value(), height_m}) {
    if (side_m >= kMinTargetSize_m && side_m <= kMaxTargetSize_m) continue;
    return InputError("", "the printed picture would be smaller than 1 mm or larger than 1 km",
                      "give its width in millimetres");
  }
  if (!IsTargetName(name)) {
    return InputError("", "the name is empty, too long or no plain UTF-8",
                      "give one of 1 to " + std::to_string(kMaxTargetName) + " bytes");
  }
  if (longer > kMaxAspect * shorter) {
    return InputError("", "the picture is more than 6 times as long as it is wide",
                      "crop it: so narrow a strip cannot be measured");
  }
  const double scale = std::min(1.0, kMaxTargetPicture_px / longer);
  const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(px * scale))); };
  PictureTarget target;
  target.name = name;
  target.width_m = width.value();
  target.height_m = height_m;
  if (std::min(side(grey.width()), side(grey.height())) < kMinTargetPicture_px) {
    return InputError("", "the picture has too few pixels",
                      "give one of at least " + std::to_string(kMinTargetPicture_px) +
                          " pixels on the shorter side");
  }
  target.picture = Reduced(grey, side(grey.width()), side(grey.height()));
  FillTargetViews(&target);
  const TargetQuality quality = RateTarget(target);
  if (quality.features < kMinTargetFeatures || quality.coverage < kMinTargetCoverage) {
    const bool few = quality.features < kMinTargetFeatures;
    return InputError("",
                      few ? "the picture has too few features to be found by (" +
                                std::to_string(quality.features) + ", at least " +
                                std::to_string(kMinTargetFeatures) + " are needed)"
                          : "the picture's features all lie in one small part of it (" +
                                std::to_string(std::lround(100.0 * quality.coverage)) +
                                " % of its area, at least " +
                                std::to_string(std::lround(100.0 * kMinTargetCoverage)) +
                                " % are needed)",
                      few ? "choose one with more fine detail, sharper edges and more contrast"
                          : "crop it to that part, or choose one that has detail everywhere");
  }
  return target;
}

}  // namespace pleinair::tracker
