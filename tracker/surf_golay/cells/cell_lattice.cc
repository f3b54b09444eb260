#include "tracker/surf_golay/cells/cell_lattice.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

constexpr int kTile_px = 32;
constexpr double kMinStep_px = 3.5, kMaxStep_px = 30.0;
constexpr double kMaxArm_px = 60.0;
constexpr int kMaxArmSteps = 3;  ///< Maximum length, in steps, of an edge between two corners.
constexpr std::size_t kMaxArms = 6;
/// The strongest corners of a tile are tried as the origin of a lattice; all corners count as its
/// nodes.
constexpr int kMaxStartsPerTile = 8;
constexpr double kMinEdgeShare = 0.6;
constexpr double kMinSine = 0.34, kMaxStepRatio = 3.0;
/// Maximum distance of a corner from its node, in steps. It grows with the distance from the
/// lattice's origin, since perspective bends the lattice.
constexpr double kOnNode = 0.12, kOnNodePerStep = 0.02;
constexpr double kOffNodeCost = 0.6;
constexpr double kMinScore = 6.0;
constexpr std::size_t kMaxLattices = 12;
/// Minimum number of corners, at the 5×5 nodes around a lattice's origin, that make a full count
/// worthwhile.
constexpr int kNear = 2, kMinNearCorners = 7;
constexpr double kOnNear = 0.2;
constexpr int kMapReach_px = 3;
constexpr int kFitRounds = 3;
constexpr int kMinNodes = 7;

double Squared(Vec2 a) { return a.x * a.x + a.y * a.y; }

/// The nearest integer, for values above -1024.
int Nearest(double value) { return static_cast<int>(value + 1024.5) - 1024; }

}  // namespace

template <typename Visit>
void CellLattice::ForCornersAround(Vec2 middle, double reach_px, Visit visit) const {
  const auto tile = [](double at, int count) {
    return static_cast<int>(std::clamp(std::floor(at / kTile_px), 0.0, count - 1.0));
  };
  const int x0 = tile(middle.x - reach_px, tile_columns_),
            x1 = tile(middle.x + reach_px, tile_columns_);
  const int y0 = tile(middle.y - reach_px, tile_rows_), y1 = tile(middle.y + reach_px, tile_rows_);
  for (int y = y0; y <= y1; ++y) {
    const int first = tile_begin_[y * tile_columns_ + x0];
    const int last = tile_begin_[y * tile_columns_ + x1 + 1];
    for (int i = first; i < last; ++i) visit(corners_[i]);
  }
}

void CellLattice::SortIntoTiles() {
  const auto tile = [this](const CornerPoint& corner) {
    const auto at = [](double px, int count) {
      return static_cast<int>(std::clamp(std::floor(px / kTile_px), 0.0, count - 1.0));
    };
    return at(corner.at_px.y, tile_rows_) * tile_columns_ + at(corner.at_px.x, tile_columns_);
  };
  std::ranges::stable_sort(corners_, {}, tile);
  tile_begin_.assign(static_cast<std::size_t>(tile_columns_) * tile_rows_ + 1, 0);
  for (const CornerPoint& corner : corners_) ++tile_begin_[tile(corner) + 1];
  for (std::size_t i = 1; i < tile_begin_.size(); ++i) tile_begin_[i] += tile_begin_[i - 1];
}

void CellLattice::MapCorners(int width, int height) {
  map_width_ = width;
  map_height_ = height;
  nearest_.assign(static_cast<std::size_t>(width) * height, -1);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const int x = Nearest(corners_[i].at_px.x);
    const int y = Nearest(corners_[i].at_px.y);
    for (int v = std::max(0, y - kMapReach_px); v <= std::min(height - 1, y + kMapReach_px); ++v) {
      for (int u = std::max(0, x - kMapReach_px); u <= std::min(width - 1, x + kMapReach_px); ++u) {
        const std::int16_t other = nearest_[static_cast<std::size_t>(v) * width + u];
        const Vec2 here{static_cast<double>(u), static_cast<double>(v)};
        if (other >= 0 &&
            Squared(corners_[other].at_px - here) <= Squared(corners_[i].at_px - here)) {
          continue;
        }
        nearest_[static_cast<std::size_t>(v) * width + u] = static_cast<std::int16_t>(i);
      }
    }
  }
}

