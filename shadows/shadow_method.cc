#include "shadows/shadow_method.h"

#include <algorithm>
#include <array>

namespace pleinair::shadows {
namespace {

using enum ShadowMethod;
using enum MapContent;

// Bleed reduction 0.25: the penumbra error of the paper's visibility step at a smaller leak (docs).
// λ: the paper's ½ for the paper's method; 0.9, almost logarithmic, is best for the wide field.
constexpr std::array<ShadowMethodTraits, 13> kMethods{{
    {kPlain, "plain", "plain map", "SHADOW_METHOD_PLAIN", kDepth, 1, false, 0.5},
    {kPcf3, "pcf3", "PCF 3×3", "SHADOW_METHOD_PCF 3", kDepth, 1, false, 0.5},
    {kPcf5, "pcf5", "PCF 5×5", "SHADOW_METHOD_PCF 5", kDepth, 1, false, 0.5},
    {kPcf7, "pcf7", "PCF 7×7", "SHADOW_METHOD_PCF 7", kDepth, 1, false, 0.5},
    {kCascadesPcf, "csm-pcf5", "cascades + PCF 5×5", "SHADOW_METHOD_PCF 5", kDepth, 4, false, 0.9},
    {kVariance, "vsm", "variance", "SHADOW_METHOD_VARIANCE 0.0", kMoments, 1, false, 0.5},
    {kVarianceReduced, "vsm-reduced", "variance, bleed reduced", "SHADOW_METHOD_VARIANCE 0.25",
     kMoments, 1, false, 0.5},
    {kCascadesVariance, "csm-vsm", "cascades + variance", "SHADOW_METHOD_VARIANCE 0.25", kMoments,
     4, false, 0.9},
    {kExponentialVariance, "evsm", "exponential variance", "SHADOW_METHOD_EXPONENTIAL",
     kWarpedMoments, 1, false, 0.5},
    {kPercentageCloserSoft, "pcss", "PCSS", "SHADOW_METHOD_PCSS", kDepth, 1, false, 0.5},
    {kCascadesGaussian, "csm-gauss", "cascades + Gaussian blur", "SHADOW_METHOD_GAUSSIAN", kMoments,
     4, false, 0.9},
    {kGaussian, "zgaf", "Z-GaF (paper)", "SHADOW_METHOD_GAUSSIAN", kMoments, 4, true, 0.5},
    {kSunDisc, "ours", "sun disc (ours)", "SHADOW_METHOD_SUN_DISC", kDepthBounds, 4, true, 0.9},
}};

}  // namespace

std::span<const ShadowMethodTraits> ShadowMethods() { return kMethods; }

const ShadowMethodTraits& TraitsOf(ShadowMethod method) {
  return kMethods[static_cast<std::size_t>(method)];
}

const ShadowMethodTraits* FindShadowMethod(std::string_view name) {
  const auto* const found = std::find_if(kMethods.begin(), kMethods.end(),
                                         [&](const auto& traits) { return traits.name == name; });
  return found == kMethods.end() ? nullptr : &*found;
}

}  // namespace pleinair::shadows
