#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/changes/light_probes.h"

namespace pleinair::compositor {

/// Surface of one normal, all in the sun or all in shade, as one frame shows it. Its described
/// color and the modelled light show which light has which pixel value, like the fields of a color
/// chart.
struct ChartField {
  std::size_t frame = 0;    ///< Index of the frame among those of the chart.
  std::size_t surface = 0;  ///< Index of the surface among those of the chart.
  std::size_t group = 0;    ///< Fields with one normal, all in the sun or all in shade.
  bool sunlit = false;
  /// Logarithms of the median, red, green and blue, decoded as sRGB.
  std::array<double, 3> log_linear{};
  double error = 0.0;  ///< One standard deviation of `log_linear`, the same error in all frames.
  LinearRgb albedo;    ///< As described.
  LinearRgb of_sun;    ///< Modelled light of the sun, direct and reflected; lux.
  LinearRgb of_sky;    ///< Modelled light of the sky; lux.
};

/// The fields of some frames.
struct ResponseChart {
  /// What kind of surface has an index.
  enum class Surface { kWhite, kBlack, kPhantom };
  std::vector<ChartField> fields;
  std::size_t frames = 0;
  std::vector<Surface> surfaces;
  std::vector<bool> level;  ///< By group: parallel to the marker, so that the light is well known.
  /// True if shade falls on surfaces that the model has in the sun. The chart is unusable then.
  bool unmodelled_shadows = false;
};

/// Collects the fields. Only probes count that lie clear of shadow edges, face the sun well if they
/// are in the sun, and belong to a field of at least five. `to_sun`: unit, marker coordinates.
/// `frames` are indices of probed frames.
ResponseChart CollectResponseChart(const std::vector<ProbedFrame>& probed,
                                   const std::vector<std::size_t>& frames,
                                   const std::vector<LightProbe>& probes,
                                   const std::vector<ProbeLight>& light,
                                   const PhantomRays& phantoms, Vec3 to_sun);

}  // namespace pleinair::compositor
