#include "tracker/surf_golay/cells/cell_reader.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::tracker {
namespace {

/// Deviation of a cell's share of white that noise does not explain: uneven light, ink, the shape
/// of the blur.
constexpr double kSystematicShare = 0.025, kMinUnevenness = 0.008, kSystematicGlare = 0.03,
                 kSystematicPerBlur = 0.05;
/// Share of the glare that may remain on a cell or be wrongly subtracted from it.
constexpr double kUnsurePerGlare = 0.15;
/// Prior probability that a cell is occluded: alone, and if all cells around it are.
constexpr double kCoveredAlone = 0.03, kCoveredAmong = 0.6;
/// Probability density of the observed share of white if a cell is occluded.
constexpr double kCoveredDensity = 0.5;
/// Residual inside a cell, in shares of white beyond noise, that indicates an occluder.
constexpr double kUnevenShare = 0.10;
/// A white above this linear value clips: a clipped pixel is white there, and glare elsewhere.
constexpr double kWhiteClips = 0.93;
/// Noise and compression put some pixels in the core of a highlight just below the maximum.
constexpr float kNearlyClips = 0.92F;
constexpr double kRidge = 1e-4;
constexpr double kKnown_px = 1000.0;  ///< Weight of a known share of white, in pixels.
constexpr double kMinObserved_px = 0.3;
/// Minimum share of one cell in a pixel that counts as a witness of its own. All the witnesses of a
/// cell together are worth a few independent ones: an occluder affects neighbouring pixels alike.
constexpr float kWholeShare = 0.85F;
constexpr double kPixelCovered = 0.3, kWitnesses = 1.3, kMinWitnesses = 6.0;
/// Reduction of the evidence of a partly occluded cell if all cells around it are occluded.
constexpr double kMimicry = 0.6;
constexpr int kRoundsWhenClipped = 3;

/// Glare is estimated at nodes half a cell apart, from a cell before the content to one beyond. The
/// pattern of the border is known, and determines the glare where cells are saturated.
constexpr double kGlareReach = sg::kCell;
constexpr int kGlareNodes = 2 * sg::kCells + 5;
constexpr std::array<int, 4> kNodeSteps{0, 1, kGlareNodes, kGlareNodes + 1};
constexpr double kGlaring = 1.12;    ///< Share of white of a cell with glare,
constexpr int kMinGlaringCells = 2;  ///< … and the minimum number of such cells.
constexpr double kGlareBend = 0.02, kGlareSize = 0.00003;

double GlareNode(double module) {
  return (module - (sg::kQuiet + sg::kContent - kGlareReach)) / (0.5 * sg::kCell);
}

/// Φ(z), the normal distribution function, interpolated between values 1/64 apart: accurate to
/// 1e-5.
double NormalBelow(double z) {
  constexpr int kPerUnit = 64, kMax = 4;
  static const auto kTable = [] {
    std::array<double, 2 * kMax * kPerUnit + 2> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double at = static_cast<double>(i) / kPerUnit - kMax;
      table[i] = 0.5 * std::erfc(-at / std::numbers::sqrt2);
    }
    return table;
  }();
  const double at = (std::clamp(z, -1.0 * kMax, 1.0 * kMax) + kMax) * kPerUnit;
  const int i = static_cast<int>(at);
  return kTable[i] + (at - i) * (kTable[i + 1] - kTable[i]);
}

/// Shares of a blurred pixel that fall into each column of cells, along one axis.
void ColumnShares(double at, double sigma, std::array<double, sg::kCells>* shares) {
  double below = NormalBelow((sg::kQuiet + sg::kContent - at) / sigma);
  for (int i = 0; i < sg::kCells; ++i) {
    const double next = NormalBelow((sg::kQuiet + sg::kContent + (i + 1) * sg::kCell - at) / sigma);
    (*shares)[i] = next - below;
    below = next;
  }
}

}  // namespace

