#include "content/flow/line_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "content/flow/dormand_prince.h"
#include "content/flow/field_sampler.h"

namespace pleinair::content {
namespace {

constexpr double kMaxStepCells = 0.5;
/// Local errors, a step, as a share of the tolerance: errors add up along a line, and neighbouring
/// lines diverge. Measured in ABC flow (tests/content/flow): 2e-3 of a cell after 100 cells.
constexpr double kLocalShare = 5e-4;
/// Errors as a share of the step: near a sink, longer steps would leap around it for ever.
constexpr double kRelativeError = 0.05;
constexpr double kRounding = 1e-14;      // Of a cell.
constexpr double kLargeGrowth = 1e-4;    // Errors below it allow steps five times as long.
constexpr double kMinStepCells = 1e-7;   // Where a step counts as exact.
constexpr double kWallCells = 1e-3;      // How near to a wall a line ends.
constexpr double kStagnantSpeed = 1e-6;  // Of the field's largest.
constexpr int kStagnantSteps = 10;
constexpr double kClosedCells = 1e-2;
constexpr double kDepartedCells = 0.05;
constexpr double kSameHeading = 0.9;            // Cosine.
constexpr std::uint64_t kMaxSteps = 2'000'000;  // A line that long winds in place.

template <typename Sampler>
class SamplerTracer final : public LineTracer {
 public:
  SamplerTracer(Sampler sampler, const LineLimits& limits)
      : sampler_(std::move(sampler)), limits_(limits) {}

  std::unique_ptr<LineTracer> Copy() const override {
    return std::make_unique<SamplerTracer>(*this);
  }

  bool Begin(const Seed& seed, LineState* line, LineVertices* vertices) override {
    *line = {};
    line->point = line->start = seed.point;
    line->time = line->begin_s = seed.time;
    if (!Read(line, seed.point, seed.time, &line->velocity, PointState::kFlow)) return false;
    line->start_velocity = line->velocity;
    if (vertices != nullptr)
      vertices->Add(seed.point, seed.time, Speed(seed.point, line->velocity));
    return true;
  }

  std::optional<LineEnd> Advance(LineState* line, Seconds stop_s, const StopAt* stop,
                                 LineVertices* vertices) override {
    const double sign = stop_s < line->time ? -1.0 : 1.0;
    acceleration_ = {};
    // The velocity of another window, or of a line that begins.
    if (!Read(line, line->point, line->time, &line->velocity, PointState::kOutside)) {
      return LineEnd::kWall;
    }
    for (std::uint64_t count = 0; count < kMaxSteps; ++count) {
      const double rest_s = sign * (stop_s - line->time);
      if (!(rest_s > 0.0)) return std::nullopt;
      DormandPrinceStep step;
      double h = 0.0;
      if (line->velocity == Vec3{} && std::isinf(rest_s)) return LineEnd::kStagnated;
      if (!TakeControlledStep(line, sign, rest_s, &step, &h)) return LineEnd::kWall;
      const bool last = std::fabs(h) == rest_s;
      if (const auto end = Finish(line, step, h, last ? stop_s : line->time + h, vertices)) {
        return end;
      }
      if (stop != nullptr && (*stop)(line->point, line->length_m)) return LineEnd::kNeighbor;
    }
    return LineEnd::kLength;
  }

 private:
  /// Reads the velocity; false beyond `worst`.
  bool Read(LineState* line, const Vec3& point, Seconds time, Vec3* velocity, PointState worst) {
    ++line->field_reads;
    state_ = sampler_.Sample(point, time, velocity);
    return state_ <= worst;
  }

  double Speed(const Vec3& point, const Vec3& velocity) const {
    if (!sampler_.stretched()) return Norm(velocity);
    const Vec3 s = sampler_.field().Stretch(point);
    return Norm(Vec3{velocity.x / s.x, velocity.y / s.y, velocity.z / s.z});
  }

