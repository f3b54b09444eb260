#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/tracker/alignment/alignment_scene.h"
#include "tests/tracker/counted_memory.h"

namespace pleinair::tracker {
namespace {

AlignmentView RandomView(double side_px, std::mt19937* random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  AlignmentView view;
  view.side_px = side_px;
  view.centre_px = {158.0 + unit(*random), 121.0 + unit(*random)};
  view.tilt = Radians(0.5 + 0.4 * unit(*random));
  view.tilt_axis = Radians(3.0 * unit(*random));
  view.roll = Radians(3.0 * unit(*random));
  return view;
}

struct Errors {
  Vec2 mean;
  double rms = 0.0, worst = 0.0;
  int failures = 0;
};

/// Corner errors over several views.
Errors Measure(double side_px, double off_px, const RenderingOptions& rendering,
               void (*cover)(AlignmentScene*), bool fit_light = false) {
  std::mt19937 random(11);
  Errors errors;
  int corners = 0;
  ObservedPatch observed;
  BlockFit fit;
  const int views = rendering.light ? 5 : 10;  // Per-sample light is slow to render.
  for (int k = 0; k < views; ++k) {
    RenderingOptions options = rendering;
    options.seed = static_cast<std::uint32_t>(k + 1);
    AlignmentScene scene = MakeScene(RandomView(side_px, &random), options);
    if (cover != nullptr) cover(&scene);
    BlockFitState state = scene.Guess(off_px);
    if (!FitWhole(scene, &observed, &fit, &state, fit_light)) {
      ++errors.failures;
      continue;
    }
    const std::array<Vec2, 4> found = scene.Corners(state);
    for (int i = 0; i < 4; ++i) {
      const Vec2 error = found[i] - scene.truth[i];
      errors.mean = errors.mean + error;
      errors.rms += Norm(error) * Norm(error);
      errors.worst = std::max(errors.worst, Norm(error));
      ++corners;
    }
  }
  errors.mean = errors.mean * (1.0 / std::max(1, corners));
  errors.rms = std::sqrt(errors.rms / std::max(1, corners));
  return errors;
}

TEST(BlockFit, BringsMarkersBackWithoutBias) {
  struct Case {
    double side_px, off_px, noise_codes, rms_px;
  };
  for (const Case& c :
       {Case{16, 0.3, 0, 0.06}, Case{24, 0.3, 0, 0.03}, Case{42, 0.4, 0, 0.02},
        Case{120, 0.8, 0, 0.015}, Case{16, 0.3, 2, 0.06}, Case{24, 0.3, 2, 0.03},
        Case{42, 0.4, 2, 0.025}, Case{120, 0.8, 2, 0.015}, Case{120, 0.8, 8, 0.04}}) {
    SCOPED_TRACE(testing::Message() << c.side_px << " px, noise " << c.noise_codes);
    const Errors errors = Measure(
        c.side_px, c.off_px, {.blur_px = 0.6, .noise_codes = c.noise_codes, .light = {}}, nullptr);
    EXPECT_EQ(errors.failures, 0);
    EXPECT_LT(Norm(errors.mean), 0.02);
    EXPECT_LT(errors.rms, c.rms_px);
  }
}

TEST(BlockFit, FindsMarkersUnderAGradient) {
  const auto gradient = [](Vec2 pixel) { return std::exp2(0.03 * (pixel.x - 200.0)); };
  const Errors errors =
      Measure(120, 0.8, {.blur_px = 0.6, .noise_codes = 2.0, .light = gradient}, nullptr);
  EXPECT_EQ(errors.failures, 0);
  EXPECT_LT(Norm(errors.mean), 0.02);
  EXPECT_LT(errors.rms, 0.08);
}

TEST(BlockFit, MeasuresMarkersUnderAGradientAsInEvenLight) {
  const auto gradient = [](Vec2 pixel) { return std::exp2(0.03 * (pixel.x - 200.0)); };
  for (const bool fit_light : {false, true}) {
    const Errors errors = Measure(120, 0.8, {.blur_px = 0.6, .noise_codes = 0.0, .light = gradient},
                                  nullptr, fit_light);
    EXPECT_EQ(errors.failures, 0);
    if (fit_light) {
      EXPECT_LT(errors.rms, 0.02);
    } else {
      EXPECT_GT(errors.rms, 0.04) << "else there is nothing to fit";
    }
  }
}

// The quiet zone of a marker of 16 px is 1.6 px wide. The lens blurs its surroundings into it.
TEST(BlockFit, IsNotDrawnByWhatLiesBesideASmallPrint) {
  const auto rms = [](double background, bool fit_light) {
    const Errors errors = Measure(16, 0.2, {.background = background, .blur_px = 0.6, .light = {}},
                                  nullptr, fit_light);
    EXPECT_EQ(errors.failures, 0);
    return errors.rms;
  };
  EXPECT_LT(rms(0.05, true), 1.15 * rms(0.8, true)) << "dark beside it as good as white";
  EXPECT_GT(rms(0.05, false), 1.4 * rms(0.8, false)) << "else there is nothing to fit";
}

TEST(BlockFit, FindsMarkersCrossedByTheEdgeOfAShadow) {
  const auto shadow = [](Vec2 pixel) { return pixel.x + 0.3 * pixel.y > 190.0 ? 1.0 : 1.0 / 16.0; };
  for (const double side : {42.0, 120.0}) {
    const Errors errors =
        Measure(side, 0.5, {.blur_px = 0.6, .noise_codes = 2.0, .light = shadow}, nullptr);
    EXPECT_EQ(errors.failures, 0);
    EXPECT_LT(Norm(errors.mean), 0.1) << side;  // Over five views.
    EXPECT_LT(errors.rms, 0.2) << side;
  }
}

TEST(BlockFit, FindsMarkersOfWhichHalfIsCovered) {
  const auto cover = [](AlignmentScene* scene) {
    std::mt19937 random(5);
    for (int y = 0; y < scene->image.height(); ++y) {
      for (int x = 0; x < 158; ++x) {
        scene->image(x, y) = static_cast<std::uint8_t>(120 + random() % 16);
      }
    }
  };
  for (const double side : {42.0, 120.0}) {
    const Errors errors =
        Measure(side, 0.4, {.blur_px = 0.6, .noise_codes = 2.0, .light = {}}, cover);
    EXPECT_EQ(errors.failures, 0);
    // The covered corners depend on the visible part: they are four times as far from it.
    EXPECT_LT(errors.rms, 0.4) << side;
    EXPECT_LT(Norm(errors.mean), 0.1) << side;
  }
}

TEST(BlockFit, FindsTheBlurToo) {
  for (const double blur : {0.6, 0.9, 1.5}) {
    const AlignmentScene scene = MakeScene({}, {.blur_px = blur, .light = {}});
    ObservedPatch observed;
    BlockFit fit;
    BlockFitState state = scene.Guess(0.4);
    ASSERT_TRUE(FitWhole(scene, &observed, &fit, &state));
    EXPECT_NEAR(state.blur_px, blur, 0.01);
    EXPECT_GT(fit.Correlation(), 0.995);
  }
}

TEST(BlockFit, LooksAtTheBorderAloneWhereTheContentIsUnknown) {
  const AlignmentScene scene = MakeScene({}, {.blur_px = 0.6, .light = {}});
  MarkerPattern other = scene.marker_pattern();
  for (int y = 0; y < other.unknown_modules; ++y) {
    for (int x = 0; x < other.unknown_modules; ++x) {
      std::uint8_t& white =
          other.white[(other.unknown_first + y) * other.modules + other.unknown_first + x];
      white = white != 0 ? 0 : 1;
    }
  }
  ASSERT_GT(other.unknown_modules, 0);
  ObservedPatch observed;
  TakeLinearWindow(*scene.lens, scene.image.view(), scene.window, &observed);
  BlockFit fit;
  BlockFitOptions options;
  options.fit_blur = true;
  BlockFitState state = scene.Guess(0.6);
  ASSERT_TRUE(fit.Run(other, MarkerPart::kBorder, observed, 8, options, &state));
  const std::array<Vec2, 4> found = scene.Corners(state);
  for (int i = 0; i < 4; ++i) EXPECT_LT(Norm(found[i] - scene.truth[i]), 0.05);
  EXPECT_GT(fit.Correlation(), 0.98);
  const float first = static_cast<float>(other.unknown_first);
  const float last = first + static_cast<float>(other.unknown_modules);
  for (std::size_t n = 0; n < observed.value.size(); ++n) {
    const float c = fit.map().column[n], r = fit.map().row[n];
    if (c > first && c < last && r > first && r < last) {
      ASSERT_EQ(fit.block_of()[n], -1);
    }
  }
}

TEST(BlockFit, DependsOnNothingThatCameBefore) {
  const AlignmentScene scene = MakeScene({}, {.blur_px = 0.6, .noise_codes = 2.0, .light = {}});
  AlignmentView small;
  small.side_px = 30.0;
  const AlignmentScene before = MakeScene(small, {.noise_codes = 9.0, .light = {}});
  ObservedPatch observed;
  BlockFit fresh, used;
  BlockFitState a = scene.Guess(0.5), b = scene.Guess(0.5), c = before.Guess(0.5);
  ASSERT_TRUE(FitWhole(before, &observed, &used, &c));
  ASSERT_TRUE(FitWhole(scene, &observed, &used, &b));
  ASSERT_TRUE(FitWhole(scene, &observed, &fresh, &a));
  EXPECT_EQ(a.modules_from_undistorted, b.modules_from_undistorted);
  EXPECT_EQ(a.blur_px, b.blur_px);
  EXPECT_EQ(fresh.MotionCovariance(), used.MotionCovariance());
  EXPECT_EQ(fresh.block_of(), used.block_of());
  EXPECT_EQ(fresh.image().white, used.image().white);
}

TEST(BlockFit, AsksForNoMemoryAfterTheFirstFit) {
  const AlignmentScene scene = MakeScene({}, {.blur_px = 0.6, .noise_codes = 2.0, .light = {}});
  AlignmentView view;
  view.side_px = 40.0;
  const AlignmentScene smaller = MakeScene(view, {.blur_px = 0.6, .light = {}});
  ObservedPatch observed;
  BlockFit fit;
  BlockFitState state = scene.Guess(0.5);
  // The maximum blur needs the longest filter taps.
  state.blur_px = 2.5;
  ASSERT_TRUE(FitWhole(scene, &observed, &fit, &state));
  const long before = Allocations();
  for (const AlignmentScene* at : {&smaller, &scene, &smaller}) {
    state = at->Guess(0.5);
    ASSERT_TRUE(FitWhole(*at, &observed, &fit, &state));
  }
  EXPECT_EQ(Allocations(), before);
}

TEST(BlockFit, SurvivesWindowsThatShowNothing) {
  const AlignmentScene scene = MakeScene({}, {.light = {}});
  ObservedPatch observed;
  BlockFit fit;
  BlockFitOptions options;
  options.fit_blur = true;
  for (const PixelWindow& window :
       {PixelWindow{0, 5, 5, 0, 0}, PixelWindow{0, 5, 5, 1, 1}, PixelWindow{0, 100, 100, 3, 40},
        PixelWindow{0, 100, 100, 40, 3}, PixelWindow{0, 0, 0, 20, 20},
        PixelWindow{2, 30, 20, 7, 9}}) {
    TakeLinearWindow(*scene.lens, scene.image.view(), window, &observed);
    for (const int blocks : {0, 1, 8, 1000}) {
      BlockFitState state = scene.Guess(0.5);
      fit.Run(scene.marker_pattern(), MarkerPart::kWhole, observed, blocks, options, &state);
      fit.Run(scene.marker_pattern(), MarkerPart::kBorder, observed, blocks, options, &state);
      EXPECT_EQ(fit.block_of().size(), window.size());
    }
  }
}

TEST(BlockFit, SurvivesHomographiesAndRaysThatAreNone) {
  AlignmentScene scene = MakeScene({}, {.light = {}});
  ObservedPatch observed;
  BlockFit fit;
  BlockFitOptions options;
  options.fit_blur = true;
  TakeLinearWindow(*scene.lens, scene.image.view(), scene.window, &observed);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const Mat3& none :
       {Mat3{{0, 0, 0, 0, 0, 0, 0, 0, 0}}, Mat3{{kNone, 0, 0, 0, 1, 0, 0, 0, 1}},
        Mat3{{1, 0, 0, 0, 1, 0, 0.01, 0, -1.6}}, Mat3{{1e30, 0, 0, 0, 1e30, 0, 0, 0, 1}}}) {
    BlockFitState state{none, 0.7};
    fit.Run(scene.marker_pattern(), MarkerPart::kWhole, observed, 8, options, &state);
  }
  // A third of the rays is missing; the rest must suffice.
  for (std::size_t n = 0; n < observed.rays.x.size() / 3; ++n) {
    observed.rays.x[n] = observed.rays.y[n] = std::numeric_limits<float>::quiet_NaN();
  }
  BlockFitState state = scene.Guess(0.3);
  ASSERT_TRUE(fit.Run(scene.marker_pattern(), MarkerPart::kWhole, observed, 8, options, &state));
  const std::array<Vec2, 4> found = scene.Corners(state);
  for (int i = 0; i < 4; ++i) EXPECT_LT(Norm(found[i] - scene.truth[i]), 0.3);
}

}  // namespace
}  // namespace pleinair::tracker
