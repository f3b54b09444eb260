#include "app/calibrate/calibration_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/calibrate/calibration_drawings.h"
#include "base/units.h"
#include "export/images/image_writer.h"
#include "export/plots/page_style.h"
#include "files/base64.h"
#include "files/markup_escape.h"

namespace pleinair::app {
namespace {

using tracker::LensCalibration;

constexpr int kDrawingWidth_px = 800;
constexpr int kThumbnailWidth_px = 360;
constexpr std::size_t kMaxThumbnails = 24;

constexpr const char* kStyle =
    "svg{max-width:100%;height:auto;border-radius:8px;display:block}"
    ".views{display:grid;grid-template-columns:repeat(auto-fill,minmax(13rem,1fr));gap:.8rem}"
    ".drawings{display:grid;grid-template-columns:repeat(auto-fit,minmax(24rem,1fr));gap:1.2rem}"
    "td .bar{display:inline-block;height:.6em;background:var(--c2);border-radius:2px}";

std::string Card(const std::string& figure, const std::string& caption) {
  return fmt::format("<div class=\"card\"><b>{}</b><span>{}</span></div>\n",
                     files::EscapeMarkup(figure), files::EscapeMarkup(caption));
}

std::string Figure(const exports::VectorDrawing& drawing, const std::string& caption) {
  std::string svg = exports::DrawingSvg(drawing, kDrawingWidth_px);
  svg.erase(0, svg.find("<svg"));
  return "<figure>" + svg + "<figcaption>" + files::EscapeMarkup(caption) +
         "</figcaption></figure>\n";
}

std::string Numbers(const LensCalibration& calibration) {
  const CameraModel& camera = calibration.fit.camera;
  const tracker::LensUncertainty& doubt = calibration.uncertainty;
  std::string html = "<table><tr><th>number</th><th>value</th><th>standard deviation</th></tr>\n";
  const auto row = [&](const char* name, const std::string& value, const std::string& deviation) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", name, value, deviation);
  };
  const auto pixels = [&](const char* name, double value, double deviation) {
    row(name, fmt::format("{:.3f} px", value), fmt::format("{:.3f} px", deviation));
  };
  pixels("fx", camera.fx, doubt.fx);
  pixels("fy", camera.fy, doubt.fy);
  pixels("cx", camera.cx, doubt.cx);
  pixels("cy", camera.cy, doubt.cy);
  const auto names = CoefficientNames(camera);
  const auto free = static_cast<std::size_t>(CoefficientsOf(calibration.fit.kind));
  for (std::size_t i = 0; i < free; ++i) {
    row(names[i], fmt::format("{:.6f}", camera.distortion[i]),
        fmt::format("{:.6f}", doubt.distortion[i]));
  }
  return html + "</table>\n";
}

std::string Tried(const LensCalibration& calibration) {
  std::string html =
      "<table><tr><th>kind of lens</th><th>RMS of views fitted</th><th>RMS of views left "
      "out</th></tr>\n";
  for (const tracker::TriedKind& tried : calibration.tried) {
    const bool chosen = tried.kind == calibration.fit.kind;
    html += fmt::format("<tr><td>{}{}</td><td>{:.4f} px</td><td>{:.4f} px</td></tr>\n",
                        NameOf(tried.kind), chosen ? " (chosen)" : "", tried.rms_px,
                        tried.validation_rms_px);
  }
  return html + "</table>\n";
}

double MaxRms(const LensCalibration& calibration) {
  double largest = 0.0;
  for (const auto& residuals : calibration.residuals_px) {
    largest = std::max(largest, tracker::Rms(residuals));
  }
  return std::max(largest, 1e-12);
}

std::string Thumbnail(const CollectedView& view, const LensCalibration& calibration,
                      std::size_t used) {
  const int width = view.grey.width(), height = view.grey.height();
  RgbImage rgb(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) rgb(x, y, c) = view.grey(x, y);
    }
  }
  std::string corners;
  for (const Vec2 seen : calibration.views[used].observed_px) {
    corners += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", seen.x + 0.5,
                           seen.y + 0.5, width / 110.0);
  }
  return fmt::format(
      "<figure><svg viewBox=\"0 0 {0} {1}\"><image width=\"{0}\" height=\"{1}\" "
      "href=\"data:image/jpeg;base64,{2}\"/><g fill=\"#e0452d\" stroke=\"#fff\" "
      "stroke-width=\"{3:.2f}\">{4}</g></svg><figcaption>{5}: {6:.3f} px</figcaption></figure>\n",
      width, height, files::Base64(exports::EncodeJpeg(rgb.view(), kThumbnailWidth_px, 70)),
      width / 700.0, corners,
      files::EscapeMarkup(std::filesystem::path(view.view.name).filename().string()),
      tracker::Rms(calibration.residuals_px[used]));
}

