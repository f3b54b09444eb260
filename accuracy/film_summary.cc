#include "accuracy/film_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "accuracy/trajectory_error.h"

namespace pleinair::accuracy {
namespace {

double Deviation(const std::vector<double>& values) {
  const double mean = MeanOf(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

JitterSummary JitterOf(const std::vector<const MarkerRecord*>& hits) {
  JitterSummary summary;
  summary.frames = static_cast<std::int64_t>(hits.size());
  for (int corner = 0; corner < 4; ++corner) {
    for (const bool along_x : {true, false}) {
      std::vector<double> errors;
      for (const MarkerRecord* hit : hits) {
        const Vec2 error = hit->corner_error_px[corner];
        errors.push_back(along_x ? error.x : error.y);
      }
      summary.corner_std_px += Deviation(errors) / 8;
      summary.corner_bias_px += std::fabs(MeanOf(errors)) / 8;
    }
  }
  std::vector<double> rotation;
  std::array<std::vector<double>, 3> place;
  for (const MarkerRecord* hit : hits) {
    if (!hit->pose) continue;
    rotation.push_back(hit->pose->rotation_error_deg);
    const Vec3 t = hit->pose->camera_from_marker.translation_m;
    place[0].push_back(t.x);
    place[1].push_back(t.y);
    place[2].push_back(t.z);
  }
  if (!rotation.empty()) {
    summary.rotation_std_deg = Deviation(rotation);
    summary.translation_std_m =
        Norm(Vec3{Deviation(place[0]), Deviation(place[1]), Deviation(place[2])});
  }
  return summary;
}

double StepJitter(const MarkerRecord& a, const MarkerRecord& b) {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Vec2 change = a.corner_error_px[i] - b.corner_error_px[i];
    sum += change.x * change.x + change.y * change.y;
  }
  return std::sqrt(sum / 4.0);
}

FilmSummary SummarizeFilm(const std::vector<const FrameRecord*>& frames) {
  FilmSummary film;
  film.frames = static_cast<std::int64_t>(frames.size());
  film.truth_aligned = frames[0]->truth_aligned;
  Trajectory found, truth;
  std::vector<double> steps, tracks;
  std::int64_t track = 0, gap = 0;
  const MarkerRecord* before = nullptr;
  for (const FrameRecord* frame : frames) {
    if (frame->markers.empty()) continue;
    const MarkerRecord& marker = frame->markers[0];
    const bool hit = marker.outcome == Outcome::kHit && marker.pose;
    truth.push_back({frame->repeat, marker.true_camera_from_marker.Inverse()});
    if (hit) found.push_back({frame->repeat, marker.pose->camera_from_marker.Inverse()});
    if (hit && before != nullptr) steps.push_back(StepJitter(*before, marker));
    before = hit ? &marker : nullptr;
    film.found += hit;
    film.gaps.count += !hit && gap == 0;
    const bool lost = !hit && track > 0;
    film.losses.count += lost;
    film.losses.reported += lost && frame->lost > 0;
    film.losses.recovered += hit && gap > 0 && !tracks.empty();
    if (lost) tracks.push_back(static_cast<double>(track));
    track = hit ? track + 1 : 0;
    gap = hit ? 0 : gap + 1;
    film.tracks.longest = std::max(film.tracks.longest, track);
    film.gaps.longest = std::max(film.gaps.longest, gap);
  }
  if (track > 0) tracks.push_back(static_cast<double>(track));
  film.tracks.count = static_cast<std::int64_t>(tracks.size());
  film.median_track = Percentile(tracks, 0.5);
  film.step_jitter_px = Percentile(steps, 0.5);
  if (const auto error = CompareTrajectories(found, truth)) {
    film.trajectory.ate_m = error->ate_rmse_m;
    film.trajectory.ate_unaligned_m = error->ate_unaligned_rmse_m;
    film.trajectory.rpe_translation_m = error->rpe_translation_rmse_m;
    film.trajectory.rpe_rotation_deg = error->rpe_rotation_rmse_deg;
  }
  return film;
}

}  // namespace

std::vector<JitterSummary> SummarizeJitter(const std::vector<FrameRecord>& records) {
  constexpr std::size_t kMin = 5;
  std::map<std::tuple<std::string, std::string, double>, std::vector<const MarkerRecord*>> cells;
  for (const FrameRecord& record : records) {
    if (record.sweep != "jitter") continue;
    for (const MarkerRecord& marker : record.markers) {
      if (marker.outcome != Outcome::kHit) continue;
      cells[{record.detector, record.pattern, -record.level}].push_back(&marker);
    }
  }
  std::vector<JitterSummary> summaries;
  for (const auto& [key, hits] : cells) {
    if (hits.size() < kMin) continue;
    JitterSummary summary = JitterOf(hits);
    summary.detector = std::get<0>(key);
    summary.pattern = std::get<1>(key);
    summary.level = -std::get<2>(key);
    summaries.push_back(summary);
  }
  return summaries;
}

std::vector<FilmSummary> SummarizeFilms(const std::vector<FrameRecord>& records) {
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<const FrameRecord*>>
      films;
  for (const FrameRecord& record : records) {
    if (IsFilm(record)) films[{record.sweep, record.pattern, record.detector}].push_back(&record);
  }
  std::vector<FilmSummary> summaries;
  for (const auto& [key, frames] : films) {
    FilmSummary film = SummarizeFilm(frames);
    film.film = std::get<1>(key).empty() ? std::get<0>(key) : std::get<1>(key);
    film.detector = std::get<2>(key);
    summaries.push_back(film);
  }
  return summaries;
}

}  // namespace pleinair::accuracy
