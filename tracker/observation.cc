#include "tracker/observation.h"

namespace pleinair::tracker {

const char* TrajectoryName(DetectionPath path) {
  switch (path) {
    case DetectionPath::kFast:
      return "fast";
    case DetectionPath::kSurfGolay:
      return "surf-golay";
    case DetectionPath::kTracked:
      return "tracked";
  }
  return "fast";
}

}  // namespace pleinair::tracker
