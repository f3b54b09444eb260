#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>

#include "content/flow/files/component_grid.h"
#include "content/flow/files/field_source.h"
#include "content/flow/files/vtk_flow.h"
#include "content/flow/files/vtk_grid.h"

namespace pleinair::content {
namespace {

constexpr std::uintmax_t kMaxVtkBytes = std::uintmax_t{4} << 30;

/// The arrays that make velocities, and whether they belong to cells.
struct Velocities {
  std::array<const VtkArray*, 3> array{};
  std::array<int, 3> component{0, 0, 0};
  bool of_cells = false;
};

std::vector<ArrayNote> NotesOf(const VtkGrid& grid) {
  std::vector<ArrayNote> notes;
  for (const VtkArrays* data : {&grid.point_data, &grid.cell_data}) {
    for (const VtkArray& array : data->arrays) {
      notes.push_back({array.name, std::to_string(array.components) + " components, no unit"});
    }
  }
  return notes;
}

const VtkArray* Find(const VtkArrays& data, const std::string& name) {
  const auto found = std::find_if(data.arrays.begin(), data.arrays.end(),
                                  [&](const VtkArray& array) { return array.name == name; });
  return found != data.arrays.end() ? &*found : nullptr;
}

Velocities OfVectors(const VtkArray* array, bool of_cells) {
  Velocities velocities{
      {array, array, array->components > 2 ? array : nullptr}, {0, 1, 2}, of_cells};
  return velocities;
}

Result<Velocities> FindVelocities(const VtkGrid& grid, const std::string& where,
                                  const FlowFileOptions& options) {
  for (const bool of_cells : {false, true}) {
    const VtkArrays& data = of_cells ? grid.cell_data : grid.point_data;
    if (!options.u.empty()) {
      Velocities found{{Find(data, options.u), Find(data, options.v),
                        options.w.empty() ? nullptr : Find(data, options.w)},
                       {0, 0, 0},
                       of_cells};
      if (found.array[0] && found.array[1] && (options.w.empty() || found.array[2])) return found;
      continue;
    }
    const std::string name = options.vectors.empty() ? data.active_vectors : options.vectors;
    const VtkArray* array = Find(data, name);
    if (array != nullptr && array->components >= 2) return OfVectors(array, of_cells);
  }
  if (options.u.empty() && options.vectors.empty()) {
    for (const bool of_cells : {false, true}) {
      const VtkArrays& data = of_cells ? grid.cell_data : grid.point_data;
      std::vector<const VtkArray*> vectors;
      for (const VtkArray& array : data.arrays) {
        if (array.components == 2 || array.components == 3) vectors.push_back(&array);
      }
      if (vectors.size() == 1) return OfVectors(vectors.front(), of_cells);
      if (vectors.size() > 1) {
        std::string list;
        for (const VtkArray* array : vectors) list += (list.empty() ? "" : ", ") + array->name;
        return InputError(where, "has several arrays of vectors: " + list.substr(0, 400),
                          "choose one with --vectors");
      }
    }
  }
  return NoVelocities(where, NotesOf(grid));
}

/// Coordinates of the points, or of the centres of the cells, along one axis.
std::vector<double> NodesOf(const VtkGrid& grid, std::size_t a, bool of_cells) {
  std::vector<double> nodes = grid.coordinates[a];
  const std::array<double, 3> origin{grid.origin.x, grid.origin.y, grid.origin.z};
  const std::array<double, 3> spacing{grid.spacing.x, grid.spacing.y, grid.spacing.z};
  for (int i = 0; nodes.size() < static_cast<std::size_t>(grid.counts[a]); ++i) {
    nodes.push_back(origin[a] + spacing[a] * i);
  }
  if (!of_cells || nodes.size() < 2) return nodes;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) nodes[i] = 0.5 * (nodes[i] + nodes[i + 1]);
  nodes.pop_back();
  return nodes;
}

/// The points of a structured grid, or the centres of its cells.
std::vector<Vec3> PositionsOf(const VtkGrid& grid, const std::array<int, 3>& counts,
                              bool of_cells) {
  if (!of_cells) return grid.points;
  std::vector<Vec3> centres;
  const auto n0 = static_cast<std::size_t>(grid.counts[0]);
  const auto n1 = static_cast<std::size_t>(grid.counts[1]);
  for (int k = 0; k < counts[2]; ++k) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int i = 0; i < counts[0]; ++i) {
        Vec3 sum;
        int corners = 0;
        for (int n = 0; n < 8; ++n) {
          const int x = i + (n & 1), y = j + (n >> 1 & 1), z = k + (n >> 2);
          if (x >= grid.counts[0] || y >= grid.counts[1] || z >= grid.counts[2]) continue;
          sum = sum +
                grid.points[static_cast<std::size_t>(x) +
                            n0 * (static_cast<std::size_t>(y) + n1 * static_cast<std::size_t>(z))];
          ++corners;
        }
        centres.push_back(sum * (1.0 / corners));
      }
    }
  }
  return centres;
}

}  // namespace

