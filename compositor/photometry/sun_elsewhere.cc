#include "compositor/photometry/sun_elsewhere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "compositor/photometry/shadow_regression.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kCells = 250;
// About half of the width of a maximum. The sun moves by up to 1.5 degrees in six minutes.
constexpr double kStep_deg = 2.0, kRefinedStep_deg = 0.25;
constexpr double kReach_min = 360.0, kStep_min = 6.0, kRefinedStep_min = 1.0;
// Chance maxima on patterned ground and under clouds have steps of up to 0.3. A sun that gives
// level ground 0.4 times the sky's light makes this one.
constexpr double kMinStep = 0.35;
constexpr double kTimesMore = 2.0, kSignificance = 4.0;
// Cosine of 4 degrees: suns nearer to the found one have a share of its maximum.
constexpr double kMaximumCosine = 0.99756;
// A sun lower than this, as a sine, casts shadows that leave the picture.
constexpr double kMinSine = 0.03;

/// The cells whose brightness varies most: shadow boundaries are among them, wherever the sun is.
std::vector<BrightnessCell> MostVaried(std::vector<BrightnessCell> cells) {
  std::stable_sort(cells.begin(), cells.end(),
                   [](const BrightnessCell& a, const BrightnessCell& b) {
                     return VarianceOf(a) > VarianceOf(b);
                   });
  if (cells.size() > kCells) cells.resize(kCells);
  return cells;
}

/// Every third surface sample of each cell.
std::vector<BrightnessCell> Thinned(const std::vector<BrightnessCell>& cells) {
  constexpr std::size_t kEvery = 3;
  std::vector<BrightnessCell> thin(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t i = 0; i < cells[c].brightness.size(); i += kEvery) {
      thin[c].surface_samples.push_back(cells[c].surface_samples[i]);
      thin[c].brightness.push_back(cells[c].brightness[i]);
    }
  }
  return thin;
}

/// One way to move the sun by a number: the heading in degrees, or the time in minutes.
struct Family {
  std::function<Vec3(double)> to_sun;
  double step = 0.0, refined_step = 0.0;

  std::vector<Vec3> At(const std::vector<double>& values) const {
    std::vector<Vec3> suns;
    suns.reserve(values.size());
    for (const double value : values) suns.push_back(to_sun(value));
    return suns;
  }
};

/// The best of a family, with the fits of its neighbourhood.
struct Candidate {
  double value = 0.0;
  Vec3 to_sun{};
  std::vector<GroupedShadowFit> fits;
  double explained = 0.0;
};

double MostExplained(const std::vector<GroupedShadowFit>& fits, int left_out) {
  double explained = 0.0;
  for (const GroupedShadowFit& fit : fits) {
    explained = std::max(explained, fit.Without(left_out).Explained());
  }
  return explained;
}

class Search {
 public:
  Search(const PhantomRays& phantoms, const SurfaceSamples& samples, const StatedSun& sun)
      : regression_(phantoms, samples),
        cells_(MostVaried(BrightnessCellsOf(samples, sun.to_sun))),
        thin_(Thinned(cells_)),
        turned_{[&sun](double heading_deg) {
                  return Turned(sun.to_sun, sun.up, FromDegrees(heading_deg));
                },
                kStep_deg, kRefinedStep_deg} {}

  const Family& turned() const { return turned_; }

  /// The best of `values`, if it explains far more than headings near the described one.
  std::optional<Candidate> Find(const Family& family, const std::vector<double>& values) const {
    if (values.size() < 2) return std::nullopt;
    const std::vector<double> near = Refined(
        family,
        BestOf(regression_.FitAll(thin_, family.At(values)), values, GroupedShadowFit::kAll).value);
    Candidate found;
    found.fits = regression_.FitAll(cells_, family.At(near));
    const auto best = SignificantOf(found.fits, near);
    if (!best || best->fit.Contrast() < kMinStep) return std::nullopt;
    found.value = best->value;
    found.to_sun = family.to_sun(best->value);
    found.explained = best->fit.Explained();
    if (!ExplainsFarMore(found)) return std::nullopt;
    return found;
  }

