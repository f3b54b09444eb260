#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

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

/// What the marker in one frame says of the camera's exposure and white balance.
struct ExposureEstimate {
  /// Display-linear value per radiance (1 / (cd/m²)), each channel of linear Rec.709.
  LinearRgb exposure_scale;
  /// Of the exposure scale, relative, one standard deviation: from the pairs' scatter, which a
  /// median of so many leaves little of. What the model's light is wrong by comes on top.
  LinearRgb error;
  int pairs = 0;              ///< White–black pairs used.
  double sunlit_share = 0.0;  ///< Share of the marker that the phantoms leave in the sun.
  /// Leaves shade it: its light is uneven where it should be in the sun, even where only the few
  /// pairs are looked at that a shadow's edge leaves there. Its brightest surface samples alone
  /// were used.
  bool dappled = false;
};

/// Uses the marker as a light meter. Pairs of points on either side of the outer black edge have
/// nearly the same light; the difference of their colors over the difference of their
/// reflectances, divided by the light that the model predicts there, is the camera's scale. The
/// difference cancels veiling glare that adds to both.
///
/// Pairs in a penumbra or too small are left out. Where half of a channel's whites are clipped, its
/// black is read in their place, which veiling glare makes too bright: by as much as in channels
/// whose white is not clipped, if there is one. Where part of the marker that should
/// be in the sun is much darker than the rest (a shadow of something that no phantom stands for),
/// the brighter part counts, from six pairs on.
class MarkerLightMeter {
 public:
  /// Predicts the light on the marker's sample points; they lie still in marker coordinates, so
  /// this is done once a light.
  MarkerLightMeter(const scene::MarkerReflectance& marker, const PhantomRays& phantoms,
                   const sky::SkyModel& day, const Mat3& marker_from_world,
                   const CameraResponse& response = {});

  /// Nothing where fewer than `kMinimumPairs` pairs can be used, or where most pairs are not
  /// clearly brighter on the white side: a marker the other way round, as of tag families whose
  /// border is black outside and white inside.
  std::optional<ExposureEstimate> Measure(
      ImageView<const std::uint8_t> rgb, const CameraModel& camera,
      const Transform<Camera, Marker>& camera_from_marker) const;

  /// A shadow's sharp edge that divides the marker, a phantom's or another thing's, where hardly
  /// anything covers it.
  std::optional<MarkerShadowEdge> FindShadow(
      ImageView<const std::uint8_t> rgb, const CameraModel& camera,
      const Transform<Camera, Marker>& camera_from_marker) const;

  /// Where the pairs lie that count: those in the sun, where there are enough of them. At the edge
  /// between white and black.
  const std::vector<Point<Marker>>& places() const { return places_; }
  /// Whether these lie in the sun.
  bool in_sun() const { return in_sun_; }
  /// Mean light predicted there: what readings are told in terms of. Black without places.
  LinearRgb light_on_marker() const { return light_on_marker_; }

  static constexpr int kMinimumPairs = 12;

 private:
  struct Pair {
    Point<Marker> white, black;
    LinearRgb irradiance;  ///< Predicted at the edge between the two.
    double sun_visibility = 0.0;
  };

  /// What one pair shows in a frame.
  struct Sample {
    /// NaN where it cannot be used, of a clipped white infinite.
    std::array<double, 3> white_scale, black_scale;
    MarkerPair seen;
    double level;  // Sum of the channels' scale, to tell sun from shadow.
    bool in_sun;
  };
  struct Samples {
    std::vector<Sample> pairs;
    std::size_t contrary = 0;  // Pairs left out: white on neither side, or black without.
  };
  /// A channel's scale as the pairs have it.
  struct ChannelScale {
    double exposure_scale = 0.0;       // Their median.
    double error = 0.0, spread = 0.0;  // Of it and of a single pair, relative.
  };
  static std::vector<double> ScalesBy(const std::vector<Sample>& pairs,
                                      std::array<double, 3> Sample::*by, std::size_t channel);
  /// Nothing where fewer than `fewest` can tell it.
  static std::optional<ChannelScale> MedianOf(const std::vector<double>& values, int min_count);
  /// Of the pairs, those whose white is clipped.
  static double ClippedShare(const std::vector<Sample>& pairs, std::size_t channel);
  /// By the blacks; how uneven the light is, by whites as far as they are not clipped.
  static std::optional<ChannelScale> BlackScaleOf(const std::vector<Sample>& pairs,
                                                  std::size_t channel, int min_count);
  /// By the whites; where half of a channel's are clipped, by its blacks.
  static std::optional<std::array<ChannelScale, 3>> ScalesOf(const std::vector<Sample>& pairs,
                                                             int min_count);
  /// By the brightest of the pairs, `fewest` at least, the same ones in each channel: by whites,
  /// or where any channel of these is clipped by blacks, the brightest of which lie elsewhere.
  static std::array<std::optional<ChannelScale>, 3> BrightestOf(std::vector<Sample> pairs,
                                                                int min_count);
  Samples SamplesIn(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
                    const Transform<Camera, Marker>& camera_from_marker) const;

  scene::MarkerReflectance marker_;
  CameraResponse response_;
  std::vector<Pair> pairs_;
  double sunlit_share_ = 0.0;
  LinearRgb shadow_depth_;  // As FindMarkerShadowEdge() takes it; 0: none to be looked for.
  std::vector<Point<Marker>> places_;
  bool in_sun_ = false;
  LinearRgb light_on_marker_;
};

}  // namespace pleinair::compositor
