#include "app/flow/flow_files.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "app/flow/flow_glb.h"
#include "app/flow/flow_plan.h"
#include "base/atomic_file.h"

namespace pleinair::app {
namespace {

std::string EndingOf(const std::string& file) {
  return std::filesystem::path(file).extension().string();
}

/// A VTK array as text.
template <typename ValueAt>
std::string VtpArray(const char* type, const std::string& attributes, std::size_t count,
                     const ValueAt& value_at) {
  std::string text = fmt::format("<DataArray type=\"{}\" {} format=\"ascii\">\n", type, attributes);
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < count; ++i) fmt::format_to(out, "{}\n", value_at(i));
  return text + "</DataArray>\n";
}

}  // namespace

const char* NameOf(content::LineEnd end) {
  using content::LineEnd;
  switch (end) {
    case LineEnd::kLeft:
      return "left";
    case LineEnd::kStagnated:
      return "stagnated";
    case LineEnd::kLength:
      return "length";
    case LineEnd::kClosed:
      return "closed";
    case LineEnd::kWall:
      return "wall";
    case LineEnd::kDuration:
      return "duration";
    case LineEnd::kNeighbor:
      return "neighbor";
  }
  return "";
}

std::string FlowCsv(const FlowLines& lines) {
  std::string text = "line,vertex,t_s,x,y,z,speed_m_s\n";
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < lines.lines.size(); ++i) {
    const content::FlowLine& line = lines.lines[i];
    for (std::size_t n = 0; n < line.points.size(); ++n) {
      const Vec3& p = lines.points[i][n];
      fmt::format_to(out, "{},{},{:.15g},{:.15g},{:.15g},{:.15g},{:.10g}\n", line.seed, n,
                     line.times_s[n], p.x, p.y, p.z, line.speeds_m_s[n]);
    }
  }
  return text;
}

std::string FlowVtp(const FlowLines& lines) {
  std::vector<Vec3> points;
  std::vector<double> times, speeds;
  std::vector<std::size_t> offsets;
  for (std::size_t i = 0; i < lines.lines.size(); ++i) {
    const content::FlowLine& line = lines.lines[i];
    points.insert(points.end(), lines.points[i].begin(), lines.points[i].end());
    times.insert(times.end(), line.times_s.begin(), line.times_s.end());
    speeds.insert(speeds.end(), line.speeds_m_s.begin(), line.speeds_m_s.end());
    offsets.push_back(points.size());
  }
  const auto array = [](const std::string& name) { return "Name=\"" + name + "\""; };
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n" +
         fmt::format(
             "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" "
             "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
             points.size(), offsets.size()) +
         "<PointData Scalars=\"speed_m_s\">\n" +
         VtpArray("Float64", array("t_s"), times.size(), [&](std::size_t i) { return times[i]; }) +
         VtpArray("Float64", array("speed_m_s"), speeds.size(),
                  [&](std::size_t i) { return speeds[i]; }) +
         "</PointData>\n<CellData>\n" +
         VtpArray("Int64", array("line"), offsets.size(),
                  [&](std::size_t i) { return lines.lines[i].seed; }) +
         "</CellData>\n<Points>\n" +
         VtpArray("Float64", "NumberOfComponents=\"3\"", points.size(),
                  [&](std::size_t i) {
                    return fmt::format("{} {} {}", points[i].x, points[i].y, points[i].z);
                  }) +
         "</Points>\n<Lines>\n" +
         VtpArray("Int64", array("connectivity"), points.size(), [](std::size_t i) { return i; }) +
         VtpArray("Int64", array("offsets"), offsets.size(),
                  [&](std::size_t i) { return offsets[i]; }) +
         "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string FlowGeoJson(const FlowLines& lines) {
  using nlohmann::ordered_json;
  ordered_json features = ordered_json::array();
  for (std::size_t i = 0; i < lines.lines.size(); ++i) {
    const content::FlowLine& line = lines.lines[i];
    const bool on_earth = !lines.geographic[i].empty();
    ordered_json coordinates = ordered_json::array();
    for (const Vec3& p : on_earth ? lines.geographic[i] : lines.points[i]) {
      ordered_json place = {p.x, p.y};
      if (lines.has_heights) place.push_back(p.z);
      coordinates.push_back(std::move(place));
    }
    double sum = 0.0;
    for (const double speed : line.speeds_m_s) sum += speed;
    ordered_json properties = {
        {"line", line.seed},
        {"mean_speed_m_s", sum / static_cast<double>(line.speeds_m_s.size())},
        {"duration_s", line.times_s.back() - line.times_s.front()}};
    if (line.upstream_end) properties["upstream_end"] = NameOf(*line.upstream_end);
    if (line.downstream_end) properties["downstream_end"] = NameOf(*line.downstream_end);
    features.push_back({{"type", "Feature"},
                        {"properties", std::move(properties)},
                        {"geometry", {{"type", "LineString"}, {"coordinates", coordinates}}}});
  }
  return ordered_json{{"type", "FeatureCollection"}, {"features", std::move(features)}}.dump() +
         "\n";
}

std::string FlowObj(const FlowLines& lines) {
  std::string text = "# Lines of a flow, metres.\n";
  auto out = std::back_inserter(text);
  std::size_t number = 0;
  for (const std::vector<Vec3>& points : lines.points) {
    for (const Vec3& p : points) fmt::format_to(out, "v {:.10g} {:.10g} {:.10g}\n", p.x, p.y, p.z);
    text += 'l';
    for (std::size_t i = 0; i < points.size(); ++i) fmt::format_to(out, " {}", ++number);
    text += '\n';
  }
  return text;
}

Result<void> CheckFlowEnding(const std::string& file) {
  const std::string ending = EndingOf(file);
  for (const char* known : {".csv", ".vtp", ".geojson", ".glb", ".obj", ".svg"}) {
    if (ending == known) return {};
  }
  return InputError(file, "has an ending that is not known",
                    "name a file that ends in .csv, .vtp, .geojson, .glb, .obj or .svg");
}

Result<void> WriteFlowFile(const FlowLines& lines, const std::string& file) {
  const std::string ending = EndingOf(file);
  if (ending == ".csv") return WriteFileAtomically(file, FlowCsv(lines));
  if (ending == ".vtp") return WriteFileAtomically(file, FlowVtp(lines));
  if (ending == ".geojson") return WriteFileAtomically(file, FlowGeoJson(lines));
  if (ending == ".glb") return WriteFileAtomically(file, FlowGlb(lines));
  if (ending == ".svg") return WriteFileAtomically(file, FlowPlan(lines));
  return WriteFileAtomically(file, FlowObj(lines));
}

}  // namespace pleinair::app