void CellReader::Gather(const MarkerPattern& blank, const BlockFit& fit,
                        const ObservedPatch& observed, const BlockFitState& state,
                        const MarkerLight& light, bool with_glare) {
  pixels_.clear();
  drowned_ = false;
  const double blur = state.blur_px / observed.rays.window.Scale();
  const double variance_px2 = blur * blur + 1.0 / 12.0;
  const double middle = 0.5 * blank.modules, per_half = 2.0 / blank.edge_modules;
  const double reach_modules = 0.5 * sg::kCells * sg::kCell + (with_glare ? kGlareReach : 0.0);
  for (std::size_t n = 0; n < observed.value.size(); ++n) {
    const double c = fit.map().column[n], r = fit.map().row[n];
    const double sigma_c =
        std::sqrt(variance_px2) * std::hypot(fit.map().column_x[n], fit.map().column_y[n]);
    const double sigma_r =
        std::sqrt(variance_px2) * std::hypot(fit.map().row_x[n], fit.map().row_y[n]);
    if (!(std::fabs(c - middle) < reach_modules + sigma_c &&
          std::fabs(r - middle) < reach_modules + sigma_r)) {
      continue;
    }
    const double u = (c - middle) * per_half, v = (r - middle) * per_half;
    const double white = light.White(u, v), black = light.black_share * white;
    const bool clipped = !(observed.inverse_variance[n] > 0.0F);
    if (clipped && (with_glare || white < kWhiteClips)) {
      drowned_ = true;
      continue;
    }
    if (with_glare && observed.value[n] > kNearlyClips) continue;
    const double known = fit.image().white[n];
    const double share = (observed.value[n] - black) / (white - black);
    Pixel pixel;
    pixel.value = static_cast<float>((clipped ? 1.0 : share) - known);
    if (clipped) pixel.least = static_cast<float>(std::min(share, 1.0) - known);
    std::array<double, sg::kCells> columns{}, rows{};
    ColumnShares(c, sigma_c, &columns);
    ColumnShares(r, sigma_r, &rows);
    for (int j = 0; j < sg::kCells; ++j) {
      if (rows[j] < 0.02) continue;
      for (int i = 0; i < sg::kCells; ++i) {
        const double part = rows[j] * columns[i];
        const int cell = sg::CodeCell(i, j);
        if (part < 0.02 || cell < 0 || pixel.cells == 9) continue;
        pixel.cell[pixel.cells] = static_cast<std::uint8_t>(cell);
        pixel.share[pixel.cells++] = static_cast<float>(part);
      }
    }
    if (pixel.cells == 0 && !with_glare) continue;
    const double gx = GlareNode(c), gy = GlareNode(r);
    const int nx = std::clamp(static_cast<int>(gx), 0, kGlareNodes - 2);
    const int ny = std::clamp(static_cast<int>(gy), 0, kGlareNodes - 2);
    pixel.node = static_cast<std::int16_t>(ny * kGlareNodes + nx);
    const float fx = static_cast<float>(gx - nx), fy = static_cast<float>(gy - ny);
    pixel.node_share = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
    pixels_.push_back(pixel);
  }
}

double CellReader::GlareAt(const Pixel& pixel, const Eigen::VectorXd& found) {
  double glare = 0.0;
  for (int a = 0; a < 4; ++a) {
    glare += pixel.node_share[a] * found[sg::kCodeCells + pixel.node + kNodeSteps[a]];
  }
  return glare;
}

bool CellReader::SolveWithGlare(Eigen::VectorXd* found, Eigen::MatrixXd* inverse) {
  // No cell is brighter than white: the excess of one that is belongs to the glare.
  CellFlags white{};
  for (bool more = true; more;) {
    if (!Solve(true, white, found, inverse)) return false;
    more = false;
    for (int k = 0; k < sg::kCodeCells; ++k) {
      if (white[k] || (*found)[k] <= kGlaring) continue;
      white[k] = more = true;
    }
  }
  return true;
}

