#include "sky/clouds/cloud_field.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <numbers>
#include <utility>

#include "base/parallel_for.h"
#include "base/units.h"
#include "sky/clouds/cloud_noise.h"

namespace pleinair::clouds {
namespace {

/// How a kind looks.
struct KindShape {
  float cellular;   ///< Share of cellular noise.
  float roughness;  ///< Amplitude of each octave relative to the one before.
  float billow;     ///< Share of folded noise in the finer octaves: rounded edges.
  double growth;    ///< The depth inside a cloud grows as the noise above its threshold to this.
  double fringe;    ///< Width of the thin edge outside, in standard deviations of the noise.
  double flat;      ///< Share of the thickness that every column has.
};

KindShape ShapeOf(CloudKind kind) {
  switch (kind) {
    case CloudKind::kCumulus:
      return {0.0F, 0.45F, 0.7F, 1.2, 0.10, 0.0};
    case CloudKind::kStratocumulus:
      return {0.6F, 0.45F, 0.3F, 0.7, 0.15, 0.4};
    case CloudKind::kStratus:
      return {0.0F, 0.50F, 0.0F, 0.5, 0.30, 0.8};
    case CloudKind::kAltocumulus:
      return {0.7F, 0.45F, 0.2F, 1.0, 0.30, 0.6};
    case CloudKind::kCirrus:
      return {0.0F, 0.55F, 0.0F, 1.0, 0.60, 1.0};
    case CloudKind::kSlab:
      break;
  }
  return {0.0F, 0.0F, 0.0F, 1.0, 0.1, 1.0};
}

/// Fewest cells of a period.
constexpr int kMinCells = 3;
/// Most cells of a period in the finest octave.
constexpr int kFinestCells = 340;

/// Noise of a layer over one period. `u`, `v` in periods, 0…1.
class LayerNoise {
 public:
  LayerNoise(const CloudLayer& layer, double period_m)
      : shape_(ShapeOf(layer.kind)), seed_(static_cast<std::uint64_t>(layer.seed)) {
    const double cells = std::max<double>(kMinCells, std::round(period_m / layer.cell_m));
    if (layer.kind == CloudKind::kCirrus) {
      AlignStreaks(layer.wind_from_deg);
      // Streaks are twice as long as a cell and half as wide.
      const double scale = std::hypot(a_, b_);
      cells_u_ = std::max(1, static_cast<int>(std::round(cells / (2.0 * scale))));
      cells_v_ = std::max(2, static_cast<int>(std::round(2.0 * cells / scale)));
    } else {
      // A cell of gradient noise holds half a wave.
      cells_u_ = cells_v_ = static_cast<int>(shape_.cellular > 0.0F ? cells : 1.5 * cells);
    }
    // A cell of the finest octave is three columns wide or wider.
    while (octaves_ < 8 && (std::max(cells_u_, cells_v_) << octaves_) <= kFinestCells / 2)
      ++octaves_;
  }

  float At(float u, float v) const {
    float x = static_cast<float>(a_) * u + static_cast<float>(b_) * v;
    float y = static_cast<float>(a_) * v - static_cast<float>(b_) * u;
    x -= std::floor(x);
    y -= std::floor(y);
    if (cells_u_ != cells_v_) {  // Streaks are bent.
      y += 0.6F / static_cast<float>(cells_v_) *
           GradientNoise({MixSeeds(seed_, 99), 2 * cells_u_, 2 * cells_u_}, x, y);
    }
    float sum = 0.0F, amplitude = 1.0F;
    for (int octave = 0; octave < octaves_; ++octave) {
      const NoiseLattice lattice{MixSeeds(seed_, static_cast<std::uint64_t>(octave)),
                                 cells_u_ << octave, cells_v_ << octave};
      float noise = GradientNoise(lattice, x, y);
      if (octave > 0 && shape_.billow > 0.0F) {
        noise += shape_.billow * (0.3F - 2.0F * std::fabs(noise) - noise);
      }
      if (octave == 0 && shape_.cellular > 0.0F) {
        noise += shape_.cellular * (2.0F * CellularNoise(lattice, x, y) - 1.0F - noise);
      }
      sum += amplitude * noise;
      amplitude *= shape_.roughness;
    }
    return sum;
  }

 private:
  /// Streaks lie along the wind as nearly as whole numbers of periods allow: within 14°.
  void AlignStreaks(double wind_from_deg) {
    const double azimuth = wind_from_deg * kRadiansPerDegree;
    double best = -1.0;
    for (int a = -2; a <= 2; ++a) {
      for (int b = 0; b <= 2; ++b) {
        if ((std::abs(a) == 2 && b == 2) || (a == 0 && b != 1) || (b == 0 && a != 1)) continue;
        const double along =
            std::fabs(a * std::sin(azimuth) + b * std::cos(azimuth)) / std::hypot(a, b);
        if (along > best) {
          best = along;
          a_ = a;
          b_ = b;
        }
      }
    }
  }

