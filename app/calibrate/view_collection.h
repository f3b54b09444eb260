#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "app/calibrate/picture_stream.h"
#include "base/camera_model.h"
#include "tracker/calibration/board_finder.h"

namespace pleinair::app {

/// A board in an image.
struct CollectedView {
  tracker::BoardView view;
  GreyImage grey;
};

struct Collection {
  int width = 0, height = 0;
  int looked_at = 0;  ///< Images.
  std::vector<CollectedView> views;
};

struct CollectionOptions {
  int max_views = 60;
  std::optional<double> seconds;  ///< For cameras.
  bool quiet = false;             ///< No messages about single views.
};

/// Detects the board in all images, and selects different views from videos. Errors (input): images
/// that cannot be read, have different sizes, or none with the board; (system): interrupted.
Result<Collection> CollectViews(PictureStream& pictures, tracker::BoardFinder& finder,
                                const CollectionOptions& options);

}  // namespace pleinair::app