bool CellReader::Solve(bool with_glare, const CellFlags& known_white, Eigen::VectorXd* found,
                       Eigen::MatrixXd* inverse) {
  const int unknowns = sg::kCodeCells + (with_glare ? kGlareNodes * kGlareNodes : 0);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  bool clipped = false;
  std::array<int, 13> index{};
  std::array<double, 13> share{};
  for (const Pixel& pixel : pixels_) {
    clipped |= pixel.least >= 0.0F;
    int terms = 0;
    for (; terms < pixel.cells; ++terms) {
      index[terms] = pixel.cell[terms];
      share[terms] = pixel.share[terms];
    }
    for (int a = 0; with_glare && a < 4; ++a, ++terms) {
      index[terms] = sg::kCodeCells + pixel.node + kNodeSteps[a];
      share[terms] = pixel.node_share[a];
    }
    for (int a = 0; a < terms; ++a) {
      for (int b = 0; b < terms; ++b) normal(index[a], index[b]) += share[a] * share[b];
    }
  }
  const double pixels_a_cell =
      normal.topLeftCorner(sg::kCodeCells, sg::kCodeCells).trace() / sg::kCodeCells;
  const double ridge = kRidge * pixels_a_cell + 1e-9;
  normal.diagonal().head(sg::kCodeCells).array() += ridge;
  for (int k = 0; k < sg::kCodeCells; ++k) normal(k, k) += known_white[k] ? kKnown_px : 0.0;
  if (with_glare) {
    // Glare is smooth, so its second differences are small. It is mostly absent, so it is small
    // too.
    const double bend = kGlareBend * pixels_a_cell, size = kGlareSize * pixels_a_cell;
    const auto node = [](int x, int y) { return sg::kCodeCells + y * kGlareNodes + x; };
    const auto bends = [&](int a, int b, int c) {
      const std::array<int, 3> at{a, b, c};
      constexpr std::array<double, 3> kSecond{1.0, -2.0, 1.0};
      for (int p = 0; p < 3; ++p) {
        for (int q = 0; q < 3; ++q) normal(at[p], at[q]) += bend * kSecond[p] * kSecond[q];
      }
    };
    for (int y = 0; y < kGlareNodes; ++y) {
      for (int x = 0; x < kGlareNodes; ++x) {
        normal(node(x, y), node(x, y)) += size;
        if (x > 0 && x + 1 < kGlareNodes) bends(node(x - 1, y), node(x, y), node(x + 1, y));
        if (y > 0 && y + 1 < kGlareNodes) bends(node(x, y - 1), node(x, y), node(x, y + 1));
      }
    }
  }
  const auto factors = normal.ldlt();
  for (int round = 0; round < (clipped ? kRoundsWhenClipped : 1); ++round) {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    right.head(sg::kCodeCells).setConstant(0.5 * ridge);
    for (int k = 0; k < sg::kCodeCells; ++k) right[k] += known_white[k] ? kKnown_px : 0.0;
    for (Pixel& pixel : pixels_) {
      if (round > 0 && pixel.least >= 0.0F) {
        // A clipped pixel takes the value that the cells found so far predict, if that clips.
        float predicted = 0.0F;
        for (int a = 0; a < pixel.cells; ++a) {
          predicted += pixel.share[a] * static_cast<float>((*found)[pixel.cell[a]]);
        }
        pixel.value = std::max(pixel.least, predicted);
      }
      for (int a = 0; a < pixel.cells; ++a) right[pixel.cell[a]] += pixel.share[a] * pixel.value;
      for (int a = 0; with_glare && a < 4; ++a) {
        right[sg::kCodeCells + pixel.node + kNodeSteps[a]] += pixel.node_share[a] * pixel.value;
      }
    }
    *found = factors.solve(right);
    if (!found->allFinite()) return false;
  }
  *inverse =
      factors.solve(Eigen::MatrixXd::Identity(unknowns, sg::kCodeCells)).topRows(sg::kCodeCells);
  return inverse->allFinite();
}

void CellReader::ReadCells(const MarkerPattern& blank, const BlockFit& fit,
                           const ObservedPatch& observed, const BlockFitState& state,
                           const MarkerLight& light, bool with_glare, CellReading* reading) {
  *reading = CellReading{};
  Gather(blank, fit, observed, state, light, with_glare);
  if (pixels_.empty()) return;
  Eigen::VectorXd found;
  Eigen::MatrixXd inverse;
  if (!(with_glare ? SolveWithGlare(&found, &inverse) : Solve(false, {}, &found, &inverse))) return;
  int glaring = 0;
  for (int k = 0; k < sg::kCodeCells; ++k) glaring += found[k] > kGlaring;
  const Eigen::VectorXd& white = found;

  // The noise of a pixel differs between black and white.
  const double white_noise2 = light.white_noise * light.white_noise;
  const double black_noise2 = light.black_noise * light.black_noise;
  const double cell_px =
      sg::kCell / std::max(1e-6F, std::hypot(fit.map().column_x[observed.value.size() / 2],
                                             fit.map().column_y[observed.value.size() / 2]));
  // Where the border is uniform, the cells are uniform too.
  const double by_blur =
      kSystematicPerBlur * state.blur_px / observed.rays.window.Scale() / cell_px;
  // Glare is separated only roughly from the surface under it.
  const double rough = by_blur + (with_glare ? kSystematicGlare : 0.0);
  const Unevenness systematic{
      std::clamp(light.black_noise, kMinUnevenness, kSystematicShare) + rough,
      std::clamp(light.white_noise, 1.5 * kMinUnevenness, kSystematicShare) + rough};

  std::array<double, sg::kCodeCells> left{}, observed_share{}, whole{}, witness{};
  std::array<double, sg::kCodeCells> glare{};
  for (const Pixel& pixel : pixels_) {
    const double thrown_back = with_glare ? GlareAt(pixel, found) : 0.0;
    double predicted = thrown_back;
    for (int a = 0; a < pixel.cells; ++a) predicted += pixel.share[a] * white[pixel.cell[a]];
    const double error = pixel.value - predicted;
    for (int a = 0; a < pixel.cells; ++a) {
      const int k = pixel.cell[a];
      left[k] += pixel.share[a] * error * error;
      glare[k] += pixel.share[a] * std::max(0.0, thrown_back);
      observed_share[k] += pixel.share[a];
      if (pixel.share[a] < kWholeShare) continue;
      const double share = white[k] + error / pixel.share[a];
      const auto density = [&](double undistorted, double noise2) {
        const double even = undistorted > 0.5 ? systematic.white : systematic.black;
        const double sigma2 = noise2 + even * even;
        return (1.0 - kPixelCovered) *
                   std::exp(-0.5 * (share - undistorted) * (share - undistorted) / sigma2) /
                   std::sqrt(2.0 * std::numbers::pi * sigma2) +
               kPixelCovered * kCoveredDensity;
      };
      whole[k] += 1.0;
      witness[k] += std::log(density(1.0, white_noise2) / density(0.0, black_noise2));
    }
  }
  for (int k = 0; k < sg::kCodeCells; ++k) {
    const double on_white = std::clamp(white[k], 0.0, 1.0);
    const double noise2 = on_white * white_noise2 + (1.0 - on_white) * black_noise2;
    reading->white[k] = static_cast<float>(white[k]);
    reading->deviation[k] = static_cast<float>(std::sqrt(std::max(0.0, inverse(k, k) * noise2)));
    reading->observed[k] = observed_share[k] > kMinObserved_px;
    if (!reading->observed[k]) continue;
    // Noise of the whole marker is no sign of an occluder.
    const double beyond = left[k] / observed_share[k] - 1.5 * noise2;
    reading->misfit[k] = static_cast<float>(std::sqrt(std::max(0.0, beyond)));
    if (whole[k] >= kMinWitnesses) {
      reading->witness[k] = static_cast<float>(kWitnesses * witness[k] / whole[k]);
    }
  }
  // Light that saturates cells completely may add little to the cells around them.
  for (int k = 0; k < sg::kCodeCells; ++k) glaring += drowned_ && !reading->observed[k];
  reading->glaring = !light.white_clips && glaring >= kMinGlaringCells;
  for (int k = 0; k < sg::kCodeCells; ++k) glare[k] /= std::max(1.0, observed_share[k]);
  Judge(systematic, glare, reading);
}

