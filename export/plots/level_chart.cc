#include "export/plots/level_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "export/plots/line_plot.h"
#include "files/markup_escape.h"

namespace pleinair::exports {
namespace {

constexpr double kWidth = 640, kHeight = 220;
constexpr double kLeft = 52, kRight = 12, kTop = 30, kBottom = 42;

double ToY(double share) { return kHeight - kBottom - share * (kHeight - kTop - kBottom); }

std::string Head(const std::string& title) {
  return fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">"
      "<text class=\"title\" x=\"{:.0f}\" y=\"16\">{}</text>",
      kWidth, kHeight, files::EscapeMarkup(title), kLeft, files::EscapeMarkup(title));
}

/// Horizontal lines with their values.
std::string Grid(double top) {
  const double step = TickStep(0.0, top, 4);
  std::string svg;
  for (int line = 0; line * step <= top * (1 + 1e-9); ++line) {
    const double y = line * step, at = ToY(y / top);
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>"
        "<text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{:.4g}</text>",
        kLeft, kWidth - kRight, at, at, kLeft - 6, at + 4, y);
  }
  return svg;
}

std::string Legend(const std::vector<std::string>& names) {
  std::string svg;
  double x = kWidth - kRight;
  for (std::size_t i = names.size(); i-- > 0;) {
    svg +=
        fmt::format("<text class=\"legend{}\" text-anchor=\"end\" x=\"{:.0f}\" y=\"16\">{}</text>",
                    i, x, files::EscapeMarkup(names[i]));
    x -= 16.0 + 7.0 * static_cast<double>(names[i].size());
  }
  return svg;
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
  std::string svg = Head(title) + Grid(top);
  const double step = (kWidth - kLeft - kRight) / static_cast<double>(levels.size());
  const auto to_x = [&](std::size_t level) {
    return kLeft + step * (static_cast<double>(level) + 0.5);
  };
  for (std::size_t i = 0; i < levels.size(); ++i) {
    svg += fmt::format(
        "<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", to_x(i),
        kHeight - kBottom + 16, files::EscapeMarkup(levels[i]));
  }
  svg +=
      fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
                  0.5 * (kLeft + kWidth - kRight), kHeight - 8, files::EscapeMarkup(level_name));
  std::vector<std::string> names;
  for (std::size_t s = 0; s < series.size(); ++s) {
    const LevelSeries& one = series[s];
    names.push_back(one.name);
    // Whiskers of several series stand beside each other.
    const double aside = 4.0 * (static_cast<double>(s) - 0.5 * (series.size() - 1.0));
    std::string path, whiskers;
    bool pen_down = false;
    for (std::size_t i = 0; i < one.values.size(); ++i) {
      if (!std::isfinite(one.values[i])) {
        pen_down = false;
        continue;
      }
      const double x = to_x(i) + aside, y = ToY(std::min(1.0, one.values[i] / top));
      path += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", x, y);
      pen_down = true;
      whiskers += fmt::format("M{:.1f} {:.1f}h3", x - 1.5, y);
      if (one.low.empty() || !std::isfinite(one.low[i])) continue;
      whiskers += fmt::format("M{:.1f} {:.1f}V{:.1f}", x, ToY(std::min(1.0, one.low[i] / top)),
                              ToY(std::min(1.0, one.high[i] / top)));
    }
    svg += fmt::format(
        "<path class=\"line{}\" d=\"{}\"/><path class=\"line{}\" "
        "stroke-opacity=\".55\" d=\"{}\"/>",
        s, path, s, whiskers);
  }
  return svg + Legend(names) + "</svg>\n";
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
  std::string svg = Head(title + ", % of hits") + Grid(largest);
  const double step = (kWidth - kLeft - kRight) / kBins;
  for (int bin = 0; bin <= kBins; bin += 4) {
    svg += fmt::format(
        "<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{:.3g}{}</text>",
        kLeft + bin * step, kHeight - kBottom + 16, top * bin / kBins,
        bin == kBins ? "+ " + unit : "");
  }
  for (std::size_t s = 0; s < shares.size(); ++s) {
    std::string path = fmt::format("M{:.1f} {:.1f}", kLeft, ToY(0));
    for (int bin = 0; bin < kBins; ++bin) {
      path +=
          fmt::format("V{:.1f}H{:.1f}", ToY(shares[s][bin] / largest), kLeft + (bin + 1) * step);
    }
    svg += fmt::format("<path class=\"line{}\" d=\"{}V{:.1f}\"/>", s, path, ToY(0));
  }
  return svg + Legend(names) + "</svg>\n";
}

}  // namespace pleinair::exports
