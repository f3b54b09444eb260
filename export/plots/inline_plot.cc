#include "export/plots/inline_plot.h"

#include <fmt/format.h>

#include "files/markup_escape.h"

namespace pleinair::exports {
namespace {

constexpr double kRight = 12.0, kTop = 30.0;

}  // namespace

InlinePlot::InlinePlot(Margins margins, const std::string& label, const std::string& title)
    : margins_(margins),
      legend_x_(kWidth - kRight),
      svg_(fmt::format(
          "<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">"
          "<text class=\"title\" x=\"{:.0f}\" y=\"16\">{}</text>",
          kWidth, kHeight, files::EscapeMarkup(label), margins.left, files::EscapeMarkup(title))) {}

double InlinePlot::ToX(double share) const {
  return margins_.left + share * (kWidth - margins_.left - kRight);
}

double InlinePlot::ToY(double share) const {
  return kHeight - margins_.bottom - share * (kHeight - kTop - margins_.bottom);
}

void InlinePlot::AddGridLine(double share, const std::string& value) {
  const double y = ToY(share);
  svg_ += fmt::format(
      "<line class=\"grid\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>"
      "<text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
      margins_.left, kWidth - kRight, y, y, margins_.left - 6, y + 4, files::EscapeMarkup(value));
}

void InlinePlot::AddTick(double x, double below, const std::string& text) {
  svg_ +=
      fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
                  x, kHeight - margins_.bottom + below, files::EscapeMarkup(text));
}

void InlinePlot::AddPath(std::size_t series, const std::string& data,
                         const std::string& attributes) {
  svg_ += fmt::format("<path class=\"line{}\"{} d=\"{}\"/>", series, attributes, data);
}

void InlinePlot::AddLegend(std::size_t series, const std::string& name) {
  svg_ +=
      fmt::format("<text class=\"legend{}\" text-anchor=\"end\" x=\"{:.0f}\" y=\"16\">{}</text>",
                  series, legend_x_, files::EscapeMarkup(name));
  legend_x_ -= 16.0 + 7.0 * static_cast<double>(name.size());
}

}  // namespace pleinair::exports
