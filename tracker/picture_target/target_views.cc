#include "tracker/picture_target/target_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/srgb.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/picture_target/picture_pyramid.h"
#include "tracker/picture_target/picture_raster.h"
#include "tracker/surf/keypoint_clusters.h"
#include "tracker/surf/surf.h"
#include "tracker/surf/view_draws.h"

namespace pleinair::tracker {
namespace {

/// Tilts (1 / cos of the angle) and the number of directions of each.
struct Tilt {
  double tilt;
  int directions;
};
constexpr std::array<Tilt, 5> kTilts{{{1.0, 1}, {1.42, 4}, {2.0, 5}, {2.85, 7}, {4.0, 9}}};
/// Longer side of the untilted image in px, its maximum tilt, and the number of keypoints that are
/// kept of a view.
struct Distance {
  double side_px, steepest;
  std::size_t keypoints;
};
constexpr std::array<Distance, 3> kDistances{
    {{320.0, 4.0, 130}, {140.0, 2.85, 90}, {70.0, 2.0, 60}}};
/// In smaller images the keypoints are those of the doubled octave.
constexpr double kSmall_px = 100.0;
constexpr int kDraws = 4;  ///< Number of random blurs, noises, distances and surroundings;
constexpr int kComesBack =
    3;  ///< … and the minimum number of them in which a keypoint must be found.
constexpr double kMargin_px = 20.0;  ///< Surroundings around the image.
constexpr double kMinBlur_px = 0.5, kMaxBlur_px = 1.1, kMaxZoom = 0.12;
constexpr double kNoise_codes = 2.0;
constexpr double kPaper = 0.75;  ///< Linear light of the image's white.

/// The image compressed `tilt` times across `direction`; its longer side is `side_px` if untilted.
struct ViewShape {
  double a, b, d, e;
  int width, height;
};

ViewShape ShapeOf(const PictureTarget& target, double side_px, double tilt, double direction) {
  const double c = std::cos(direction), s = std::sin(direction), k = 1.0 / tilt;
  const double per_m = side_px / std::max(target.width_m, target.height_m);
  const double along_u = per_m * target.width_m / kTargetSide;
  const double along_v = per_m * target.height_m / kTargetSide;
  ViewShape shape{};
  shape.a = along_u * (c * c + k * s * s);
  shape.b = along_v * (1.0 - k) * c * s;
  shape.d = along_u * (1.0 - k) * c * s;
  shape.e = along_v * (s * s + k * c * c);
  const double half = 0.5 * kTargetSide;
  shape.width =
      static_cast<int>(2.0 * (half * (std::fabs(shape.a) + std::fabs(shape.b)) + kMargin_px));
  shape.height =
      static_cast<int>(2.0 * (half * (std::fabs(shape.d) + std::fabs(shape.e)) + kMargin_px));
  return shape;
}

/// `shape` magnified `zoom` times, with the target's centre `shift` from the image's.
TargetView ViewOf(const ViewShape& shape, double zoom, Vec2 shift) {
  const double half = 0.5 * kTargetSide;
  const double a = zoom * shape.a, b = zoom * shape.b, d = zoom * shape.d, e = zoom * shape.e;
  return {{a, b, 0.5 * (shape.width - 1) + shift.x - (a + b) * half, d, e,
           0.5 * (shape.height - 1) + shift.y - (d + e) * half}};
}

Mat3 TargetFromView(const TargetView& view) {
  const auto& m = view.from_target;
  const double determinant = m[0] * m[4] - m[1] * m[3];
  return {{m[4] / determinant, -m[1] / determinant, (m[1] * m[5] - m[4] * m[2]) / determinant,
           -m[3] / determinant, m[0] / determinant, (m[3] * m[2] - m[0] * m[5]) / determinant, 0, 0,
           1}};
}

class ViewMaker {
 public:
  explicit ViewMaker(PictureTarget* target) : target_(*target), pyramid_(target->picture.view()) {}

  void Make() {
    for (const Distance& distance : kDistances) {
      Surf surf({.octaves = 3,
                 .max_keypoints = 2 * static_cast<int>(distance.keypoints),
                 .double_size = distance.side_px < kSmall_px,
                 .bucket_px = static_cast<int>(0.2 * distance.side_px),
                 .descriptor_window_scales = kTargetDescriptorWindow_scales});
      for (const Tilt& tilt : kTilts) {
        if (tilt.tilt > distance.steepest) break;
        for (int k = 0; k < tilt.directions; ++k) {
          const double direction = std::numbers::pi * k / tilt.directions;
          AddView(distance, tilt.tilt, direction, &surf);
        }
      }
    }
  }

