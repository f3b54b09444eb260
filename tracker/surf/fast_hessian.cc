#include "tracker/surf/fast_hessian.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tracker/surf/response_maxima.h"

namespace pleinair::tracker {

namespace {

/// Vector code reads and writes whole vectors at the end of a row of responses.
constexpr int kRowPadding = IntegralImage::kPadding;
/// Elements before the start of a row: the neighbourhood reads one to the left.
constexpr int kRowFront = 16;
/// Columns of the image that are searched together: a filter of 27 px then uses 30 KB of sums.
constexpr int kStrip_px = 256;

/// Maximum of the parabola through the 3 x 3 x 3 neighbourhood, relative to its central sample, in
/// samples (Brown and Lowe, "Invariant Features from Interest Point Groups", BMVC 2002):
/// -(Hessian)^-1 gradient. Returns nullopt if it is more than a sample away: the parabola then does
/// not fit the neighbourhood.
struct Offset {
  float x, y, layer;
};
std::optional<Offset> Interpolate(const ResponseNeighbourhood& n, int i) {
  const auto at = [&](int layer, int row, int dx) {
    return static_cast<double>(n.rows[layer + 1][row + 1][i + dx]);
  };
  const double middle = at(0, 0, 0);
  const double gx = (at(0, 0, 1) - at(0, 0, -1)) / 2;
  const double gy = (at(0, 1, 0) - at(0, -1, 0)) / 2;
  const double gs = (at(1, 0, 0) - at(-1, 0, 0)) / 2;
  const double xx = at(0, 0, 1) + at(0, 0, -1) - 2 * middle;
  const double yy = at(0, 1, 0) + at(0, -1, 0) - 2 * middle;
  const double ss = at(1, 0, 0) + at(-1, 0, 0) - 2 * middle;
  const double xy = (at(0, 1, 1) - at(0, 1, -1) - at(0, -1, 1) + at(0, -1, -1)) / 4;
  const double xs = (at(1, 0, 1) - at(1, 0, -1) - at(-1, 0, 1) + at(-1, 0, -1)) / 4;
  const double ys = (at(1, 1, 0) - at(1, -1, 0) - at(-1, 1, 0) + at(-1, -1, 0)) / 4;
  // Cramer's rule, by cofactors of the symmetric matrix.
  const double cxx = yy * ss - ys * ys;
  const double cxy = xs * ys - xy * ss;
  const double cxs = xy * ys - yy * xs;
  const double cyy = xx * ss - xs * xs;
  const double cys = xy * xs - xx * ys;
  const double css = xx * yy - xy * xy;
  const double determinant = xx * cxx + xy * cxy + xs * cxs;
  if (determinant == 0) return std::nullopt;
  const Offset offset = {static_cast<float>(-(cxx * gx + cxy * gy + cxs * gs) / determinant),
                         static_cast<float>(-(cxy * gx + cyy * gy + cys * gs) / determinant),
                         static_cast<float>(-(cxs * gx + cys * gy + css * gs) / determinant)};
  const float largest = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.layer)});
  if (!(largest <= 1.0f)) return std::nullopt;
  return offset;
}

int StepOfOctave(int octave, int first_step) {
  constexpr int kMaxStep = 4;
  return octave >= 2 ? kMaxStep : std::min(first_step << octave, kMaxStep);
}

}  // namespace

float* FastHessian::RingRow(int layer, int sample_y) {
  return ring_[layer * 3 + sample_y % 3].data() + kRowFront;
}

void FastHessian::Detect(const IntegralImage& integral, int octaves, int first_step,
                         float threshold, std::vector<SurfKeypoint>* maxima) {
  for (int octave = 0; octave < octaves; ++octave) {
    // The neighbourhood needs three samples whose largest filter is inside the image.
    const int step = StepOfOctave(octave, first_step);
    const int needed = FilterSize(octave, 2) + 2 * step;
    if (std::min(integral.width(), integral.height()) < needed) return;
    DetectOctave(integral, octave, step, octave + 1 < octaves, StepOfOctave(octave + 1, first_step),
                 threshold, maxima);
    std::swap(shared_, shared_next_);
  }
}

