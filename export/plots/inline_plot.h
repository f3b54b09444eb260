#pragma once

// Internal: what the plots of this folder have in common.

#include <cstddef>
#include <string>

namespace pleinair::exports {

/// A small plot as SVG inside a page, whose style (export/plots/page_style.h) colors it by classes:
/// title, grid lines with their values, ticks, lines and a legend, in the order of the calls.
/// Coordinates are rounded to a tenth, so equal data give equal bytes. Texts are escaped.
class InlinePlot {
 public:
  static constexpr double kWidth = 640.0, kHeight = 220.0;

  /// Units of the plot beside its data; 12 right of them and 30 above.
  struct Margins {
    double left = 52.0, bottom = 42.0;
  };

  /// `label` describes the plot to who cannot see it; `title` stands above it.
  InlinePlot(Margins margins, const std::string& label, const std::string& title);

  /// Where a share 0…1 of an axis lies.
  double ToX(double share) const;
  double ToY(double share) const;

  /// A horizontal line at a share of the axis, with its value on the left.
  void AddGridLine(double share, const std::string& value);

  /// A text centred on `x`, `below` the data.
  void AddTick(double x, double below, const std::string& text);

  /// SVG path data in the color of series `series`; `attributes` begin with a space or are empty.
  void AddPath(std::size_t series, const std::string& data, const std::string& attributes = {});

  /// The name of a series, left of those before.
  void AddLegend(std::size_t series, const std::string& name);

  /// The finished element.
  std::string Svg() const { return svg_ + "</svg>\n"; }

 private:
  Margins margins_;
  double legend_x_;
  std::string svg_;
};

}  // namespace pleinair::exports
