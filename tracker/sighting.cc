#include "tracker/sighting.h"

namespace pleinair::tracker {

const char* PathName(DetectionPath path) {
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