  /// A step whose error and size fit; `h` is signed. Returns false before a wall.
  bool TakeControlledStep(LineState* line, double sign, double rest_s, DormandPrinceStep* step,
                          double* h) {
    const Vec3 cell = sampler_.CellSize();
    const Vec3& v = line->velocity;
    const double cells_per_s =
        std::max({std::fabs(v.x) / cell.x, std::fabs(v.y) / cell.y, std::fabs(v.z) / cell.z});
    double max_s =
        cells_per_s > 0.0 ? kMaxStepCells / cells_per_s : std::numeric_limits<double>::infinity();
    if (limits_.max_step_m > 0.0) max_s = std::min(max_s, limits_.max_step_m / Norm(v));
    const double controlled_s = std::min(line->step_s > 0.0 ? line->step_s : max_s, max_s);
    double size_s = std::min(controlled_s, sampler_.SecondsToSide(v * sign, acceleration_));
    bool is_cut = size_s < controlled_s;
    const double allowed = limits_.tolerance_cells * kLocalShare;
    step->k[0] = v;
    for (;;) {
      if (size_s >= rest_s) {
        size_s = rest_s;
        is_cut = true;
      }
      *h = sign * size_s;
      const Seconds time = line->time;
      const auto velocity = [&](const Vec3& point, double share, Vec3* out) {
        return Read(line, point, time + *h * share, out, PointState::kOutside);
      };
      if (!TakeStep(line->point, *h, velocity, step)) {
        if (cells_per_s * size_s < kWallCells) return false;
        size_s *= 0.5;
        continue;
      }
      const Vec3& e = step->error;
      const Vec3 moved = step->end - line->point;
      // Of the smaller cell, at either end.
      const Vec3 there = sampler_.CellSize();
      const double moved_cells = std::max({std::fabs(moved.x) / std::min(cell.x, there.x),
                                           std::fabs(moved.y) / std::min(cell.y, there.y),
                                           std::fabs(moved.z) / std::min(cell.z, there.z)});
      const double error =
          std::max({std::fabs(e.x) / cell.x, std::fabs(e.y) / cell.y, std::fabs(e.z) / cell.z}) /
          std::min(allowed, kRelativeError * moved_cells + kRounding);
      const bool fits = error <= 1.0 && moved_cells <= 1.2 * kMaxStepCells;
      if (fits || cells_per_s * size_s < kMinStepCells) {
        const double growth = error > kLargeGrowth ? 0.9 * std::pow(error, -0.2) : 5.0;
        // A step that was cut does not shrink the next one.
        const double next_s = size_s * std::clamp(growth, 0.2, 5.0);
        line->step_s = is_cut ? std::max(next_s, line->step_s) : next_s;
        return true;
      }
      is_cut = false;
      size_s *= error > 1.0 ? std::max(0.2, 0.9 * std::pow(error, -0.2)) : 0.5;
    }
  }

  /// Moves the line to the end of a step, or to where it ends within.
  std::optional<LineEnd> Finish(LineState* line, const DormandPrinceStep& step, double h,
                                Seconds end_s, LineVertices* vertices) {
    const bool outside = state_ == PointState::kOutside;
    const double max_rest_m = limits_.length_m - line->length_m;
    const double step_m = ArcLength(*line, step, h);
    std::optional<LineEnd> end;
    double theta = 1.0;
    DenseStep dense;
    const bool may_return = limits_.may_close && MayReturn(line, step.end);
    if (outside || step_m >= max_rest_m || may_return || limits_.step_s > 0.0) {
      dense = step.Dense(line->point, h);
    }
    if (outside) {
      theta = LastInside(line, dense, h);
      end = LineEnd::kLeft;
    }
    if (step_m * theta >= max_rest_m) {
      theta = ShareOfLength(dense, max_rest_m / step_m);
      end = LineEnd::kLength;
    }
    if (may_return) {
      if (const auto closed = Closing(*line, dense, step); closed && *closed <= theta) {
        theta = *closed;
        end = LineEnd::kClosed;
      }
    }
    RecordMultiples(line, dense, h, theta, step, vertices);
    const Vec3 velocity = end ? step.k[0] + (step.k[6] - step.k[0]) * theta : step.k[6];
    line->length_m += end == LineEnd::kLength ? max_rest_m : step_m * theta;
    line->point = theta < 1.0 ? dense.At(theta) : step.end;
    line->time = theta < 1.0 ? line->time + theta * h : end_s;
    line->velocity = velocity;
    const double speed_m_s = Speed(line->point, velocity);
    if (vertices != nullptr &&
        (limits_.step_s <= 0.0 || (end && vertices->times_s.back() != line->time))) {
      vertices->Add(line->point, line->time, speed_m_s);
    }
    acceleration_ = (step.k[6] - step.k[0]) * (1.0 / h);
    const bool is_slow = limits_.steady && speed_m_s < kStagnantSpeed * limits_.max_speed_m_s;
    line->slow_steps = is_slow ? line->slow_steps + 1 : 0;
    return end || line->slow_steps < kStagnantSteps ? end : LineEnd::kStagnated;
  }

