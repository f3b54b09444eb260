#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/flow/flow_arguments.h"
#include "base/error.h"
#include "content/flow/even_placement.h"
#include "content/flow/files/flow_file.h"
#include "content/flow/flow_line.h"

namespace pleinair::app {

/// The lines of `pleinair flow` with what its report states.
struct FlowLines {
  std::vector<content::FlowLine> lines;       ///< In the metres of the field.
  std::vector<std::vector<Vec3>> points;      ///< In the coordinates of the output, by line.
  std::vector<std::vector<Vec3>> geographic;  ///< Longitude, latitude, height; empty: no place.
  bool has_heights = false;
  std::uint64_t field_reads = 0;
  int levels = 0;
  std::optional<content::LineSpacing> spacing;
  std::array<content::Seconds, 2> time_range_s{};
  std::array<double, 3> milliseconds{};  ///< Reading, levels, integration.
  std::vector<std::string> warnings;

  std::size_t Vertices() const;
};

/// Reads a file of velocities and follows its lines. Errors (input): those of ReadFlowFile() and
/// ReadSeeds(); all seeds outside; a time that the file does not have; options that exclude each
/// other.
Result<FlowLines> MakeFlowLines(const FlowArguments& arguments);

}  // namespace pleinair::app
