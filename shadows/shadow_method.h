#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pleinair::shadows {

/// Methods that compute visibility from the maps: one renderer, one family of shaders, one
/// permutation each. docs/measurements/shadows.md has the measured errors and times.
enum class ShadowMethod {
  kPlain,                 ///< One comparison per point (Williams 1978).
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
  kSunDisc,               ///< Ours, the default: unoccluded share of the sun's disc.
};

/// Quality levels of kSunDisc's filter. The other methods have one filter.
enum class SunDiscFilter {
  kFull,    ///< Blocker search, penumbrae of any width.
  kBox,     ///< A box over 4×4 texels: no search, no pyramid, penumbrae up to 3 texels.
  kSample,  ///< One sample of 2×2 texels, as cheap as a plain map.
};

/// Data in a method's maps in addition to depth.
enum class MapContent {
  kDepth,          ///< None.
  kDepthBounds,    ///< A pyramid of minimum and maximum depths.
  kMoments,        ///< Blurred z, z².
  kWarpedMoments,  ///< Blurred moments of e^cz and −e^−cz.
};

struct ShadowMethodTraits {
  ShadowMethod method;
  std::string_view name;   ///< On the command line and in files: "pcf5".
  std::string_view title;  ///< In reports: "PCF 5×5".
  std::string_view shader_define;
  MapContent content;
  int partitions;           ///< Usual number for this method.
  bool falling_resolution;  ///< Maps of N, N/2, N/2, N/4 in place of N each.
  double split_weight;      ///< λ of Eq. 11.
};

/// All methods, in the order of the enumeration.
std::span<const ShadowMethodTraits> ShadowMethods();
const ShadowMethodTraits& TraitsOf(ShadowMethod method);
/// The method of that name; nullptr if there is none.
const ShadowMethodTraits* FindShadowMethod(std::string_view name);

}  // namespace pleinair::shadows