bool CellLattice::CornerAt(Vec2 at, double within_px) const {
  const int x = Nearest(at.x), y = Nearest(at.y);
  if (!(at.x > 0.0 && at.y > 0.0) || x >= map_width_ || y >= map_height_) return false;
  const int nearest = nearest_[static_cast<std::size_t>(y) * map_width_ + x];
  if (nearest < 0) return false;
  return Squared(corners_[nearest].at_px - at) < within_px * within_px;
}

bool CellLattice::Promising(const Lattice& lattice) const {
  const double step =
      std::sqrt(std::fabs(lattice.along.x * lattice.down.y - lattice.along.y * lattice.down.x));
  const auto corner_at = [&](double u, double v) {
    return CornerAt(lattice.corner + lattice.along * u + lattice.down * v, kOnNear * step) ? 1 : 0;
  };
  int hits = 0;
  for (int v = -kNear; v <= kNear; ++v) {
    for (int u = -kNear; u <= kNear; ++u) hits += corner_at(u, v);
  }
  if (hits < kMinNearCorners) return false;
  // A texture has as many corners between the nodes.
  for (int v = -kNear; v < kNear; ++v) {
    for (int u = -kNear; u < kNear; ++u) hits -= corner_at(u + 0.5, v + 0.5);
  }
  return hits >= kMinNearCorners;
}

double CellLattice::EdgeShare(ImageView<const std::uint8_t> grey, Vec2 from, Vec2 to) {
  // Away from the corners, where there is one edge only.
  constexpr int kSamples = 4;
  const Vec2 direction = to - from;
  const double length = Norm(direction);
  double across = 0.0, along = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 at = from + direction * ((i + 1.0) / (kSamples + 1.0));
    const int x = Nearest(at.x), y = Nearest(at.y);
    if (x < 1 || y < 1 || x + 1 >= grey.width() || y + 1 >= grey.height()) return 0.0;
    const double gx = grey(x + 1, y) - grey(x - 1, y), gy = grey(x, y + 1) - grey(x, y - 1);
    across += (direction.x * gy - direction.y * gx) / length;
    along += std::fabs(direction.x * gx + direction.y * gy) / length;
  }
  constexpr double kMinGradient = 10.0;
  across = std::fabs(across);
  return across < kSamples * kMinGradient ? 0.0 : across / (across + along);
}

void CellLattice::FindArms(ImageView<const std::uint8_t> grey, const CornerPoint& corner) {
  arms_.clear();
  ForCornersAround(corner.at_px, kMaxArm_px, [&](const CornerPoint& other) {
    const double squared = Squared(other.at_px - corner.at_px);
    if (squared < kMinStep_px * kMinStep_px || squared > kMaxArm_px * kMaxArm_px) return;
    arms_.push_back({other.at_px - corner.at_px, static_cast<float>(squared)});
  });
  // The nearest ones first, if the image has an edge there.
  std::ranges::sort(arms_, {}, &Arm::squared_length);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < arms_.size() && kept < kMaxArms; ++i) {
    const double share = EdgeShare(grey, corner.at_px, corner.at_px + arms_[i].to);
    if (share > kMinEdgeShare) arms_[kept++] = arms_[i];
  }
  arms_.resize(kept);
}

