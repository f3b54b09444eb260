#pragma once

#include <string>
#include <vector>

namespace pleinair::exports {

/// A series of a chart over levels; NaN leaves a gap.
struct LevelSeries {
  std::string name;
  std::vector<double> values;
  std::vector<double> low, high;  ///< Of intervals; empty: none.
};

/// A chart over levels that stand at equal steps, whatever their numbers: points joined by lines,
/// with intervals as whiskers. `top`: the largest value of the axis; 0: as the data ask for.
std::string LevelChartSvg(const std::string& title, const std::string& level_name,
                          const std::vector<std::string>& levels,
                          const std::vector<LevelSeries>& series, double top);

/// Cells of a picture coloured by a value 0…`top`; NaN stays empty.
std::string CellMapSvg(const std::string& title, int columns, int rows,
                       const std::vector<double>& values, double top);

/// Shares of values in equal steps from 0 to `top`, the last one open.
std::string HistogramSvg(const std::string& title, const std::string& unit,
                         const std::vector<std::string>& names,
                         const std::vector<std::vector<double>>& values, double top);

}  // namespace pleinair::exports
