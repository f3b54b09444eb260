#include "content/flow/even_placement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <utility>

#include "content/flow/field_probe.h"
#include "content/flow/level_grid.h"
#include "content/flow/line_points.h"
#include "content/flow/line_tracer.h"
#include "content/flow/placement_holes.h"

namespace pleinair::content {
namespace {

constexpr double kStopAt = 0.5;          // Of the spacing: where a line ends before another.
constexpr double kPointEvery = 0.1;      // Of the spacing, along the lines in the hash.
constexpr double kSelfTestEvery = 0.05;  // Of the spacing, along a line.
constexpr double kSeedSlack = 1e-6;      // A seed at the spacing, but for rounding, is at it.
constexpr double kFirstWithin = 1e-3;    // Of the median of speeds.

bool IsInside(const Box& box, const Vec3& p) {
  const auto in = [](double x, double low, double high) { return x >= low && x <= high; };
  return in(p.x, box.min.x, box.max.x) && in(p.y, box.min.y, box.max.y) &&
         in(p.z, box.min.z, box.max.z);
}

/// Places lines one by one.
class Placement {
 public:
  Placement(LinePoints points, std::unique_ptr<LineTracer> tracer, const Box& box, bool plane,
            double spacing_m)
      : points_(std::move(points)),
        tracer_(std::move(tracer)),
        box_(box),
        plane_(plane),
        spacing_m_(spacing_m) {}

  /// Follows a line from a seed unless others are near. Returns whether it is kept.
  bool TryLine(const Vec3& seed);
  /// Called for each line.
  void SetProgress(std::function<void()> progress) { progress_ = std::move(progress); }
  /// Tries the seeds beside the points of all lines, the oldest first.
  void TrySeedsBesideLines(const Vec3& normal);

  bool IsFree(const Vec3& seed) const {
    return !points_.AnyNear(seed, spacing_m_ * (1.0 - kSeedSlack),
                            [](const LinePoints::Entry&, double) { return true; });
  }
  const LinePoints& points() const { return points_; }
  std::vector<FlowLine> TakeLines() { return std::move(lines_); }

 private:
  LineEnd Follow(const Vec3& seed, double sign, LineVertices* vertices, double* length_m);

