#include "sky/clouds/film/film_layer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/quantile.h"
#include "base/units.h"
#include "sky/clouds/cloud_sky.h"
#include "sky/clouds/cloud_slab.h"

namespace pleinair::clouds {
namespace {

constexpr int kCandidates = 6;
constexpr double kSlowest_m_s = 1.0, kFastest_m_s = 60.0;

/// The course at evenly spaced times.
FilmCourse Resampled(const FilmCourse& course, std::size_t samples) {
  FilmCourse even = course;
  even.seconds.clear();
  even.sun.clear();
  even.sky.clear();
  even.seconds.reserve(samples);
  even.sun.reserve(samples);
  even.sky.reserve(samples);
  for (std::size_t s = 0; s < samples; ++s) {
    const double seconds = course.seconds.front() + course.Span() * static_cast<double>(s) /
                                                        static_cast<double>(samples - 1);
    even.seconds.push_back(seconds);
    even.sun.push_back(ValueAt(course.seconds, course.sun, seconds));
    if (!course.sky.empty()) even.sky.push_back(ValueAt(course.seconds, course.sky, seconds));
  }
  return even;
}

CloudKind KindOf(const FilmCourse& course, const FilmLayerFacts& facts) {
  constexpr double kThin = 0.15;
  if (facts.kind) return *facts.kind;
  return Quantile(course.sun, 0.05) > kThin ? CloudKind::kCirrus : CloudKind::kCumulus;
}

CloudLayer UsualLayer(CloudKind kind) {
  CloudLayerFacts facts;
  facts.kind = kind;
  return MakeCloudLayer(facts).value();
}

double Rounded(double value, double unit) { return std::round(value / unit) * unit; }

/// The layer of a draw, with wind and cell.
CloudLayer LayerOf(const LayerDraw& draw, CloudKind kind, const FilmCourse& course,
                   const FilmLayerFacts& facts, double wind_from_deg, int seed) {
  CloudLayer layer = UsualLayer(kind);
  layer.cover = Rounded(draw.cover, 0.001);
  layer.optical_depth = Rounded(draw.optical_depth, 0.01);
  layer.seed = seed;
  layer.wind_from_deg = wind_from_deg;
  const double cells_per_second = draw.cells / course.Span();
  const double least = std::clamp(LeastWind(course), kSlowest_m_s, kFastest_m_s);
  layer.wind_m_s =
      facts.wind_m_s.value_or(std::clamp(cells_per_second * layer.cell_m, least, kFastest_m_s));
  layer.wind_m_s = std::min(layer.wind_m_s, kMaxPassing_m / course.Span());
  layer.wind_m_s = std::max(0.01, Rounded(layer.wind_m_s, 0.01));
  layer.cell_m = std::clamp(Rounded(layer.wind_m_s / cells_per_second, 1.0), 50.0, 8'000.0);
  return layer;
}

/// The layer's sky over the clear one at some times of the course.
struct SkyCourse {
  std::vector<double> seconds, sky;
  double error = 0.0, light_error = 0.0;
};
SkyCourse SkyUnder(const FieldInStep& field, const FilmCourse& course, const FilmSky& sky,
                   int samples) {
  const CloudFields fields{field.field};
  const CloudSky first(sky.clear, fields, sky.ground_albedo, course.seconds.front());
  const double clear = Luminance(sky.clear->SkyHorizontalIrradiance());
  const double ratio = ClearSunOverSky(*sky.clear);
  SkyCourse found;
  double squares = 0.0, mean = 0.0, light_squares = 0.0, light_mean = 0.0;
  for (int s = 0; s < samples; ++s) {
    const auto i =
        static_cast<std::size_t>((s + 0.5) / samples * static_cast<double>(course.seconds.size()));
    const CloudSky at(first, course.seconds[i]);
    constexpr int kRings = 24;
    found.seconds.push_back(course.seconds[i]);
    found.sky.push_back(Luminance(at.DomeIlluminance(kRings)) / clear);
    const double wanted = course.sky.empty() ? found.sky.back() : course.sky[i];
    const double off = found.sky.back() - wanted;
    const double light_off = off + ratio * (field.sun[i] - course.sun[i]);
    squares += off * off;
    light_squares += light_off * light_off;
    mean += wanted / samples;
    light_mean += (wanted + ratio * course.sun[i]) / samples;
  }
  found.error = std::sqrt(squares / samples) / mean;
  found.light_error = std::sqrt(light_squares / samples) / light_mean;
  return found;
}

/// Steady light: a slab whose sun over sky is that of the film.
FilmLayer UniformLayer(const FilmCourse& course, const FilmSky& sky) {
  FilmLayer found;
  found.outcome = FilmLayer::Outcome::kUniform;
  found.layer = UsualLayer(CloudKind::kSlab);
  const double cosine = sky.clear->ToSun().xyz.z;
  const double sun = Luminance(sky.clear->SunNormalIrradiance()) * cosine;
  const double skylight = Luminance(sky.clear->SkyHorizontalIrradiance());
  const auto ratio_of = [&](double depth) {
    const double direct = sun * Unscattered(depth, cosine);
    const double diffuse =
        IlluminanceBelow(SlabTable::Water(), depth, {sun, cosine, skylight}, sky.ground_albedo) -
        direct;
    return direct / diffuse / (sun / skylight);
  };
  double thin = 0.0, thick = 50.0;
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (thin + thick);
    (ratio_of(middle) > course.top_ratio ? thin : thick) = middle;
  }
  // A hundredth of the sun is lost in the noise of films.
  constexpr double kNoSun = 0.01;
  found.is_opaque = course.top_ratio < kNoSun;
  const double least = std::min(thin, cosine * std::log(1.0 / kNoSun));
  found.layer.optical_depth =
      Rounded(found.is_opaque ? std::max(found.layer.optical_depth, least) : thin, 0.01);
  found.cover = {1.0, 1.0, 1.0};
  // The film's ratio of sun and sky is known to some 20 %: turbidity and albedo of the land.
  const double error = cosine * std::log(1.2);
  found.optical_depth = found.is_opaque ? FittedNumber{found.layer.optical_depth, least, 200.0}
                                        : FittedNumber{found.layer.optical_depth,
                                                       std::max(0.0, thin - error), thin + error};
  found.light.seconds = course.seconds;
  found.light.sun.assign(course.seconds.size(), std::exp(-found.layer.optical_depth / cosine));
  return found;
}

}  // namespace

double ClearSunOverSky(const sky::SkyModel& clear) {
  return Luminance(clear.SunNormalIrradiance()) * std::max(0.0, clear.ToSun().xyz.z) /
         Luminance(clear.SkyHorizontalIrradiance());
}

FilmLayer FitFilmLayer(const FilmCourse& course, const FilmLayerFacts& facts, const FilmSky& sky) {
  if (course.IsSteady()) {
    if (!course.SeesClearSun()) return UniformLayer(course, sky);
    FilmLayer clear;
    clear.light.seconds = course.seconds;
    clear.light.sun.assign(course.seconds.size(), 1.0);
    return clear;
  }
  FilmLayer found;
  found.outcome = FilmLayer::Outcome::kPassing;
  found.least_wind_m_s = LeastWind(course);
  const Direction<World> to_sun = sky.clear->ToSun();
  const CloudKind kind = KindOf(course, facts);
  const double across_sun = std::atan2(to_sun.xyz.x, to_sun.xyz.y) / kRadiansPerDegree + 90.0;
  const double wind_from_deg = facts.wind_from_deg.value_or(
      Rounded(across_sun < 0.0 ? across_sun + 360.0 : across_sun, 0.1));
  const LayerDraws draws(kind, to_sun, facts.wind_from_deg, course.noise);
  const LayerPosterior posterior =
      draws.Posterior(NumbersOf(Resampled(course, kCourseSamples).sun));
  // The frames that the fit and the errors use.
  constexpr std::size_t kMostSamples = 400;
  const FilmCourse even = Resampled(course, std::min(kMostSamples, course.seconds.size()));
  double least = std::numeric_limits<double>::infinity();
  FieldInStep best;
  for (int i = 0; i < kCandidates; ++i) {
    const LayerDraw& draw = posterior.draws[static_cast<std::size_t>(i)];
    const CloudLayer layer = LayerOf(draw, kind, even, facts, wind_from_deg, i + 1);
    const FieldInStep field = InStep(layer, even, sky.sun_at);
    constexpr int kFewSkies = 8;
    const double error = SkyUnder(field, even, sky, kFewSkies).light_error;
    if (error >= least) continue;
    least = error;
    best = field;
  }
  constexpr int kSkies = 24;
  const SkyCourse skies = SkyUnder(best, even, sky, kSkies);
  found.layer = best.field->layer();
  found.cover = posterior.cover;
  found.optical_depth = posterior.optical_depth;
  const auto seconds_of = [&](double cells) { return course.Span() / cells; };
  found.cell_over_wind_s = {seconds_of(posterior.cells.value), seconds_of(posterior.cells.high),
                            seconds_of(posterior.cells.low)};
  found.errors = {best.sun_rms, course.sky.empty() ? 0.0 : skies.error, skies.light_error};
  found.light.seconds = even.seconds;
  found.light.sun = best.sun;
  found.light.sky.reserve(even.seconds.size());
  for (const double seconds : even.seconds) {
    found.light.sky.push_back(ValueAt(skies.seconds, skies.sky, seconds));
  }
  return found;
}

}  // namespace pleinair::clouds
