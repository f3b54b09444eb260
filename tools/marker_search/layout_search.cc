#include "tools/marker_search/layout_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pleinair::marker_search {
namespace {

/// Share of the budget for random layouts, and number of views of their first score.
constexpr double kRandomShare = 0.2;
constexpr int kFirstViews = 8;
constexpr int kClimbers = 6, kLastClimbers = 2;
constexpr int kLargeShapes = 12;
/// Minimum number of modules that must differ; about 540 modules belong to the border.
constexpr int kMinAsymmetry = 150;
/// A change is rejected early if its first score is lower by this amount.
constexpr double kHopeless = 0.02;
/// Changes that lower the score are accepted as in simulated annealing (Kirkpatrick et al. 1983).
constexpr double kFirstTemperature = 0.004;

class Search {
 public:
  Search(LayoutScorer* scorer, const LayoutSearchOptions& options,
         const std::function<void(const std::string&)>& progress)
      : scorer_(*scorer), options_(options), progress_(progress), draws_(options.seed) {}

  std::vector<ScoredLayout> Run() {
    DrawFirst();
    const long begin = spent_;
    for (std::size_t climbers = pool_.size();;
         climbers = std::max<std::size_t>(kLastClimbers, climbers / 2)) {
      // Each halving receives an equal share of the remaining budget.
      SortPool();
      if (pool_.size() > climbers) pool_.resize(climbers);
      const bool last = pool_.size() <= kLastClimbers;
      const long until = last ? options_.budget : spent_ + (options_.budget - begin) / 3;
      while (spent_ < std::min(until, options_.budget)) {
        for (Climber& climber : pool_) Improve(&climber);
      }
      if (last || spent_ >= options_.budget) break;
    }
    for (Climber& climber : pool_) climber.now = climber.best;
    SortPool();
    std::vector<ScoredLayout> found;
    for (Climber& climber : pool_) found.push_back(std::move(climber.best));
    return found;
  }

 private:
  struct Climber {
    ScoredLayout now, best;
    double first_views = 0.0;  ///< Score of `now` on the first views only.
  };

  double Score(const BorderLayout& layout, int views) {
    spent_ += views;
    return scorer_.Score(layout.border(), views).total;
  }

  void DrawFirst() {
    std::vector<ScoredLayout> drawn;
    if (options_.start) {
      drawn.push_back({*options_.start, Score(*options_.start, kFirstViews)});
    } else {
      const long until = std::lround(kRandomShare * static_cast<double>(options_.budget));
      while (spent_ < until || drawn.size() < kClimbers) {
        BorderLayout layout =
            BorderLayout::Random(library_, kLargeShapes - 2 + draws_.Below(4), &draws_);
        if (!layout.IsAsymmetric(kMinAsymmetry)) continue;
        const double score = Score(layout, kFirstViews);
        drawn.push_back({std::move(layout), score});
        if (drawn.size() % 200 == 0) progress_(fmt::format("{} random layouts", drawn.size()));
      }
    }
    // Twice as many layouts as the search keeps are scored again on all views.
    std::sort(drawn.begin(), drawn.end(),
              [](const ScoredLayout& a, const ScoredLayout& b) { return a.score > b.score; });
    if (drawn.size() > 2 * kClimbers) drawn.resize(2 * kClimbers);
    for (ScoredLayout& layout : drawn) {
      Climber climber;
      climber.first_views = layout.score;
      layout.score = Score(layout.layout, scorer_.views());
      climber.now = climber.best = std::move(layout);
      pool_.push_back(std::move(climber));
    }
    SortPool();
    if (pool_.size() > kClimbers) pool_.resize(kClimbers);
  }

  void SortPool() {
    std::stable_sort(pool_.begin(), pool_.end(), [](const Climber& a, const Climber& b) {
      return a.best.score > b.best.score;
    });
  }

  void Improve(Climber* climber) {
    BorderLayout layout = climber->now.layout.Varied(library_, &draws_);
    if (!layout.IsAsymmetric(kMinAsymmetry)) return;
    const double first = Score(layout, kFirstViews);
    if (first < climber->first_views - kHopeless) return;
    const double score = Score(layout, scorer_.views());
    const double left = 1.0 - static_cast<double>(spent_) / static_cast<double>(options_.budget);
    const double temperature = kFirstTemperature * std::max(left, 0.0);
    const double change = score - climber->now.score;
    if (change <= 0.0 && draws_.Uniform() >= std::exp(change / std::max(temperature, 1e-9))) {
      return;
    }
    climber->now = {std::move(layout), score};
    climber->first_views = first;
    if (score <= climber->best.score) return;
    climber->best = climber->now;
    progress_(fmt::format("{:3.0f} %  climber {} of {}: {:.4f}", 100.0 * (1.0 - left),
                          climber - pool_.data() + 1, pool_.size(), score));
  }

  LayoutScorer& scorer_;
  const LayoutSearchOptions& options_;
  const std::function<void(const std::string&)>& progress_;
  const ShapeLibrary library_ = MakeShapeLibrary();
  RandomDraws draws_;
  std::vector<Climber> pool_;
  long spent_ = 0;
};

}  // namespace

std::vector<ScoredLayout> SearchLayouts(LayoutScorer* scorer, const LayoutSearchOptions& options,
                                        const std::function<void(const std::string&)>& progress) {
  return Search(scorer, options, progress).Run();
}

}  // namespace pleinair::marker_search
