#include "tests/tracker/surf/surf_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace pleinair::tracker::reference {

double Response(const GreyImage& grey, int filter_size, int x, int y, double* laplacian) {
  const int margin = filter_size / 2;
  const int lobe = filter_size / 3;
  if (x < margin || y < margin || x + margin >= grey.width() || y + margin >= grey.height()) {
    return 0;
  }
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for (int dy = -margin; dy <= margin; ++dy) {
    for (int dx = -margin; dx <= margin; ++dx) {
      const double value = grey(x + dx, y + dy) / 255.0;
      // Fig. 2: lobes of weight 1, -2, 1 of L/3 by 2 L/3 - 1 px.
      if (std::abs(dy) < lobe) xx += (2 * std::abs(dx) < lobe ? -2 : 1) * value;
      if (std::abs(dx) < lobe) yy += (2 * std::abs(dy) < lobe ? -2 : 1) * value;
      // Four boxes of L/3 px, one pixel off the axes.
      if (dx != 0 && dy != 0 && std::abs(dx) <= lobe && std::abs(dy) <= lobe) {
        xy += ((dx > 0) == (dy > 0) ? 1 : -1) * value;
      }
    }
  }
  const double area = static_cast<double>(filter_size) * filter_size;
  if (laplacian != nullptr) *laplacian = (xx + yy) / area;
  return (xx * yy - 0.9 * 0.9 * xy * xy) / (area * area);
}

std::vector<Sample> Maxima(const GreyImage& grey, int octave, int step, double threshold) {
  static const std::array<std::array<int, 4>, 3> kSizes = {
      {{9, 15, 21, 27}, {15, 27, 39, 51}, {27, 51, 75, 99}}};
  std::map<std::tuple<int, int, int>, double> responses;
  const auto at = [&](int layer, int x, int y) {
    const auto [place, is_new] = responses.try_emplace({layer, x, y}, 0.0);
    if (is_new) place->second = Response(grey, kSizes[octave][layer], x, y);
    return place->second;
  };
  std::vector<Sample> maxima;
  for (const int layer : {1, 2}) {
    const int margin = kSizes[octave][layer + 1] / 2 + step;
    for (int y = 0; y + margin < grey.height(); y += step) {
      for (int x = 0; x + margin < grey.width(); x += step) {
        if (x < margin || y < margin || at(layer, x, y) <= threshold) continue;
        bool largest = true;
        for (int n = 0; n < 27 && largest; ++n) {
          if (n == 13) continue;
          largest = at(layer, x, y) >
                    at(layer + n / 9 - 1, x + (n % 3 - 1) * step, y + (n / 3 % 3 - 1) * step);
        }
        if (largest) maxima.push_back({kSizes[octave][layer], x, y});
      }
    }
  }
  std::sort(maxima.begin(), maxima.end());
  return maxima;
}

double BoxMean(const GreyImage& grey, int box, int step, double x, double y) {
  const int columns = (grey.width() - box) / step;
  const int rows = (grey.height() - box) / step;
  const double u = std::clamp((x - (box - 1) / 2.0) / step, 0.0, static_cast<double>(columns));
  const double v = std::clamp((y - (box - 1) / 2.0) / step, 0.0, static_cast<double>(rows));
  const int column = static_cast<int>(u);
  const int row = static_cast<int>(v);
  const auto mean = [&](int i, int j) {
    double sum = 0;
    for (int dy = 0; dy < box; ++dy) {
      for (int dx = 0; dx < box; ++dx) {
        sum += grey(std::min(i, columns) * step + dx, std::min(j, rows) * step + dy);
      }
    }
    return sum / (box * box);
  };
  const double right = u - column;
  const double down = v - row;
  return (1 - down) * ((1 - right) * mean(column, row) + right * mean(column + 1, row)) +
         down * ((1 - right) * mean(column, row + 1) + right * mean(column + 1, row + 1));
}

