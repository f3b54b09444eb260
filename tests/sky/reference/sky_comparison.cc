#include "tests/sky/reference/sky_comparison.h"

#include <cmath>
#include <numbers>

#include "base/units.h"

namespace pleinair::sky::reference {

std::vector<Sample> DomeSamples(int rings, int sectors) {
  std::vector<Sample> samples;
  for (int ring = 0; ring < rings; ++ring) {
    const double low = 90.0 * ring / rings, high = 90.0 * (ring + 1) / rings;
    const double band = 2.0 * std::numbers::pi *
                        (std::sin(high * kRadiansPerDegree) - std::sin(low * kRadiansPerDegree));
    for (int sector = 0; sector < sectors; ++sector) {
      samples.push_back({0.5 * (low + high), 180.0 * (sector + 0.5) / sectors, band / sectors});
    }
  }
  return samples;
}

std::vector<XyY> Evaluate(const std::vector<Sample>& samples, const SkyFunction& sky) {
  std::vector<XyY> values;
  for (const Sample& sample : samples) values.push_back(sky(sample));
  return values;
}

std::vector<XyY> PathTrace(const std::vector<Sample>& samples, const Scene& scene, int paths,
                           std::uint64_t seed) {
  const PathTracedSky sky(scene);
  return Evaluate(samples, [&](const Sample& s) {
    return sky.At(s.elevation_deg, s.azimuth_deg, paths, ++seed);
  });
}

Comparison Compare(const std::vector<Sample>& samples, const std::vector<XyY>& truth,
                   const std::vector<XyY>& sky) {
  double difference = 0.0, truth_square = 0.0, product = 0.0, square = 0.0;
  double lux = 0.0, truth_lux = 0.0, distance = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double w = samples[i].weight, t = truth[i].luminance, s = sky[i].luminance;
    const double up = std::sin(samples[i].elevation_deg * kRadiansPerDegree);
    difference += w * (s - t) * (s - t);
    truth_square += w * t * t;
    product += w * s * t;
    square += w * s * s;
    lux += w * up * s;
    truth_lux += w * up * t;
    distance += std::hypot(sky[i].x - truth[i].x, sky[i].y - truth[i].y);
  }
  // With the factor k = product / square the mean square difference is T² − product² / S².
  const double shape = std::max(0.0, truth_square - product * product / square);
  return {std::sqrt(difference / truth_square), std::sqrt(shape / truth_square), lux / truth_lux,
          distance / static_cast<double>(samples.size())};
}

}  // namespace pleinair::sky::reference