  /// Simpson's rule on the speed; that in the middle is of Hermite's cubic.
  double ArcLength(const LineState& line, const DormandPrinceStep& step, double h) const {
    const Vec3 middle = (step.end - line.point) * (1.5 / h) - (step.k[0] + step.k[6]) * 0.25;
    if (!sampler_.stretched()) {
      return std::fabs(h) / 6.0 * (Norm(step.k[0]) + 4.0 * Norm(middle) + Norm(step.k[6]));
    }
    const Vec3 between = (line.point + step.end) * 0.5;
    return std::fabs(h) / 6.0 *
           (Speed(line.point, step.k[0]) + 4.0 * Speed(between, middle) +
            Speed(step.end, step.k[6]));
  }

  double LastInside(LineState* line, const DenseStep& dense, double h) {
    double inside = 0.0, beyond = 1.0;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (inside + beyond);
      Vec3 ignored;
      const bool is_inside =
          Read(line, dense.At(middle), line->time + middle * h, &ignored, PointState::kFlow);
      (is_inside ? inside : beyond) = middle;
    }
    return inside;
  }

  /// Where `share` of the length of a step lies, by its chords.
  static double ShareOfLength(const DenseStep& dense, double share) {
    constexpr int kChords = 32;
    std::array<double, kChords + 1> length{};
    for (int i = 1; i <= kChords; ++i) {
      length[static_cast<std::size_t>(i)] =
          length[static_cast<std::size_t>(i) - 1] +
          Norm(dense.At(1.0 * i / kChords) - dense.At((i - 1.0) / kChords));
    }
    const double wanted = std::clamp(share, 0.0, 1.0) * length.back();
    std::size_t i = 1;
    while (i < kChords && length[i] < wanted) ++i;
    const double chord = length[i] - length[i - 1];
    const double part = chord > 0.0 ? (wanted - length[i - 1]) / chord : 1.0;
    return (static_cast<double>(i) - 1.0 + part) / kChords;
  }

  double CellsBetween(const Vec3& a, const Vec3& b) const {
    const Vec3 cell = sampler_.CellSize();
    return Norm(Vec3{(a.x - b.x) / cell.x, (a.y - b.y) / cell.y, (a.z - b.z) / cell.z});
  }

  bool MayReturn(LineState* line, const Vec3& end) const {
    const double cells = CellsBetween(end, line->start);
    if (!line->departed) {
      line->departed = cells > kDepartedCells;
      return false;
    }
    return cells < 2.0 * kMaxStepCells;
  }