  KindShape shape_;
  std::uint64_t seed_;
  int a_ = 1, b_ = 0;  ///< The first axis of the noise: a east, b north.
  int cells_u_ = 1, cells_v_ = 1;
  int octaves_ = 1;
};

/// The shift of passing clouds at a time within theirs.
double ShiftAt(const CloudPassing& passing, double seconds) {
  const auto next =
      std::upper_bound(passing.seconds.begin() + 1, passing.seconds.end() - 1, seconds);
  const auto i = static_cast<std::size_t>(next - passing.seconds.begin());
  const double span = passing.seconds[i] - passing.seconds[i - 1];
  const double part = std::clamp((seconds - passing.seconds[i - 1]) / span, 0.0, 1.0);
  return passing.shifts[i - 1] + part * (passing.shifts[i] - passing.shifts[i - 1]);
}

constexpr int kCoverSamples = 1000;  ///< Along each side of the square.

/// East or north of the place, metres.
double CoverSample(int i) { return ((i + 0.5) / kCoverSamples - 0.5) * kCoverSquare_m; }

/// The value that `share` of the values exceed.
float ExceededBy(std::vector<float> values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>((1.0 - share) * static_cast<double>(values.size()));
  if (rank >= static_cast<std::ptrdiff_t>(values.size())) {
    return std::numeric_limits<float>::infinity();
  }
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

double DeviationOf(const std::vector<float>& values) {
  double sum = 0.0, squares = 0.0;
  for (const float value : values) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const double mean = sum / static_cast<double>(values.size());
  return std::sqrt(std::max(1e-12, squares / static_cast<double>(values.size()) - mean * mean));
}

}  // namespace

CloudField::CloudField(const CloudLayer& layer) : layer_(layer) {
  const double azimuth = layer.wind_from_deg * kRadiansPerDegree;
  velocity_m_s_ = Vec2{-std::sin(azimuth), -std::cos(azimuth)} * layer.wind_m_s;
  const KindShape shape = ShapeOf(layer.kind);
  flat_share_ = shape.flat;
  if (layer.optical_depth > 0.0) inverse_reference_ = 1.0 / (2.0 * layer.optical_depth);
  if (layer.kind == CloudKind::kSlab) {
    uniform_depth_ = layer.optical_depth;
  } else if (layer.cover > 0.0 && layer.optical_depth > 0.0) {
    MakeColumns();
    AddPassing();
  }
}

CloudField::CloudField(const CloudField& bare, Vec2 displacement_m, const CloudPassing& passing)
    : CloudField(bare) {
  layer_.east_m = displacement_m.x;
  layer_.north_m = displacement_m.y;
  layer_.passing = passing;
  AddPassing();
}

// Texel by texel along the strip. Where the strip is longer than a period, it crosses itself.
void CloudField::AddPassing() {
  const CloudPassing& passing = layer_.passing;
  const double speed = std::hypot(velocity_m_s_.x, velocity_m_s_.y);
  if (passing.seconds.empty() || noise_.empty() || speed <= 0.0) return;
  const Vec2 along = velocity_m_s_ * (1.0 / speed);
  const double texel = period_m_ / kSide;
  // In the coordinates of the field: what passes the place later lies farther upwind.
  const auto at = [&](double seconds) {
    return Vec2{passing.east_m - layer_.east_m, passing.north_m - layer_.north_m} -
           velocity_m_s_ * seconds;
  };
  const Vec2 first = at(passing.seconds.front()), last = at(passing.seconds.back());
  const auto texels = [&](double metres) { return static_cast<long>(std::floor(metres / texel)); };
  const long x_end = texels(std::max(first.x, last.x) + passing.width_m) + 1;
  const long y_end = texels(std::max(first.y, last.y) + passing.width_m) + 1;
  for (long y = texels(std::min(first.y, last.y) - passing.width_m); y <= y_end; ++y) {
    for (long x = texels(std::min(first.x, last.x) - passing.width_m); x <= x_end; ++x) {
      const Vec2 from_first =
          first - Vec2{static_cast<double>(x) * texel, static_cast<double>(y) * texel};
      const double seconds =
          passing.seconds.front() + (from_first.x * along.x + from_first.y * along.y) / speed;
      const double inside = std::clamp(seconds, passing.seconds.front(), passing.seconds.back());
      const double across = from_first.x * along.y - from_first.y * along.x;
      const double away = std::hypot(across, (seconds - inside) * speed) / passing.width_m;
      if (away >= 1.0) continue;
      const double fading = (1.0 - away * away) * (1.0 - away * away);
      noise_[static_cast<std::size_t>(y & (kSide - 1)) * kSide +
             static_cast<std::size_t>(x & (kSide - 1))] +=
          static_cast<float>(fading * deviation_ * ShiftAt(passing, inside));
    }
  }
}

std::vector<float> CloudField::NoiseOfSquare() const {
  std::vector<float> noise;
  noise.reserve(static_cast<std::size_t>(kCoverSamples) * kCoverSamples);
  for (int y = 0; y < kCoverSamples; ++y) {
    for (int x = 0; x < kCoverSamples; ++x) {
      const Vec2 place = InPeriods(CoverSample(x), CoverSample(y), 0.0);
      noise.push_back(
          NoiseAt(static_cast<float>(place.x * kSide), static_cast<float>(place.y * kSide)));
    }
  }
  return noise;
}

// Cover fixes the threshold of the noise, the mean optical depth the scale above it.
void CloudField::MakeColumns() {
  if (layer_.cell_m * (kMinCells - 0.5) > kCoverSquare_m) period_m_ = kMinCells * layer_.cell_m;
  const LayerNoise noise(layer_, period_m_);
  noise_.resize(static_cast<std::size_t>(kSide) * kSide);
  ParallelFor(kSide, 0, [&](std::size_t row) {
    for (std::size_t x = 0; x < kSide; ++x) {
      noise_[row * kSide + x] =
          noise.At(static_cast<float>(x) / kSide, static_cast<float>(row) / kSide);
    }
  });
  const std::vector<float> square = NoiseOfSquare();
  const KindShape shape = ShapeOf(layer_.kind);
  const float threshold = ExceededBy(square, layer_.cover);
  const double deviation = DeviationOf(square);
  deviation_ = deviation;
  const double edge = CloudyDepth(layer_);
  const auto grown = [&](double value) {
    return std::pow(std::max(0.0, (value - threshold) / deviation), shape.growth);
  };
  double sum = 0.0;
  std::size_t cloudy = 0;
  for (const float value : square) {
    if (value < threshold) continue;
    sum += grown(value);
    ++cloudy;
  }
  const double scale =
      sum > 0.0 ? (layer_.optical_depth - edge) * static_cast<double>(cloudy) / sum : 0.0;
  // The table begins where the thin edge does.
  lowest_ = static_cast<float>(threshold - deviation * shape.fringe);
  const float highest = *std::max_element(noise_.begin(), noise_.end());
  entries_per_unit_ = (kEntries - 1) / std::max(1e-6F, highest - lowest_);
  depths_.reserve(kEntries);
  for (int i = 0; i < kEntries; ++i) {
    const double value = lowest_ + i / static_cast<double>(entries_per_unit_);
    const double tail = std::clamp((value - lowest_) / (deviation * shape.fringe), 0.0, 1.0);
    depths_.push_back(
        static_cast<float>(value < threshold ? edge * tail * tail : edge + scale * grown(value)));
  }
}

std::shared_ptr<const CloudField> CloudField::Of(const CloudLayer& layer) {
  struct Shared {
    CloudLayer layer;
    std::weak_ptr<const CloudField> field;
  };
  static std::mutex mutex;
  static std::vector<Shared> all;
  const std::lock_guard lock(mutex);
  for (const Shared& shared : all) {
    if (shared.layer != layer) continue;
    if (auto field = shared.field.lock()) return field;
  }
  auto made = std::make_shared<const CloudField>(layer);
  std::erase_if(all, [](const Shared& shared) { return shared.field.expired(); });
  all.push_back({layer, made});
  return made;
}

Vec2 CloudField::InPeriods(double east_m, double north_m, double seconds) const {
  const double u = (east_m - layer_.east_m - velocity_m_s_.x * seconds) / period_m_;
  const double v = (north_m - layer_.north_m - velocity_m_s_.y * seconds) / period_m_;
  return {u - std::floor(u), v - std::floor(v)};
}

double CloudField::Extinction(Vec3 point_m, double seconds) const {
  const double above = point_m.z - layer_.base_m;
  if (above < 0.0) return 0.0;
  const double column = ColumnDepth(point_m.x, point_m.y, seconds);
  const double height = ColumnHeight(column);
  return above <= height ? column / height : 0.0;
}

double CloudField::MostExtinction() const {
  // Depth grows with the noise, and depth over height with the depth.
  const double deepest = noise_.empty() ? uniform_depth_ : depths_.back();
  return deepest > 0.0 ? deepest / ColumnHeight(deepest) : 0.0;
}

double CloudField::DepthAlong(Vec3 from_m, Vec3 up, double seconds, int max_steps) const {
  double sum = 0.0;
  March(
      from_m, up, seconds, [&sum](double depth, Vec3, double, double) { sum += depth; }, max_steps);
  return sum;
}

CloudStatistics CloudField::Statistics(double seconds) const {
  const double cloudy_depth = CloudyDepth(layer_);
  double sum = 0.0;
  int cloudy = 0;
  for (int y = 0; y < kCoverSamples; ++y) {
    for (int x = 0; x < kCoverSamples; ++x) {
      const double depth = ColumnDepth(CoverSample(x), CoverSample(y), seconds);
      if (depth <= cloudy_depth) continue;
      sum += depth;
      ++cloudy;
    }
  }
  if (cloudy == 0) return {};
  return {static_cast<double>(cloudy) / (kCoverSamples * kCoverSamples), sum / cloudy};
}

}  // namespace pleinair::clouds
