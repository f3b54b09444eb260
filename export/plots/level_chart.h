#pragma once

#include <string>
#include <vector>

namespace pleinair::exports {

/// A series of a chart over levels; NaN creates a gap.
struct LevelSeries {
  std::string name;
  std::vector<double> values;
  std::vector<double> low, high;  ///< Interval bounds; empty: none.
};

/// A chart over equidistant levels, whatever their values: points connected by lines, with
/// intervals as whiskers. `top`: maximum of the axis; 0: fits the data.
std::string LevelChartSvg(const std::string& title, const std::string& level_name,
                          const std::vector<std::string>& levels,
                          const std::vector<LevelSeries>& series, double top);

/// An image of cells colored by a value 0…`top`; NaN remains empty.
std::string CellMapSvg(const std::string& title, int columns, int rows,
                       const std::vector<double>& values, double top);

/// A histogram of shares with equal bins from 0 to `top`; the last bin is open.
std::string HistogramSvg(const std::string& title, const std::string& unit,
                         const std::vector<std::string>& names,
                         const std::vector<std::vector<double>>& values, double top);

}  // namespace pleinair::exports
