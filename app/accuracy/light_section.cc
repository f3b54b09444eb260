#include "app/accuracy/light_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "files/markup_escape.h"

namespace pleinair::app {
namespace {

std::string Row(const accuracy::LightSummary& light) {
  std::string row = fmt::format(
      "<tr><td>{}</td><td>{}</td>",
      light.recording.empty() ? "mean of the recordings" : files::EscapeMarkup(light.recording),
      light.pictures);
  for (const accuracy::LightFigure& figure : light.figures) {
    if (figure.count == 0) {
      row += "<td>–</td>";
    } else if (!figure.interval) {
      row += fmt::format("<td>{:.3f}</td>", figure.mean);
    } else {
      row += fmt::format("<td>{:.3f}<br><small>{:.3f}…{:.3f}</small></td>", figure.mean,
                         figure.interval->low, figure.interval->high);
    }
  }
  return row + "</tr>\n";
}

/// Color difference around the object, which is visually the most important region.
double Badness(const LightPicture& picture) {
  constexpr std::size_t kNear = 4;
  static_assert(std::string_view(accuracy::kImageMeasures[kNear].name) == "dE_near");
  return picture.record.scores[kNear].value_or(0.0);
}

std::string Figures(const LightPicture& picture) {
  const std::string name =
      files::EscapeMarkup(picture.record.recording + ", " + picture.record.picture);
  std::string html;
  const auto add = [&](const std::string& jpeg, const char* what) {
    html += fmt::format(
        "<figure><img class=\"light\" alt=\"{0}: {1}\" src=\"data:image/jpeg;base64,{2}\">"
        "<figcaption>{0}: {1}</figcaption></figure>\n",
        name, what, jpeg);
  };
  add(picture.truth, "truth");
  add(picture.composed, "composed");
  add(picture.difference, fmt::format("difference, near {:.2f}", Badness(picture)).c_str());
  return html;
}

}  // namespace

std::string LightSection(const AccuracyReport& report) {
  if (report.pictures.empty()) return {};
  std::string html =
      "<h2>Light</h2>\n<p class=\"lead\">Composed key frames against ground-truth images, as "
      "<code>pleinair compare</code> has it: mean CIEDE2000 over the virtual object, its shadow, "
      "both with 25 pixels around them, everything; small: where the mean lies with 95 % by "
      "Student's t over the key frames.</p>\n<div "
      "class=\"wide\"><table><tr><th>recording</th><th>images</th>";
  for (const accuracy::ImageMeasure& measure : accuracy::kImageMeasures) {
    html += fmt::format("<th>{}</th>", measure.name);
  }
  html += "</tr>\n";
  for (const accuracy::LightSummary& light : report.summary.light) html += Row(light);
  std::vector<const LightPicture*> worst;
  for (const LightPicture& picture : report.pictures) worst.push_back(&picture);
  std::stable_sort(worst.begin(), worst.end(), [](const LightPicture* a, const LightPicture* b) {
    return Badness(*a) > Badness(*b);
  });
  constexpr std::size_t kShown = 3;
  worst.resize(std::min(kShown, worst.size()));
  html +=
      "</table></div>\n<p class=\"lead\">The worst of them. Differences: black 0, blue 2.5, red 5, "
      "white 10 and more.</p>\n<div class=\"thirds\">\n";
  for (const LightPicture* picture : worst) html += Figures(*picture);
  return html + "</div>\n";
}

}  // namespace pleinair::app
