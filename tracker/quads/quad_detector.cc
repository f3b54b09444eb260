#include "tracker/quads/quad_detector.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "tracker/quads/dark_components.h"
#include "tracker/quads/dark_mask.h"
#include "tracker/quads/quad_box.h"
#include "tracker/quads/quad_edges.h"
#include "tracker/quads/quad_outline.h"

namespace pleinair::tracker {
namespace {

/// At full size only the thinnest borders are searched, and speckle costs most. The contrast of a
/// neighbourhood must be at least half its brightness, and above the noise.
constexpr DarkContrast kFullSize{.codes = 150, .halvings = 1, .eighths = 5};
/// Half size detects markers with low contrast, noise and blur.
constexpr DarkContrast kHalfSize{.codes = 64, .halvings = 2, .eighths = 4};
/// Where a shadow edge crosses a marker, the quiet zone in shadow is darker than half way to the
/// sunlit one. It then merges with the border. With a quarter of the way, shadow edges up to 16:1
/// are handled.
constexpr DarkContrast kShadowEdges{.codes = 150, .halvings = 1, .eighths = 2};

constexpr float kMinContrast = 6.0F;  // 8-bit values; quantisation and noise leave 4 within black.
constexpr float kMinSide = 0.12F;
/// Markers reach it below 13 px, where border and quiet zone blur into each other, or where noise
/// is a third of their difference.
constexpr float kMaxDoubt = 0.8F;

Vec2 Centre(const Quad& quad) {
  return (quad.corners_px[0] + quad.corners_px[1] + quad.corners_px[2] + quad.corners_px[3]) * 0.25;
}

double Area(const Quad& quad) {
  const Vec2 d = quad.corners_px[2] - quad.corners_px[0],
             e = quad.corners_px[3] - quad.corners_px[1];
  return 0.5 * (d.x * e.y - d.y * e.x);
}

bool Plausible(const RimEvidence& evidence, float max_doubt) {
  return evidence.contrast >= kMinContrast && evidence.min_side >= kMinSide &&
         evidence.Doubt() <= max_doubt;
}

/// Whether two detections are the same square.
bool Same(const Quad& a, const Quad& b) {
  const double area = std::min(Area(a), Area(b));
  if (std::max(Area(a), Area(b)) > 1.3 * area) return false;
  const Vec2 apart = Centre(a) - Centre(b);
  return apart.x * apart.x + apart.y * apart.y < 0.01 * area;
}

}  // namespace

struct QuadDetector::Work {
  QuadDetectorOptions options;
  DarkMaskBuffers buffers;
  BitMask mask;
  Image<std::uint8_t> half;
  DarkComponents components;
  QuadOutline outline;

  void DetectAt(ImageView<const std::uint8_t> level, int scale, DarkContrast contrast,
                ImageView<const std::uint8_t> grey, std::vector<Quad>* quads);
};

QuadDetector::QuadDetector(QuadDetectorOptions options) : work_(std::make_unique<Work>()) {
  work_->options = options;
}
QuadDetector::~QuadDetector() = default;
QuadDetector::QuadDetector(QuadDetector&&) noexcept = default;
QuadDetector& QuadDetector::operator=(QuadDetector&&) noexcept = default;

void QuadDetector::Work::DetectAt(ImageView<const std::uint8_t> level, int scale,
                                  DarkContrast contrast, ImageView<const std::uint8_t> grey,
                                  std::vector<Quad>* quads) {
  ComputeDarkMask(level, contrast, SimdDarkMaskKernels(), &buffers, &mask);
  components.Find(mask);
  const std::vector<DarkComponent>& found = components.components();
  const double min_side = std::max(options.min_side_px / scale, 6.0);
  const int min_extent = static_cast<int>(std::floor(min_side));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const DarkComponent& c = found[i];
    const int width = c.max_x - c.min_x + 1, height = c.max_y - c.min_y + 1;
    // A closed border has at least about as many pixels as its box is wide and high. A whole marker
    // has a quiet zone around it.
    if (width < min_extent || height < min_extent || c.area < width + height ||
        c.parent != static_cast<int>(i) || c.min_x == 0 || c.min_y == 0 ||
        c.max_x == level.width() - 1 || c.max_y == level.height() - 1) {
      continue;
    }
    if (std::ranges::any_of(*quads, [&](const Quad& q) { return FillsBoxOf(q, c, scale); }))
      continue;
    const auto outline_found = outline.Fit(components.runs(), c, min_side);
    if (!outline_found) continue;
    Quad quad{*outline_found, 0.0F};
    for (Vec2& corner : quad.corners_px) {
      corner = corner * scale + Vec2{0.5 * (scale - 1), 0.5 * (scale - 1)};
    }
    const auto known = [&](const Quad& other) { return Same(quad, other); };
    if (std::any_of(quads->begin(), quads->end(), known)) continue;
    if (!RefineQuad(grey, 3.0 * scale, 12, &quad.corners_px) ||
        !Plausible(SampleRim(grey, quad.corners_px), 1.2F * kMaxDoubt)) {
      continue;
    }
    // Few are left: refine again with a small search range and many samples.
    if (!RefineQuad(grey, 6.0, 48, &quad.corners_px)) continue;
    const RimEvidence evidence = SampleRim(grey, quad.corners_px);
    if (!Plausible(evidence, kMaxDoubt)) continue;
    quad.contrast = evidence.contrast;
    if (std::none_of(quads->begin(), quads->end(), known)) quads->push_back(quad);
  }
}

void QuadDetector::Detect(ImageView<const std::uint8_t> grey, std::vector<Quad>* quads) {
  CHECK_EQ(grey.channels(), 1);
  quads->clear();
  if (grey.width() < 8 || grey.height() < 8) return;
  work_->DetectAt(grey, 1, kFullSize, grey, quads);
  HalveImage(grey, SimdDarkMaskKernels(), &work_->half);
  work_->DetectAt(work_->half.view(), 2, kHalfSize, grey, quads);
  work_->DetectAt(work_->half.view(), 2, kShadowEdges, grey, quads);
}

}  // namespace pleinair::tracker
