#include "tracker/calibration/marker_views.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/parallel_for.h"
#include "tracker/april_tag_detector.h"
#include "tracker/refinement/marker_alignment.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {
namespace {

// Relative to the image's width. A marker that moves more from frame to frame is blurred, and
// distorted by rolling shutters.
constexpr double kStillMarker = 0.01;
constexpr double kNewMarkerView = 0.01;
constexpr double kWiderSpacing = 1.25;
/// Covered cells distort the fit slightly; the film has other views.
constexpr double kWhole = 0.97;
/// White around the outermost cells that a cut-out holds, relative to the marker's extent.
constexpr double kCutOutMargin = 0.35;
constexpr double kCutOutBorder_px = 8.0;

double MeanDistance(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += Norm(a[i] - b[i]);
  return sum / 4.0;
}

/// A lens with which markers are found; any ordinary one suffices.
CameraModel OrdinaryLens(ImageSize size) {
  CameraModel camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.fx = camera.fy = 0.9 * std::max(size.width, size.height);
  camera.cx = 0.5 * (size.width - 1);
  camera.cy = 0.5 * (size.height - 1);
  return camera;
}

}  // namespace

Result<MarkerViewCollector> MarkerViewCollector::Create(ImageSize size,
                                                        const MarkerViewOptions& options) {
  MarkerViewCollector collector(size, options);
  collector.spacing_px_ = kNewMarkerView * size.width;
  TrackerOptions tracking;
  tracking.families = options.families;
  tracking.marker_size_m = 1.0;  // The lens does not depend on it.
  tracking.consecutive_frames = options.consecutive_frames;
  const CameraModel lens = OrdinaryLens(size);
  if (options.consecutive_frames) {
    PLEINAIR_ASSIGN_OR_RETURN(collector.tracker_, Tracker::Create(lens, tracking));
  } else {
    PLEINAIR_ASSIGN_OR_RETURN(collector.trackers_,
                              ParallelTrackers::Create(lens, tracking, options.images_at_once));
  }
  return collector;
}

Result<int> MarkerViewCollector::Add(std::span<const NamedImage> images) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<UnmeasuredMarkers> found, Find(images));
  int with_marker = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    with_marker += Take(images[i], found[i]) ? 1 : 0;
  }
  return with_marker;
}

Result<std::vector<UnmeasuredMarkers>> MarkerViewCollector::Find(
    std::span<const NamedImage> images) {
  if (trackers_) {
    std::vector<ImageView<const std::uint8_t>> greys;
    greys.reserve(images.size());
    for (const NamedImage& image : images) greys.push_back(image.grey);
    return trackers_->Find(greys);
  }
  std::vector<UnmeasuredMarkers> found;
  found.reserve(images.size());
  for (const NamedImage& image : images) {
    PLEINAIR_ASSIGN_OR_RETURN(UnmeasuredMarkers markers, tracker_->Find(image.grey));
    found.push_back(std::move(markers));
  }
  return found;
}

bool MarkerViewCollector::Take(const NamedImage& image, const UnmeasuredMarkers& found) {
  const std::int64_t number = images_++;
  bool any = false;
  for (const Candidate& candidate : found.candidates) {
    const MarkerDetection& detection = candidate.detection;
    const int which = WhichMarker(detection);
    if (which < 0) continue;
    any = true;
    Marker& marker = markers_[static_cast<std::size_t>(which)];
    const bool followed = marker.last_image == number - 1;
    const bool still = followed && MeanDistance(marker.last_px, detection.corners_px) <=
                                       kStillMarker * size_.width;
    marker.last_px = detection.corners_px;
    marker.last_image = number;
    const auto seen = CornersSeen(image.grey, detection.corners_px);
    const bool whole = detection.visible_fraction >= kWhole &&
                       std::all_of(seen.begin(), seen.end(), [](bool corner) { return corner; });
    if (!whole || (options_.consecutive_frames && !still)) continue;
    if (!IsNew(which, detection.corners_px, kept_.size())) continue;
    Keep(image.name, which, detection.corners_px, image.grey);
  }
  return any;
}

