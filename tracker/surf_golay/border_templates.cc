#include "tracker/surf_golay/border_templates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/srgb.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/golay/golay_code.h"
#include "tracker/surf/keypoint_clusters.h"
#include "tracker/surf/surf.h"
#include "tracker/surf/view_draws.h"
#include "tracker/surf_golay/sg_layout.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {
namespace {

/// Tilts (1 / cos of the angle) and the number of directions of each.
struct Tilt {
  double tilt;
  int directions;
};
constexpr std::array<Tilt, 6> kTilts{
    {{1.0, 1}, {1.42, 4}, {2.0, 5}, {2.85, 7}, {4.0, 9}, {5.6, 10}}};
/// Edge of the untilted marker square: near and far.
constexpr std::array<double, 2> kEdges_px{150.0, 60.0};
constexpr int kDraws = 4;  ///< Number of random contents and surroundings;
constexpr int kComesBack =
    3;  ///< … and the minimum number of them in which a keypoint must be found.
constexpr double kMargin_px = 24.0;  ///< Surroundings around the marker.
constexpr double kBlur_px = 0.7;
constexpr double kInk = 0.04, kPaper = 0.8;
constexpr int kMaxKeypoints = 200;

class TemplateMaker {
 public:
  TemplateMaker(float window_scales, const sg::Border& border)
      : border_(border),
        surf_({.threshold = 0.0002F,
               .max_keypoints = kMaxKeypoints,
               .bucket_px = 0,
               .descriptor_window_scales = window_scales}) {}

  BorderTemplates Make() {
    for (const double edge : kEdges_px) {
      for (const Tilt& tilt : kTilts) {
        // Far and at a large tilt, a border has no keypoints.
        if (edge < 100.0 && tilt.tilt > 3.0) continue;
        for (int k = 0; k < tilt.directions; ++k) {
          AddView(edge, tilt.tilt, std::numbers::pi * k / tilt.directions);
        }
      }
    }
    return std::move(templates_);
  }

 private:
  void AddView(double edge_px, double tilt, double direction) {
    // Compress across `direction`, about the marker's centre.
    const double c = std::cos(direction), s = std::sin(direction), k = 1.0 / tilt;
    const double per_module = edge_px / sg::kEdge;
    const double a = per_module * (c * c + k * s * s), b = per_module * (1.0 - k) * c * s;
    const double e = per_module * (s * s + k * c * c);
    const double half = 0.5 * sg::kModules;
    const double reach_x = half * (std::fabs(a) + std::fabs(b)) + kMargin_px;
    const double reach_y = half * (std::fabs(b) + std::fabs(e)) + kMargin_px;
    const int width = static_cast<int>(2.0 * reach_x), height = static_cast<int>(2.0 * reach_y);
    const double x0 = 0.5 * (width - 1), y0 = 0.5 * (height - 1);
    BorderTemplates::View view{{a, b, x0 - (a + b) * half, b, e, y0 - (b + e) * half}};
    const double determinant = a * e - b * b;
    const Mat3 modules_from_view{
        {e / determinant, -b / determinant,
         (b * view.from_modules[5] - e * view.from_modules[2]) / determinant, -b / determinant,
         a / determinant, (b * view.from_modules[2] - a * view.from_modules[5]) / determinant, 0, 0,
         1}};
    CameraModel camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = 1.0;
    LookUpRays(LensGrid(camera), {0, 0, 0, width, height}, &rays_);

    std::vector<KeypointCluster> clusters;
    GreyImage grey(width, height);
    for (int draw = 0; draw < kDraws; ++draw) {
      const MarkerPattern marker = SgMarkerPatternOfWord(
          CodewordOfNumber(static_cast<int>(draws_.Next() % kGolayNumbers)), border_);
      raster_.Render(marker, modules_from_view, rays_, kBlur_px, &map_, &picture_);
      const double around = kInk + (kPaper - kInk) * draws_.Uniform() * draws_.Uniform();
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const std::size_t n = static_cast<std::size_t>(y) * width + x;
          const bool inside = map_.column[n] > 0.0F && map_.column[n] < sg::kModules &&
                              map_.row[n] > 0.0F && map_.row[n] < sg::kModules;
          const double light = inside ? kInk + (kPaper - kInk) * picture_.white[n] : around;
          grey(x, y) = Srgb8FromLinear(light);
        }
      }
      surf_.Detect(grey.view(), &keypoints_);
      surf_.Describe(&keypoints_, &descriptors_);
      for (std::size_t i = 0; i < keypoints_.size(); ++i) {
        AddToClusters({keypoints_[i], descriptors_[i]}, draw + kComesBack <= kDraws, &clusters);
      }
    }
    const int view_index = static_cast<int>(templates_.views.size());
    templates_.views.push_back(view);
    for (const KeypointCluster& cluster : clusters) {
      if (static_cast<int>(cluster.size()) < kComesBack) continue;
      AddKeypoint(cluster, modules_from_view, view_index);
    }
  }

  void AddKeypoint(const KeypointCluster& cluster, const Mat3& modules_from_view, int view_index) {
    const double n = static_cast<double>(cluster.size());
    BorderTemplate keypoint;
    keypoint.view_index = view_index;
    SurfDescriptor mean{};
    double cosine = 0.0, sine = 0.0;
    for (const DescribedKeypoint& observed : cluster) {
      keypoint.view = keypoint.view + Vec2{observed.keypoint.x / n, observed.keypoint.y / n};
      keypoint.scale += observed.keypoint.scale / n;
      cosine += std::cos(observed.keypoint.angle_rad);
      sine += std::sin(observed.keypoint.angle_rad);
      for (std::size_t k = 0; k < mean.size(); ++k) {
        mean[k] += observed.descriptor[k] / static_cast<float>(n);
      }
    }
    keypoint.angle_rad = std::atan2(sine, cosine);
    const Vec3 modules = modules_from_view * Vec3{keypoint.view.x, keypoint.view.y, 1.0};
    keypoint.modules = {modules.x, modules.y};
    // A keypoint off the marker, or dominated by the content, is no evidence.
    if (keypoint.modules.x < 0 || keypoint.modules.x > sg::kModules || keypoint.modules.y < 0 ||
        keypoint.modules.y > sg::kModules) {
      return;
    }
    templates_.keypoints.push_back(keypoint);
    templates_.descriptors.push_back(Quantise(mean, cluster.front().keypoint.bright));
  }

  const sg::Border& border_;
  Surf surf_;
  ViewDraws draws_;
  MarkerRaster raster_;
  WindowRays rays_;
  PlaneMap map_;
  PredictedImage picture_;
  std::vector<SurfKeypoint> keypoints_;
  std::vector<SurfDescriptor> descriptors_;
  BorderTemplates templates_;
};

}  // namespace

BorderTemplates MakeBorderTemplates(float descriptor_window_scales, const sg::Border& border) {
  return TemplateMaker(descriptor_window_scales, border).Make();
}

}  // namespace pleinair::tracker
