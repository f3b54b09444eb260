#include "app/compare/compare_html.h"

#include <fmt/format.h>

#include <cmath>

#include "export/plots/page_style.h"
#include "files/base64.h"
#include "files/markup_escape.h"

namespace pleinair::app {
namespace {

std::string Row(const std::string& name, const PictureScores& scores) {
  std::string row = "<tr><td>" + files::EscapeMarkup(name) + "</td>";
  for (const double value : scores.Values()) {
    row += std::isnan(value) ? "<td>–</td>" : fmt::format("<td>{:.3f}</td>", value);
  }
  return row + "</tr>\n";
}

std::string Figure(const std::vector<std::uint8_t>& jpeg, const std::string& caption) {
  return fmt::format(
      "<figure><img alt=\"{0}\" style=\"width:100%;border-radius:8px\" "
      "src=\"data:image/jpeg;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
      files::EscapeMarkup(caption), files::Base64(jpeg));
}

}  // namespace

std::string CompareHtml(const Comparison& comparison) {
  std::string html = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">";
  html += "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">";
  html +=
      "<title>pleinair compare: " + files::EscapeMarkup(comparison.pictures) + "</title><style>";
  html += std::string(exports::kPageStyle) +
          ".pictures{grid-template-columns:repeat(3,1fr)}</style></head><body>\n<h1>" +
          files::EscapeMarkup(comparison.pictures) + "</h1>\n<p class=\"lead\">against " +
          files::EscapeMarkup(comparison.truth) + ": <code>" +
          files::EscapeMarkup(comparison.command) + "</code></p>\n<table><tr><th>picture</th>";
  for (const char* name : kPictureScoreNames) html += fmt::format("<th>{}</th>", name);
  html += "</tr>\n";
  for (const ComparedPicture& picture : comparison.compared) {
    html += Row(picture.name, picture.scores);
  }
  html += Row("mean", comparison.mean);
  html +=
      "</table>\n<p class=\"lead\">dE: mean CIEDE2000 over object, its shadow, both with 25 "
      "pixels around them, everything. Differences: black 0, blue 2.5, red 5, white 10 and "
      "more.</p>\n";
  for (const ComparedPicture& picture : comparison.compared) {
    html += "<h2>" + files::EscapeMarkup(picture.name) + "</h2>\n<div class=\"pictures\">\n" +
            Figure(picture.truth_jpeg, "truth") + Figure(picture.picture_jpeg, "composed") +
            Figure(picture.difference_jpeg, "difference") + "</div>\n";
  }
  return html + comparison.time_lapse + "</body></html>\n";
}

}  // namespace pleinair::app
