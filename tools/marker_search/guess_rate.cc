#include "tools/marker_search/guess_rate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "tools/marker_search/surroundings.h"
#include "tracker/pose/homography.h"

namespace pleinair::marker_search {
namespace {

using tracker::sg::kEdge;
using tracker::sg::kModules;

constexpr int kSide_px = 320;
constexpr int kFirstGuesses = 10;
constexpr double kNear = 0.12;  ///< Maximum corner error, relative to the edge.
constexpr double kBandInner = 11.0, kBandOuter = 16.0;  ///< Modules from the centre.
constexpr int kMaxPatches = 40;

/// Occluder of the border: the half-plane beside a line through the centre, or patches.
struct Cover {
  bool patches = false;
  double angle_rad = 0.0;
  struct Patch {
    double x0, y0, x1, y1;
  };
  std::vector<Patch> list;
  int texture = 0, texture_x = 0, texture_y = 0;

  bool Covers(double column, double row) const {
    const double x = column - 0.5 * kModules, y = row - 0.5 * kModules;
    if (!patches) return x * std::cos(angle_rad) + y * std::sin(angle_rad) > 0.0;
    return std::any_of(list.begin(), list.end(), [&](const Patch& p) {
      return x > p.x0 && x < p.x1 && y > p.y0 && y < p.y1;
    });
  }

  double CoveredShareOfBorder() const {
    int band = 0, covered = 0;
    for (int y = 0; y < kModules; ++y) {
      for (int x = 0; x < kModules; ++x) {
        const double away =
            std::max(std::fabs(x + 0.5 - 0.5 * kModules), std::fabs(y + 0.5 - 0.5 * kModules));
        if (away < kBandInner || away > kBandOuter) continue;
        ++band;
        covered += Covers(x + 0.5, y + 0.5) ? 1 : 0;
      }
    }
    return static_cast<double>(covered) / band;
  }
};

Cover DrawCover(bool patches, int textures, RandomDraws* draws) {
  Cover cover;
  cover.texture = draws->Below(textures);
  cover.texture_x = draws->Below(kTextureSide_px);
  cover.texture_y = draws->Below(kTextureSide_px);
  cover.angle_rad = draws->Uniform(0.0, 2.0 * std::numbers::pi);
  cover.patches = patches;
  for (int i = 0; i < kMaxPatches && patches && cover.CoveredShareOfBorder() < 0.5; ++i) {
    const double x = draws->Uniform(-22.0, 22.0), y = draws->Uniform(-22.0, 22.0);
    const double w = draws->Uniform(4.0, 10.0), h = draws->Uniform(4.0, 10.0);
    cover.list.push_back({x - w, y - h, x + w, y + h});
  }
  return cover;
}

bool IsNear(const Mat3& modules_from_undistorted, const Mat3& true_pixels, double edge_px) {
  const Mat3 pixels = tracker::Adjugate(modules_from_undistorted);
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2 modules{corner & 1 ? 44.0 : 4.0, corner & 2 ? 44.0 : 4.0};
    const Vec2 off = tracker::Apply(pixels, modules) - tracker::Apply(true_pixels, modules);
    if (!(Norm(off) < kNear * edge_px)) return false;
  }
  return true;
}

}  // namespace

GuessRate MeasureGuessRate(const tracker::sg::Border& border,
                           const std::vector<GreyImage>& textures, int scenes, std::uint64_t seed,
                           const tracker::BorderSearchOptions& options) {
  CameraModel camera;
  camera.width = camera.height = kSide_px;
  camera.fx = camera.fy = 600.0;
  camera.cx = camera.cy = 0.5 * (kSide_px - 1);
  const tracker::LensGrid lens(camera);
  tracker::BorderSearch search(
      lens, tracker::MakeBorderTemplates(options.surf.descriptor_window_scales, border), options);
  ViewRenderer renderer(textures);
  RandomDraws draws(seed);
  GreyImage image;
  std::vector<tracker::BorderGuess> guesses;
  GuessRate result;
  std::array<int, GuessRate::kSizes> of_size{};
  std::array<int, GuessRate::kTilts> of_tilt{};
  int found = 0, with_patches = 0;
  for (int scene = 0; scene < scenes; ++scene) {
    MarkerView view;
    view.DrawConditions(static_cast<int>(textures.size()), &draws);
    view.edge_px = 30.0 * std::pow(150.0 / 30.0, draws.Uniform());
    view.tilt_rad = kRadiansPerDegree * draws.Uniform(0.0, 75.0);
    view.direction_rad = draws.Uniform(0.0, 2.0 * std::numbers::pi);
    view.roll_rad = draws.Uniform(0.0, 2.0 * std::numbers::pi);
    const Vec2 centre{draws.Uniform(100.0, 220.0), draws.Uniform(100.0, 220.0)};
    const bool patches = scene % 2 == 1;
    const Cover cover = DrawCover(patches, static_cast<int>(textures.size()), &draws);

    const Mat3 pixels = view.PixelsFromModules(centre);
    renderer.Render(view, border, pixels, kSide_px, kSide_px, &image);
    constexpr int kMask = kTextureSide_px - 1;
    std::size_t n = 0;
    for (int y = 0; y < kSide_px; ++y) {
      for (int x = 0; x < kSide_px; ++x, ++n) {
        const float column = renderer.map().column[n], row = renderer.map().row[n];
        if (column < 0.0F || column > kModules || row < 0.0F || row > kModules) continue;
        if (!cover.Covers(column, row)) continue;
        image(x, y) =
            textures[cover.texture]((x + cover.texture_x) & kMask, (y + cover.texture_y) & kMask);
      }
    }
    search.Find(image.view(), {}, tracker::BorderSearch::Sizes::kAll, &guesses);
    if (guesses.size() > kFirstGuesses) guesses.resize(kFirstGuesses);
    const double right =
        std::any_of(guesses.begin(), guesses.end(),
                    [&](const auto& guess) {
                      return IsNear(guess.modules_from_undistorted, pixels, view.edge_px);
                    })
            ? 1.0
            : 0.0;
    const int size = view.edge_px < 60.0 ? 0 : view.edge_px < 100.0 ? 1 : 2;
    const int tilt = view.tilt_rad < 40.0 * kRadiansPerDegree   ? 0
                     : view.tilt_rad < 60.0 * kRadiansPerDegree ? 1
                                                                : 2;
    ++of_size[size];
    ++of_tilt[tilt];
    result.by_size[size] += right;
    result.by_tilt[tilt] += right;
    found += right > 0.0 ? 1 : 0;
    if (patches) {
      ++with_patches;
      result.by_patches += right;
    }
  }
  result.scenes = scenes;
  result.rate = static_cast<double>(found) / std::max(1, scenes);
  result.by_patches /= std::max(1, with_patches);
  for (std::size_t i = 0; i < of_size.size(); ++i) result.by_size[i] /= std::max(1, of_size[i]);
  for (std::size_t i = 0; i < of_tilt.size(); ++i) result.by_tilt[i] /= std::max(1, of_tilt[i]);
  return result;
}

}  // namespace pleinair::marker_search
