#include "export/plots/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/markup_escape.h"

namespace pleinair::exports {
namespace {

constexpr double kWidth = 640, kHeight = 220;
constexpr double kLeft = 64, kRight = 12, kTop = 30, kBottom = 30;

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
  const auto to_x = [&](double x) { return kLeft + xs.Share(x) * (kWidth - kLeft - kRight); };
  const auto to_y = [&](double y) {
    return kHeight - kBottom - ys.Share(y) * (kHeight - kTop - kBottom);
  };
  std::string svg = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">"
      "<text class=\"title\" x=\"{:.0f}\" y=\"16\">{} ({})</text>",
      kWidth, kHeight, files::EscapeMarkup(title), kLeft, files::EscapeMarkup(title),
      files::EscapeMarkup(y_unit));
  const double y_step = TickStep(ys.low, ys.high, 4);
  for (double y = std::ceil(ys.low / y_step) * y_step; y <= ys.high + 1e-9 * y_step; y += y_step) {
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>"
        "<text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
        kLeft, kWidth - kRight, to_y(y), to_y(y), kLeft - 6, to_y(y) + 4,
        TickLabel(std::abs(y) < 1e-9 * y_step ? 0.0 : y, y_step));
  }
  const double x_step = TickStep(xs.low, xs.high, 8);
  for (double x = std::ceil(xs.low / x_step) * x_step; x <= xs.high + 1e-9 * x_step; x += x_step) {
    svg += fmt::format(
        "<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{} {}</text>",
        to_x(x), kHeight - kBottom + 18, TickLabel(x, x_step), files::EscapeMarkup(x_unit));
  }
  double legend_x = kWidth - kRight;
  for (std::size_t i = lines.size(); i-- > 0;) {
    const PlotLine& line = lines[i];
    std::string path;
    bool pen_down = false;
    for (std::size_t k = 0; k < line.x.size(); ++k) {
      if (!std::isfinite(line.y[k])) {
        pen_down = false;
        continue;
      }
      path +=
          fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", to_x(line.x[k]), to_y(line.y[k]));
      pen_down = true;
    }
    svg += fmt::format("<path class=\"line{}\" d=\"{}\"/>", i, path);
    if (line.name.empty()) continue;
    svg +=
        fmt::format("<text class=\"legend{}\" text-anchor=\"end\" x=\"{:.0f}\" y=\"16\">{}</text>",
                    i, legend_x, files::EscapeMarkup(line.name));
    legend_x -= 16.0 + 7.0 * static_cast<double>(line.name.size());
  }
  return svg + "</svg>\n";
}

}  // namespace pleinair::exports
