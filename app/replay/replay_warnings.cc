#include "app/replay/replay_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

#include "app/replay/light_contradiction.h"
#include "app/replay/trajectory_warnings.h"
#include "compositor/lens/disc_kernel.h"
#include "compositor/passes/render_targets.h"

namespace pleinair::app {
namespace {

// A model with many unsupported features must not fill the report.
constexpr std::size_t kMaxKinds = 8;
constexpr double kNoticeableTurnDeg = 1.0;
// With locked exposure, the exposure scale varies by a few hundredths.
constexpr double kNoticeableExposureChange = 1.3;
// End of civil dusk: nobody films in this light.
constexpr double kNightDeg = -6.0;

/// The scene's marker as text: "sg_17", "tag36h11", "number 5 of sg or tag36h11", "sg or tag36h11".
std::string Described(const scene::MarkerDescription& marker) {
  if (marker.target) return "the picture of " + marker.target->filename().string();
  if (marker.family) {
    return *marker.family + (marker.id ? "_" + std::to_string(*marker.id) : "");
  }
  return marker.id ? fmt::format("number {} of sg or tag36h11", *marker.id) : "sg or tag36h11";
}

/// Why the color of a surface was not measured.
const char* ReasonOf(compositor::SurfaceColor::Outcome outcome) {
  using Outcome = compositor::SurfaceColor::Outcome;
  switch (outcome) {
    case Outcome::kClipped:
      return "most of it is too bright or too dark in the frames";
    case Outcome::kUneven:
      return "it has no color that prevails";
    case Outcome::kImpossible:
      return "in this light no real surface looks so";
    case Outcome::kNoLight:
      return "the light is not known";
    case Outcome::kTooFew:
    case Outcome::kMeasured:
      break;
  }
  return "too little of it is seen";
}

std::string NeverSeen(const ReplayReport& report, const scene::MarkerDescription& marker) {
  std::string seen;
  for (const session::MarkerName& other : report.markers) seen += " " + other.ToString();
  std::string sentence =
      fmt::format("The scene's marker ({}) was seen in no frame, so nothing was drawn. Seen:{}.",
                  Described(marker), seen.empty() ? " no other either" : seen);
  if (marker.id && marker.family.value_or("sg") == "sg") {
    sentence += fmt::format(
        " Of the S-G markers, only number {} was searched for; to search for all, remove the id "
        "from the scene.",
        *marker.id);
  }
  return sentence;
}

/// True if the frames show sun and sky separately, so that a change of exposure is known to be one.
bool AreToldApart(const std::vector<LightRow>& rows) {
  using Source = compositor::FrameLight::Source;
  const auto is = [](Source source) {
    return [source](const LightRow& row) { return row.source == source; };
  };
  if (std::any_of(rows.begin(), rows.end(), is(Source::kStated))) return true;
  return std::any_of(rows.begin(), rows.end(), is(Source::kSurfaces)) &&
         std::none_of(rows.begin(), rows.end(), is(Source::kTotalOnly));
}

std::vector<std::string> AnchorWarnings(const session::AnchorSummary& summary) {
  std::vector<std::string> warnings;
  for (const session::PlacedAnchor& anchor : summary.anchors) {
    if (anchor.frames == 0) {
      warnings.push_back(fmt::format("No frame shows the anchor {}.", anchor.marker.ToString()));
    } else if (!anchor.reference_from_anchor) {
      warnings.push_back(fmt::format(
          "The anchor {} is not used: no frame shows it beside another marker, so its place is not "
          "known. Film both together, or give its translation_m.",
          anchor.marker.ToString()));
    }
  }
  if (summary.by_anchors > 0) {
    warnings.push_back(
        fmt::format("{} frames have their pose from the anchors alone.", summary.by_anchors));
  }
  if (summary.filled > 0) {
    warnings.push_back(fmt::format(
        "{} frames show no marker and have their pose from the camera's motion before and after: "
        "{} gaps of at most {:.2f} s.",
        summary.filled, summary.gaps, summary.longest_gap_s));
  }
  return warnings;
}

/// What the frames show against the scene's sun and sky, and what is made of it; or nothing.
std::string ContradictionSentence(const compositor::MeasuredLight& light) {
  const LightContradiction contradiction = ContradictionOf(light);
  std::string sentence = SeenText(contradiction, light);
  if (sentence.empty()) return sentence;
  sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
  switch (contradiction) {
    case LightContradiction::kNone:
      break;
    case LightContradiction::kNoSunlight:
    case LightContradiction::kShadowsMissing:
      return sentence +
             ": the sky is assumed overcast. If the sun shone, check place, time and heading, or "
             "give --sun-to-sky.";
    case LightContradiction::kShadowsVisible:
    case LightContradiction::kMarkerDivided:
      return sentence +
             ": the sun is assumed to shine, although the scene describes an overcast sky.";
    case LightContradiction::kShadowsElsewhere:
      return sentence +
             ": it is uncertain whether the sun shone, and the scene's sky is kept. Check place, "
             "time and heading, or give --sun-to-sky.";
    case LightContradiction::kSunElsewhere:
      return sentence +
             ": time or heading is wrong, or both, and the scene's sky is kept. Check them; "
             "'pleinair check' names values that fit.";
  }
  return sentence;
}

}  // namespace

std::vector<std::string> MarkerWarnings(const ReplayReport& report,
                                        const session::MarkerTracks& marker_tracks,
                                        const scene::SceneDescription& scene) {
  std::vector<std::string> warnings;
  const auto missing = report.film.frames - static_cast<std::int64_t>(report.path.size());
  if (report.placing.trajectory) {
    warnings = TrajectoryWarnings(*report.placing.trajectory);
  } else if (!report.reference_marker) {
    warnings.push_back(NeverSeen(report, scene.marker));
  } else if (missing > 0) {
    warnings.push_back(
        fmt::format("{} of {} frames show no marker {}: they are left as they were recorded.",
                    missing, report.film.frames, report.reference_marker->ToString()));
  }
  for (std::string& sentence : AnchorWarnings(report.placing.anchors)) {
    warnings.push_back(std::move(sentence));
  }
  if (marker_tracks.frames_with_duplicates() > 0) {
    warnings.push_back(
        fmt::format("{} frames show a marker of the same number twice: the one nearest to its last "
                    "position is used.",
                    marker_tracks.frames_with_duplicates()));
  }
  const std::int64_t ambiguous = SummarizeTrajectory(report.path).ambiguous_frames;
  if (ambiguous > 0) {
    warnings.push_back(
        fmt::format("In {} frames the marker's tilt is ambiguous: it is too small or seen too "
                    "frontally. Film from nearer or more from the side.",
                    ambiguous));
  }
  return warnings;
}

std::vector<std::string> ModelWarnings(const std::vector<compositor::PlacedModel>& models) {
  // By file: a file may be both a phantom and an object.
  std::map<std::filesystem::path, std::set<std::string>> by_file;
  for (const compositor::PlacedModel& placed : models) {
    if (placed.is_phantom) continue;  // It only reflects light: these features do not matter.
    std::set<std::string> unsupported_features = compositor::UnsupportedFeatures(*placed.model);
    by_file[placed.model->file].merge(unsupported_features);
  }
  std::vector<std::string> warnings;
  for (auto& [file, unsupported_features] : by_file) {
    if (unsupported_features.empty()) continue;
    const std::size_t more =
        unsupported_features.size() - std::min(unsupported_features.size(), kMaxKinds);
    for (std::size_t i = 0; i < more; ++i)
      unsupported_features.erase(std::prev(unsupported_features.end()));
    warnings.push_back(fmt::format("{} uses features that are not drawn: {}{}.", file.string(),
                                   fmt::join(unsupported_features, ", "),
                                   more > 0 ? fmt::format(" and {} more", more) : ""));
  }
  return warnings;
}

std::vector<std::string> DrawingWarnings(std::optional<int> samples) {
  constexpr int kWanted = compositor::RenderTargets::kWantedSamples;
  if (!samples || *samples >= kWanted) return {};
  return {
      fmt::format("The renderer gives {} of {} samples a pixel: edges of virtual objects are "
                  "coarser than the camera's own. 'pleinair doctor' names the renderer.",
                  *samples, kWanted)};
}

std::vector<std::string> CloudWarnings(const scene::SceneDescription& scene) {
  if (!scene.clouds.ignored_word || *scene.clouds.ignored_word == scene::Cloudiness::kClear) {
    return {};
  }
  return {
      fmt::format("cloudiness = \"{}\" is not used: the layers of clouds of the scene are its "
                  "clouds, and the sky between them is clear.",
                  CloudinessName(*scene.clouds.ignored_word))};
}

std::vector<std::string> LensWarnings(const compositor::FocusFit& fit, bool is_asked_for) {
  std::vector<std::string> warnings;
  if (!fit.is_measured() && is_asked_for) {
    warnings.push_back("Focus and aperture could not be measured: " + fit.reason +
                       ". Nothing is blurred by its distance. Film the marker from near it to "
                       "twice that distance, or state both with --focus and --aperture-mm.");
  }
  if (!fit.changes.empty()) {
    warnings.emplace_back(
        "The focus changes during the recording. A calibration holds for one focus only: hold the "
        "camera's focus, and calibrate at it.");
  }
  return warnings;
}

std::string ExposureWarning(const compositor::ExposureFit& fit) {
  return "The exposure could not be measured: " + fit.reason +
         ". Nothing is blurred by the camera's motion. State it with --exposure-ms.";
}

std::vector<std::string> BlurWarnings(const session::CameraSummary& drawn) {
  constexpr double kLargest_px = compositor::DiscKernels::kMaxCircle_px;
  if (!drawn.lens || drawn.lens_places != compositor::kByLayers ||
      drawn.drawn_lens.largest_circle_px <= kLargest_px) {
    return {};
  }
  return {
      fmt::format("Circles of confusion of up to {:.0f} pixels are drawn with {:.0f}. Draw them "
                  "whole with --defocus-method lens:256, or reduce --size.",
                  drawn.drawn_lens.largest_circle_px, kLargest_px)};
}

std::vector<std::string> LightWarnings(const session::LightSummary& summary,
                                       const std::vector<LightRow>& rows) {
  const compositor::MeasuredLight& light = summary.measured;
  std::vector<std::string> warnings;
  if (summary.exposure_scale_source == session::LightSummary::ExposureScaleSource::kGuess) {
    warnings.emplace_back(
        "The exposure could not be estimated from the marker in any frame and is guessed. Set "
        "exposure_gain in the scene if the brightness is wrong.");
  }
  if (summary.exposures.change > kNoticeableExposureChange && !AreToldApart(rows)) {
    warnings.push_back(
        fmt::format("The marker's brightness changed by a factor of {:.1f}. It is attributed to "
                    "the camera's exposure, and sun and sky are assumed constant: if a cloud "
                    "passed, shadows are too dark or too faint before or after it. Replay the "
                    "parts one by one, or film with locked exposure.",
                    summary.exposures.change));
  }
  for (const session::SurfaceColorSummary& color : summary.surface_colors) {
    if (color.measured.outcome == compositor::SurfaceColor::Outcome::kMeasured) continue;
    warnings.push_back(
        fmt::format("The color of {} could not be measured: {}. {:.2f} {:.2f} {:.2f} is assumed. "
                    "Give its color in the scene if the light from it matters{}",
                    color.surface, ReasonOf(color.measured.outcome), color.reflectance.r,
                    color.reflectance.g, color.reflectance.b,
                    color.measured.outcome == compositor::SurfaceColor::Outcome::kImpossible
                        ? ", and let 'pleinair check' judge cloudiness and time."
                        : "."));
  }
  if (summary.response.source == session::ResponseSummary::Source::kMeasured) {
    warnings.push_back(
        fmt::format("The camera does not encode light as sRGB: its response was estimated from the "
                    "frames, light within {:.0f} %. 'pleinair response' writes it to a file for "
                    "--response; --response srgb keeps sRGB.",
                    100 * summary.response.log_error));
  }
  const double elevation_deg = ToDegrees(summary.sun.elevation);
  if (elevation_deg < kNightDeg) {
    warnings.push_back(
        fmt::format("It is night at the scene's place and time: the sun is {:.1f} degrees below "
                    "the horizon. Check place, time and the time's offset from UTC.",
                    -elevation_deg));
  }
  std::string contradiction = ContradictionSentence(light);
  if (!contradiction.empty()) warnings.push_back(std::move(contradiction));
  const double turn_deg = ToDegrees(light.heading_offset);
  if (std::abs(turn_deg) > kNoticeableTurnDeg) {
    warnings.push_back(
        fmt::format("The shadows fit a marker heading {:+.1f} degrees from the scene's, and this "
                    "heading is used. Correct marker.heading_deg in the scene if it is right.",
                    turn_deg));
  }
  return warnings;
}

std::string NoObjectWarning(bool replaces_own) {
  std::string warning = "The scene has no virtual object: the frames are unchanged.";
  if (replaces_own) {
    warning +=
        " A scene given with --scene takes place, time, sky and marker from the recording's own, "
        "but "
        "no models: add [[object]] and [[phantom]] to it.";
  }
  return warning;
}

}  // namespace pleinair::app
