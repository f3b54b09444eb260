#include "accuracy/summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "accuracy/film_summary.h"
#include "accuracy/light_summary.h"
#include "accuracy/peer_summary.h"
#include "tracker/observation.h"

namespace pleinair::accuracy {
namespace {

/// Data of the frames of one cell.
struct Gathered {
  CellSummary cell;
  std::int64_t frames_with_false = 0;
  std::vector<double> corner_px, rotation_deg, translation_m, translation_share, nees;
  double sum_x = 0.0, sum_y = 0.0, sum_outward = 0.0;

  void Add(const FrameRecord& record) {
    ++cell.counts.frames;
    cell.counts.false_numbers += record.false_numbers;
    frames_with_false += record.false_numbers > 0;
    for (const MarkerRecord& marker : record.markers) Add(marker);
  }

  void Add(const MarkerRecord& marker) {
    ++cell.counts.markers;
    cell.counts.misplaced += marker.outcome == Outcome::kMisplaced;
    if (marker.outcome != Outcome::kHit) return;
    ++cell.counts.hits;
    corner_px.push_back(marker.CornerRms());
    Vec2 middle;
    for (const Vec2 corner : marker.true_corners_px) middle = middle + corner * 0.25;
    for (int i = 0; i < 4; ++i) {
      const Vec2 error = marker.corner_error_px[i] * 0.25, out = marker.true_corners_px[i] - middle;
      sum_x += error.x;
      sum_y += error.y;
      sum_outward += (error.x * out.x + error.y * out.y) / Norm(out);
    }
    if (!marker.pose) return;
    rotation_deg.push_back(marker.pose->rotation_error_deg);
    translation_m.push_back(marker.pose->translation_error_m);
    translation_share.push_back(marker.pose->translation_error_m /
                                Norm(marker.true_camera_from_marker.translation_m));
    const bool flip = marker.pose->rotation_error_deg > kFlip_deg;
    cell.counts.flips += flip;
    if (marker.pose->nees && !flip) nees.push_back(*marker.pose->nees);
  }

  CellSummary Finish() {
    cell.rates.hits = WilsonInterval(cell.counts.hits, cell.counts.markers);
    cell.rates.false_frames = WilsonInterval(frames_with_false, cell.counts.frames);
    cell.corner_px = SpreadOf(corner_px);
    const double hits = static_cast<double>(std::max<std::int64_t>(cell.counts.hits, 1));
    cell.bias_px.x = sum_x / hits;
    cell.bias_px.y = sum_y / hits;
    cell.bias_px.outward = sum_outward / hits;
    cell.rotation_deg = SpreadOf(rotation_deg);
    cell.translation_m = SpreadOf(translation_m);
    cell.translation_share = SpreadOf(translation_share);
    if (!nees.empty()) {
      constexpr double kDegrees = 6.0;
      NeesSummary summary{.count = static_cast<std::int64_t>(nees.size())};
      for (const double value : nees) summary.mean += value / static_cast<double>(nees.size());
      summary.band = MeanChiSquareBand(kDegrees, summary.count);
      cell.nees = summary;
    }
    return cell;
  }
};

/// Cells in the order of their first frames; the whole sweep is before its parts.
class Cells {
 public:
  void Add(const FrameRecord& record) {
    At(record, "", std::nullopt).Add(record);
    if (!record.pattern.empty()) At(record, record.pattern, std::nullopt).Add(record);
    At(record, record.pattern, record.level).Add(record);
  }
  std::vector<CellSummary> Finish() {
    std::vector<CellSummary> cells;
    for (Gathered& gathered : gathered_) cells.push_back(gathered.Finish());
    return cells;
  }

 private:
  Gathered& At(const FrameRecord& record, const std::string& pattern, std::optional<double> level) {
    const auto key = std::tuple(record.detector, record.sweep, pattern, level);
    const auto [place, added] = places_.emplace(key, gathered_.size());
    if (added) {
      Gathered gathered;
      gathered.cell.detector = record.detector;
      gathered.cell.sweep = record.sweep;
      gathered.cell.pattern = pattern;
      gathered.cell.level = level;
      gathered_.push_back(std::move(gathered));
    }
    return gathered_[place->second];
  }

