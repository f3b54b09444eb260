#include "tests/tracker/surf/surf_test_images.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace pleinair::tracker {

namespace {

double BlobAt(const TestBlob& blob, double x, double y) {
  const double dx = x - blob.x;
  const double dy = y - blob.y;
  const double exponent = (dx * dx + dy * dy) / (2 * blob.sigma * blob.sigma);
  return exponent > 20 ? 0.0 : blob.contrast * std::exp(-exponent);
}

std::uint8_t ToByte(double grey) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
}

}  // namespace

GreyImage DrawBlobs(int width, int height, double ground, const std::vector<TestBlob>& blobs) {
  GreyImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double grey = ground;
      for (const TestBlob& blob : blobs) grey += BlobAt(blob, x, y);
      image(x, y) = ToByte(grey);
    }
  }
  return image;
}

TestTexture::TestTexture(unsigned seed, double half) {
  std::mt19937 random(seed);
  // Not the standard distributions: their values differ between libraries.
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const int count = static_cast<int>(half * half / 60);
  for (int i = 0; i < count; ++i) {
    const double sign = uniform(0, 1) < 0.5 ? -1 : 1;
    const double angle = uniform(0, 2 * std::numbers::pi);
    const double along = 1 / uniform(4, 9);
    const double across = 1 / uniform(1.5, 4);
    blobs_.push_back({.x = uniform(-half, half),
                      .y = uniform(-half, half),
                      .along_x = along * std::cos(angle),
                      .along_y = along * std::sin(angle),
                      .across_x = -across * std::sin(angle),
                      .across_y = across * std::cos(angle),
                      .contrast = sign * uniform(20, 60)});
  }
}

double TestTexture::operator()(double x, double y) const {
  double grey = 128;
  for (const LongBlob& blob : blobs_) {
    const double along = (x - blob.x) * blob.along_x + (y - blob.y) * blob.along_y;
    const double across = (x - blob.x) * blob.across_x + (y - blob.y) * blob.across_y;
    const double exponent = (along * along + across * across) / 2;
    if (exponent < 20) grey += blob.contrast * std::exp(-exponent);
  }
  return grey;
}

GreyImage TestTexture::Draw(int width, int height, double angle_rad, double zoom) const {
  GreyImage image(width, height);
  const double c = std::cos(angle_rad) / zoom;
  const double s = std::sin(angle_rad) / zoom;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double dx = x - (width - 1) / 2.0;
      const double dy = y - (height - 1) / 2.0;
      image(x, y) = ToByte((*this)(c * dx + s * dy, -s * dx + c * dy));
    }
  }
  return image;
}

GreyImage DrawNoise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  GreyImage image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image.data()[i] = static_cast<std::uint8_t>(random() >> 24);
  }
  return image;
}

}  // namespace pleinair::tracker
