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

/// Prints of one kind by number; null where it has no such number.
using PatternByNumber = std::function<std::shared_ptr<const tracker::MarkerPattern>(int number)>;

/// What is known for certain of a marker in a frame.
struct MarkerTruth {
  int number = 0;
  Transform<Camera, Marker> camera_from_marker{};
  /// Top-left, then clockwise as the print is read; pixels (integer = pixel centre).
  std::array<Vec2, 4> corners_px{};
  CoveredShares covered{};
};

struct RenderedFrame {
  GreyImage grey;
  std::vector<MarkerTruth> truth;  ///< In the order of the scene.
};

/// Turns scenes into pictures as a real camera would take them: light adds up linearly over each
/// pixel's area through the lens and its point spread; then defocus, motion and the vignette; then
/// photon and read-out noise; then the sRGB curve and eight bits. One thread at a time; the
/// lens's rays are shared.
class FrameRenderer {
 public:
  /// Every `seed` gives other backgrounds and occluders, every `noise_seed` another noise.
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
  /// Draws a marker over the background through the lens.
  void Paint(const MarkerSpec& marker, const Occluder* occluder, const PhotoSpec& photo,
             Image<float>* picture);
  /// What the finer pixels of one pixel see, before the lens blurs it.
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
  std::string background_key_;  ///< Of the background kept from the frame before.
  Image<float> background_;
};

}  // namespace pleinair::accuracy