void FastHessian::DetectOctave(const IntegralImage& integral, int octave, int step,
                               bool shares_with_next, int next_step, float threshold,
                               std::vector<SurfKeypoint>* maxima) {
  const int columns = (integral.width() + step - 1) / step;
  const int rows = (integral.height() + step - 1) / step;
  for (std::vector<float>& row : ring_) {
    const std::size_t needed = std::size_t{kRowFront} + columns + kRowPadding;
    if (row.size() < needed) row.resize(needed);
  }
  candidates_.resize(columns + kRowPadding);
  // The next octave shares every sample of this one, or every second in both directions.
  const int ratio = next_step / step;
  const int next_columns = (columns + ratio - 1) / ratio;
  const int next_rows = (rows + ratio - 1) / ratio;
  if (shares_with_next) {
    for (Plane& plane : shared_next_) {
      plane.stride = next_columns;
      plane.values.resize(static_cast<std::size_t>(next_columns) * next_rows);
    }
  }

  const int strip = kStrip_px / step;
  for (int first = 0; first < columns; first += strip) {
    DetectStrip(integral, octave, step, shares_with_next, ratio,
                {first, std::min(first + strip, columns)}, threshold, maxima);
  }
}

void FastHessian::DetectStrip(const IntegralImage& integral, int octave, int step,
                              bool shares_with_next, int ratio, SampleRange strip, float threshold,
                              std::vector<SurfKeypoint>* maxima) {
  const int columns = (integral.width() + step - 1) / step;
  const int rows = (integral.height() + step - 1) / step;
  // Includes the neighbours of the strip's samples.
  const SampleRange around{std::max(0, strip.first - 1), std::min(columns, strip.last + 1)};
  const int next_first = (strip.first + ratio - 1) / ratio;
  const int next_last = (strip.last + ratio - 1) / ratio;
  for (int sample_y = 0; sample_y < rows; ++sample_y) {
    for (int layer = 0; layer < kLayers; ++layer) {
      float* const row = RingRow(layer, sample_y);
      if (octave > 0 && layer < 2) {
        const Plane& plane = shared_[layer];
        const float* const from = plane.values.data() + sample_y * plane.stride;
        std::copy(from + around.first, from + around.last, row + around.first);
      } else {
        ComputeHessianRow(integral, FilterSize(octave, layer), step, sample_y * step, around,
                          &scratch_, row);
      }
      if (shares_with_next && layer % 2 == 1 && sample_y % ratio == 0) {
        Plane& plane = shared_next_[layer / 2];
        float* const shared_row = plane.values.data() + (sample_y / ratio) * plane.stride;
        for (int i = next_first; i < next_last; ++i) shared_row[i] = row[i * ratio];
      }
    }
    if (sample_y >= 2) FindMaxima(integral, octave, step, sample_y - 1, strip, threshold, maxima);
  }
}

void FastHessian::FindMaxima(const IntegralImage& integral, int octave, int step, int sample_y,
                             SampleRange strip, float threshold,
                             std::vector<SurfKeypoint>* maxima) {
  for (int layer = 1; layer + 1 < kLayers; ++layer) {
    // Only where the largest filter of the neighbourhood is inside the image at all its samples.
    const int margin = FilterSize(octave, layer + 1) / 2;
    const int y = sample_y * step;
    if (y - step < margin || y + step + margin >= integral.height()) continue;
    const int begin = std::max(strip.first, (margin + step - 1) / step + 1);
    const int end = std::min(strip.last, (integral.width() - 1 - margin) / step);
    if (begin >= end) continue;
    ResponseNeighbourhood neighbourhood;
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) {
        neighbourhood.rows[k][j] = RingRow(layer - 1 + k, sample_y - 1 + j);
      }
    }
    const int count = FindResponseMaxima(neighbourhood, begin, end, threshold, candidates_.data());
    const int filter_size = FilterSize(octave, layer);
    const int layer_step = FilterSize(octave, layer + 1) - filter_size;
    for (int k = 0; k < count; ++k) {
      const int i = candidates_[k];
      const std::optional<Offset> offset = Interpolate(neighbourhood, i);
      if (!offset) continue;
      const float size =
          static_cast<float>(filter_size) + offset->layer * static_cast<float>(layer_step);
      maxima->push_back({.x = (static_cast<float>(i) + offset->x) * static_cast<float>(step),
                         .y = (static_cast<float>(sample_y) + offset->y) * static_cast<float>(step),
                         .scale = 1.2f * size / 9.0f,
                         .response = neighbourhood.rows[1][1][i],
                         .bright = LaplacianAt(integral, filter_size, i * step, y) < 0});
    }
  }
}

}  // namespace pleinair::tracker
