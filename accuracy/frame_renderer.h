#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "accuracy/marker_texture.h"
#include "accuracy/occluders.h"
#include "accuracy/scene.h"
#include "base/camera_model.h"
#include "base/image.h"

namespace pleinair::accuracy {

/// Bit patterns of markers of one kind by number; null if there is no such number.
using PatternByNumber = std::function<std::shared_ptr<const tracker::MarkerPattern>(int number)>;

/// Ground truth of a marker in a frame.
struct MarkerTruth {
  int number = 0;
  Transform<Camera, Marker> camera_from_marker{};
  /// Clockwise from top-left on the upright marker; pixels (integer = pixel centre).
  std::array<Vec2, 4> corners_px{};
  CoveredShares covered{};
};

struct RenderedFrame {
  GreyImage grey;
  std::vector<MarkerTruth> truth;  ///< In the order of the scene.
};

/// Renders scenes as images of a real camera: light integrated linearly over each pixel's area
/// through lens and point spread function; then defocus, motion blur and vignetting; then photon
/// and read-out noise; then the sRGB curve and quantisation to 8 bits. One thread at a time; the
/// rays of the lens are shared.
class FrameRenderer {
 public:
  /// `seed` determines backgrounds and occluders, `noise_seed` the noise.
  FrameRenderer(const CameraModel& camera, PatternByNumber patterns, std::uint64_t seed,
                std::uint64_t noise_seed);
  ~FrameRenderer();

  RenderedFrame Render(const FrameSpec& frame);

 private:
  struct LensRays;

  const MarkerTexture& TextureOf(int number);
  struct Place {
    int x, y;
  };
  /// Renders a marker over the background through the lens.
  void Paint(const MarkerSpec& marker, const Occluder* occluder, const PhotoSpec& photo,
             Image<float>* picture);
  /// Renders the sub-pixels of one pixel, before the lens blurs it.
  void PaintPixel(const MarkerSpec& marker, const MarkerTexture& texture, const Occluder* occluder,
                  double light, Place pixel, Place first, Image<float>* fine) const;
  void AddLightPatterns(const FrameSpec& frame, const MarkerTruth& first, Image<float>* picture);
  Image<float> Expose(const PhotoSpec& photo, Image<float> light) const;
  GreyImage Develop(const FrameSpec& frame, const Image<float>& light) const;

  const CameraModel camera_;
  const PatternByNumber patterns_;
  const std::uint64_t seed_, noise_seed_;
  std::unique_ptr<LensRays> rays_;
  std::vector<std::unique_ptr<MarkerTexture>> textures_;
  std::string background_key_;  ///< Key of the background kept from the previous frame.
  Image<float> background_;
};

}  // namespace pleinair::accuracy
