#include "tracker/parallel_trackers.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <optional>
#include <thread>
#include <utility>

#include "base/check.h"
#include "base/parallel_for.h"

namespace pleinair::tracker {
namespace {

/// `work(tracker, image)` of each image, in their order.
template <typename Value, typename Work>
Result<std::vector<Value>> OfEachImage(const std::vector<std::unique_ptr<Tracker>>& trackers,
                                       std::span<const ImageView<const std::uint8_t>> greys,
                                       const Work& work) {
  std::vector<std::optional<Result<Value>>> results(greys.size());
  std::atomic<std::size_t> next{0};
  ParallelFor(trackers.size(), static_cast<int>(trackers.size()), [&](std::size_t which) {
    for (std::size_t i = next++; i < greys.size(); i = next++) {
      results[i] = work(*trackers[which], greys[i]);
    }
  });
  std::vector<Value> values;
  values.reserve(results.size());
  for (auto& result : results) {
    if (!*result) return tl::make_unexpected(std::move(*result).error());
    values.push_back(**std::move(result));
  }
  return values;
}

}  // namespace

Result<ParallelTrackers> ParallelTrackers::Create(const CameraModel& camera,
                                                  const TrackerOptions& options,
                                                  std::size_t images) {
  CHECK_EQ(options.consecutive_frames, false);
  ParallelTrackers parallel;
  const auto threads = static_cast<std::size_t>(std::thread::hardware_concurrency());
  for (std::size_t i = 0; i < std::clamp<std::size_t>(threads, 1, images); ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(auto tracker, Tracker::Create(camera, options));
    parallel.trackers_.push_back(std::move(tracker));
  }
  return parallel;
}

Result<std::vector<UnmeasuredMarkers>> ParallelTrackers::Find(
    std::span<const ImageView<const std::uint8_t>> greys) {
  return OfEachImage<UnmeasuredMarkers>(
      trackers_, greys,
      [](Tracker& tracker, ImageView<const std::uint8_t> grey) { return tracker.Find(grey); });
}

Result<std::vector<std::vector<MarkerObservation>>> ParallelTrackers::Track(
    std::span<const ImageView<const std::uint8_t>> greys) {
  return OfEachImage<std::vector<MarkerObservation>>(
      trackers_, greys,
      [](Tracker& tracker, ImageView<const std::uint8_t> grey) { return tracker.Track(grey); });
}

}  // namespace pleinair::tracker
