#include "app/accuracy/worst_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/accuracy/accuracy_run.h"
#include "export/images/image_writer.h"
#include "files/base64.h"
#include "files/markup_escape.h"

namespace pleinair::app {
namespace {

using accuracy::FrameRecord;
using accuracy::MarkerRecord;
using accuracy::Outcome;

struct Bad {
  double badness = 0.0;
  std::string why{};
  const FrameRecord* record = nullptr;
};

/// Severity of a frame's error; 0: no error.
Bad BadnessOf(const FrameRecord& record) {
  Bad bad{.record = &record};
  const auto consider = [&](double badness, std::string why) {
    if (badness <= bad.badness) return;
    bad.badness = badness;
    bad.why = std::move(why);
  };
  if (record.false_numbers > 0) {
    consider(4000.0 + record.false_numbers, fmt::format("{} false numbers", record.false_numbers));
  }
  for (const MarkerRecord& marker : record.markers) {
    if (marker.outcome == Outcome::kMissed) continue;
    const double rms = marker.CornerRms();
    if (marker.outcome == Outcome::kMisplaced) {
      consider(3000.0 + rms, fmt::format("{} misplaced by {:.1f} px", marker.number, rms));
    } else if (marker.pose && marker.pose->rotation_error_deg > accuracy::kFlip_deg) {
      consider(2000.0 + rms,
               fmt::format("{} flipped, {:.0f}°", marker.number, marker.pose->rotation_error_deg));
    } else {
      consider(rms, fmt::format("{} off by {:.2f} px", marker.number, rms));
    }
  }
  return bad;
}

std::string Outline(const std::array<Vec2, 4>& corners, const char* color) {
  std::string points;
  for (const Vec2 corner : corners)
    points += fmt::format("{:.1f},{:.1f} ", corner.x + 0.5, corner.y + 0.5);
  return fmt::format("<polygon points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>",
                     points, color);
}

std::string PictureHtml(const Bad& bad, const GreyImage& grey) {
  constexpr int kQuality = 80;
  RgbImage rgb(grey.width(), grey.height(), 3);
  for (std::size_t i = 0; i < grey.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) rgb.data()[3 * i + channel] = grey.data()[i];
  }
  std::string outlines;
  for (const MarkerRecord& marker : bad.record->markers) {
    outlines += Outline(marker.true_corners_px, "#2fae5f");
    if (marker.outcome == Outcome::kMissed) continue;
    std::array<Vec2, 4> found = marker.true_corners_px;
    for (int i = 0; i < 4; ++i) found[i] = found[i] + marker.corner_error_px[i];
    outlines += Outline(found, "#e0442c");
  }
  return fmt::format(
      "<figure><div class=\"worst\"><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\">"
      "<svg viewBox=\"0 0 {2} {3}\">{4}</svg></div><figcaption>{0}: {5}</figcaption></figure>\n",
      files::EscapeMarkup(bad.record->name),
      files::Base64(exports::EncodeJpeg(rgb.view(), grey.width(), kQuality)), grey.width(),
      grey.height(), outlines, files::EscapeMarkup(bad.why));
}

}  // namespace

std::string WorstFrames(const AccuracyReport& report, const std::vector<FrameRecord>& records) {
  constexpr std::size_t kPictures = 6;
  std::vector<Bad> worst;
  for (const FrameRecord& record : records) {
    if (record.detector != report.summary.detectors[0]) continue;
    Bad bad = BadnessOf(record);
    if (bad.badness > 0.0) worst.push_back(std::move(bad));
  }
  std::stable_sort(worst.begin(), worst.end(),
                   [](const Bad& a, const Bad& b) { return a.badness > b.badness; });
  std::string html =
      "<h2>Worst frames</h2>\n<p class=\"lead\">Green: where the markers are. Red: "
      "where " +
      report.summary.detectors[0] + " found them.</p>\n<div class=\"pictures\">\n";
  for (std::size_t i = 0; i < std::min(kPictures, worst.size()); ++i) {
    if (const auto grey = PictureOf(report.config, worst[i].record->frame)) {
      html += PictureHtml(worst[i], *grey);
    }
  }
  return html + "</div>\n";
}

}  // namespace pleinair::app
