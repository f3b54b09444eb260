#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/marker/marker_shadow_edge.h"
#include "scene/marker_reflectance.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Estimate of the camera's exposure and white balance from the marker in one frame.
struct ExposureEstimate {
  /// Display-linear value per radiance (1 / (cd/m²)), per channel of linear Rec.709.
  LinearRgb exposure_scale;
  /// Standard deviation of the exposure scale, relative. It comes from the scatter of the pairs,
  /// which the median of many pairs reduces. Errors of the modelled light add to it.
  LinearRgb error;
  int pairs = 0;              ///< White–black pairs used.
  double sunlit_share = 0.0;  ///< Share of the marker that the phantoms leave sunlit.
  /// Leaves shade the marker: its light is uneven where the model has it in the sun. Then only its
  /// brightest surface samples were used. The flag is also set where a shadow edge leaves only few
  /// pairs.
  bool dappled = false;
};

/// Estimates exposure and white balance from the marker.
///
/// Each pair has one point on either side of the outer black edge, under nearly the same light.
/// Exposure scale = color difference / (reflectance difference × predicted radiance per
/// reflectance). The difference cancels additive veiling glare.
///
/// Pairs in a penumbra or too small are not used. Where half of a channel's whites are clipped, its
/// black is measured instead. Veiling glare makes the black too bright. The correction comes from
/// the channels with unclipped white, if there are any. Unmodelled geometry may shade a part of the
/// marker that should be sunlit. Then the brighter part counts, from six pairs on.
class MarkerLightMeter {
 public:
  /// Predicts the light on the marker's sample points. The points are fixed in marker coordinates,
  /// so this is done once per light.
  MarkerLightMeter(const scene::MarkerReflectance& marker, const PhantomRays& phantoms,
                   const sky::SkyModel& day, const Mat3& marker_from_world,
                   const CameraResponse& response = {});

  /// Returns nothing where fewer than `kMinimumPairs` pairs can be used. Returns nothing where most
  /// pairs are not clearly brighter on the white side. This is an inverted marker: some tag
  /// families have a border that is black outside and white inside.
  std::optional<ExposureEstimate> Measure(
      CameraImageView image, const CameraModel& camera,
      const Transform<Camera, Marker>& camera_from_marker) const;

  /// Finds a sharp shadow edge that divides the marker, whatever casts it. Returns nothing if too
  /// much of the marker is covered.
  std::optional<MarkerShadowEdge> FindShadow(
      CameraImageView image, const CameraModel& camera,
      const Transform<Camera, Marker>& camera_from_marker) const;

  /// Places of the pairs in use, at the edge between white and black. These are the sunlit pairs if
  /// there are enough, otherwise all.
  const std::vector<Point<Marker>>& places() const { return places_; }
  /// True if these places lie in the sun.
  bool in_sun() const { return in_sun_; }
  /// Mean light predicted there, which is the unit of the estimates. Black without places.
  LinearRgb light_on_marker() const { return light_on_marker_; }

  static constexpr int kMinimumPairs = 12;

 private:
  struct Pair {
    Point<Marker> white, black;
    LinearRgb irradiance;  ///< Predicted at the edge between the two.
    double sun_visibility = 0.0;
  };

  /// Measurement of one pair in a frame.
  struct Sample {
    /// NaN where it cannot be used; infinite for a clipped white.
    std::array<double, 3> white_scale, black_scale;
    MarkerPair seen;
    double level;  // Sum of the channels' scales, to separate sun from shadow.
    bool in_sun;
  };
  struct Samples {
    std::vector<Sample> pairs;
    std::size_t contrary = 0;  // Rejected pairs: white on neither side, or black outside.
  };
  /// A channel's scale by the pairs.
  struct ChannelScale {
    double exposure_scale = 0.0;       // Their median.
    double error = 0.0, spread = 0.0;  // Of the median and of a single pair, relative.
  };
  static std::vector<double> ScalesBy(const std::vector<Sample>& pairs,
                                      std::array<double, 3> Sample::*by, std::size_t channel);
  /// Returns nothing where there are fewer than `min_count` values.
  static std::optional<ChannelScale> MedianOf(const std::vector<double>& values, int min_count);
  /// Share of the pairs whose white is clipped.
  static double ClippedShare(const std::vector<Sample>& pairs, std::size_t channel);
  /// Scale by the blacks. The spread comes from the whites, as far as they are not clipped.
  static std::optional<ChannelScale> BlackScaleOf(const std::vector<Sample>& pairs,
                                                  std::size_t channel, int min_count);
  /// Scales by the whites. A channel with half of its whites clipped uses its blacks.
  static std::optional<std::array<ChannelScale, 3>> ScalesOf(const std::vector<Sample>& pairs,
                                                             int min_count);
  /// Scales by the brightest pairs, `min_count` at least and the same ones for each channel. Uses
  /// their whites. If any channel of these is clipped, it uses the blacks, of which other pairs are
  /// the brightest.
  static std::array<std::optional<ChannelScale>, 3> BrightestOf(std::vector<Sample> pairs,
                                                                int min_count);
  Samples SamplesIn(CameraImageView image, const CameraModel& camera,
                    const Transform<Camera, Marker>& camera_from_marker) const;

  scene::MarkerReflectance marker_;
  CameraResponse response_;
  std::vector<Pair> pairs_;
  double sunlit_share_ = 0.0;
  LinearRgb shadow_depth_;  // As FindMarkerShadowEdge() takes it; 0: no shadow is searched.
  std::vector<Point<Marker>> places_;
  bool in_sun_ = false;
  LinearRgb light_on_marker_;
};

}  // namespace pleinair::compositor
