#include "tracker/surf_golay/cells/cell_split.h"

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {
namespace {

constexpr int kMinCellsOfAColor = 4;
/// Added to a share of white before its logarithm is taken: no black is quite black.
constexpr double kFloor = 0.04;
constexpr double kMinGap = 0.5, kPlainGap = 1.1;  ///< Natural logarithms of ratios.
constexpr double kPlain = 5.0;                    ///< Log-likelihood ratio of a plain cell.
/// Residual inside a cell, as a share of the light at the gap, that makes the cell undecided.
constexpr double kUneven = 0.5;
/// Excess over the marker's black, in shares of the darkest white, at which a black cell is
/// undecided. Ink reflects little under any light, a hand more.
constexpr double kGreyer = 0.15;

}  // namespace

CellSplits SplitCells(const CellReading& cells) {
  std::array<int, sg::kCodeCells> order{};
  std::array<double, sg::kCodeCells> level{};
  int observed = 0;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    if (!cells.observed[k]) continue;
    level[k] = std::log(std::max(0.0, static_cast<double>(cells.white[k])) + kFloor);
    order[observed++] = k;
  }
  std::sort(order.begin(), order.begin() + observed,
            [&](int a, int b) { return level[a] != level[b] ? level[a] < level[b] : a < b; });
  struct Gap {
    double size, middle;
  };
  std::array<Gap, sg::kCodeCells> gaps{};
  int count = 0;
  for (int i = kMinCellsOfAColor; i <= observed - kMinCellsOfAColor; ++i) {
    const double below = level[order[i - 1]], above = level[order[i]];
    if (above - below > kMinGap) gaps[count++] = {above - below, 0.5 * (below + above)};
  }
  std::stable_sort(gaps.begin(), gaps.begin() + count,
                   [](const Gap& a, const Gap& b) { return a.size > b.size; });
  CellSplits splits;
  splits.count = std::min(count, CellSplits::kMax);
  for (int i = 0; i < splits.count; ++i) {
    const double plain = kPlain * std::min(1.0, gaps[i].size / kPlainGap);
    const double at_gap = std::exp(gaps[i].middle);
    // There are at least this many black cells, so none is blacker than the last of them.
    const double black = std::exp(level[order[kMinCellsOfAColor - 1]]);
    const double darkest_white = std::exp(gaps[i].middle + 0.5 * gaps[i].size);
    for (int n = 0; n < observed; ++n) {
      const int k = order[n];
      const bool white = level[k] > gaps[i].middle;
      // An occluder of a part of a cell, or a shadow edge across it, makes the cell uneven.
      const double light = white ? std::exp(level[k]) : at_gap;
      const double uneven = cells.misfit[k] / (kUneven * light);
      const double greyer =
          white ? 0.0 : std::max(0.0, std::exp(level[k]) - black) / (kGreyer * darkest_white);
      const double likelihood = plain / (1.0 + uneven * uneven * uneven * uneven) /
                                (1.0 + greyer * greyer * greyer * greyer);
      splits.likelihoods[i][k] = static_cast<float>(white ? likelihood : -likelihood);
    }
  }
  return splits;
}

}  // namespace pleinair::tracker
