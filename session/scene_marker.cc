#include "session/scene_marker.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tracker/april_tag_detector.h"
#include "tracker/golay/golay_code.h"
#include "tracker/picture_target/target_file.h"
#include "tracker/surf_golay/sg_layout.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::session {
namespace {

/// Families of a marker without a declared family: ours, or the tag that most people have at hand.
constexpr const char* kUsualTagFamily = "tag36h11";

/// Default edge of the white margin over that of the black square.
constexpr double kUsualBoard = 1.25;

/// Number of outermost rings that are completely black, within the square of the reported corners.
int BlackRings(const tracker::MarkerPattern& pattern) {
  const int first = (pattern.modules - pattern.edge_modules) / 2;
  const auto is_black = [&](int ring) {
    const int low = first + ring, high = first + pattern.edge_modules - 1 - ring;
    for (int i = low; i <= high; ++i) {
      for (const auto& [x, y] : {std::pair{i, low}, {i, high}, {low, i}, {high, i}}) {
        if (pattern.white[static_cast<std::size_t>(y) * pattern.modules + x] != 0) return false;
      }
    }
    return true;
  };
  int rings = 0;
  while (2 * rings < pattern.edge_modules && is_black(rings)) ++rings;
  return rings;
}

}  // namespace

Result<tracker::TrackerOptions> TrackingOf(const scene::SceneDescription& scene) {
  const scene::MarkerDescription& marker = scene.marker;
  tracker::TrackerOptions options;
  options.consecutive_frames = true;
  if (marker.target) {
    PLEINAIR_ASSIGN_OR_RETURN(tracker::PictureTarget target,
                              tracker::ReadTargetFile(*marker.target));
    options.families.clear();
    options.targets = {std::make_shared<const tracker::PictureTarget>(std::move(target))};
    return options;
  }
  const bool may_be_sg = marker.family.value_or(kSgFamily) == kSgFamily;
  if (may_be_sg && marker.version && *marker.version != tracker::sg::kVersion) {
    return InputError(scene.file.string(),
                      "has an S-G marker of version " + std::to_string(*marker.version),
                      "this program reads version " + std::to_string(tracker::sg::kVersion));
  }
  options.families = marker.family ? std::vector<std::string>{*marker.family}
                                   : std::vector<std::string>{kSgFamily, kUsualTagFamily};
  options.marker_size_m = marker.size_m;
  if (may_be_sg && marker.id) options.sg.numbers_in_use = {*marker.id};
  for (const scene::AnchorDescription& anchor : scene.anchors) {
    if (std::ranges::count(options.families, anchor.family) == 0) {
      options.families.push_back(anchor.family);
    }
    if (anchor.family == kSgFamily) options.sg.numbers_in_use.push_back(anchor.id);
  }
  return options;
}

std::shared_ptr<const tracker::MarkerPattern> PatternOf(const MarkerName& marker) {
  if (marker.family != kSgFamily) return tracker::AprilTagPattern(marker.family, marker.id);
  if (marker.id < 0 || marker.id >= tracker::kGolayNumbers) return nullptr;
  return std::make_shared<const tracker::MarkerPattern>(tracker::SgMarkerPattern(marker.id));
}

scene::MarkerReflectance MarkerReflectanceOf(const scene::MarkerDescription& described,
                                             const MarkerName& marker) {
  scene::MarkerReflectance marker_reflectance;
  marker_reflectance.size_m = described.size_m;
  marker_reflectance.board_size_m =
      described.board_size_m > 0.0 ? described.board_size_m : described.size_m * kUsualBoard;
  marker_reflectance.albedo_black = described.albedo_black;
  marker_reflectance.albedo_white = described.albedo_white;
  if (const auto pattern = PatternOf(marker)) {
    // Families whose square is white outside have no black ring; the meter detects this itself.
    marker_reflectance.black_band_m =
        described.size_m * std::max(1, BlackRings(*pattern)) / pattern->edge_modules;
  }
  return marker_reflectance;
}

compositor::MarkerVisibility VisibilityOf(const scene::MarkerDescription& described,
                                          const MarkerName& marker, const Observation& seen) {
  const auto pattern = PatternOf(marker);
  if (pattern == nullptr || seen.visibility_side <= 0) return {};
  return {seen.visibility_side, described.size_m * pattern->Extent(), seen.visibility};
}

}  // namespace pleinair::session
