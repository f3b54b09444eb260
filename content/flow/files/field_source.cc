#include "content/flow/files/field_source.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pleinair::content {
namespace {

constexpr double kTurn_deg = 360.0;
constexpr double kCloseWithin = 1e-3;  // Of a step: how exactly longitudes go round.

std::vector<double> Unwrapped(const SourceAxis& axis) {
  std::vector<double> nodes = axis.nodes;
  for (std::size_t i = 1; axis.longitude && i < nodes.size(); ++i) {
    nodes[i] -= kTurn_deg * std::round((nodes[i] - nodes[i - 1]) / kTurn_deg);
  }
  return nodes;
}

/// `text` with the first `from` that stands as a word between underscores replaced.
std::optional<std::string> WithWord(const std::string& text, const std::string& from,
                                    const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + 1)) {
    const bool begins = at == 0 || text[at - 1] == '_';
    const std::size_t end = at + from.size();
    const bool ends = end == text.size() || text[end] == '_';
    if (begins && ends) return text.substr(0, at) + to + text.substr(end);
  }
  return std::nullopt;
}

bool IsMotion(const std::string& name) {
  return name.find("wind") != std::string::npos || name.find("velocity") != std::string::npos ||
         name.find("current") != std::string::npos;
}

}  // namespace

Result<FieldAxis> MakeFieldAxis(const SourceAxis& axis, double offset, double scale,
                                const std::string& name) {
  std::vector<double> nodes = Unwrapped(axis);
  const bool finite =
      std::all_of(nodes.begin(), nodes.end(), [](double node) { return std::isfinite(node); });
  if (nodes.empty() || !finite) {
    return InputError("", "coordinate \"" + name + "\" has values that are not finite",
                      "repair the coordinates of the file");
  }
  FieldAxis made;
  made.source.resize(nodes.size());
  std::iota(made.source.begin(), made.source.end(), 0);
  if (nodes.size() > 1 && nodes.back() < nodes.front()) {
    std::reverse(nodes.begin(), nodes.end());
    std::reverse(made.source.begin(), made.source.end());
  }
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (nodes[i] > nodes[i - 1]) continue;
    return InputError("", "coordinate \"" + name + "\" neither ascends nor descends",
                      "sort the file along it");
  }
  if (axis.longitude && nodes.size() > 2) {
    const double step = (nodes.back() - nodes.front()) / static_cast<double>(nodes.size() - 1);
    const double around = nodes.back() - nodes.front();
    // A file may repeat its first meridian at the end.
    const bool repeats = std::fabs(around - kTurn_deg) < kCloseWithin * step;
    if (repeats) made.source.pop_back();
    if (repeats || std::fabs(around + step - kTurn_deg) < kCloseWithin * step) {
      const int count = static_cast<int>(made.source.size());
      made.axis =
          GridAxis::Closed((nodes.front() - offset) * scale, kTurn_deg / count * scale, count);
      std::vector<int> source;
      for (int i = -GridAxis::kNodesBefore; i < count + GridAxis::kNodesAfter; ++i) {
        source.push_back(made.source[static_cast<std::size_t>((i + count) % count)]);
      }
      made.source = std::move(source);
      return made;
    }
  }
  for (double& node : nodes) node = (node - offset) * scale;
  made.axis = GridAxis(std::move(nodes));
  return made;
}

double MiddleOf(const SourceAxis& axis) {
  const std::vector<double> nodes = Unwrapped(axis);
  return nodes.empty() ? 0.0 : 0.5 * (nodes.front() + nodes.back());
}

double HalfWidthOf(const SourceAxis& axis) {
  const std::vector<double> nodes = Unwrapped(axis);
  return nodes.empty() ? 0.0 : 0.5 * std::fabs(nodes.back() - nodes.front());
}

tl::unexpected<Error> NoVelocities(const std::string& where, const std::vector<ArrayNote>& arrays) {
  std::string list;
  for (const ArrayNote& array : arrays) {
    if (list.size() > 600) {
      list += ", ...";
      break;
    }
    list += (list.empty() ? "" : ", ") + array.name.substr(0, 60) + " [" +
            array.unit.substr(0, 30) + "]";
  }
  return InputError(
      where,
      "has no velocities that their names state; its arrays are: " +
          (list.empty() ? std::string("none") : list),
      "name the components with --u and --v, or vectors of a VTK file with --vectors");
}

bool IsTrueEast(const std::string& standard_name) {
  return standard_name.find("eastward") != std::string::npos &&
         standard_name.find("grid_eastward") == std::string::npos;
}

std::optional<std::string> NorthPartner(const std::string& standard_name) {
  if (!IsMotion(standard_name)) return std::nullopt;
  if (auto partner = WithWord(standard_name, "eastward", "northward")) return partner;
  return WithWord(standard_name, "x", "y");
}

std::optional<std::string> UpPartner(const std::string& standard_name) {
  if (standard_name.find("wind") != std::string::npos) return "upward_air_velocity";
  if (standard_name.find("sea_water") != std::string::npos) return "upward_sea_water_velocity";
  return std::nullopt;
}

}  // namespace pleinair::content