  LinePoints points_;
  std::unique_ptr<LineTracer> tracer_;
  Box box_;
  bool plane_;
  double spacing_m_;
  std::vector<FlowLine> lines_;
  std::vector<Vec3> directions_;        // Of the flow at each of points_.
  std::vector<LinePoints::Entry> own_;  // The line that is being followed.
  std::vector<Vec3> own_directions_;
  std::uint64_t reads_ = 0;
  std::function<void()> progress_;
};

/// One way of a line. Where it meets its own start it may close: it goes on for one spacing, and
/// back to where it met if it does not.
LineEnd Placement::Follow(const Vec3& seed, double sign, LineVertices* vertices, double* length_m) {
  vertices->Clear();
  LineState state;
  *length_m = 0.0;
  if (!tracer_->Begin({seed, 0.0}, &state, vertices)) return LineEnd::kWall;
  double last_m = 0.0, tested_m = 0.0, safe_until_m = 0.0,
         met_m = std::numeric_limits<double>::infinity();
  std::size_t met_count = 0;
  bool beyond = false;
  const auto number = static_cast<std::uint32_t>(lines_.size());
  const StopAt stop = [&](const Vec3& point, double arc_m) {
    if (!IsInside(box_, point)) {
      beyond = true;
      return true;
    }
    if (arc_m > met_m + spacing_m_) return true;
    // A line that is r from the nearest other one meets none within r minus half the spacing.
    if (arc_m >= safe_until_m) {
      double square_m2 = spacing_m_ * spacing_m_;
      points_.AnyNear(point, spacing_m_, [&](const LinePoints::Entry&, double square) {
        square_m2 = std::min(square_m2, square);
        return false;
      });
      const double margin_m = std::sqrt(square_m2) - kStopAt * spacing_m_;
      if (margin_m < 0.0) return true;
      safe_until_m = arc_m + margin_m;
    }
    const bool tests_itself = arc_m - tested_m >= kSelfTestEvery * spacing_m_;
    if (tests_itself) tested_m = arc_m;
    for (std::size_t i = 0; tests_itself && i < own_.size() && met_count == 0; ++i) {
      const LinePoints::Entry& entry = own_[i];
      const Vec3 off = entry.point - point;
      if (Dot(off, off) >= kStopAt * kStopAt * spacing_m_ * spacing_m_) continue;
      if (std::fabs(sign * arc_m - static_cast<double>(entry.arc_m)) <= spacing_m_) continue;
      met_count = vertices->points.size() - 1;
      met_m = arc_m;
      if (std::fabs(static_cast<double>(entry.arc_m)) > spacing_m_) return true;
    }
    if (arc_m - last_m >= kPointEvery * spacing_m_) {
      last_m = arc_m;
      own_.push_back({point, number, static_cast<float>(sign * arc_m)});
      own_directions_.push_back(state.velocity);
    }
    return false;
  };
  const LineEnd end =
      tracer_->Advance(&state, sign * std::numeric_limits<double>::infinity(), &stop, vertices)
          .value_or(LineEnd::kDuration);
  reads_ += state.field_reads;
  *length_m = state.length_m;
  if (end == LineEnd::kClosed) return end;
  std::size_t keep = vertices->points.size();
  if (end == LineEnd::kNeighbor) --keep;
  if (met_count > 0) keep = std::min(keep, met_count);
  if (keep < vertices->points.size()) {
    vertices->points.resize(keep);
    vertices->times_s.resize(keep);
    vertices->speeds_m_s.resize(keep);
    *length_m = std::min(*length_m, met_m);
    // Points of what was given up.
    while (!own_.empty() && std::fabs(static_cast<double>(own_.back().arc_m)) > *length_m &&
           (own_.back().arc_m > 0.0F) == (sign > 0.0)) {
      own_.pop_back();
      own_directions_.pop_back();
    }
  }
  if (beyond) return LineEnd::kLeft;
  return met_count > 0 ? LineEnd::kNeighbor : end;
}

bool Placement::TryLine(const Vec3& seed) {
  if (!IsInside(box_, seed) || !IsFree(seed)) return false;
  own_.clear();
  own_directions_.clear();
  LineState at_seed;
  if (!tracer_->Begin({seed, 0.0}, &at_seed, nullptr)) return false;
  own_.push_back({seed, static_cast<std::uint32_t>(lines_.size()), 0.0F});
  own_directions_.push_back(at_seed.velocity);
  FlowLine line;
  LineVertices up, down;
  double up_m = 0.0, down_m = 0.0;
  reads_ = 0;
  line.upstream_end = Follow(seed, -1.0, &up, &up_m);
  const bool closed = line.upstream_end == LineEnd::kClosed;
  if (!closed) line.downstream_end = Follow(seed, 1.0, &down, &down_m);
  if (!closed && line.downstream_end != LineEnd::kClosed && up_m + down_m < spacing_m_)
    return false;
  line.points.assign(up.points.rbegin(), up.points.rend());
  line.times_s.assign(up.times_s.rbegin(), up.times_s.rend());
  line.speeds_m_s.assign(up.speeds_m_s.rbegin(), up.speeds_m_s.rend());
  if (down.points.size() > 1) {
    line.points.insert(line.points.end(), down.points.begin() + 1, down.points.end());
    line.times_s.insert(line.times_s.end(), down.times_s.begin() + 1, down.times_s.end());
    line.speeds_m_s.insert(line.speeds_m_s.end(), down.speeds_m_s.begin() + 1,
                           down.speeds_m_s.end());
  }
  if (line.points.size() < 2) return false;
  line.seed = lines_.size();
  line.field_reads = reads_;
  lines_.push_back(std::move(line));
  for (const LinePoints::Entry& entry : own_) points_.Add(entry);
  // The ends lie between points of the hash.
  for (const Vec3& end : {lines_.back().points.front(), lines_.back().points.back()}) {
    points_.Add({end, own_.front().line, 0.0F});
    own_directions_.push_back({});
  }
  if (progress_) progress_();
  directions_.insert(directions_.end(), own_directions_.begin(), own_directions_.end());
  return true;
}

void Placement::TrySeedsBesideLines(const Vec3& normal) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 direction = directions_[i];
    if (!(Norm(direction) > 0.0)) continue;
    const Vec3 along = Normalized(direction), point = points_[i].point;
    Vec3 side = Cross(normal, along);
    // Along the normal, any side will do.
    if (!(Norm(side) > 1e-6)) side = Cross({1.0, 0.0, 0.0}, along);
    side = Normalized(side) * spacing_m_;
    TryLine(point + side);
    TryLine(point - side);
    if (plane_) continue;
    const Vec3 other = Cross(along, side);
    TryLine(point + other);
    TryLine(point - other);
  }
}

