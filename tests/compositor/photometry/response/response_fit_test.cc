#include "compositor/photometry/response/response_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "base/srgb.h"

namespace pleinair::compositor {
namespace {

using Curve = std::function<double(double)>;

/// K. Narkowicz's fit of the ACES reference curve (2015), behind it sRGB.
double Filmic(double light) {
  const double x = 0.85 * light;
  return SrgbFromLinear((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14));
}

/// Reinhard et al. 2002, eq. 4, with white at 2.2, behind it sRGB.
double Shoulder(double light) {
  const double x = std::min(light, 2.2);
  return SrgbFromLinear(std::min(1.0, 1.5 * x * (1 + x / (2.2 * 2.2)) / (1 + x)));
}

/// More contrast than sRGB, as picture styles have.
double Contrast(double light) {
  const double code = SrgbFromLinear(light);
  return 0.5 * code + 0.5 * code * code * (3 - 2 * code);
}

/// Gamma 1.8 with raised blacks.
double Flat(double light) { return 0.05 + 0.95 * std::pow(light, 1 / 1.8); }

/// A power law of 2.6.
double Steep(double light) { return std::pow(light, 1 / 2.6); }

/// A camera's picture of the marker and of surfaces that a scene describes with errors of a tenth,
/// each in sun and in shade, in two frames. `white`: linear light of the sunlit white.
ResponseChart Chart(const Curve& curve, unsigned seed, double white = 0.75) {
  using Surface = ResponseChart::Surface;
  const std::vector<double> described{0.85, 0.04, 0.6, 0.4, 0.25, 0.15, 0.08};
  constexpr std::size_t kFrames = 2;
  constexpr double kError = 0.06;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  ResponseChart chart;
  chart.frames = kFrames;
  chart.level = {true, true};
  std::vector<double> albedo = described;
  for (std::size_t s = 0; s < described.size(); ++s) {
    chart.surfaces.push_back(s == 0   ? Surface::kWhite
                             : s == 1 ? Surface::kBlack
                                      : Surface::kPhantom);
    if (s > 0) albedo[s] *= std::exp(0.1 * normal(random));
  }
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    for (std::size_t s = 0; s < described.size(); ++s) {
      for (const bool sunlit : {true, false}) {
        ChartField field;
        field.frame = frame;
        field.surface = s;
        field.group = sunlit ? 0 : 1;
        field.sunlit = sunlit;
        field.error = kError;
        field.albedo = LinearRgb{1, 1, 1} * described[s];
        const double sun = (sunlit ? 4.0 : 0.0) + 0.15, sky = 0.9;
        field.of_sun = LinearRgb{1, 1, 1} * sun;
        field.of_sky = LinearRgb{1, 1, 1} * sky;
        // The sky is brighter than described.
        const double light = albedo[s] * (sun + 1.3 * sky) / (0.85 * (4.15 + 1.3 * 0.9)) * white;
        for (double& value : field.log_linear) {
          const double code = curve(light * std::exp(0.5 * kError * normal(random)));
          value = std::log(LinearFromSrgb(std::max(code, 0.01)));
        }
        chart.fields.push_back(field);
      }
    }
  }
  return chart;
}

/// RMS difference of the logarithm of light beside that of the white, from 2 % of it on.
double RmsError(const CameraResponse& response, const Curve& curve, double white = 0.75) {
  const auto measured = [&](double light) {
    const double at = curve(light) * 255;
    const int below = std::min(static_cast<int>(at), 254);
    const auto& linear = response.Linear(1);
    return std::log(linear[below] + (at - below) * (linear[below + 1] - linear[below]));
  };
  double sum = 0.0;
  int count = 0;
  for (double light = 0.02 * white; light < white; light *= 1.2) {
    const double off = measured(light) - measured(white) - std::log(light / white);
    sum += off * off;
    ++count;
  }
  return std::sqrt(sum / count);
}

constexpr unsigned kSeeds = 10;

struct Case {
  const char* name;
  Curve curve;
  int conclusive;  // At least so many of kSeeds.
};

TEST(ResponseFit, FindsTheCurvesOfFiveCameras) {
  for (const auto& [name, curve, conclusive] :
       {Case{"filmic", Filmic, 10}, Case{"shoulder", Shoulder, 10}, Case{"contrast", Contrast, 10},
        Case{"flat", Flat, 9}, Case{"steep", Steep, 5}}) {
    int found = 0, within = 0;
    double sum = 0.0;
    for (unsigned seed = 0; seed < kSeeds; ++seed) {
      const ResponseEstimate estimate = FitResponse(Chart(curve, seed));
      EXPECT_TRUE(estimate.usable);
      EXPECT_EQ(estimate.response.IsSrgb(), !estimate.conclusive);
      if (!estimate.conclusive) continue;
      const double error = RmsError(estimate.response, curve);
      ++found;
      within += error < 2 * estimate.log_error ? 1 : 0;
      sum += error;
    }
    RecordProperty(std::string(name) + "_rms", std::to_string(sum / found));
    EXPECT_GE(found, conclusive) << name;
    EXPECT_GE(within, found - 1) << name;
    EXPECT_LE(sum / found, 0.12) << name;
    // No worse than sRGB, and mostly much better.
    EXPECT_LE(sum / found, RmsError({}, curve)) << name;
  }
}

TEST(ResponseFit, HoldsSrgbOfSrgbCameras) {
  const auto srgb = [](double light) { return SrgbFromLinear(light); };
  for (unsigned seed = 0; seed < 100; ++seed) {
    const ResponseEstimate found = FitResponse(Chart(srgb, seed));
    EXPECT_TRUE(found.usable);
    EXPECT_FALSE(found.conclusive) << seed;
    EXPECT_TRUE(found.response.IsSrgb());
  }
}

TEST(ResponseFit, IsNoSurerBecauseManyFramesShowTheSame) {
  // One surface is in a shade that the model lacks; eight equal frames show it.
  const auto srgb = [](double light) { return SrgbFromLinear(light); };
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    ResponseChart once = Chart(srgb, seed);
    once.frames = 1;
    std::erase_if(once.fields, [](const ChartField& field) { return field.frame != 0; });
    for (double& value : once.fields[4].log_linear) value += std::log(0.4);
    ResponseChart often = once;
    often.frames = 8;
    for (std::size_t frame = 1; frame < often.frames; ++frame) {
      for (ChartField field : once.fields) {
        field.frame = frame;
        often.fields.push_back(field);
      }
    }
    EXPECT_NEAR(FitResponse(often).log_evidence, FitResponse(once).log_evidence, 0.5) << seed;
  }
}

