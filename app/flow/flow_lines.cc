#include "app/flow/flow_lines.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "app/flow/flow_seeds.h"
#include "app/flow/level_lines.h"
#include "app/options/located_error.h"
#include "app/place/marker_place.h"
#include "app/place/transform_warnings.h"
#include "app/terminal/progress_bar.h"
#include "files/csv.h"

namespace pleinair::app {
namespace {

using content::FlowFile;
using content::FlowLine;
using content::Seconds;
using content::Seed;

constexpr double kUsualSpacings = 40.0;  // Across the domain, where no seeds are given.
constexpr std::size_t kMaxWarnedSeeds = 5;
constexpr std::size_t kMaxFlowVertices = 20'000'000;

class Stopwatch {
 public:
  double Milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
        .count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Seconds after the first time of the file.
Result<Seconds> StartTime(const FlowArguments& arguments, const FlowFile& flow) {
  if (arguments.time.empty()) return 0.0;
  Seconds seconds = 0.0;
  if (const auto number = files::ParseNumber(arguments.time)) {
    seconds = *number;
  } else {
    const auto moment = UtcTime::Parse(arguments.time);
    if (!moment) return LocatedError(moment.error(), "--time");
    if (!flow.first_time) {
      return InputError("--time", arguments.file + " states no moments",
                        "give seconds after its first time");
    }
    seconds = static_cast<double>(moment->nanoseconds_since_1970() -
                                  flow.first_time->nanoseconds_since_1970()) *
              1e-9;
  }
  const auto times = flow.field->times();
  const Seconds last = times.empty() ? 0.0 : times.back();
  if (seconds < 0.0 || seconds > last) {
    std::string range = fmt::format("0 to {:g} seconds", last);
    if (flow.first_time) {
      range = flow.first_time->ToString() + " to " + flow.first_time->PlusSeconds(last).ToString();
    }
    return InputError(
        "--time",
        "\"" + arguments.time.substr(0, 60) + "\" is outside the times of " + arguments.file,
        "they are " + range);
  }
  return seconds;
}

/// Options that exclude each other.
Result<void> CheckFlowOptions(const FlowArguments& arguments) {
  if (!arguments.seeds.empty() && arguments.spacing_m > 0.0) {
    return InputError("--spacing", "lines are placed without seeds", "leave out --seeds or this");
  }
  const bool streams = arguments.trace.kind == content::LineKind::kStream;
  if (arguments.seeds.empty() && !streams) {
    return InputError("--lines", "pathlines and streaklines need seeds", "give --seeds");
  }
  if (arguments.steps > 0 && !(arguments.trace.step_s > 0.0)) {
    return InputError("--steps", "needs the duration of a step", "give --step, seconds");
  }
  if (arguments.method == FlowMethod::kRk45) return {};
  if (!streams || arguments.seeds.empty()) {
    return InputError("--method", "levels give streamlines of seeds",
                      "give --seeds and --lines stream, or --method rk45");
  }
  if (arguments.steps < 1 || !std::has_single_bit(static_cast<unsigned>(arguments.steps))) {
    return InputError("--steps", "levels need a number of steps that is a power of two",
                      "give --steps 64, for example, and --step");
  }
  return {};
}

/// Warns of seeds without flow. Error (input): all of them.
Result<void> CheckSeeds(const FlowArguments& arguments, const FlowFile& flow,
                        const std::vector<Seed>& seeds, std::vector<std::string>* warnings) {
  std::vector<std::size_t> outside;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Seconds time = arguments.trace.kind == content::LineKind::kStream
                             ? arguments.trace.frozen_at_s
                             : seeds[i].time;
    if (std::isnan(flow.field->At(seeds[i].point, time).x)) outside.push_back(i);
  }
  if (outside.size() == seeds.size()) {
    const content::Box box = flow.field->bounds();
    const Vec3 low = flow.chart.ToFile(box.min), high = flow.chart.ToFile(box.max);
    return InputError(arguments.seeds, "all seeds lie outside the flow of " + arguments.file,
                      fmt::format("it extends from {:.10g}, {:.10g} to {:.10g}, {:.10g}", low.x,
                                  low.y, high.x, high.y));
  }
  for (std::size_t i = 0; i < std::min(outside.size(), kMaxWarnedSeeds); ++i) {
    warnings->push_back(
        fmt::format("{}: seed {} lies outside the flow", arguments.seeds, outside[i]));
  }
  if (outside.size() > kMaxWarnedSeeds) {
    warnings->push_back(
        fmt::format("{}: {} seeds lie outside the flow", arguments.seeds, outside.size()));
  }
  return {};
}

Result<content::OutputFrame> FrameOf(const FlowArguments& arguments, const FlowFile& flow) {
  const content::Box box = flow.field->bounds();
  if (arguments.scene.empty()) {
    return content::OutputFrame::OfFile(flow.chart, (box.min + box.max) * 0.5, flow.half_width_deg,
                                        arguments.file);
  }
  MarkerPlaceArguments place;
  place.scene = arguments.scene;
  PLEINAIR_ASSIGN_OR_RETURN(const MarkerPlace marker, ReadMarkerPlace(place, "flow"));
  return content::OutputFrame::OfMarker(flow.chart, arguments.read.crs, marker.place,
                                        marker.marker_from_world.value_or(Mat3{}), flow.has_heights,
                                        arguments.file);
}

/// Fills the points of the output.
Result<void> PlacePoints(const content::OutputFrame& frame, const std::string& file,
                         FlowLines* result) {
  for (const FlowLine& line : result->lines) {
    std::vector<Vec3> points, geographic;
    points.reserve(line.points.size());
    for (const Vec3& point : line.points) {
      const auto placed = frame.FromField(point);
      if (!placed) {
        return InputError(file, "a line leaves the area where its map projection is defined",
                          "check the coordinate reference system");
      }
      points.push_back(*placed);
      if (const auto geodetic = frame.Geodetic(point)) {
        geographic.push_back({geodetic->longitude_deg, geodetic->latitude_deg, geodetic->height_m});
      }
    }
    if (geographic.size() != points.size()) geographic.clear();
    result->points.push_back(std::move(points));
    result->geographic.push_back(std::move(geographic));
  }
  return {};
}

Result<void> Integrate(const FlowArguments& arguments, const content::TraceOptions& trace,
                       const FlowFile& flow, FlowLines* result) {
  const Stopwatch watch;
  double levels_ms = 0.0;
  if (arguments.seeds.empty()) {
    const content::Box box = flow.field->bounds();
    const Vec3 size = box.max - box.min;
    const double spacing_m = arguments.spacing_m > 0.0
                                 ? arguments.spacing_m
                                 : std::max({size.x, size.y, size.z}) / kUsualSpacings;
    ProgressBar bar("lines", std::nullopt, "lines");
    content::TraceOptions with_bar = trace;
    with_bar.progress = [&bar] { bar.Advance(); };
    auto lines = content::PlaceLines(*flow.field, spacing_m, with_bar);
    if (!lines) return LocatedError(lines.error(), "--spacing");
    result->lines = std::move(*lines);
    result->spacing =
        content::MeasureSpacing(*flow.field, trace.frozen_at_s, result->lines, spacing_m);
  } else {
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<Seed> seeds,
                              ReadSeeds(arguments.seeds, flow, trace.frozen_at_s));
    PLEINAIR_RETURN_IF_ERROR(CheckSeeds(arguments, flow, seeds, &result->warnings));
    ProgressBar bar("lines", static_cast<std::int64_t>(seeds.size()), "seeds");
    content::TraceOptions with_bar = trace;
    with_bar.progress = [&bar] { bar.Advance(); };
    if (arguments.method == FlowMethod::kRk45) {
      PLEINAIR_ASSIGN_OR_RETURN(result->lines, content::TraceLines(*flow.field, seeds, with_bar));
    } else {
      PLEINAIR_ASSIGN_OR_RETURN(LevelLines levels,
                                FollowLevels(*flow.field, seeds, with_bar, arguments.steps,
                                             arguments.method == FlowMethod::kHierarchicalNearest));
      result->lines = std::move(levels.lines);
      result->field_reads = levels.field_reads;
      result->levels = levels.levels;
      levels_ms = levels.build_ms;
    }
  }
  for (const FlowLine& line : result->lines) result->field_reads += line.field_reads;
  result->milliseconds[1] = levels_ms;
  result->milliseconds[2] = watch.Milliseconds() - levels_ms;
  return {};
}

}  // namespace