/// Where the speed is nearest to its median; of such nodes, the one nearest to the middle.
std::optional<Vec3> FirstSeed(const LevelGrid& grid, const Box& box, FieldProbe* probe,
                              Seconds time) {
  std::vector<std::pair<double, std::size_t>> speeds;
  for (std::size_t node = 0; node < grid.nodes(); ++node) {
    Vec3 velocity;
    const Vec3 at = grid.Node(node);
    if (!IsInside(box, at) || probe->Sample(at, time, &velocity) != PointState::kFlow) continue;
    speeds.emplace_back(Norm(velocity), node);
  }
  if (speeds.empty()) return std::nullopt;
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  const double median = middle->first;
  const Vec3 centre = (box.min + box.max) * 0.5;
  std::optional<Vec3> best;
  double best_m = std::numeric_limits<double>::infinity();
  std::sort(speeds.begin(), speeds.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const auto& [speed, node] : speeds) {
    const double away_m = Norm(grid.Node(node) - centre);
    if (std::fabs(speed - median) > kFirstWithin * median || away_m >= best_m) continue;
    best = grid.Node(node);
    best_m = away_m;
  }
  return best;
}

/// The axis across a field in the plane; zero in space.
Vec3 NormalOf(const VectorField& field) {
  const auto* grid = dynamic_cast<const GridField*>(&field);
  if (grid != nullptr && grid->axes().size() == 3) return {};
  if (grid != nullptr) {
    const int across = 3 - grid->axes()[0] - grid->axes()[1];
    return across == 0 ? Vec3{1, 0, 0} : (across == 1 ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  }
  const Box box = field.bounds();
  return box.max.z > box.min.z ? Vec3{} : Vec3{0.0, 0.0, 1.0};
}

}  // namespace

