#include "app/print_measurer.h"

#include <optional>

#include "app/scene_marker.h"
#include "base/units.h"
#include "tracker/planar_pose.h"
#include "tracker/print_alignment.h"

namespace pleinair::app {

std::vector<tracker::Sighting> PrintMeasurer::Measure(ImageView<const std::uint8_t> grey,
                                                      std::vector<tracker::Sighting> sightings) {
  for (tracker::Sighting& sighting : sightings) {
    if (sighting.detection.family == kSgFamily) MeasureOne(grey, &sighting);
  }
  return sightings;
}

void PrintMeasurer::MeasureOne(ImageView<const std::uint8_t> grey, tracker::Sighting* sighting) {
  tracker::MarkerDetection& detection = sighting->detection;
  const MarkerName name{detection.family, detection.id};
  Marker& marker = markers_[name];
  if (!marker.pattern) marker.pattern = PatternOf(name);
  const std::optional<tracker::PrintAlignment> alignment =
      tracker::AlignPrint(camera_, *marker.pattern, grey, detection.corners_px,
                          {detection.visibility_side, detection.visibility});
  if (alignment) {
    const std::optional<tracker::PoseEstimate> pose = tracker::EstimatePlanarPose(
        camera_, alignment->corners_px, alignment->corner_covariance_px2, Metres(marker_size_m_),
        marker.seen ? &marker.last_rotation : nullptr);
    if (pose) {
      // The share that is seen stays the tracker's: its blocks tell it better where much is hidden.
      detection.corners_px = alignment->corners_px;
      sighting->pose = *pose;
    }
  }
  marker.last_rotation = sighting->pose.best.camera_from_marker.rotation;
  marker.seen = true;
}

}  // namespace pleinair::app
