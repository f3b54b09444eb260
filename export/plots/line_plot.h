#pragma once

#include <string>
#include <vector>

namespace pleinair::exports {

/// One line of a plot; NaN creates a gap.
struct PlotLine {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};

/// A small plot as inline SVG, colored by the page's style (classes line0…, axis, grid).
/// Coordinates are rounded, so that equal data give equal bytes.
std::string LinePlotSvg(const std::string& title, const std::string& y_unit,
                        const std::vector<PlotLine>& lines, const std::string& x_unit = "s");

/// Step of 1, 2 or 5 times a power of ten that divides `low`…`high` into at most `maximum` parts.
double TickStep(double low, double high, int maximum);

}  // namespace pleinair::exports
