#include "accuracy/regression.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <utility>

#include "accuracy/statistics.h"

namespace pleinair::accuracy {
namespace {

struct Pair {
  const FrameRecord* before;
  const FrameRecord* after;
};

/// The frames of one scene.
using Scene = std::vector<Pair>;

std::string SceneOf(const FrameRecord& record, bool same_scenes) {
  if (same_scenes) return record.name;
  if (IsFilm(record)) return record.sweep + "/" + record.pattern;
  if (record.sweep == "jitter") return fmt::format("jitter/{}/{}", record.pattern, record.level);
  return record.name;
}

/// Scenes by sweep, in the order of the records.
std::vector<std::pair<std::string, std::vector<Scene>>> PairScenes(
    const std::vector<FrameRecord>& before, const std::vector<FrameRecord>& after,
    const RegressionOptions& options) {
  std::map<std::string, const FrameRecord*> after_by_name;
  for (const FrameRecord& record : after) {
    if (record.detector == options.detector) after_by_name[record.name] = &record;
  }
  std::vector<std::pair<std::string, std::vector<Scene>>> sweeps;
  std::map<std::string, std::size_t> sweep_places, scene_places;
  for (const FrameRecord& record : before) {
    if (record.detector != options.detector) continue;
    const auto other = after_by_name.find(record.name);
    if (other == after_by_name.end()) continue;
    const auto [sweep, new_sweep] = sweep_places.emplace(record.sweep, sweeps.size());
    if (new_sweep) sweeps.emplace_back(record.sweep, std::vector<Scene>());
    std::vector<Scene>& scenes = sweeps[sweep->second].second;
    const auto [scene, new_scene] =
        scene_places.emplace(SceneOf(record, options.same_scenes), scenes.size());
    if (new_scene) scenes.emplace_back();
    scenes[scene->second].push_back({&record, other->second});
  }
  return sweeps;
}

/// A count per frame; more is worse.
using Count = std::int64_t (*)(const FrameRecord&);
/// An error of a hit.
using ErrorOf = std::optional<double> (*)(const MarkerRecord&);

std::int64_t CountOutcome(const FrameRecord& record, Outcome outcome) {
  std::int64_t count = 0;
  for (const MarkerRecord& marker : record.markers) count += marker.outcome == outcome;
  return count;
}

Change CompareCounts(const std::vector<Scene>& scenes, Count count) {
  Change change;
  std::int64_t worse = 0, better = 0;
  for (const Scene& scene : scenes) {
    std::int64_t before = 0, after = 0;
    for (const Pair& pair : scene) {
      before += count(*pair.before);
      after += count(*pair.after);
    }
    change.before += static_cast<double>(before);
    change.after += static_cast<double>(after);
    worse += after > before;
    better += after < before;
  }
  change.pairs = static_cast<std::int64_t>(scenes.size());
  change.p_worse = SignTestGreater(worse, better);
  change.p_better = SignTestGreater(better, worse);
  return change;
}

/// The hit rate; its counts are those of markers that were not hit.
Change CompareRates(const std::vector<Scene>& scenes) {
  Change change = CompareCounts(scenes, [](const FrameRecord& record) {
    return static_cast<std::int64_t>(record.markers.size()) - CountOutcome(record, Outcome::kHit);
  });
  double markers = 0.0;
  for (const Scene& scene : scenes) {
    for (const Pair& pair : scene) markers += static_cast<double>(pair.before->markers.size());
  }
  change.before = 1.0 - change.before / markers;
  change.after = 1.0 - change.after / markers;
  return change;
}

Change CompareErrors(const std::vector<Scene>& scenes, ErrorOf error) {
  std::vector<double> differences, before, after;
  for (const Scene& scene : scenes) {
    double sum = 0.0;
    int count = 0;
    for (const Pair& pair : scene) {
      const auto& old_markers = pair.before->markers;
      const auto& new_markers = pair.after->markers;
      if (old_markers.size() != new_markers.size()) continue;
      for (std::size_t i = 0; i < old_markers.size(); ++i) {
        const auto old_error = error(old_markers[i]), new_error = error(new_markers[i]);
        if (!old_error || !new_error) continue;
        before.push_back(*old_error);
        after.push_back(*new_error);
        sum += *new_error - *old_error;
        ++count;
      }
    }
    if (count > 0) differences.push_back(sum / count);
  }
  Change change;
  change.pairs = static_cast<std::int64_t>(differences.size());
  change.before = Percentile(before, 0.5);
  change.after = Percentile(after, 0.5);
  change.p_worse = SignedRankGreater(differences);
  for (double& difference : differences) difference = -difference;
  change.p_better = SignedRankGreater(differences);
  return change;
}

std::optional<double> CornerError(const MarkerRecord& marker) {
  return marker.outcome == Outcome::kHit ? std::optional(marker.CornerRms()) : std::nullopt;
}

std::optional<double> RotationError(const MarkerRecord& marker) {
  return marker.pose ? std::optional(marker.pose->rotation_error_deg) : std::nullopt;
}

std::optional<double> TranslationError(const MarkerRecord& marker) {
  if (!marker.pose) return std::nullopt;
  return 100.0 * marker.pose->translation_error_m /
         Norm(marker.true_camera_from_marker.translation_m);
}

/// Adds all figures of these scenes.
void AddChanges(const std::string& sweep, const std::vector<Scene>& scenes,
                std::vector<Change>* changes) {
  const auto add = [&](const char* measure, Change change) {
    change.sweep = sweep;
    change.measure = measure;
    changes->push_back(std::move(change));
  };
  add("false_numbers", CompareCounts(scenes, [](const FrameRecord& record) {
        return static_cast<std::int64_t>(record.false_numbers);
      }));
  bool markers = false;
  for (const Scene& scene : scenes) markers = markers || !scene[0].before->markers.empty();
  if (!markers) return;
  add("rate", CompareRates(scenes));
  add("misplaced", CompareCounts(scenes, [](const FrameRecord& record) {
        return CountOutcome(record, Outcome::kMisplaced);
      }));
  add("corner_px", CompareErrors(scenes, CornerError));
  add("rotation_deg", CompareErrors(scenes, RotationError));
  add("translation_percent", CompareErrors(scenes, TranslationError));
}

/// Adds the composited images that both runs have.
void AddLightChanges(const std::vector<ImageRecord>& before, const std::vector<ImageRecord>& after,
                     std::vector<Change>* changes) {
  std::map<std::pair<std::string, std::string>, const ImageRecord*> after_by_name;
  for (const ImageRecord& picture : after) {
    after_by_name[{picture.recording, picture.picture}] = &picture;
  }
  for (std::size_t i = 0; i < kImageMeasures.size(); ++i) {
    std::vector<double> old_scores, new_scores, worse, better;
    for (const ImageRecord& picture : before) {
      const auto other = after_by_name.find({picture.recording, picture.picture});
      if (other == after_by_name.end()) continue;
      const auto old_score = picture.scores[i], new_score = other->second->scores[i];
      if (!old_score || !new_score) continue;
      old_scores.push_back(*old_score);
      new_scores.push_back(*new_score);
      const double sign = kImageMeasures[i].more_is_worse ? 1.0 : -1.0;
      worse.push_back(sign * (*new_score - *old_score));
      better.push_back(-worse.back());
    }
    if (worse.empty()) continue;
    Change change{.sweep = "light", .measure = kImageMeasures[i].name};
    change.pairs = static_cast<std::int64_t>(worse.size());
    change.before = MeanOf(old_scores);
    change.after = MeanOf(new_scores);
    change.p_worse = MeanGreater(worse, kImageMeasures[i].min_change);
    change.p_better = MeanGreater(better, kImageMeasures[i].min_change);
    changes->push_back(std::move(change));
  }
}

}  // namespace

std::vector<Change> CompareRuns(const RunRecords& before, const RunRecords& after,
                                const RegressionOptions& options) {
  std::vector<Change> changes;
  const auto sweeps = PairScenes(before.frames, after.frames, options);
  std::vector<Scene> all;
  for (const auto& [sweep, scenes] : sweeps) {
    AddChanges(sweep, scenes, &changes);
    all.insert(all.end(), scenes.begin(), scenes.end());
  }
  if (sweeps.size() > 1) AddChanges("all", all, &changes);
  AddLightChanges(before.pictures, after.pictures, &changes);
  std::vector<double> p_worse, p_better;
  for (const Change& change : changes) {
    p_worse.push_back(change.p_worse);
    p_better.push_back(change.p_better);
  }
  const std::vector<bool> worse = HolmRejections(p_worse, options.alpha);
  const std::vector<bool> better = HolmRejections(p_better, options.alpha);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i].worse = worse[i];
    changes[i].better = better[i];
  }
  return changes;
}

}  // namespace pleinair::accuracy
