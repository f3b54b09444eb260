#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/image.h"
#include "base/image_size.h"
#include "tracker/calibration/marker_lens.h"
#include "tracker/marker_pattern.h"
#include "tracker/parallel_trackers.h"
#include "tracker/tracker.h"
#include "tracker/unmeasured_markers.h"

namespace pleinair::tracker {

struct MarkerViewOptions {
  std::vector<std::string> families{"sg", "tag36h11"};  ///< Marker families to detect.
  std::size_t max_views = 120;
  /// The images are consecutive frames: those in which the marker moves fast are left out.
  bool consecutive_frames = true;
  /// Images that do not follow each other are given to Add() in groups of at most this number.
  std::size_t images_at_once = 8;
};

/// An image and its name for messages.
struct NamedImage {
  std::string name;
  ImageView<const std::uint8_t> grey;
};

/// Collects the views of markers from a film, and measures them from all their cells. Views differ
/// from each other by at least 1 % of the image's width, and by more where there are too many.
class MarkerViewCollector {
 public:
  /// Errors (input): an unknown family.
  static Result<MarkerViewCollector> Create(ImageSize size, const MarkerViewOptions& options);

  /// Takes the next images, which have the collector's size. Returns how many show a marker. Keeps
  /// a cut-out of each where the marker is seen as a whole, at a new place. Images that do not
  /// follow each other are searched in parallel.
  Result<int> Add(std::span<const NamedImage> images);

  /// The corners of the collected views, by an alignment of all cells through this lens
  /// (refinement/marker_alignment.h). Views that cannot be aligned are left out. Uses all
  /// processors.
  std::vector<MarkerView> Measure(const CameraModel& camera) const;

  std::size_t count() const { return kept_.size(); }

 private:
  using Corners = std::array<Vec2, 4>;
  struct Kept {
    std::string name;
    int which = 0;  ///< Index in markers_.
    Corners corners_px{};
    GreyImage cut_out;
    int left = 0, top = 0;  ///< Place of the cut-out in the image.
  };
  /// A marker and where it was seen last.
  struct Marker {
    std::string family;
    int id = 0;
    MarkerPattern pattern;
    Corners last_px{};
    std::int64_t last_image = -2;
  };

  MarkerViewCollector(ImageSize size, const MarkerViewOptions& options)
      : size_(size), options_(options) {}
  Result<std::vector<UnmeasuredMarkers>> Find(std::span<const NamedImage> images);
  /// Returns whether the image shows a marker.
  bool Take(const NamedImage& image, const UnmeasuredMarkers& found);
  /// Index in markers_; -1 for a marker without a known pattern.
  int WhichMarker(const MarkerDetection& detection);
  bool IsNew(int which, const Corners& corners_px, std::size_t among) const;
  void Keep(const std::string& name, int which, const Corners& corners_px,
            ImageView<const std::uint8_t> grey);

  ImageSize size_;
  MarkerViewOptions options_;
  std::unique_ptr<Tracker> tracker_;            // For consecutive frames,
  std::optional<ParallelTrackers> trackers_{};  // for others.
  double spacing_px_ = 0.0;
  std::int64_t images_ = 0;
  std::vector<Marker> markers_;
  std::vector<Kept> kept_;
};

}  // namespace pleinair::tracker
