#include "app/replay/report/report_html.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "app/lens/lens_text.h"
#include "base/units.h"
#include "export/plots/line_plot.h"
#include "export/plots/page_style.h"
#include "files/base64.h"
#include "files/markup_escape.h"

namespace pleinair::app {
namespace {

constexpr const char* kScript = R"(
for(const input of document.querySelectorAll('input[type=range]'))
 input.addEventListener('input',()=>input.closest('figure').querySelector('.pair')
  .style.setProperty('--cut',input.value+'%'));
)";

std::string Card(const std::string& figure, const std::string& caption) {
  return fmt::format("<div class=\"card\"><b>{}</b><span>{}</span></div>\n",
                     files::EscapeMarkup(figure), files::EscapeMarkup(caption));
}

std::string Pictures(const ReplayReport& report) {
  std::string html;
  for (const ReportPicture& picture : report.files.pictures) {
    html += fmt::format(
        "<figure><span class=\"pair\"><img alt=\"frame {0} as recorded\" "
        "src=\"data:image/jpeg;base64,{1}\"><img class=\"after\" alt=\"frame {0} composed\" "
        "src=\"data:image/jpeg;base64,{2}\"></span><input type=\"range\" min=\"0\" max=\"100\" "
        "value=\"50\" aria-label=\"frame {0}: where the composed image begins\"><figcaption>Frame "
        "{0}: recorded left, composed right of the line</figcaption></figure>\n",
        picture.frame_index, files::Base64(picture.before_jpeg), files::Base64(picture.after_jpeg));
  }
  return html;
}

/// Sun and sky over time, as a white level surface in the open shows them.
std::string LightPlot(const std::vector<LightRow>& rows) {
  exports::PlotLine sun{"sun", {}, {}}, sky{"sky", {}, {}};
  for (const LightRow& row : rows) {
    const double t_s = static_cast<double>(row.timestamp_ns) * 1e-9;
    sun.x.push_back(t_s);
    sun.y.push_back(Luminance(row.sun));
    sky.x.push_back(t_s);
    sky.y.push_back(Luminance(row.sky));
  }
  return exports::LinePlotSvg("Light on white level ground, display-linear", "", {sun, sky});
}

/// Camera position, orientation and reprojection error over time; gaps where the marker was not
/// observed.
std::string Plots(const ReplayReport& report) {
  exports::PlotLine x{"x", {}, {}}, y{"y", {}, {}}, z{"z", {}, {}};
  exports::PlotLine heading{"heading", {}, {}}, tilt{"tilt", {}, {}}, roll{"roll", {}, {}};
  exports::PlotLine error{"", {}, {}}, visible{"", {}, {}};
  const auto add = [](exports::PlotLine& line, double at_s, double value) {
    line.x.push_back(at_s);
    line.y.push_back(value);
  };
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  std::int64_t last_index = -1;
  double last_heading = 0.0;
  for (const session::Observation& at : report.path) {
    const double t_s = static_cast<double>(at.timestamp_ns) * 1e-9;
    if (last_index >= 0 && at.frame_index != last_index + 1) {
      for (exports::PlotLine* line : {&x, &y, &z, &heading, &tilt, &roll, &error, &visible}) {
        add(*line, t_s, kGap);
      }
    }
    const auto marker_from_camera = at.camera_from_marker.Inverse();
    const Mat3& r = marker_from_camera.rotation;
    add(x, t_s, marker_from_camera.translation_m.x);
    add(y, t_s, marker_from_camera.translation_m.y);
    add(z, t_s, marker_from_camera.translation_m.z);
    // Columns of r: the camera's right, down and forward axes in the marker frame.
    const double degree = 1.0 / kRadiansPerDegree;
    double heading_deg = std::atan2(r(0, 2), r(1, 2)) * degree;
    if (last_index >= 0) {
      heading_deg += 360.0 * std::round((last_heading - heading_deg) / 360.0);
    }
    last_heading = heading_deg;
    add(heading, t_s, heading_deg);
    add(tilt, t_s, std::asin(std::fmax(-1.0, std::fmin(1.0, r(2, 2)))) * degree);
    add(roll, t_s, std::atan2(-r(2, 0), -r(2, 1)) * degree);
    add(error, t_s, at.reprojection_rms_px);
    add(visible, t_s, at.visible_fraction * 100);
    last_index = at.frame_index;
  }
  return exports::LinePlotSvg("Camera position in the marker frame", "m", {x, y, z}) +
         exports::LinePlotSvg("Camera orientation in the marker frame", "degrees",
                              {heading, tilt, roll}) +
         exports::LinePlotSvg("Reprojection error of the marker's corners", "px rms", {error}) +
         exports::LinePlotSvg("Visible part of the marker", "%", {visible});
}

/// ", ± 7 %", or an empty string if unknown.
std::string PlusMinus(const std::optional<double>& relative_error) {
  return relative_error ? fmt::format(", ± {:.0f} %", *relative_error * 100) : "";
}

std::string MeasuredCards(const compositor::MeasuredLight& light) {
  using Source = compositor::MeasuredLight::Source;
  const std::string sun = light.sun_shines ? fmt::format("{:.2f}", light.sun_to_sky) : "no sun";
  std::string from = "sun-to-sky ratio on level ground, from the scene";
  if (light.sun_source == Source::kOverride)
    from = "sun-to-sky ratio on level ground, from --sun-to-sky";
  if (light.sun_source == Source::kMeasured) {
    from = fmt::format("{}: {} of {} shadow edges agree, in {} frames; scene: {:.2f}",
                       light.sun_shines
                           ? "sun-to-sky ratio on level ground" + PlusMinus(light.sun_to_sky_error)
                           : "where phantoms would cast shadows",
                       light.evidence.edges_agreeing, light.evidence.edges, light.evidence.frames,
                       light.sun_to_sky_stated);
  }
  if (light.sun_source == Source::kShade) {
    from = fmt::format(
        "sun-to-sky ratio on level ground{}, from the contrast of tree shadows at {} places in {} "
        "frames; scene: {:.2f}",
        PlusMinus(light.sun_to_sky_error), light.evidence.shade_places, light.evidence.frames,
        light.sun_to_sky_stated);
  }
  if (light.sun_source == Source::kMarker) {
    from = fmt::format(
        "sun-to-sky ratio on level ground{}, from a shadow edge on the marker; scene: {:.2f}",
        PlusMinus(light.sun_to_sky_error), light.sun_to_sky_stated);
  }
  std::string html = Card(sun, from);
  if (light.sun_doubtful) {
    html +=
        Card("doubtful", "whether the sun shone: shadows are not where phantoms would cast them");
  }
  if (light.evidence.edges > 0) {
    html += Card(
        fmt::format("{:.0f} %", std::fmax(0.0, light.evidence.edges_with_contrast) * 100),
        fmt::format("of {} phantom shadow edges, by weight, are visible", light.evidence.edges));
  }
  if (light.heading_source == Source::kMeasured && light.heading_error) {
    html += Card(fmt::format("{:+.2f}° ± {:.2f}°", ToDegrees(light.heading_offset),
                             ToDegrees(*light.heading_error)),
                 "added to the marker's heading, estimated from shadows");
  }
  return html;
}

/// The camera's exposure scale and its source.
std::string ExposureScaleCard(const session::LightSummary& light) {
  using ExposureScaleSource = session::LightSummary::ExposureScaleSource;
  const std::string exposure_scale = fmt::format("{:.3g} {:.3g} {:.3g}", light.exposure_scale.r,
                                                 light.exposure_scale.g, light.exposure_scale.b);
  const std::string what = "camera exposure scale (r g b per cd/m²), ";
  if (light.exposure_scale_source == ExposureScaleSource::kScene)
    return Card(exposure_scale, what + "from the scene");
  if (light.exposure_scale_source == ExposureScaleSource::kGuess)
    return Card(exposure_scale, what + "guessed");
  const LinearRgb& error = light.exposure_scale_error;
  return Card(exposure_scale,
              what + fmt::format("± {:.1f} {:.1f} {:.1f} % from the marker in {} frames, changed "
                                 "by a factor of {:.2f}",
                                 error.r * 100, error.g * 100, error.b * 100,
                                 light.exposures.estimates, light.exposures.change));
}

/// The camera's response and its source.
std::string ResponseCard(const session::ResponseSummary& response) {
  using Source = session::ResponseSummary::Source;
  if (response.source == Source::kStated) return Card("given", "camera response, by the user");
  if (response.source == Source::kSrgb || response.source == Source::kFilm) {
    const char* curve = response.source == Source::kSrgb ? "sRGB" : "by the film's tags";
    return Card(curve, response.IsShown() ? "camera response: the frames do not contradict it"
                                          : "camera response: the frames do not show it");
  }
  return Card(fmt::format("± {:.0f} %", 100 * response.log_error),
              "light by the camera response that the frames show; it is not sRGB");
}

/// Whether the sun reaches the marker; empty if the marker gave no exposure estimate.
std::string MarkerCard(const session::LightSummary& light) {
  if (light.exposures.estimates == 0) return "";
  std::string figure = fmt::format("{:.0f} % in the sun", light.exposures.sunlit_share * 100);
  if (light.exposures.sunlit_share <= 0.0) figure = "in shade";
  if (light.exposures.sunlit_share >= 1.0) figure = "in the sun";
  if (!light.measured.sun_shines) figure = "no sun";
  return Card(
      figure,
      fmt::format("marker, by the phantoms' shadows; foliage shades it in {:.0f} % of frames",
                  session::DappledShare(light) * 100));
}

std::string Light(const ReplayReport& report) {
  const scene::PlaceTime& place = report.scene.place_time;
  std::string html = Card(fmt::format("{:.4f}°, {:.4f}°", place.latitude_deg, place.longitude_deg),
                          "latitude, longitude");
  html += Card(place.start.ToString(), "start of the recording");
  html += Card(CloudinessName(report.scene.cloudiness), "sky, from the scene");
  if (!report.light) return html;
  const session::LightSummary& light = *report.light;
  html += Card(fmt::format("{:.1f}° / {:.1f}°", ToDegrees(light.sun.azimuth),
                           ToDegrees(light.sun.elevation_refracted)),
               "sun: azimuth / elevation");
  html += Card(fmt::format("{:.1f} klx", light.sun_normal_lux / 1000), "sun, facing it");
  html += Card(fmt::format("{:.1f} klx", light.sky_horizontal_lux / 1000), "sky, on level ground");
  html += MeasuredCards(light.measured);
  html += MarkerCard(light);
  html += ExposureScaleCard(light);
  html += ResponseCard(light.response);
  if (light.camera.look) {
    html += Card(fmt::format("{:.2f} px / {:.1f} ‰", light.camera.look->blur_px,
                             1000 * light.camera.look->NoiseSigma(1, session::kMediumLight)),
                 "blur / noise at medium brightness, applied to virtual objects too");
  }
  return html;
}

/// The lens and the exposure that the marker's blur shows; empty where it was not looked for.
std::string Lens(const ReplayReport& report) {
  if (!report.film.lens) return "";
  const compositor::FocusFit& fit = report.film.lens->fit;
  std::string html = "<h2>Lens</h2>\n<div class=\"cards\">\n";
  if (fit.is_measured()) {
    const double q = fit.focus_dioptres;
    html += Card(q > 0.0 ? fmt::format("{:.3g} m", 1.0 / q) : "infinity",
                 fmt::format("in focus: {:.3f} ± {:.3f} /m", q, fit.focus_dioptres_error));
    html += Card(fmt::format("{:.3g} mm ± {:.1f} %", 1e3 * fit.aperture_m,
                             100.0 * fit.aperture_relative_error),
                 "diameter of the entrance pupil");
    html += Card(fmt::format("{:.2f} px", fit.in_focus_blur_px), "blur of what is in focus");
  } else {
    html += Card("not measured", fit.reason);
  }
  const compositor::ExposureFit& exposure = report.film.lens->exposure;
  if (exposure.is_measured()) {
    html +=
        Card(fmt::format("{:.3g} ± {:.2g} ms", 1e3 * exposure.exposure_s, 1e3 * exposure.error_s),
             "exposure, by the edges that move");
  }
  return html + "</div>\n" + ReadingsPlot(*report.film.lens);
}

}  // namespace

