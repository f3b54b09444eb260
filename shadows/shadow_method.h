#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pleinair::shadows {

/// How visibility is taken from the maps: one renderer, one family of shaders, a permutation each.
/// docs/measurements/shadows.md has the measured errors and times.
enum class ShadowMethod {
  kPlain,                 ///< One comparison a point (Williams 1978).
  kPcf3,                  ///< Percentage-closer filtering, 3×3 bilinear comparisons (Reeves 1987).
  kPcf5,                  ///< 5×5.
  kPcf7,                  ///< 7×7.
  kCascadesPcf,           ///< Four cascades (Zhang et al. 2006) with PCF 5×5.
  kVariance,              ///< Blurred depth moments, Chebyshev's bound (Donnelly & Lauritzen 2006).
  kVarianceReduced,       ///< The same with bleed reduction (Lauritzen 2007).
  kCascadesVariance,      ///< Four cascades with variance and bleed reduction.
  kExponentialVariance,   ///< Moments of two exponential warps (Lauritzen & McCool 2008).
  kPercentageCloserSoft,  ///< Blocker search, then a filter of that width (Fernando 2005).
  kCascadesGaussian,      ///< Four cascades with Z-GaF's blur and step: the paper's "CSMs with
                          ///< Gaussian blurring" (its Figure 8 C).
  kGaussian,              ///< The paper's Z-GaF: a Gaussian of blurred depth moments.
  kSunDisc,               ///< Ours, the default: the sun's disc seen past the blockers.
};

/// How much of kSunDisc's filter is computed. The other methods have one filter.
enum class SunDiscFilter {
  kFull,    ///< A search for blockers, penumbrae of any width.
  kBox,     ///< A box over 4×4 texels: no search, no pyramid, penumbrae of at most 3 texels.
  kSample,  ///< One sample of 2×2 texels, as cheap as a plain map.
};

/// What a method's maps hold beside depth.
enum class MapContent {
  kDepth,          ///< Nothing more.
  kDepthBounds,    ///< A pyramid of nearest and farthest depths.
  kMoments,        ///< Blurred z, z².
  kWarpedMoments,  ///< Blurred moments of e^cz and −e^−cz.
};

struct ShadowMethodTraits {
  ShadowMethod method;
  std::string_view name;   ///< On the command line and in files: "pcf5".
  std::string_view title;  ///< For people: "PCF 5×5".
  std::string_view shader_define;
  MapContent content;
  int partitions;           ///< As the method is commonly used.
  bool falling_resolution;  ///< Maps of N, N/2, N/2, N/4 in place of N each.
  double split_weight;      ///< λ of Eq. 11.
};

/// All methods, in the order of the enumeration.
std::span<const ShadowMethodTraits> ShadowMethods();
const ShadowMethodTraits& TraitsOf(ShadowMethod method);
/// The method of that name; nullptr where there is none.
const ShadowMethodTraits* FindShadowMethod(std::string_view name);

}  // namespace pleinair::shadows
