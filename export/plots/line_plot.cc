#include "export/plots/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "export/plots/inline_plot.h"

namespace pleinair::exports {
namespace {

constexpr InlinePlot::Margins kMargins{.left = 64.0, .bottom = 30.0};
constexpr double kTickBelow = 18.0;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void Add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void MakeUsable() {
    if (!(low <= high)) low = high = 0.0;
    if (high - low < 1e-9 * std::max(1.0, std::abs(high))) {
      low -= 0.5;
      high += 0.5;
    }
  }
  double Share(double value) const { return (value - low) / (high - low); }
};

std::string TickLabel(double value, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
}

}  // namespace

double TickStep(double low, double high, int maximum) {
  const double raw = (high - low) / maximum;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10.0 * power;
}

std::string LinePlotSvg(const std::string& title, const std::string& y_unit,
                        const std::vector<PlotLine>& lines, const std::string& x_unit) {
  Range xs, ys;
  for (const PlotLine& line : lines) {
    for (const double x : line.x) xs.Add(x);
    for (const double y : line.y) ys.Add(y);
  }
  xs.MakeUsable();
  ys.MakeUsable();
  InlinePlot plot(kMargins, title, title + " (" + y_unit + ")");
  const double y_step = TickStep(ys.low, ys.high, 4);
  for (double y = std::ceil(ys.low / y_step) * y_step; y <= ys.high + 1e-9 * y_step; y += y_step) {
    plot.AddGridLine(ys.Share(y), TickLabel(std::abs(y) < 1e-9 * y_step ? 0.0 : y, y_step));
  }
  const double x_step = TickStep(xs.low, xs.high, 8);
  for (double x = std::ceil(xs.low / x_step) * x_step; x <= xs.high + 1e-9 * x_step; x += x_step) {
    plot.AddTick(plot.ToX(xs.Share(x)), kTickBelow, TickLabel(x, x_step) + " " + x_unit);
  }
  for (std::size_t i = lines.size(); i-- > 0;) {
    const PlotLine& line = lines[i];
    std::string path;
    bool pen_down = false;
    for (std::size_t k = 0; k < line.x.size(); ++k) {
      if (!std::isfinite(line.y[k])) {
        pen_down = false;
        continue;
      }
      path += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", plot.ToX(xs.Share(line.x[k])),
                          plot.ToY(ys.Share(line.y[k])));
      pen_down = true;
    }
    plot.AddPath(i, path);
    if (!line.name.empty()) plot.AddLegend(i, line.name);
  }
  return plot.Svg();
}

}  // namespace pleinair::exports