 private:
  static std::vector<double> Refined(const Family& family, double about) {
    return EvenSteps(about - family.step, about + family.step, family.refined_step);
  }

  /// Compares with the described sun, turned by up to kMaxHeadingError_deg.
  bool ExplainsFarMore(const Candidate& found) const {
    const std::vector<double> here =
        EvenSteps(-kMaxHeadingError_deg, kMaxHeadingError_deg, kStep_deg);
    std::vector<double> far = here;
    std::erase_if(far, [&](double heading) {
      return Dot(turned_.to_sun(heading), found.to_sun) >= kMaximumCosine;
    });
    if (far.empty() || MostExplained(BestFitsOf(here), GroupedShadowFit::kAll) >= found.explained) {
      return false;
    }
    const std::vector<GroupedShadowFit> others = BestFitsOf(far);
    const auto more = [&](int left_out) {
      return MostExplained(found.fits, left_out) - MostExplained(others, left_out);
    };
    std::array<double, GroupedShadowFit::kGroups> without{};
    for (int g = 0; g < GroupedShadowFit::kGroups; ++g) without[g] = more(g);
    return found.explained > kTimesMore * MostExplained(others, GroupedShadowFit::kAll) &&
           more(GroupedShadowFit::kAll) > kSignificance * JackknifeError(without);
  }

  /// Fits at the best of the headings and around it, where they reach.
  std::vector<GroupedShadowFit> BestFitsOf(const std::vector<double>& headings) const {
    std::vector<double> refined = headings;
    if (headings.size() > 1) {
      const auto coarse = regression_.FitAll(thin_, turned_.At(headings));
      refined = Refined(turned_, BestOf(coarse, headings, GroupedShadowFit::kAll).value);
      std::erase_if(refined, [&](double heading) {
        return heading < headings.front() || heading > headings.back();
      });
    }
    return regression_.FitAll(cells_, turned_.At(refined));
  }

  ShadowRegression regression_;
  std::vector<BrightnessCell> cells_, thin_;
  Family turned_;
};

}  // namespace

std::optional<SunElsewhere> FindSunElsewhere(const PhantomRays& phantoms,
                                             const SurfaceSamples& samples, const StatedSun& sun) {
  constexpr double kMinute_s = 60.0;
  if (Dot(sun.up, sun.to_sun) <= 0.0) return std::nullopt;
  const Search search(phantoms, samples, sun);
  const auto heading = search.Find(
      search.turned(), EvenSteps(kMaxHeadingError_deg + kRefinedStep_deg,
                                 360.0 - kMaxHeadingError_deg - kRefinedStep_deg, kStep_deg));
  const Family later{[&sun](double minutes) { return sun.to_sun_after(kMinute_s * minutes); },
                     kStep_min, kRefinedStep_min};
  std::vector<double> day = EvenSteps(-kReach_min, kReach_min, kStep_min);
  std::erase_if(day, [&](double minutes) {
    const Vec3 there = later.to_sun(minutes);
    return Dot(sun.up, there) < kMinSine || Dot(sun.to_sun, there) > kMaximumCosine;
  });
  const auto time = search.Find(later, day);
  SunElsewhere found;
  if (heading) {
    const double offset_deg = std::remainder(heading->value, 360.0);
    if (std::fabs(offset_deg) > kMaxHeadingError_deg) {
      found.heading_offset = FromDegrees(offset_deg);
    }
  }
  if (time) found.later_s = kMinute_s * time->value;
  if (!found.heading_offset && !found.later_s) return std::nullopt;
  found.time_fits_better = time && (!found.heading_offset || time->explained > heading->explained);
  return found;
}

}  // namespace pleinair::compositor