std::string ReportHtml(const ReplayReport& report) {
  const PoseStatistics poses = SummarizeTrajectory(report.path);
  std::string html = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">";
  html += "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">";
  html += "<title>pleinair: " + files::EscapeMarkup(report.call.recording) + "</title><style>";
  html += std::string(exports::kPageStyle) + "</style></head><body>\n<h1>" +
          files::EscapeMarkup(report.call.recording) +
          "</h1>\n<p class=\"lead\">composed by pleinair " +
          files::EscapeMarkup(report.call.version) + ": <code>" +
          files::EscapeMarkup(report.call.command) + "</code></p>\n<div class=\"cards\">\n";
  html +=
      Card(fmt::format("{} of {}", report.path.size(), report.film.frames), "frames with a pose");
  if (const auto& trajectory = report.placing.trajectory) {
    html += Card(std::to_string(trajectory->frames.by_trajectory),
                 fmt::format("frames with the pose of a given trajectory, {} without marker",
                             trajectory->frames.without_marker));
  }
  html += Card(report.reference_marker ? report.reference_marker->ToString() : "none",
               "marker that anchors the scene");
  html += Card(fmt::format("{}×{}, {:.4g} Hz", report.film.width, report.film.height,
                           report.film.frame_rate_hz),
               "output");
  if (!report.path.empty()) {
    html += Card(fmt::format("{:.2f}…{:.2f} m", poses.distance_min_m, poses.distance_max_m),
                 "camera to marker");
    html += Card(
        fmt::format("{:.3f} px", poses.reprojection_median_px),
        fmt::format("reprojection error, median (95 %: {:.3f} px)", poses.reprojection_p95_px));
    html += Card(fmt::format("{:.2f} m", poses.path_length_m), "length of the camera trajectory");
    html +=
        Card(fmt::format("{} / {} / {}", poses.found_by[0], poses.found_by[1], poses.found_by[2]),
             "frames: marker found fast / by S-G / tracked");
    html +=
        Card(fmt::format("{:.0f} %", poses.visible_min * 100), "of the marker visible, minimum");
    const LostFrames lost =
        CountLostFrames(report.path, report.film.first_frame + report.film.frames);
    html += Card(fmt::format("{}", lost.frames),
                 fmt::format("frames in which it was lost (longest: {})", lost.longest));
  }
  html += "</div>\n";
  if (!report.warnings.empty()) {
    html += "<h2>Warnings</h2>\n<ul class=\"warnings\">\n";
    for (const std::string& warning : report.warnings) {
      html += "<li>" + files::EscapeMarkup(warning) + "</li>\n";
    }
    html += "</ul>\n";
  }
  if (!report.files.pictures.empty()) {
    html += "<h2>Before and after</h2>\n<div class=\"pictures\">\n" + Pictures(report) + "</div>\n";
  }
  html += "<h2>Light</h2>\n<div class=\"cards\">\n" + Light(report) + "</div>\n";
  html += report.files.time_lapse;
  if (!report.light_changes.rows.empty()) html += LightPlot(report.light_changes.rows);
  html += Lens(report);
  if (!report.path.empty()) html += "<h2>Camera trajectory</h2>\n" + Plots(report);
  html +=
      "<h2>Time per stage</h2>\n<table><tr><th>stage</th><th>runs</th><th>median, ms</th>"
      "<th>95 %, ms</th><th>frames a second</th></tr>\n";
  for (const StageTimes::Summary& stage : report.timings) {
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.1f}</td></tr>\n",
        files::EscapeMarkup(stage.stage), stage.runs, stage.median_ms, stage.p95_ms,
        FramesPerSecond(report, stage));
  }
  return html + "</table>\n<script>" + kScript + "</script></body></html>\n";
}

}  // namespace pleinair::app
