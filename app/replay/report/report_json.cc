#include "app/replay/report/report_json.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/quantile.h"
#include "compositor/passes/render_targets.h"

namespace pleinair::app {
namespace {

using Json = nlohmann::ordered_json;

/// Rounds to nine significant digits.
double Rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return 0.0;
  const double scale = std::pow(10.0, 8 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

std::string Dump(const Json& json, int indent) {
  // A path on disk need not be UTF-8.
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

const char* SourceName(compositor::MeasuredLight::Source source) {
  switch (source) {
    case compositor::MeasuredLight::Source::kDescription:
      return "stated";
    case compositor::MeasuredLight::Source::kMeasured:
      return "measured";
    case compositor::MeasuredLight::Source::kShade:
      return "shade";
    case compositor::MeasuredLight::Source::kMarker:
      return "marker";
    case compositor::MeasuredLight::Source::kOverride:
      return "option";
  }
  return "stated";
}

const char* SourceName(session::LightSummary::ExposureScaleSource source) {
  switch (source) {
    case session::LightSummary::ExposureScaleSource::kMarker:
      return "marker";
    case session::LightSummary::ExposureScaleSource::kScene:
      return "scene";
    case session::LightSummary::ExposureScaleSource::kGuess:
      return "guess";
  }
  return "guess";
}

Json ColorJson(const LinearRgb& color) {
  return {Rounded(color.r), Rounded(color.g), Rounded(color.b)};
}

/// Null means unknown; 0 would be a value.
Json IfKnown(bool known, double value) { return known ? Json(Rounded(value)) : Json(); }

Json MeasuredJson(const compositor::MeasuredLight& light) {
  return {{"sun_shines", light.sun_shines},
          {"sun_to_sky", Rounded(light.sun_to_sky)},
          {"sun_to_sky_relative_error",
           IfKnown(light.sun_to_sky_error.has_value(), light.sun_to_sky_error.value_or(0.0))},
          {"sun_to_sky_stated", Rounded(light.sun_to_sky_stated)},
          {"sun_from", SourceName(light.sun_source)},
          {"heading_offset_deg", Rounded(ToDegrees(light.heading_offset))},
          {"heading_error_deg", IfKnown(light.heading_error.has_value(),
                                        ToDegrees(light.heading_error.value_or(Radians())))},
          {"heading_from", SourceName(light.heading_source)},
          {"frames", light.evidence.frames},
          {"shadow_edges", light.evidence.edges},
          {"shadow_edges_agreeing", light.evidence.edges_agreeing},
          {"shadow_edges_with_contrast",
           IfKnown(light.evidence.edges > 0, light.evidence.edges_with_contrast)},
          {"shade_places", light.evidence.shade_places},
          {"sun_doubtful", light.sun_doubtful},
          {"shaded_without_phantom", Rounded(light.shaded)},
          {"open_sun_over_brightest_of_print", Rounded(light.marker_shade)}};
}

Json ResponseJson(const session::ResponseSummary& response) {
  using Source = session::ResponseSummary::Source;
  const char* from = response.source == Source::kMeasured ? "measured" : "srgb";
  if (response.source == Source::kStated) from = "stated";
  if (response.source == Source::kFilm) from = "film";
  return {{"from", from},
          {"evidence_log", Rounded(response.log_evidence)},
          {"light_relative_error", IfKnown(response.IsShown(), response.log_error)}};
}

/// Noise as its standard deviation at medium brightness, in thousandths of the maximum value.
Json LookJson(const compositor::CameraLook& look) {
  Json noise;
  for (int c = 0; c < 3; ++c)
    noise.push_back(Rounded(1000 * look.NoiseSigma(c, session::kMediumLight)));
  return {{"blur_px", Rounded(look.blur_px)},
          {"noise_permille_at_medium_light", noise},
          {"noise_neighbour_correlation", Rounded(look.neighbour_correlation)},
          {"noise_channel_correlation", Rounded(look.channel_correlation)}};
}

const char* OutcomeName(compositor::SurfaceColor::Outcome outcome) {
  using Outcome = compositor::SurfaceColor::Outcome;
  switch (outcome) {
    case Outcome::kMeasured:
      return "measured";
    case Outcome::kTooFew:
      return "not seen";
    case Outcome::kClipped:
      return "clipped";
    case Outcome::kUneven:
      return "uneven";
    case Outcome::kImpossible:
      return "impossible";
    case Outcome::kNoLight:
      return "light unknown";
  }
  return "";
}

/// Colors of the surfaces that the scene describes without one.
Json SurfaceColorsJson(const std::vector<session::SurfaceColorSummary>& colors) {
  Json list = Json::array();
  for (const session::SurfaceColorSummary& color : colors) {
    const bool is_measured = color.measured.outcome == compositor::SurfaceColor::Outcome::kMeasured;
    list.push_back({{"surface", color.surface},
                    {"reflectance_rgb", ColorJson(color.reflectance)},
                    {"relative_error", IfKnown(is_measured, color.measured.relative_error)},
                    {"outcome", OutcomeName(color.measured.outcome)},
                    {"places", color.measured.places}});
  }
  return list;
}

/// Samples or places of a pixel; null if nothing was drawn.
Json SamplesOf(const ReplayedFilm& film) {
  if (!film.samples) return {};
  if (film.antialiasing.method == compositor::AntialiasingMethod::kNone) return 1;
  return film.antialiasing.HasPlaces() ? film.antialiasing.places : *film.samples;
}

/// Share of the drawn pixels with coverage at places; null if nothing was drawn.
Json MixedPixelsOf(const ReplayReport& report) {
  if (!report.light || !report.film.samples) return {};
  return Rounded(report.light->camera.mixed_pixels);
}

/// The lens that the objects are seen through.
Json LensJson(const session::CameraSummary& drawn,
              const std::optional<session::MeasuredLens>& measured) {
  const bool is_drawn = drawn.lens.has_value();
  const bool is_by_layers = is_drawn && drawn.lens_places == compositor::kByLayers;
  const bool is_measured = drawn.defocus == session::LensFactSource::kMeasured && measured;
  const compositor::FocusFit fit = measured ? measured->fit : compositor::FocusFit();
  const double focus = is_drawn ? drawn.lens->focus_dioptres : 0.0;
  return {
      {"defocus", session::NameOf(drawn.defocus)},
      {"method", !is_drawn      ? Json()
                 : is_by_layers ? Json("layered")
                                : Json("lens:" + std::to_string(drawn.lens_places))},
      {"focus_m", IfKnown(focus > 0.0, 1.0 / focus)},
      {"aperture_mm", IfKnown(is_drawn, is_drawn ? 1e3 * drawn.lens->aperture_m : 0.0)},
      {"focus_dioptres_error", IfKnown(is_measured, fit.focus_dioptres_error)},
      {"aperture_relative_error", IfKnown(is_measured, fit.aperture_relative_error)},
      {"in_focus_blur_px", IfKnown(is_drawn && drawn.look, drawn.look ? drawn.look->blur_px : 0.0)},
      {"largest_blur_px", Rounded(drawn.drawn_lens.largest_circle_px)},
      {"layers", is_by_layers ? Json(drawn.drawn_lens.layers) : Json()},
      {"peels", is_by_layers ? Json(drawn.drawn_lens.peels) : Json()}};
}

/// The motion blur of the objects. A measured exposure has an error.
Json MotionJson(const session::CameraSummary& drawn,
                const std::optional<session::MeasuredLens>& measured) {
  const bool is_known = drawn.exposure.seconds > 0.0;
  const bool is_measured =
      drawn.exposure.source == session::LensFactSource::kMeasured && measured.has_value();
  return {{"mode", session::NameOf(drawn.exposure.source)},
          {"exposure_ms", IfKnown(is_known, 1e3 * drawn.exposure.seconds)},
          {"exposure_error_ms",
           IfKnown(is_measured, is_measured ? 1e3 * measured->exposure.error_s : 0.0)},
          {"longest_streak_px", Rounded(drawn.drawn_lens.longest_streak_px)}};
}

Json LightJson(const session::LightSummary& light) {
  const bool is_metered =
      light.exposure_scale_source == session::LightSummary::ExposureScaleSource::kMarker;
  // Without a sun, a marker is neither sunlit nor in shadow.
  const bool may_be_lit = light.exposures.estimates > 0 && light.measured.sun_shines;
  return {{"sun_azimuth_deg", Rounded(ToDegrees(light.sun.azimuth))},
          {"sun_elevation_deg", Rounded(ToDegrees(light.sun.elevation))},
          {"sun_elevation_refracted_deg", Rounded(ToDegrees(light.sun.elevation_refracted))},
          {"sun_normal_lux", Rounded(light.sun_normal_lux)},
          {"sky_horizontal_lux", Rounded(light.sky_horizontal_lux)},
          {"gain_rgb", ColorJson(light.exposure_scale)},
          {"gain_from", SourceName(light.exposure_scale_source)},
          {"gain_relative_error_rgb", is_metered ? ColorJson(light.exposure_scale_error) : Json()},
          {"gain_change", IfKnown(is_metered, light.exposures.change)},
          {"gain_readings", light.exposures.estimates},
          {"marker_in_sun", IfKnown(may_be_lit, light.exposures.sunlit_share)},
          {"marker_dappled", IfKnown(light.exposures.estimates > 0, session::DappledShare(light))},
          {"look", light.camera.look ? LookJson(*light.camera.look) : Json()},
          {"camera_response", ResponseJson(light.response)},
          {"surface_colors", SurfaceColorsJson(light.surface_colors)},
          {"measured", MeasuredJson(light.measured)}};
}

/// How the light changes. `sun` of the frames is relative to its median.
Json ChangesJson(const ReplayedLight& light) {
  std::vector<double> suns;
  std::map<std::string, int> sources;
  for (const LightRow& row : light.rows) {
    suns.push_back(Luminance(row.sun));
    ++sources[LightSourceName(row.source)];
  }
  if (suns.empty()) return {};
  const double usual = Median(suns);
  const auto [least, most] = std::minmax_element(suns.begin(), suns.end());
  return {{"mode", session::NameOf(light.mode)},
          {"least_sun", IfKnown(usual > 0.0, *least / usual)},
          {"most_sun", IfKnown(usual > 0.0, *most / usual)},
          {"frames_by_source", sources}};
}

Json PosesJson(const ReplayReport& report) {
  const PoseStatistics s = SummarizeTrajectory(report.path);
  const LostFrames lost =
      CountLostFrames(report.path, report.film.first_frame + report.film.frames);
  Json found_by;
  for (const auto path : {tracker::DetectionPath::kFast, tracker::DetectionPath::kSurfGolay,
                          tracker::DetectionPath::kTracked}) {
    found_by[tracker::TrajectoryName(path)] = s.found_by[static_cast<std::size_t>(path)];
  }
  return {
      {"distance_m",
       {{"min", Rounded(s.distance_min_m)},
        {"median", Rounded(s.distance_median_m)},
        {"max", Rounded(s.distance_max_m)}}},
      {"path_length_m", Rounded(s.path_length_m)},
      {"step_rotation_p95_deg", Rounded(s.step_rotation_p95_deg)},
      {"step_translation_p95_m", Rounded(s.step_translation_p95_m)},
      {"reprojection_rms_px",
       {{"median", Rounded(s.reprojection_median_px)}, {"p95", Rounded(s.reprojection_p95_px)}}},
      {"ambiguous_frames", s.ambiguous_frames},
      {"found_by", found_by},
      {"visible_fraction",
       {{"min", Rounded(s.visible_min)}, {"median", Rounded(s.visible_median)}}},
      {"lost", {{"frames", lost.frames}, {"longest", lost.longest}}}};
}

Json AnchorsJson(const session::AnchorSummary& summary) {
  Json anchors = Json::array();
  for (const session::PlacedAnchor& anchor : summary.anchors) {
    Json one = {{"marker", anchor.marker.ToString()},
                {"frames", anchor.frames},
                {"place", anchor.is_given                ? "given"
                          : anchor.reference_from_anchor ? "found"
                                                         : "unknown"}};
    if (anchor.reference_from_anchor) {
      const Vec3& at = anchor.reference_from_anchor->translation_m;
      one["translation_m"] = {Rounded(at.x), Rounded(at.y), Rounded(at.z)};
    }
    anchors.push_back(std::move(one));
  }
  return {{"markers", anchors},
          {"frames_by_anchors", summary.by_anchors},
          {"filled_frames", summary.filled},
          {"gaps", summary.gaps},
          {"longest_gap_s", Rounded(summary.longest_gap_s)}};
}

Json TrajectoryJson(const session::TrajectorySummary& summary) {
  const session::TrajectoryAlignment& alignment = summary.alignment;
  const session::TrajectorySimilarity& similarity = alignment.marker_from_trajectory;
  constexpr double kNanosecond_s = 1e-9;
  const Vec3& t = similarity.translation_m;
  Json rotation = Json::array();
  for (const double element : similarity.rotation.m) rotation.push_back(Rounded(element));
  const char* unit = summary.by_points ? "m" : "px";
  Json json{{"file", summary.file},
            {"matched_by", summary.by_frame ? "frame" : "time"},
            {"offset_s", Rounded(static_cast<double>(summary.offset.offset_ns) * kNanosecond_s)},
            {"offset_deviation_s", nullptr},
            {"aligned_by", summary.by_points ? "places" : "marker"},
            {"used", alignment.used},
            {"outliers", alignment.outliers},
            {std::string("residual_rms_") + unit, Rounded(alignment.residual_rms)},
            {std::string("residual_max_") + unit, Rounded(alignment.residual_max)},
            {"marker_rms_px", nullptr},
            {"marker_from_trajectory",
             {{"scale", Rounded(similarity.scale)},
              {"rotation", std::move(rotation)},
              {"translation_m", {Rounded(t.x), Rounded(t.y), Rounded(t.z)}}}},
            {"centre_deviation_m", Rounded(summary.centre_deviation_m)},
            {"frames_by_trajectory", summary.frames.by_trajectory},
            {"frames_without_marker", summary.frames.without_marker},
            {"frames_by_marker", summary.frames.by_marker},
            {"filled_frames", summary.frames.filled},
            {"missing_frames", summary.frames.missing}};
  if (summary.offset.deviation_s) json["offset_deviation_s"] = Rounded(*summary.offset.deviation_s);
  if (summary.marker_rms_px) json["marker_rms_px"] = Rounded(*summary.marker_rms_px);
  if (summary.tilt) json["tilt_deg"] = Rounded(ToDegrees(*summary.tilt));
  return json;
}

Json TimingsJson(const ReplayReport& report) {
  Json timings = Json::array();
  for (const StageTimes::Summary& stage : report.timings) {
    timings.push_back({{"stage", stage.stage},
                       {"runs", stage.runs},
                       {"median_ms", Rounded(stage.median_ms)},
                       {"p95_ms", Rounded(stage.p95_ms)},
                       {"total_ms", Rounded(stage.total_ms)},
                       {"frames_per_s", Rounded(FramesPerSecond(report, stage))}});
  }
  return timings;
}

/// The maps that lie on the phantoms.
Json ContentJson(const std::vector<InkFacts>& maps) {
  Json content = Json::array();
  for (const InkFacts& map : maps) {
    content.push_back({{"kind", "drape"},
                       {"file", map.file},
                       {"crs", map.crs},
                       {"features", map.features},
                       {"shapes", map.shapes},
                       {"vertices_in", map.drape.vertices_in},
                       {"vertices_out", map.drape.vertices_out},
                       {"off_target", map.drape.off_target},
                       {"clipped", map.drape.clipped},
                       {"lay_milliseconds", Rounded(map.milliseconds)}});
  }
  return content;
}

}  // namespace

std::string ReportJson(const ReplayReport& report) {
  Json json;
  json["program"] = "pleinair";
  json["version"] = report.call.version;
  json["command"] = report.call.command;
  json["recording"] = report.call.recording;
  json["scene"] = report.call.scene_file;
  json["first_frame"] = report.film.first_frame;
  json["frames"] = report.film.frames;
  json["frames_with_pose"] = report.path.size();
  json["size_px"] = {report.film.width, report.film.height};
  json["frame_rate_hz"] = Rounded(report.film.frame_rate_hz);
  json["marker"] = report.reference_marker ? Json(report.reference_marker->ToString()) : Json();
  json["markers_seen"] = Json::array();
  for (const session::MarkerName& marker : report.markers)
    json["markers_seen"].push_back(marker.ToString());
  if (!report.placing.anchors.anchors.empty()) {
    json["anchors"] = AnchorsJson(report.placing.anchors);
  }
  if (report.placing.trajectory) json["trajectory"] = TrajectoryJson(*report.placing.trajectory);
  json["poses"] = report.path.empty() ? Json() : PosesJson(report);
  json["place_time"] = {{"latitude_deg", Rounded(report.scene.place_time.latitude_deg)},
                        {"longitude_deg", Rounded(report.scene.place_time.longitude_deg)},
                        {"height_m", Rounded(report.scene.place_time.height_m)},
                        {"start", report.scene.place_time.start.ToString()}};
  json["cloudiness"] = CloudinessName(report.scene.cloudiness);
  json["virtual_objects"] = report.scene.virtual_objects;
  json["phantoms"] = report.scene.phantoms;
  json["content"] = ContentJson(report.scene.maps);
  json["antialiasing"] = {{"method", compositor::NameOf(report.film.antialiasing.method)},
                          {"samples", SamplesOf(report.film)},
                          {"mixed_pixels", MixedPixelsOf(report)}};
  json["lens"] = report.light ? LensJson(report.light->camera, report.film.lens) : Json();
  json["motion"] = report.light ? MotionJson(report.light->camera, report.film.lens) : Json();
  json["light"] = report.light ? LightJson(*report.light) : Json();
  if (report.light) json["light"]["changes"] = ChangesJson(report.light_changes);
  json["video_encoder"] =
      report.files.video_encoder.empty() ? Json() : Json(report.files.video_encoder);
  json["outputs"] = report.files.outputs;
  json["warnings"] = report.warnings;
  json["timings"] = TimingsJson(report);
  return Dump(json, 1) + "\n";
}

std::string SummaryJson(const ReplayReport& report, const std::filesystem::path& folder) {
  Json json;
  json["folder"] = folder.string();
  json["frames"] = report.film.frames;
  json["frames_with_pose"] = report.path.size();
  json["marker"] = report.reference_marker ? Json(report.reference_marker->ToString()) : Json();
  json["outputs"] = report.files.outputs;
  json["warnings"] = report.warnings;
  json["timings"] = TimingsJson(report);
  return Dump(json, -1);
}

}  // namespace pleinair::app
