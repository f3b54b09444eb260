#pragma once

// Internal: follows one line through one window of a field.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "content/flow/flow_line.h"
#include "content/flow/grid_field.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// What ends a line, besides the field itself.
struct LineLimits {
  double tolerance_cells = 1e-3;
  double length_m = 0.0;
  double max_speed_m_s = 0.0;  ///< The field's; a millionth of it counts as standing.
  bool may_close = false;      ///< Streamlines.
  bool steady = true;          ///< Where nothing moves, nothing ever will.
  double max_step_m = 0.0;     ///< 0: half a cell alone.
  double step_s = 0.0;         ///< Vertices at its multiples; 0: at the steps of the integration.
};

/// A line that is being followed.
struct LineState {
  Vec3 point, velocity;
  Seconds time = 0.0;     ///< Of the particle.
  Seconds begin_s = 0.0;  ///< Of its start.
  double step_s = 0.0;    ///< That the next step tries, not negative.
  double length_m = 0.0;
  Vec3 start, start_velocity;
  int slow_steps = 0;
  bool departed = false;  ///< It has been away from its start.
  std::uint64_t field_reads = 0;
  std::uint64_t recorded = 0;  ///< Vertices at multiples of LineLimits::step_s.
};

/// The vertices of a line, appended.
struct LineVertices {
  std::vector<Vec3> points;
  std::vector<Seconds> times_s;
  std::vector<double> speeds_m_s;

  void Clear();
  void Add(const Vec3& point, Seconds time, double speed_m_s);
};

/// Called after each step with its end and the length so far; true ends the line.
using StopAt = std::function<bool(const Vec3& point, double length_m)>;

/// Integrates by Dormand and Prince's method. A step is at most half a cell along each axis, so
/// that no cell is skipped. One for each thread.
class LineTracer {
 public:
  virtual ~LineTracer() = default;

  /// Starts a line and records its first vertex. Returns false where there is no flow.
  virtual bool Begin(const Seed& seed, LineState* line, LineVertices* vertices) = 0;
  /// Follows a line until `stop_s`, downstream if that is later than its time, else upstream.
  /// Unset: it got there.
  virtual std::optional<LineEnd> Advance(LineState* line, Seconds stop_s, const StopAt* stop,
                                         LineVertices* vertices) = 0;
  virtual std::unique_ptr<LineTracer> Copy() const = 0;
};

std::unique_ptr<LineTracer> MakeTracer(const GridField& field, const FieldWindow& window,
                                       const LineLimits& limits);
/// Fields that are no grid. `frozen_s`: the time of a steady state; unset: the line's own.
std::unique_ptr<LineTracer> MakeTracer(const VectorField& field, std::optional<Seconds> frozen_s,
                                       const LineLimits& limits);

/// The largest true speed of the nodes of a window, or of a lattice of any field. It is 0 where
/// nothing flows.
double MaxSpeed(const VectorField& field, const FieldWindow& window);

}  // namespace pleinair::content
