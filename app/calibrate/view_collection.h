#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "app/calibrate/picture_stream.h"
#include "base/camera_model.h"
#include "tracker/calibration/board_finder.h"

namespace pleinair::app {

/// A board in a picture.
struct CollectedView {
  tracker::BoardView view;
  GreyImage grey;
};

struct Collection {
  int width = 0, height = 0;
  int looked_at = 0;  ///< Pictures.
  std::vector<CollectedView> views;
};

struct CollectionOptions {
  int max_views = 60;
  std::optional<double> seconds;  ///< For cameras.
  bool quiet = false;             ///< Says nothing of single views.
};

/// Looks for the board in all pictures, and picks views that differ out of films. Errors (input):
/// pictures that cannot be read, of different sizes, none with the board; (system): interrupted.
Result<Collection> CollectViews(PictureStream& pictures, tracker::BoardFinder& finder,
                                const CollectionOptions& options);

}  // namespace pleinair::app