void CellReader::Judge(const Unevenness& systematic,
                       const std::array<double, sg::kCodeCells>& glare, CellReading* reading) {
  std::array<double, sg::kCodeCells> evidence{}, covered{};
  const auto density = [&](int k, double undistorted) {
    const double off = reading->white[k] - undistorted;
    const double even =
        (undistorted > 0.5 ? systematic.white : systematic.black) + kUnsurePerGlare * glare[k];
    const double sigma2 = even * even + reading->deviation[k] * reading->deviation[k];
    return std::exp(-0.5 * off * off / sigma2) / std::sqrt(2.0 * std::numbers::pi * sigma2);
  };
  for (int k = 0; k < sg::kCodeCells; ++k) {
    // A cell without observed pixels is saturated or outside the image; it is not occluded.
    if (!reading->observed[k]) continue;
    // Likelihood of the cell's observation if something occludes it.
    const double uneven = reading->misfit[k] / (kUnevenShare + kUnsurePerGlare * glare[k]);
    evidence[k] = std::exp(std::min(20.0, 2.0 * uneven * uneven)) * kCoveredDensity;
    const double clean = 0.5 * (density(k, 0.0) + density(k, 1.0));
    covered[k] =
        kCoveredAlone * evidence[k] / (kCoveredAlone * evidence[k] + (1.0 - kCoveredAlone) * clean);
  }
  for (int k = 0; k < sg::kCodeCells; ++k) {
    if (!reading->observed[k]) continue;
    // What occludes a cell mostly occludes some of its neighbours too.
    double around = 0.0, neighbours = 0.0;
    for (int other = 0; other < sg::kCodeCells; ++other) {
      const int dx = std::abs(sg::CodeCellColumn(other) - sg::CodeCellColumn(k));
      const int dy = std::abs(sg::CodeCellRow(other) - sg::CodeCellRow(k));
      if (other == k || dx > 1 || dy > 1) continue;
      const double weight = dx + dy == 1 ? 1.0 : 0.5;
      around += weight * covered[other];
      neighbours += weight;
    }
    const double prior = kCoveredAlone + (kCoveredAmong - kCoveredAlone) * around / neighbours;
    const double spoiled = prior * evidence[k];
    const float mean = static_cast<float>(std::log((density(k, 1.0) * (1.0 - prior) + spoiled) /
                                                   (density(k, 0.0) * (1.0 - prior) + spoiled)));
    // The fully white pixels of a partly occluded cell still are evidence.
    const float part =
        reading->witness[k] * static_cast<float>(1.0 - kMimicry * around / neighbours);
    reading->likelihoods[k] = std::fabs(part) > std::fabs(mean) ? part : mean;
  }
}

}  // namespace pleinair::tracker