  /// Where in a step the line comes back to its start.
  std::optional<double> Closing(const LineState& line, const DenseStep& dense,
                                const DormandPrinceStep& step) const {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 50; ++i) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      if (CellsBetween(dense.At(a), line.start) < CellsBetween(dense.At(b), line.start)) {
        high = b;
      } else {
        low = a;
      }
    }
    const double theta = 0.5 * (low + high);
    if (CellsBetween(dense.At(theta), line.start) > kClosedCells) return std::nullopt;
    const Vec3 velocity = step.k[0] + (step.k[6] - step.k[0]) * theta;
    const double same = Dot(velocity, line.start_velocity);
    if (same < kSameHeading * Norm(velocity) * Norm(line.start_velocity)) return std::nullopt;
    return theta;
  }

  /// Vertices at multiples of the step that was asked for.
  void RecordMultiples(LineState* line, const DenseStep& dense, double h, double theta,
                       const DormandPrinceStep& step, LineVertices* vertices) const {
    if (!(limits_.step_s > 0.0) || vertices == nullptr) return;
    for (;;) {
      const double next_s = static_cast<double>(line->recorded + 1) * limits_.step_s;
      const double at = (next_s - std::fabs(line->time - line->begin_s)) / std::fabs(h);
      if (at > theta * (1.0 + 1e-9)) return;
      const double share = std::clamp(at, 0.0, 1.0);
      const Vec3 point = dense.At(share);
      const Vec3 velocity = step.k[0] + (step.k[6] - step.k[0]) * share;
      vertices->Add(point, line->begin_s + std::copysign(next_s, h), Speed(point, velocity));
      ++line->recorded;
    }
  }

  Sampler sampler_;
  LineLimits limits_;
  PointState state_ = PointState::kFlow;  // Of the point that was read last.
  Vec3 acceleration_;                     // In the last step.
};

template <typename Sampler>
std::unique_ptr<LineTracer> TracerOf(Sampler sampler, const LineLimits& limits) {
  return std::make_unique<SamplerTracer<Sampler>>(std::move(sampler), limits);
}

template <typename T>
double MaxSquare(const std::vector<T>& values, std::size_t components, double best) {
  for (std::size_t i = 0; i + components <= values.size(); i += components) {
    double square = 0.0;
    for (std::size_t c = 0; c < components; ++c) {
      square += static_cast<double>(values[i + c]) * static_cast<double>(values[i + c]);
    }
    if (square > best) best = square;
  }
  return best;
}

}  // namespace

void LineVertices::Clear() {
  points.clear();
  times_s.clear();
  speeds_m_s.clear();
}

void LineVertices::Add(const Vec3& point, Seconds time, double speed_m_s) {
  points.push_back(point);
  times_s.push_back(time);
  speeds_m_s.push_back(speed_m_s);
}

std::unique_ptr<LineTracer> MakeTracer(const GridField& field, const FieldWindow& window,
                                       const LineLimits& limits) {
  return WithGridSampler(field, window,
                         [&](auto sampler) { return TracerOf(std::move(sampler), limits); });
}

std::unique_ptr<LineTracer> MakeTracer(const VectorField& field, std::optional<Seconds> frozen_s,
                                       const LineLimits& limits) {
  return TracerOf(AnyFieldSampler(field, frozen_s.has_value(), frozen_s.value_or(0.0)), limits);
}

double MaxSpeed(const VectorField& field, const FieldWindow& window) {
  double best = 0.0;
  if (const auto* grid = dynamic_cast<const GridField*>(&field)) {
    for (const SharedSlice& slice : {window.first, window.second}) {
      if (!slice) continue;
      best = MaxSquare(slice->singles, grid->axes().size(), best);
      best = MaxSquare(slice->doubles, grid->axes().size(), best);
    }
    return std::sqrt(best);
  }
  constexpr int kLattice = 17;
  const Box box = field.bounds();
  const Vec3 size = box.max - box.min;
  for (int n = 0; n < kLattice * kLattice * kLattice; ++n) {
    const int column = n % kLattice, row = n / kLattice % kLattice, layer = n / kLattice / kLattice;
    const Vec3 share = Vec3{1.0 * column, 1.0 * row, 1.0 * layer} * (1.0 / (kLattice - 1.0));
    const Vec3 v = field.At(box.min + Vec3{size.x * share.x, size.y * share.y, size.z * share.z},
                            window.first_s);
    if (Norm(v) > best) best = Norm(v);
  }
  return best;
}

}  // namespace pleinair::content
