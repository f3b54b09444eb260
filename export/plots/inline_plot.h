#pragma once

// Internal: shared by the plots of this folder.

#include <cstddef>
#include <string>

namespace pleinair::exports {

/// A small plot as SVG inside a page. The page's style (export/plots/page_style.h) colors it by
/// classes. Title, grid lines with values, ticks, lines and legend appear in the order of the
/// calls. Coordinates are rounded to a tenth, so that equal data give equal bytes. Texts are
/// escaped.
class InlinePlot {
 public:
  static constexpr double kWidth = 640.0, kHeight = 220.0;

  /// Space around the data, in the plot's units. It is 12 on the right and 30 on top.
  struct Margins {
    double left = 52.0, bottom = 42.0;
  };

  /// `label`: description of the plot for screen readers. `title`: text above it.
  InlinePlot(Margins margins, const std::string& label, const std::string& title);

  /// Position of a fraction 0…1 of an axis.
  double ToX(double share) const;
  double ToY(double share) const;

  /// Adds a horizontal line at a fraction of the axis, with its value on the left.
  void AddGridLine(double share, const std::string& value);

  /// Adds a text centred on `x`, `below` the data.
  void AddTick(double x, double below, const std::string& text);

  /// Adds SVG path data in the color of series `series`. `attributes` begin with a space or are
  /// empty.
  void AddPath(std::size_t series, const std::string& data, const std::string& attributes = {});

  /// Adds the name of a series, left of the previous names.
  void AddLegend(std::size_t series, const std::string& name);

  /// The finished element.
  std::string Svg() const { return svg_ + "</svg>\n"; }

 private:
  Margins margins_;
  double legend_x_;
  std::string svg_;
};

}  // namespace pleinair::exports