void CellLattice::Score(Lattice* lattice) const {
  const Vec2 a = lattice->along, b = lattice->down;
  const double determinant = a.x * b.y - a.y * b.x;
  std::array<float, kAround * kAround> on{}, off{};
  const double reach = (kReach + 0.5) * std::max(Norm(a), Norm(b)) * 1.5;
  ForCornersAround(lattice->corner, reach, [&](const CornerPoint& corner) {
    const Vec2 to = corner.at_px - lattice->corner;
    const double u = (to.x * b.y - to.y * b.x) / determinant;
    const double v = (a.x * to.y - a.y * to.x) / determinant;
    if (!(std::fabs(u) < kReach + 0.5 && std::fabs(v) < kReach + 0.5)) return;
    const int node_u = Nearest(u), node_v = Nearest(v);
    const int farthest = std::max(std::abs(node_u), std::abs(node_v));
    const int at = (node_v + kReach) * kAround + node_u + kReach;
    const double tolerance = kOnNode + kOnNodePerStep * farthest;
    if (std::max(std::fabs(u - node_u), std::fabs(v - node_v)) < tolerance) {
      on[at] = 1.0F;
    } else {
      off[at] += static_cast<float>(kOffNodeCost);
    }
  });
  // Prefix sums over all nodes above and left: a window of 6×6 nodes needs four of them.
  std::array<float, (kAround + 1) * (kAround + 1)> sums{};
  for (int v = 0; v < kAround; ++v) {
    float row = 0.0F;
    for (int u = 0; u < kAround; ++u) {
      row += on[v * kAround + u] - std::min(1.0F, off[v * kAround + u]);
      sums[(v + 1) * (kAround + 1) + u + 1] = sums[v * (kAround + 1) + u + 1] + row;
    }
  }
  lattice->score = -1e9;
  for (int v = 0; v + kNodes <= kAround; ++v) {
    for (int u = 0; u + kNodes <= kAround; ++u) {
      const auto sum = [&](int du, int dv) { return sums[(v + dv) * (kAround + 1) + u + du]; };
      const float score = sum(kNodes, kNodes) - sum(0, kNodes) - sum(kNodes, 0) + sum(0, 0);
      if (score <= lattice->score) continue;
      lattice->score = score;
      lattice->first_u = u - kReach;
      lattice->first_v = v - kReach;
    }
  }
}

void CellLattice::Keep(const Lattice& lattice) {
  const auto middle = [](const Lattice& of) {
    return of.corner + of.along * (of.first_u + 0.5 * kReach) +
           of.down * (of.first_v + 0.5 * kReach);
  };
  const auto area = [](const Lattice& of) {
    return std::fabs(of.along.x * of.down.y - of.along.y * of.down.x);
  };
  for (Lattice& other : best_) {
    const double step = std::sqrt(area(other));
    const double ratio = area(lattice) / area(other);
    if (Norm(middle(other) - middle(lattice)) > 0.3 * step || ratio < 0.8 || ratio > 1.25) continue;
    if (lattice.score > other.score) other = lattice;
    return;
  }
  best_.push_back(lattice);
  if (best_.size() > 4 * kMaxLattices) {
    std::ranges::stable_sort(best_, std::ranges::greater{}, &Lattice::score);
    best_.resize(2 * kMaxLattices);
  }
}