 private:
  void AddView(const Distance& distance, double tilt, double direction, Surf* surf) {
    const ViewShape shape = ShapeOf(target_, distance.side_px, tilt, direction);
    const TargetView view = ViewOf(shape, 1.0, {});
    CameraModel camera;
    camera.width = shape.width;
    camera.height = shape.height;
    camera.fx = camera.fy = 1.0;
    LookUpRays(LensGrid(camera), {0, 0, 0, shape.width, shape.height}, &rays_);
    clusters_.clear();
    for (int draw = 0; draw < kDraws; ++draw) {
      const double zoom = 1.0 + kMaxZoom * (draws_.Uniform() - 0.5);
      const Vec2 shift{draws_.Uniform() - 0.5, draws_.Uniform() - 0.5};
      const TargetView drawn = ViewOf(shape, zoom, shift);
      surf->Detect(Draw(drawn), &keypoints_);
      surf->Describe(&keypoints_, &descriptors_);
      for (std::size_t i = 0; i < keypoints_.size(); ++i) {
        Collect(view, drawn, zoom, draw, {keypoints_[i], descriptors_[i]});
      }
    }
    Keep(view, distance.keypoints);
  }

  /// Renders the target as a camera would observe it.
  ImageView<const std::uint8_t> Draw(const TargetView& view) {
    const double blur = kMinBlur_px + (kMaxBlur_px - kMinBlur_px) * draws_.Uniform();
    raster_.Render(pyramid_, TargetFromView(view), rays_, blur, &map_, &picture_, &ranges_);
    const int width = rays_.window.width, height = rays_.window.height;
    const double around = 0.5 * draws_.Uniform();
    if (grey_.width() != width || grey_.height() != height) grey_ = GreyImage(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t n = static_cast<std::size_t>(y) * width + x;
        const bool inside = map_.column[n] > 0.0F && map_.column[n] < kTargetSide &&
                            map_.row[n] > 0.0F && map_.row[n] < kTargetSide;
        const double light = inside ? kPaper * picture_.white[n] : around;
        const double code = 255.0 * SrgbFromLinear(light) + kNoise_codes * draws_.Normal();
        grey_(x, y) = static_cast<std::uint8_t>(std::clamp(code + 0.5, 0.0, 255.0));
      }
    }
    return grey_.view();
  }

  /// Clusters a keypoint of a drawn view, in the coordinates of `view`, with those of other draws.
  void Collect(const TargetView& view, const TargetView& drawn, double zoom, int draw,
               DescribedKeypoint observed) {
    const Vec2 place = PlaceOnTarget(drawn, {observed.keypoint.x, observed.keypoint.y});
    if (!(place.x > 0.0 && place.x < kTargetSide && place.y > 0.0 && place.y < kTargetSide)) return;
    const auto& m = view.from_target;
    observed.keypoint.x = static_cast<float>(m[0] * place.x + m[1] * place.y + m[2]);
    observed.keypoint.y = static_cast<float>(m[3] * place.x + m[4] * place.y + m[5]);
    observed.keypoint.scale /= static_cast<float>(zoom);
    AddToClusters(observed, draw + kComesBack <= kDraws, &clusters_);
  }

  void Keep(const TargetView& view, std::size_t most) {
    std::erase_if(clusters_, [](const KeypointCluster& c) { return c.size() < kComesBack; });
    // First those found most often, then the strongest.
    std::stable_sort(clusters_.begin(), clusters_.end(),
                     [](const KeypointCluster& a, const KeypointCluster& b) {
                       const std::size_t times_a = std::min<std::size_t>(a.size(), kDraws);
                       const std::size_t times_b = std::min<std::size_t>(b.size(), kDraws);
                       if (times_a != times_b) return times_a > times_b;
                       return a.front().keypoint.response > b.front().keypoint.response;
                     });
    if (clusters_.size() > most) clusters_.resize(most);
    const int index = static_cast<int>(target_.views.size());
    target_.views.push_back(view);
    for (const KeypointCluster& cluster : clusters_) AddKeypoint(cluster, index);
  }

  void AddKeypoint(const KeypointCluster& cluster, int view) {
    const auto n = static_cast<float>(cluster.size());
    TargetKeypoint keypoint;
    keypoint.view = view;
    SurfDescriptor mean{};
    float cosine = 0.0F, sine = 0.0F;
    for (const DescribedKeypoint& observed : cluster) {
      keypoint.x += observed.keypoint.x / n;
      keypoint.y += observed.keypoint.y / n;
      keypoint.scale += observed.keypoint.scale / n;
      cosine += std::cos(observed.keypoint.angle_rad);
      sine += std::sin(observed.keypoint.angle_rad);
      for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += observed.descriptor[k] / n;
    }
    keypoint.angle_rad = std::atan2(sine, cosine);
    target_.keypoints.push_back(keypoint);
    target_.descriptors.push_back(Quantise(mean, cluster.front().keypoint.bright));
  }

  PictureTarget& target_;
  const PicturePyramid pyramid_;
  ViewDraws draws_;
  PictureRaster raster_;
  WindowRays rays_;
  PlaneMap map_;
  PredictedImage picture_;
  std::vector<RowRange> ranges_;
  GreyImage grey_;
  std::vector<SurfKeypoint> keypoints_;
  std::vector<SurfDescriptor> descriptors_;
  std::vector<KeypointCluster> clusters_;
};

}  // namespace

void FillTargetViews(PictureTarget* target) { ViewMaker(target).Make(); }

}  // namespace pleinair::tracker