double Direction(const GreyImage& grey, const SurfKeypoint& keypoint, int box, int step) {
  struct Wavelet {
    double x, y, angle;
  };
  std::vector<Wavelet> wavelets;
  const double s = keypoint.scale;
  for (int j = -6; j <= 6; ++j) {
    for (int i = -6; i <= 6; ++i) {
      if (i * i + j * j > 36) continue;
      const auto mean = [&](int di, int dj) {
        return BoxMean(grey, box, step, keypoint.x + (i + di) * s, keypoint.y + (j + dj) * s);
      };
      const double weight = std::exp(-(i * i + j * j) / (2 * 2.5 * 2.5));
      const double x = weight * (mean(1, -1) + mean(1, 1) - mean(-1, -1) - mean(-1, 1));
      const double y = weight * (mean(-1, 1) + mean(1, 1) - mean(-1, -1) - mean(1, -1));
      wavelets.push_back({x, y, std::atan2(y, x)});
    }
  }
  double longest = 0;
  double direction = 0;
  for (const Wavelet& first : wavelets) {
    double x = 0;
    double y = 0;
    for (const Wavelet& wavelet : wavelets) {
      double turn = wavelet.angle - first.angle;
      if (turn < 0) turn += 2 * std::numbers::pi;
      if (turn > std::numbers::pi) continue;
      x += wavelet.x;
      y += wavelet.y;
    }
    if (x * x + y * y <= longest) continue;
    longest = x * x + y * y;
    direction = std::atan2(y, x);
  }
  return direction;
}

SurfDescriptor Describe(const GreyImage& grey, const SurfKeypoint& keypoint, int box, int step) {
  std::array<double, 64> sums = {};
  const double c = std::cos(keypoint.angle_rad) * keypoint.scale;
  const double s = std::sin(keypoint.angle_rad) * keypoint.scale;
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 20; ++i) {
      const auto mean = [&](int di, int dj) {
        const double u = i + di - 10;
        const double v = j + dj - 10;
        return BoxMean(grey, box, step, keypoint.x + c * u - s * v, keypoint.y + s * u + c * v);
      };
      const double u = i - 9.5;
      const double v = j - 9.5;
      const double weight = std::exp(-(u * u + v * v) / (2 * 3.3 * 3.3));
      const double dx = weight * (mean(1, 0) + mean(1, 1) - mean(0, 0) - mean(0, 1));
      const double dy = weight * (mean(0, 1) + mean(1, 1) - mean(0, 0) - mean(1, 0));
      // Shared between cells by the distance from their middles.
      for (int cell = 0; cell < 16; ++cell) {
        const double from_x = std::abs(i - (cell % 4 * 5 + 2)) / 5.0;
        const double from_y = std::abs(j - (cell / 4 * 5 + 2)) / 5.0;
        if (from_x >= 1 || from_y >= 1) continue;
        const double share = (1 - from_x) * (1 - from_y);
        sums[cell * 4] += share * dx;
        sums[cell * 4 + 1] += share * dy;
        sums[cell * 4 + 2] += share * std::abs(dx);
        sums[cell * 4 + 3] += share * std::abs(dy);
      }
    }
  }
  double squared_length = 0;
  for (const double sum : sums) squared_length += sum * sum;
  SurfDescriptor descriptor;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    descriptor[i] =
        squared_length > 0 ? static_cast<float>(sums[i] / std::sqrt(squared_length)) : 0.0f;
  }
  return descriptor;
}

std::vector<DescriptorMatch> Nearest(const QuantisedDescriptor& from,
                                     const std::vector<QuantisedDescriptor>& to, int k) {
  std::vector<DescriptorMatch> all;
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (to[i].bright != from.bright) continue;
    int sum = 0;
    for (std::size_t n = 0; n < 64; ++n) {
      const int difference = to[i].values[n] - from.values[n];
      sum += difference * difference;
    }
    all.push_back({static_cast<std::int32_t>(i), sum});
  }
  std::stable_sort(all.begin(), all.end(), [](const DescriptorMatch& a, const DescriptorMatch& b) {
    return a.squared_distance < b.squared_distance;
  });
  all.resize(k);
  return all;
}

}  // namespace pleinair::tracker::reference