  std::map<std::tuple<std::string, std::string, std::string, std::optional<double>>, std::size_t>
      places_;
  std::vector<Gathered> gathered_;
};

std::vector<AmbiguityBin> BinAmbiguity(const std::vector<FrameRecord>& records,
                                       const std::string& detector) {
  // The first bin holds the unambiguous poses.
  constexpr std::array<double, 5> kEdges{0.0, tracker::kCertainRatio, 0.01, 0.1, 1.0};
  std::vector<AmbiguityBin> bins(kEdges.size() - 1);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].detector = detector;
    bins[i].low = kEdges[i];
    bins[i].high = kEdges[i + 1];
  }
  for (const FrameRecord& record : records) {
    if (record.detector != detector) continue;
    for (const MarkerRecord& marker : record.markers) {
      if (!marker.pose || !marker.pose->alternative_error_deg) continue;
      AmbiguityBin& bin = *std::find_if(bins.begin(), bins.end() - 1, [&](const AmbiguityBin& b) {
        return marker.pose->ambiguity_ratio < b.high;
      });
      ++bin.count;
      bin.wrong += *marker.pose->alternative_error_deg < marker.pose->rotation_error_deg;
      bin.flips += marker.pose->rotation_error_deg > kFlip_deg;
    }
  }
  for (AmbiguityBin& bin : bins) bin.rate = WilsonInterval(bin.wrong, bin.count);
  return bins;
}

ErrorMap MapErrors(const std::vector<FrameRecord>& records, const std::string& detector, int width,
                   int height) {
  constexpr int kColumns = 12, kRows = 9;
  std::vector<std::vector<double>> errors(kColumns * kRows);
  for (const FrameRecord& record : records) {
    if (record.detector != detector) continue;
    for (const MarkerRecord& marker : record.markers) {
      if (marker.outcome != Outcome::kHit) continue;
      for (int i = 0; i < 4; ++i) {
        const Vec2 at = marker.true_corners_px[i];
        const int column = static_cast<int>((at.x + 0.5) / width * kColumns);
        const int row = static_cast<int>((at.y + 0.5) / height * kRows);
        errors[std::clamp(row, 0, kRows - 1) * kColumns + std::clamp(column, 0, kColumns - 1)]
            .push_back(Norm(marker.corner_error_px[i]));
      }
    }
  }
  ErrorMap map{detector, kColumns, kRows, {}, {}};
  for (const std::vector<double>& cell : errors) {
    map.counts.push_back(static_cast<std::int64_t>(cell.size()));
    map.median_px.push_back(Percentile(cell, 0.5));
  }
  return map;
}

}  // namespace

RunSummary Summarize(const RunRecords& records, int image_width, int image_height) {
  RunSummary summary;
  Cells cells;
  const auto note = [](std::vector<std::string>* names, const std::string& name) {
    if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
  };
  std::vector<std::string> recordings;
  for (const FrameRecord& record : records.frames) {
    note(&summary.detectors, record.detector);
    note(&summary.sweeps, record.sweep);
    if (record.sweep == kRecordingSweep) note(&recordings, record.pattern);
    cells.Add(record);
  }
  summary.cells = cells.Finish();
  summary.jitter = SummarizeJitter(records.frames);
  summary.films = SummarizeFilms(records.frames);
  summary.light = SummarizeLight(records.pictures);
  for (const std::string& detector : summary.detectors) {
    for (AmbiguityBin& bin : BinAmbiguity(records.frames, detector)) {
      summary.ambiguity.push_back(std::move(bin));
    }
    summary.maps.push_back(MapErrors(records.frames, detector, image_width, image_height));
    for (const CellSummary& cell : summary.cells) {
      const bool nominal = cell.detector == detector && cell.sweep == "distance" && !cell.level;
      if (nominal && cell.nees) summary.nominal_nees.push_back(*cell.nees);
    }
  }
  for (std::size_t i = 1; i < summary.detectors.size(); ++i) {
    const auto compare = [&](const std::string& sweep, const std::string& film) {
      const auto peer = CompareWithPeer(records.frames, {sweep, film}, summary.detectors[0],
                                        summary.detectors[i]);
      if (peer) summary.peers.push_back(*peer);
    };
    for (const std::string& sweep : summary.sweeps) compare(sweep, "");
    if (recordings.size() < 2) continue;
    for (const std::string& recording : recordings) compare(kRecordingSweep, recording);
  }
  return summary;
}

}  // namespace pleinair::accuracy