int MarkerViewCollector::WhichMarker(const MarkerDetection& detection) {
  if (!detection.id) return -1;
  const int id = *detection.id;
  for (std::size_t i = 0; i < markers_.size(); ++i) {
    if (markers_[i].id == id && markers_[i].family == detection.family) {
      return static_cast<int>(i);
    }
  }
  Marker marker{detection.family, id, {}, {}, -2};
  if (detection.family == "sg") {
    marker.pattern = SgMarkerPattern(id);
  } else if (const auto pattern = AprilTagPattern(detection.family, id)) {
    marker.pattern = *pattern;
  } else {
    return -1;
  }
  markers_.push_back(std::move(marker));
  return static_cast<int>(markers_.size()) - 1;
}

bool MarkerViewCollector::IsNew(int which, const Corners& corners_px, std::size_t among) const {
  return std::none_of(
      kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(among), [&](const Kept& kept) {
        return kept.which == which && MeanDistance(kept.corners_px, corners_px) < spacing_px_;
      });
}

void MarkerViewCollector::Keep(const std::string& name, int which, const Corners& corners_px,
                               ImageView<const std::uint8_t> grey) {
  Vec2 least = corners_px[0], most = least;
  for (const Vec2 corner : corners_px) {
    least = {std::min(least.x, corner.x), std::min(least.y, corner.y)};
    most = {std::max(most.x, corner.x), std::max(most.y, corner.y)};
  }
  const Vec2 margin{kCutOutMargin * (most.x - least.x) + kCutOutBorder_px,
                    kCutOutMargin * (most.y - least.y) + kCutOutBorder_px};
  Kept kept;
  kept.name = name;
  kept.which = which;
  kept.corners_px = corners_px;
  kept.left = std::max(0, static_cast<int>(std::floor(least.x - margin.x)));
  kept.top = std::max(0, static_cast<int>(std::floor(least.y - margin.y)));
  const int right = std::min(size_.width, static_cast<int>(std::ceil(most.x + margin.x)) + 1);
  const int bottom = std::min(size_.height, static_cast<int>(std::ceil(most.y + margin.y)) + 1);
  kept.cut_out = CopyImage(ImageView<const std::uint8_t>(
      grey.row(kept.top) + kept.left, right - kept.left, bottom - kept.top, 1, grey.stride()));
  kept_.push_back(std::move(kept));
  while (kept_.size() > options_.max_views) {
    if (spacing_px_ > std::hypot(size_.width, size_.height)) {
      kept_.resize(options_.max_views);  // One view of each marker is left.
      break;
    }
    spacing_px_ *= kWiderSpacing;
    std::size_t count = 0;
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      if (!IsNew(kept_[i].which, kept_[i].corners_px, count)) continue;
      if (i != count) kept_[count] = std::move(kept_[i]);
      ++count;
    }
    kept_.resize(count);
  }
}

std::vector<MarkerView> MarkerViewCollector::Measure(const CameraModel& camera) const {
  std::vector<std::optional<MarkerView>> measured(kept_.size());
  ParallelFor(kept_.size(), 0, [&](std::size_t i) {
    const Kept& kept = kept_[i];
    const Vec2 offset{static_cast<double>(kept.left), static_cast<double>(kept.top)};
    CameraModel cut = camera;
    cut.width = kept.cut_out.width();
    cut.height = kept.cut_out.height();
    cut.cx -= offset.x;
    cut.cy -= offset.y;
    Corners corners_px = kept.corners_px;
    for (Vec2& corner : corners_px) corner = corner - offset;
    const auto aligned = AlignMarker(cut, markers_[static_cast<std::size_t>(kept.which)].pattern,
                                     kept.cut_out.view(), corners_px);
    if (!aligned || aligned->visible_fraction < kWhole) return;
    MarkerView view{kept.name, aligned->corners_px, aligned->corner_covariance_px2};
    for (Vec2& corner : view.corners_px) corner = corner + offset;
    measured[i] = std::move(view);
  });
  std::vector<MarkerView> views;
  for (auto& view : measured) {
    if (view) views.push_back(*std::move(view));
  }
  return views;
}

}  // namespace pleinair::tracker