Result<std::vector<FlowLine>> PlaceLines(const VectorField& field, double spacing_m,
                                         const TraceOptions& options) {
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m)) {
    return InputError("", "the spacing of lines is not positive", "give it in metres");
  }
  Box box = field.bounds();
  const Vec3 normal = NormalOf(field);
  const bool plane = Norm(normal) > 0.0;
  const auto* grid = dynamic_cast<const GridField*>(&field);
  if (plane && grid != nullptr && !grid->grid().cells.empty()) {
    box.min.z = -std::numeric_limits<double>::max();
    box.max.z = std::numeric_limits<double>::max();
  }
  LineLimits limits;
  limits.tolerance_cells = options.tolerance_cells;
  limits.length_m = LengthOf(field, options);
  limits.may_close = true;
  limits.max_step_m = kPointEvery * spacing_m;
  std::unique_ptr<LineTracer> tracer;
  FieldWindow window;
  if (grid != nullptr) {
    PLEINAIR_ASSIGN_OR_RETURN(window, grid->FrozenAt(options.frozen_at_s));
    limits.max_speed_m_s = MaxSpeed(field, window);
    tracer = MakeTracer(*grid, window, limits);
  } else {
    window.first_s = options.frozen_at_s;
    limits.max_speed_m_s = MaxSpeed(field, window);
    tracer = MakeTracer(field, options.frozen_at_s, limits);
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::unique_ptr<FieldProbe> probe,
                            MakeFrozenProbe(field, options.frozen_at_s));
  PLEINAIR_ASSIGN_OR_RETURN(LinePoints points, LinePoints::Create(field.bounds(), spacing_m));
  Placement placement(std::move(points), std::move(tracer), box, plane, spacing_m);
  placement.SetProgress(options.progress);
  const auto first = FirstSeed(LevelGrid(field), box, probe.get(), options.frozen_at_s);
  if (!first) return std::vector<FlowLine>{};
  placement.TryLine(*first);
  placement.TrySeedsBesideLines(normal);
  const auto has_flow = [&](const Vec3& at) {
    Vec3 velocity;
    return probe->Sample(at, options.frozen_at_s, &velocity) == PointState::kFlow &&
           Norm(velocity) > 0.0;
  };
  PLEINAIR_ASSIGN_OR_RETURN(PlacementHoles holes,
                            PlacementHoles::Create(field.bounds(), spacing_m, plane, has_flow));
  std::size_t known = 0;
  const auto add_points = [&] {
    for (; known < placement.points().size(); ++known) holes.Add(placement.points()[known].point);
  };
  add_points();
  while (const auto hole = holes.TakeLargest()) {
    if (!placement.TryLine(*hole)) continue;
    placement.TrySeedsBesideLines(normal);
    add_points();
  }
  return placement.TakeLines();
}

LineSpacing MeasureSpacing(const VectorField& field, Seconds frozen_s,
                           const std::vector<FlowLine>& lines, double spacing_m) {
  LineSpacing spacing;
  auto points = LinePoints::Create(field.bounds(), spacing_m);
  const auto probe = MakeFrozenProbe(field, frozen_s);
  if (!points || !probe) return spacing;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const Vec3& p : lines[i].points) points->Add({p, static_cast<std::uint32_t>(i), 0.0F});
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const Vec3& p : lines[i].points) {
      points->AnyNear(p, spacing_m, [&](const LinePoints::Entry& entry, double square) {
        if (entry.line != i) nearest = std::min(nearest, square);
        return false;
      });
    }
  }
  spacing.nearest_min_m = std::isfinite(nearest) ? std::sqrt(nearest) : 0.0;
  const LevelGrid grid(field);
  std::size_t cells = 0, covered = 0;
  for (std::size_t node = 0; node < grid.nodes(); ++node) {
    const Vec3 corner = grid.Node(node);
    const LevelGrid::Place place = grid.Find(corner);
    Vec3 half{};
    const auto half_step = [&](std::size_t a) {
      const GridAxis& axis = grid.axes()[a];
      return axis.flat() ? 0.0 : 0.5 * axis.Step(place.index[a]);
    };
    half = {half_step(0), half_step(1), half_step(2)};
    const Vec3 centre = corner + half;
    Vec3 velocity;
    if ((*probe)->Sample(centre, frozen_s, &velocity) != PointState::kFlow ||
        !(Norm(velocity) > 0.0) || !IsInside(field.bounds(), centre)) {
      continue;
    }
    ++cells;
    covered +=
        points->AnyNear(centre, spacing_m, [](const LinePoints::Entry&, double) { return true; })
            ? 1
            : 0;
  }
  spacing.covered = cells > 0 ? static_cast<double>(covered) / static_cast<double>(cells) : 0.0;
  return spacing;
}

}  // namespace pleinair::content
