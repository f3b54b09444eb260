#include "accuracy/light_summary.h"

#include <algorithm>

namespace pleinair::accuracy {
namespace {

/// Figure of one measure: the scores of each recording's images.
LightFigure FigureOf(const std::vector<double>& scores) {
  LightFigure figure{.count = static_cast<std::int64_t>(scores.size())};
  if (scores.empty()) return figure;
  figure.mean = MeanOf(scores);
  figure.interval = MeanInterval(scores);
  return figure;
}

}  // namespace

std::vector<LightSummary> SummarizeLight(const std::vector<ImageRecord>& pictures) {
  std::vector<LightSummary> summaries;
  for (const ImageRecord& picture : pictures) {
    const auto same = [&](const LightSummary& one) { return one.recording == picture.recording; };
    if (std::none_of(summaries.begin(), summaries.end(), same)) {
      summaries.push_back({.recording = picture.recording});
    }
  }
  LightSummary all;
  for (std::size_t measure = 0; measure < kImageMeasures.size(); ++measure) {
    std::vector<double> means;
    for (LightSummary& summary : summaries) {
      std::vector<double> scores;
      for (const ImageRecord& picture : pictures) {
        if (picture.recording == summary.recording && picture.scores[measure]) {
          scores.push_back(*picture.scores[measure]);
        }
      }
      summary.figures[measure] = FigureOf(scores);
      if (!scores.empty()) means.push_back(summary.figures[measure].mean);
    }
    all.figures[measure] = FigureOf(means);
  }
  for (LightSummary& summary : summaries) {
    summary.pictures = std::count_if(
        pictures.begin(), pictures.end(),
        [&](const ImageRecord& picture) { return picture.recording == summary.recording; });
  }
  all.pictures = static_cast<std::int64_t>(pictures.size());
  if (summaries.size() > 1) summaries.push_back(std::move(all));
  return summaries;
}

}  // namespace pleinair::accuracy