TEST(ResponseFit, TakesFramesWithoutAWhiteBesideOneThatHasIt) {
  const auto srgb = [](double light) { return SrgbFromLinear(light); };
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    ResponseChart chart = Chart(srgb, seed, 0.2);
    std::erase_if(chart.fields,
                  [](const ChartField& field) { return field.frame == 1 && field.surface == 0; });
    for (ChartField& field : chart.fields) {
      // Lux.
      field.of_sun = field.of_sun * 25e3;
      field.of_sky = field.of_sky * 25e3;
    }
    const ResponseEstimate found = FitResponse(chart);
    EXPECT_TRUE(found.usable);
    EXPECT_FALSE(found.conclusive) << seed << ": " << found.log_evidence;
  }
}

TEST(ResponseFit, HoldsSrgbBehindAHazyLens) {
  const auto hazy = [](double light) { return SrgbFromLinear(light + 0.01); };
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    EXPECT_FALSE(FitResponse(Chart(hazy, seed)).conclusive) << seed;
  }
}

TEST(ResponseFit, TakesNoChartWithoutAWhiteOrWithShadeThatTheModelLacks) {
  ResponseChart chart = Chart(Filmic, 0);
  EXPECT_TRUE(FitResponse(chart).usable);
  chart.unmodelled_shadows = true;
  EXPECT_FALSE(FitResponse(chart).usable);
  chart.unmodelled_shadows = false;
  std::erase_if(chart.fields, [](const ChartField& field) { return field.surface == 0; });
  EXPECT_FALSE(FitResponse(chart).usable);
  EXPECT_FALSE(FitResponse(ResponseChart{}).usable);
}

}  // namespace
}  // namespace pleinair::compositor