Result<FlowFile> ParseVtkFlow(std::string_view bytes, const std::string& where,
                              const FlowFileOptions& options) {
  const bool legacy = bytes.starts_with("# vtk");
  PLEINAIR_ASSIGN_OR_RETURN(const VtkGrid grid,
                            legacy ? ParseVtkLegacy(bytes, where) : ParseVtkXml(bytes, where));
  PLEINAIR_ASSIGN_OR_RETURN(const Velocities velocities, FindVelocities(grid, where, options));
  std::array<int, 3> counts = grid.counts;
  for (int& count : counts) {
    if (velocities.of_cells && count > 1) --count;
  }
  FieldChart chart;
  if (!options.crs.empty() && options.crs != "marker") chart = FieldChart::Projected(options.crs);
  std::array<FieldAxis, 3> axes;
  const std::array<const char*, 3> names{"x", "y", "z"};
  for (std::size_t a = 0; a < 3; ++a) {
    SourceAxis axis;
    if (grid.points.empty()) {
      axis.nodes = NodesOf(grid, a, velocities.of_cells);
    } else {
      for (int i = 0; i < counts[a]; ++i) axis.nodes.push_back(i);
    }
    PLEINAIR_ASSIGN_OR_RETURN(axes[a], MakeFieldAxis(axis, 0.0, 1.0, names[a]));
  }
  CurvilinearCells cells;
  if (!grid.points.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(
        cells, CurvilinearCells::Create(counts, PositionsOf(grid, counts, velocities.of_cells)));
  }
  const std::array<std::size_t, 3> strides{
      1, static_cast<std::size_t>(counts[0]),
      static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1])};
  auto components =
      std::make_shared<ComponentGrid>(std::move(axes), strides, std::move(cells), chart);
  // The velocities, once; the file's other arrays end here.
  std::array<std::vector<double>, 3> values;
  std::array<const std::vector<double>*, 3> pointers{};
  for (std::size_t c = 0; c < 3; ++c) {
    const VtkArray* array = velocities.array[c];
    if (array == nullptr) continue;
    const auto step = static_cast<std::size_t>(array->components);
    const auto first = static_cast<std::size_t>(velocities.component[c]);
    for (std::size_t i = first; i < array->values.size(); i += step) {
      const double value = array->values[i];
      values[c].push_back(std::isfinite(value) ? value : std::nan(""));
    }
    pointers[c] = &values[c];
  }
  auto slice = std::make_shared<const FieldSlice>(
      components->Combine(pointers, velocities.array[0]->is_double));
  const auto read = [slice](std::size_t) -> Result<FieldSlice> { return *slice; };
  PLEINAIR_ASSIGN_OR_RETURN(FlowFile flow, MakeFlowFile(components, {}, read, chart, options));
  for (const VtkArray* array : velocities.array) {
    if (array != nullptr && (flow.arrays.empty() || flow.arrays.back() != array->name)) {
      flow.arrays.push_back(array->name);
    }
  }
  flow.unit = "m s-1";
  return flow;
}

Result<FlowFile> ReadVtkFlow(const std::string& path, const std::string& where,
                             const FlowFileOptions& options) {
  std::error_code error;
  if (std::filesystem::file_size(path, error) > kMaxVtkBytes) {
    return InputError(where, "has more than 4 GiB", "cut out what lies near the marker");
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  if (!stream && !stream.eof()) {
    return SystemError(where, "cannot be read", "check the permissions of the file");
  }
  return ParseVtkFlow(bytes, where, options);
}

}  // namespace pleinair::content
