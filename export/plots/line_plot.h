#pragma once

#include <string>
#include <vector>

namespace pleinair::exports {

/// One line of a plot; missing points (NaN) leave a gap.
struct PlotLine {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};

/// A small plot as inline SVG, coloured by the page's style (classes line0…, axis, grid).
/// Coordinates are rounded, so equal data give equal bytes.
std::string LinePlotSvg(const std::string& title, const std::string& y_unit,
                        const std::vector<PlotLine>& lines, const std::string& x_unit = "s");

/// Steps of 1, 2 or 5 times a power of ten that cut `low`…`high` into at most `most` parts.
double TickStep(double low, double high, int maximum);

}  // namespace pleinair::exports