std::string Views(const LensCalibration& calibration, const std::vector<CollectedView>& views) {
  const double largest = MaxRms(calibration);
  std::string table = "<table><tr><th>view</th><th>corners</th><th>RMS</th><th></th></tr>\n";
  std::string thumbnails;
  std::size_t shown = 0;
  for (std::size_t used = 0; used < calibration.views.size(); ++used) {
    const tracker::PlaneView& view = calibration.views[used];
    const double rms = tracker::Rms(calibration.residuals_px[used]);
    table += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{:.3f} px</td><td style=\"text-align:left\"><span "
        "class=\"bar\" style=\"width:{:.1f}rem\"></span></td></tr>\n",
        files::EscapeMarkup(view.name), view.observed_px.size(), rms, 8.0 * rms / largest);
    const auto source = std::find_if(views.begin(), views.end(), [&](const CollectedView& each) {
      return each.view.name == view.name && !each.grey.empty();
    });
    if (source != views.end() && shown++ < kMaxThumbnails) {
      thumbnails += Thumbnail(*source, calibration, used);
    }
  }
  for (const tracker::DroppedView& dropped : calibration.dropped) {
    table += "<tr><td>" + files::EscapeMarkup(dropped.name) +
             "</td><td colspan=\"3\">left out: " + files::EscapeMarkup(dropped.why) +
             "</td></tr>\n";
  }
  return "<div class=\"views\">\n" + thumbnails + "</div>\n" + table + "</table>\n";
}

}  // namespace

std::vector<const char*> CoefficientNames(const CameraModel& camera) {
  if (camera.distortion_model == DistortionModel::kEquidistant) return {"k1", "k2", "k3", "k4"};
  return {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
}

std::string CalibrationPage(const CalibrationFacts& facts, const LensCalibration& calibration,
                            const std::vector<CollectedView>& views) {
  const CameraModel& camera = calibration.fit.camera;
  const auto degrees = [](double pixels, double focal) {
    return 2.0 * std::atan(0.5 * pixels / focal) / kRadiansPerDegree;
  };
  std::string html = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">";
  html += "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">";
  html += "<title>pleinair calibrate: " + files::EscapeMarkup(facts.title) + "</title><style>" +
          std::string(exports::kPageStyle) + kStyle + "</style></head><body>\n<h1>Lens of " +
          files::EscapeMarkup(facts.title) + "</h1>\n<p class=\"lead\">" +
          files::EscapeMarkup(facts.board) +
          fmt::format(", seen in {} of {} images: <code>", facts.with_board, facts.looked_at) +
          files::EscapeMarkup(facts.command) + "</code></p>\n<div class=\"cards\">\n";
  html += Card(
      fmt::format("{:.2f} px", 0.5 * (camera.fx + camera.fy)),
      fmt::format("focal length, to {:.2f} %", 100.0 * calibration.uncertainty.fx / camera.fx));
  html += Card(fmt::format("{:.3f} px", calibration.rms_px), "RMS of all corners");
  html += Card(fmt::format("{:.3f} px", calibration.validation.rms_px),
               fmt::format("RMS of views left out ({} folds)", calibration.validation.folds));
  html +=
      Card(fmt::format("{:.0f} %", 100.0 * calibration.coverage.Share()), "of the image covered");
  if (camera.distortion_model == DistortionModel::kBrownConrady) {
    html += Card(fmt::format("{:.1f} x {:.1f}", degrees(camera.width, camera.fx),
                             degrees(camera.height, camera.fy)),
                 "degrees of view, without distortion");
  }
  html += Card(NameOf(calibration.fit.kind), "kind of lens");
  html += "</div>\n";
  if (!calibration.judgement.advice.empty()) {
    html += "<h2>What would make it better</h2>\n<ul class=\"warnings\">\n";
    for (const std::string& advice : calibration.judgement.advice) {
      html += "<li>" + files::EscapeMarkup(advice) + "</li>\n";
    }
    html += "</ul>\n";
  }
  html += "<h2>Where the board was seen</h2>\n<div class=\"drawings\">\n";
  html += Figure(CoverageDrawing(calibration),
                 "Corners by residual: blue zero, red three times the RMS and more. Crosses: no "
                 "corner was seen here.");
  html += Figure(
      ResidualDrawing(calibration),
      "Residuals by region. Aligned arrows show distortion that this kind of lens does not model.");
  html += Figure(DistortionDrawing(calibration),
                 "A grid without distortion (dashed) and through this lens.");
  html += Figure(PlacesDrawing(calibration), "Boards from above and from the side.");
  html += "</div>\n<h2>The lens</h2>\n" + Numbers(calibration);
  html += "<h2>Kinds of lens that were tried</h2>\n" + Tried(calibration);
  html += "<h2>Views</h2>\n" + Views(calibration, views);
  return html + "</body></html>\n";
}

}  // namespace pleinair::app
