#include "app/replay/report_frames.h"

#include <cstddef>

#include "session/light_frames.h"

namespace pleinair::app {
namespace {

constexpr std::size_t kReportPictures = 4;

}  // namespace

std::set<std::int64_t> ReportFrames(const std::vector<session::Observation>& path,
                                    std::int64_t first, std::int64_t frames) {
  using session::EvenlySpread;
  std::set<std::int64_t> shown;
  if (path.empty()) {
    for (const std::size_t at : EvenlySpread(static_cast<std::size_t>(frames), kReportPictures)) {
      shown.insert(first + static_cast<std::int64_t>(at));
    }
  } else {
    for (const std::size_t at : EvenlySpread(path.size(), kReportPictures)) {
      shown.insert(path[at].frame_index);
    }
  }
  return shown;
}

}  // namespace pleinair::app
