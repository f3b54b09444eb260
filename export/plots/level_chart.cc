#include "export/plots/level_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "export/plots/inline_plot.h"
#include "export/plots/line_plot.h"
#include "files/markup_escape.h"

namespace pleinair::exports {
namespace {

constexpr InlinePlot::Margins kMargins{.left = 52.0, .bottom = 42.0};
constexpr double kTickBelow = 16.0, kNameBelow = 34.0;

/// Horizontal lines with their values.
void AddGrid(double top, InlinePlot* plot) {
  const double step = TickStep(0.0, top, 4);
  for (int line = 0; line * step <= top * (1 + 1e-9); ++line) {
    const double y = line * step;
    plot->AddGridLine(y / top, fmt::format("{:.4g}", y));
  }
}

double LargestOf(const std::vector<LevelSeries>& series) {
  double largest = 0.0;
  for (const LevelSeries& one : series) {
    for (const double value : one.values) {
      if (std::isfinite(value)) largest = std::max(largest, value);
    }
  }
  return largest > 0.0 ? largest * 1.05 : 1.0;
}

}  // namespace

std::string LevelChartSvg(const std::string& title, const std::string& level_name,
                          const std::vector<std::string>& levels,
                          const std::vector<LevelSeries>& series, double top) {
  if (top <= 0.0) top = LargestOf(series);
  InlinePlot plot(kMargins, title, title);
  AddGrid(top, &plot);
  const auto to_x = [&](std::size_t level) {
    return plot.ToX((static_cast<double>(level) + 0.5) / static_cast<double>(levels.size()));
  };
  for (std::size_t i = 0; i < levels.size(); ++i) plot.AddTick(to_x(i), kTickBelow, levels[i]);
  plot.AddTick(plot.ToX(0.5), kNameBelow, level_name);
  for (std::size_t s = 0; s < series.size(); ++s) {
    const LevelSeries& one = series[s];
    // Places the whiskers of several series side by side.
    const double aside = 4.0 * (static_cast<double>(s) - 0.5 * (series.size() - 1.0));
    std::string path, whiskers;
    bool pen_down = false;
    for (std::size_t i = 0; i < one.values.size(); ++i) {
      if (!std::isfinite(one.values[i])) {
        pen_down = false;
        continue;
      }
      const double x = to_x(i) + aside, y = plot.ToY(std::min(1.0, one.values[i] / top));
      path += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", x, y);
      pen_down = true;
      whiskers += fmt::format("M{:.1f} {:.1f}h3", x - 1.5, y);
      if (one.low.empty() || !std::isfinite(one.low[i])) continue;
      whiskers += fmt::format("M{:.1f} {:.1f}V{:.1f}", x, plot.ToY(std::min(1.0, one.low[i] / top)),
                              plot.ToY(std::min(1.0, one.high[i] / top)));
    }
    plot.AddPath(s, path);
    plot.AddPath(s, whiskers, " stroke-opacity=\".55\"");
  }
  for (std::size_t s = series.size(); s-- > 0;) plot.AddLegend(s, series[s].name);
  return plot.Svg();
}

std::string CellMapSvg(const std::string& title, int columns, int rows,
                       const std::vector<double>& values, double top) {
  constexpr double kCell = 26.0;
  const double width = columns * kCell + 20.0, height = rows * kCell + 44.0;
  std::string svg = fmt::format(
      "<svg class=\"plot\" style=\"max-width:{:.0f}px\" viewBox=\"0 0 {:.0f} {:.0f}\" "
      "role=\"img\" aria-label=\"{}\"><text class=\"title\" x=\"10\" y=\"18\">{}</text>",
      1.5 * width, width, height, files::EscapeMarkup(title), files::EscapeMarkup(title));
  for (int i = 0; i < columns * rows; ++i) {
    const double value = values[i];
    const int column = i % columns, row = i / columns;
    const double x = 10.0 + column * kCell, y = 30.0 + row * kCell;
    if (!std::isfinite(value)) continue;
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#c2452d\" "
        "fill-opacity=\"{:.3f}\"/><text style=\"font-size:8px\" text-anchor=\"middle\" "
        "x=\"{:.1f}\" y=\"{:.1f}\">{:.2f}</text>",
        x, y, kCell - 1, kCell - 1, std::clamp(value / top, 0.0, 1.0), x + 0.5 * kCell,
        y + 0.5 * kCell + 3, value);
  }
  return svg + "</svg>\n";
}

std::string HistogramSvg(const std::string& title, const std::string& unit,
                         const std::vector<std::string>& names,
                         const std::vector<std::vector<double>>& values, double top) {
  constexpr int kBins = 24;
  std::vector<std::vector<double>> shares;
  double largest = 0.0;
  for (const std::vector<double>& sample : values) {
    std::vector<double> share(kBins, 0.0);
    for (const double value : sample) {
      const int bin = std::clamp(static_cast<int>(value / top * kBins), 0, kBins - 1);
      share[bin] += 100.0 / static_cast<double>(sample.size());
    }
    largest = std::max(largest, *std::max_element(share.begin(), share.end()));
    shares.push_back(std::move(share));
  }
  if (largest == 0.0) largest = 1.0;
  const std::string heading = title + ", % of hits";
  InlinePlot plot(kMargins, heading, heading);
  AddGrid(largest, &plot);
  for (int bin = 0; bin <= kBins; bin += 4) {
    plot.AddTick(plot.ToX(static_cast<double>(bin) / kBins), kTickBelow,
                 fmt::format("{:.3g}{}", top * bin / kBins, bin == kBins ? "+ " + unit : ""));
  }
  for (std::size_t s = 0; s < shares.size(); ++s) {
    std::string path = fmt::format("M{:.1f} {:.1f}", plot.ToX(0.0), plot.ToY(0.0));
    for (int bin = 0; bin < kBins; ++bin) {
      path += fmt::format("V{:.1f}H{:.1f}", plot.ToY(shares[s][bin] / largest),
                          plot.ToX((bin + 1.0) / kBins));
    }
    plot.AddPath(s, path + fmt::format("V{:.1f}", plot.ToY(0.0)));
  }
  for (std::size_t s = names.size(); s-- > 0;) plot.AddLegend(s, names[s]);
  return plot.Svg();
}

}  // namespace pleinair::exports