std::size_t FlowLines::Vertices() const {
  std::size_t vertices = 0;
  for (const FlowLine& line : lines) vertices += line.points.size();
  return vertices;
}

Result<FlowLines> MakeFlowLines(const FlowArguments& arguments) {
  PLEINAIR_RETURN_IF_ERROR(CheckFlowOptions(arguments));
  FlowLines result;
  const Stopwatch watch;
  PLEINAIR_ASSIGN_OR_RETURN(const FlowFile flow,
                            content::ReadFlowFile(arguments.file, arguments.read));
  result.milliseconds[0] = watch.Milliseconds();
  for (const std::string& warning : flow.warnings) {
    result.warnings.push_back(arguments.file + ": " + warning);
  }
  result.has_heights = flow.has_heights;
  const auto times = flow.field->times();
  if (!times.empty()) result.time_range_s = {times.front(), times.back()};
  PLEINAIR_ASSIGN_OR_RETURN(const content::OutputFrame frame, FrameOf(arguments, flow));
  if (frame.facts()) {
    for (const std::string& warning : TransformWarnings(*frame.facts())) {
      result.warnings.push_back(arguments.file + ": " + warning);
    }
  }
  content::TraceOptions trace = arguments.trace;
  PLEINAIR_ASSIGN_OR_RETURN(trace.frozen_at_s, StartTime(arguments, flow));
  if (arguments.steps > 0) {
    trace.duration_s = std::min(trace.duration_s, arguments.steps * trace.step_s);
  }
  FlowArguments at_time = arguments;
  at_time.trace = trace;
  PLEINAIR_RETURN_IF_ERROR(Integrate(at_time, trace, flow, &result));
  if (result.Vertices() > kMaxFlowVertices) {
    return InputError(arguments.file, "gives more than 20 million vertices",
                      "use fewer seeds, a larger spacing or a shorter length");
  }
  PLEINAIR_RETURN_IF_ERROR(PlacePoints(frame, arguments.file, &result));
  return result;
}

}  // namespace pleinair::app
