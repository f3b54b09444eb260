#include "tools/marker_search/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/vector.h"

namespace pleinair::marker_search {
namespace {

/// Octaves of smooth noise. Each octave's amplitude is `persistence` times that of the next coarser
/// one. With ½ the amplitudes fall as 1/f (Field, "Relations between the statistics of natural
/// images and the response properties of cortical cells", 1987).
GreyImage Noise(double persistence, RandomDraws* draws) {
  std::vector<double> sum(static_cast<std::size_t>(kTextureSide_px) * kTextureSide_px);
  double strength = 1.0;
  for (int cell = 128; cell >= 2; cell /= 2, strength *= persistence) {
    const int nodes = kTextureSide_px / cell + 2;
    std::vector<double> lattice(static_cast<std::size_t>(nodes) * nodes);
    for (double& value : lattice) value = draws->Normal();
    for (int y = 0; y < kTextureSide_px; ++y) {
      const double v = static_cast<double>(y % cell) / cell, t = v * v * (3.0 - 2.0 * v);
      for (int x = 0; x < kTextureSide_px; ++x) {
        const double u = static_cast<double>(x % cell) / cell, s = u * u * (3.0 - 2.0 * u);
        const double* node = &lattice[static_cast<std::size_t>(y / cell) * nodes + x / cell];
        const double top = node[0] + s * (node[1] - node[0]);
        const double bottom = node[nodes] + s * (node[nodes + 1] - node[nodes]);
        sum[static_cast<std::size_t>(y) * kTextureSide_px + x] +=
            strength * (top + t * (bottom - top));
      }
    }
  }
  const double contrast = draws->Uniform(20.0, 60.0), mean = draws->Uniform(70.0, 170.0);
  GreyImage noise(kTextureSide_px, kTextureSide_px);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    noise.data()[i] = static_cast<std::uint8_t>(std::clamp(mean + contrast * sum[i], 0.0, 255.0));
  }
  return noise;
}

/// Overlapping polygons, many small and few large: the "dead leaves" model of Lee, Mumford & Huang,
/// "Occlusion models for natural images" (2001).
GreyImage Polygons(RandomDraws* draws) {
  GreyImage image(kTextureSide_px, kTextureSide_px);
  std::fill_n(image.data(), image.size(), static_cast<std::uint8_t>(draws->Below(256)));
  const double smallest = draws->Uniform(3.0, 12.0);
  for (int n = 0; n < 2500; ++n) {
    const double radius = std::min(120.0, smallest / std::sqrt(1.0 - draws->Uniform()));
    const Vec2 centre{draws->Uniform(0, kTextureSide_px), draws->Uniform(0, kTextureSide_px)};
    const int corners = 3 + draws->Below(5);
    const double squeeze = draws->Uniform(0.3, 1.0), turn = draws->Uniform(0.0, std::numbers::pi);
    std::array<Vec2, 8> polygon;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + draws->Uniform(0.0, 0.7)) / corners;
      const double a = radius * std::cos(angle), b = squeeze * radius * std::sin(angle);
      polygon[i] = centre + Vec2{a * std::cos(turn) - b * std::sin(turn),
                                 a * std::sin(turn) + b * std::cos(turn)};
    }
    const auto grey = static_cast<std::uint8_t>(draws->Below(256));
    const int x0 = std::max(0, static_cast<int>(centre.x - radius));
    const int x1 = std::min(kTextureSide_px - 1, static_cast<int>(centre.x + radius) + 1);
    const int y0 = std::max(0, static_cast<int>(centre.y - radius));
    const int y1 = std::min(kTextureSide_px - 1, static_cast<int>(centre.y + radius) + 1);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        bool inside = true;
        for (int i = 0; i < corners && inside; ++i) {
          const Vec2 a = polygon[i], b = polygon[(i + 1) % corners];
          inside = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) >= 0.0;
        }
        if (inside) image(x, y) = grey;
      }
    }
  }
  GreyImage blurred = image;
  for (int y = 1; y + 1 < kTextureSide_px; ++y) {
    for (int x = 1; x + 1 < kTextureSide_px; ++x) {
      blurred(x, y) =
          static_cast<std::uint8_t>((4 * image(x, y) + image(x - 1, y) + image(x + 1, y) +
                                     image(x, y - 1) + image(x, y + 1)) /
                                    8);
    }
  }
  return blurred;
}

}  // namespace

std::vector<GreyImage> MakeTextures(int count, RandomDraws* draws) {
  std::vector<GreyImage> textures;
  textures.reserve(count);
  for (int i = 0; i < count; ++i) {
    textures.push_back(i % 2 == 0 ? Noise(draws->Uniform(0.45, 0.8), draws) : Polygons(draws));
  }
  return textures;
}

Result<std::vector<GreyImage>> ReadPhotographs(const std::vector<std::string>& files) {
  std::vector<GreyImage> photographs;
  for (const std::string& file : files) {
    cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
    if (image.empty()) {
      return InputError(file, "cannot be read as a picture", "give a PNG or JPEG photograph");
    }
    const double scale = static_cast<double>(kTextureSide_px) / std::min(image.cols, image.rows);
    cv::resize(image, image, {}, scale, scale, scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
    GreyImage photograph(kTextureSide_px, kTextureSide_px);
    const int x0 = (image.cols - kTextureSide_px) / 2, y0 = (image.rows - kTextureSide_px) / 2;
    for (int y = 0; y < kTextureSide_px; ++y) {
      for (int x = 0; x < kTextureSide_px; ++x) {
        photograph(x, y) = image.at<std::uint8_t>(std::clamp(y + y0, 0, image.rows - 1),
                                                  std::clamp(x + x0, 0, image.cols - 1));
      }
    }
    photographs.push_back(std::move(photograph));
  }
  return photographs;
}

}  // namespace pleinair::marker_search