bool CellLattice::Fit(const Lattice& lattice, double scale, LatticeGuess* guess) const {
  const auto undistorted = [&](Vec2 reduced_px) {
    return lens_.Undistort((reduced_px.x + 0.5) * scale - 0.5, (reduced_px.y + 0.5) * scale - 0.5);
  };
  // Maps nodes (0…5 each way) to undistorted pixels: affine at first, then a homography.
  const Vec2 origin = undistorted(lattice.corner + lattice.along * lattice.first_u +
                                  lattice.down * lattice.first_v);
  const Vec2 a = lattice.along * scale, b = lattice.down * scale;
  Mat3 undistorted_from_nodes{{a.x, b.x, origin.x, a.y, b.y, origin.y, 0, 0, 1}};
  const Vec2 middle = lattice.corner + lattice.along * (lattice.first_u + 0.5 * kReach) +
                      lattice.down * (lattice.first_v + 0.5 * kReach);
  const double reach = 0.75 * kNodes * (Norm(lattice.along) + Norm(lattice.down));
  int nodes = 0;
  for (int round = 0; round < kFitRounds; ++round) {
    const Mat3 nodes_from_undistorted = Adjugate(undistorted_from_nodes);
    Eigen::Matrix<double, 8, 8> normal = Eigen::Matrix<double, 8, 8>::Zero();
    Eigen::Matrix<double, 8, 1> right = Eigen::Matrix<double, 8, 1>::Zero();
    nodes = 0;
    const double tolerance = round == 0 ? 0.25 : 0.18;
    ForCornersAround(middle, reach, [&](const CornerPoint& corner) {
      const Vec2 observed = undistorted(corner.at_px);
      const Vec2 at = Apply(nodes_from_undistorted, observed);
      const double u = std::round(at.x), v = std::round(at.y);
      if (!(u >= 0 && v >= 0 && u <= kReach && v <= kReach)) return;
      if (std::max(std::fabs(at.x - u), std::fabs(at.y - v)) > tolerance) return;
      ++nodes;
      // Correction of the nodes' coordinates by a homography near the identity.
      const double s = u - 0.5 * kReach, t = v - 0.5 * kReach;
      Eigen::Matrix<double, 8, 1> row_u, row_v;
      row_u << s, t, 1, 0, 0, 0, -s * s, -s * t;
      row_v << 0, 0, 0, s, t, 1, -s * t, -t * t;
      normal += row_u * row_u.transpose() + row_v * row_v.transpose();
      right += row_u * (at.x - u) + row_v * (at.y - v);
    });
    if (nodes < kMinNodes) return false;
    // Perspective is weak over so small a square: a prior limits it where the corners hardly
    // determine it.
    normal(6, 6) += 20.0;
    normal(7, 7) += 20.0;
    normal.diagonal().array() += 1e-6;
    const Eigen::Matrix<double, 8, 1> x = normal.ldlt().solve(right);
    if (!x.allFinite()) return false;
    const double half = 0.5 * kReach;
    const Mat3 centred{{1, 0, -half, 0, 1, -half, 0, 0, 1}},
        back{{1, 0, half, 0, 1, half, 0, 0, 1}};
    const Mat3 correction{{1 + x[0], x[1], x[2], x[3], 1 + x[4], x[5], x[6], x[7], 1}};
    undistorted_from_nodes = undistorted_from_nodes * (back * (correction * centred));
  }
  constexpr double kFirst = sg::kQuiet + sg::kContent;
  constexpr Mat3 kModulesFromNodes{{sg::kCell, 0, kFirst, 0, sg::kCell, kFirst, 0, 0, 1}};
  guess->modules_from_undistorted = kModulesFromNodes * Adjugate(undistorted_from_nodes);
  guess->score = lattice.score;
  return true;
}

void CellLattice::Find(ImageView<const std::uint8_t> grey, double scale,
                       std::vector<LatticeGuess>* guesses) {
  guesses->clear();
  corners_ = detector_.Find(grey);
  tile_columns_ = grey.width() / kTile_px + 1;
  tile_rows_ = grey.height() / kTile_px + 1;
  SortIntoTiles();
  MapCorners(grey.width(), grey.height());
  best_.clear();
  for (const CornerPoint& corner : corners_) {
    if (corner.rank >= kMaxStartsPerTile) continue;
    FindArms(grey, corner);
    for (std::size_t i = 0; i < arms_.size(); ++i) {
      for (std::size_t k = i + 1; k < arms_.size(); ++k) {
        Vec2 a = arms_[i].to, b = arms_[k].to;
        const double cross = a.x * b.y - a.y * b.x, la = Norm(a), lb = Norm(b);
        if (std::fabs(cross) < kMinSine * la * lb) continue;
        if (cross < 0.0) std::swap(a, b);  // A marker is observed from its front.
        for (int n = 1; n <= kMaxArmSteps; ++n) {
          for (int m = 1; m <= kMaxArmSteps; ++m) {
            Lattice lattice{corner.at_px, a * (1.0 / n), b * (1.0 / m)};
            const double sa = Norm(lattice.along), sb = Norm(lattice.down);
            if (std::min(sa, sb) < kMinStep_px || std::max(sa, sb) > kMaxStep_px ||
                std::max(sa, sb) > kMaxStepRatio * std::min(sa, sb)) {
              continue;
            }
            if (!Promising(lattice)) continue;
            Score(&lattice);
            if (lattice.score >= kMinScore) Keep(lattice);
          }
        }
      }
    }
  }
  std::ranges::stable_sort(best_, std::ranges::greater{}, &Lattice::score);
  for (const Lattice& lattice : best_) {
    if (guesses->size() >= kMaxLattices) break;
    LatticeGuess guess;
    if (Fit(lattice, scale, &guess)) guesses->push_back(guess);
  }
}

}  // namespace pleinair::tracker
