#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/error.h"
#include "base/image.h"
#include "compositor/lens/real_occluders.h"
#include "compositor/passes/ink_images.h"
#include "compositor/passes/render_camera.h"
#include "compositor/passes/render_targets.h"
#include "compositor/picture/camera_look.h"
#include "compositor/surfaces/image_tiles.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"

namespace pleinair::compositor {

/// Last steps of compositing. The virtual image is blurred and distorted as by the camera and drawn
/// over the camera image. It then receives the camera's noise and is encoded to 8-bit pixel values.
/// Needs a current OpenGL context with the compositor's shaders registered.
class CameraPicture {
 public:
  static Result<CameraPicture> Create(const CameraModel& camera, const RenderCamera& render,
                                      double supersampling, const CameraResponse& response);

  /// As Composer::SetCameraLook().
  Result<void> SetCameraLook(const std::optional<CameraLook>& look);

  /// Counts an image that is not drawn: each one has noise of its own.
  void Skip() { ++grain_.pictures; }

  /// Uploads the camera image. It must have the camera's size and no gaps between rows. Errors: no
  /// memory.
  Result<void> SetBackground(CameraImageView image);
  /// Max. distance by which the blur spreads a drawn pixel, along a row or column, in render
  /// pixels. 0 without blur.
  int Spread_px() const { return added_blur_px_ > 0.0 ? 2 * BlurReach_px() : 0; }
  /// Standard deviation of that blur, render pixels.
  double Blur_px() const { return added_blur_px_ * supersampling_; }
  double supersampling() const { return supersampling_; }
  /// Sets the tiles of the render image for the next Draw(). `tiles.all` must have all render
  /// pixels within Spread_px() of a ratio other than 1 or of an object, `tiles.fine` those that
  /// need the full resolution. `ink`: null, or with ink in its tiles. Returns the tiles that must
  /// be drawn at full resolution.
  ImageTiles SetTiles(const AffectedTiles& tiles, const InkImages* ink = nullptr);
  /// Composes the drawn and resolved `targets` and the coarse ratio. The blur is applied to
  /// `targets` in place, in the tiles with objects and those drawn at full resolution. `occluders`:
  /// real surfaces that cover objects over a part of the lens; null: none. `ink`: null, or ink
  /// whose tiles are drawn at full resolution. Errors as Create().
  Result<void> Draw(const RenderTargets& targets, const gl::GlTexture& coarse_ratio,
                    const AffectedTiles& tiles, const RealOccluders* occluders = nullptr,
                    const InkImages* ink = nullptr);
  /// Binds the camera image, the render pixels' positions in it, and the table of linear light per
  /// pixel value.
  void BindForShading(int background_unit, int positions_unit, int light_unit) const {
    background_.Bind(background_unit);
    camera_positions_.Bind(positions_unit);
    response_.light_of_pixel_value.Bind(light_unit);
  }
  /// Returns the image, including anything drawn into the tiles of framebuffer() since. `rgb`: the
  /// camera image, of which the other pixels are copies.
  RgbImage Read(ImageView<const std::uint8_t> rgb) const;

  const gl::GlTexture& positions() const { return positions_; }
  const gl::GlFramebuffer& framebuffer() const { return output_.framebuffer; }

 private:
  /// The camera's response, with tables for both directions.
  struct Response {
    CameraResponse curve;
    gl::GlTexture light_of_pixel_value, pixel_value_of_light;
  };
  struct Output {
    gl::GlTexture picture;
    gl::GlFramebuffer framebuffer;
    // By the resolution of the virtual image in them; with ink and nothing else.
    std::vector<PixelRect> fine, coarse, inked;
  };
  /// Render pixels that a tile of the camera image samples.
  struct Sampled {
    PixelRect tile;
    glm::vec2 low{1e30F}, high{-1e30F};
  };
  struct Programs {
    // Second index: without and with grain. First index: fine and coarse.
    std::array<std::array<gl::GlProgram, 2>, 2> composite;
    // Fine, by Parts and grain; created on first use.
    std::array<std::optional<gl::GlProgram>, 16> others;
    gl::GlProgram blur, blur_of_ratio;
  };
  /// The sensor's noise.
  struct Grain {
    gl::GlTexture texture;
    std::optional<CameraLook> look;  // Empty: no visible noise.
    double correlation = -1.0;       // Of the texture.
    std::uint32_t pictures = 0;      // Images composed so far. Each receives its own noise.
  };
  /// What the tile whose first pixel is (x, y) samples. `positions`: RenderPositions().
  static Sampled SampledFrom(int x, int y, const Image<float>& positions);
  Result<void> CreateResponseTables();
  /// The last program. `defines`: in addition to those that camera and response need.
  Result<gl::GlProgram> CreateComposite(std::vector<std::string> defines, bool grain) const;
  /// What takes part in the composition of a tile at full resolution.
  struct Parts {
    bool occluded = false, inked = false, ink_alone = false;
  };
  Result<const gl::GlProgram*> FineProgram(const Parts& parts);
  int BlurReach_px() const;
  void Blur(const RenderTargets& targets, const AffectedTiles& tiles) const;
  void SetGrain(const gl::GlProgram& program) const;

  CameraModel camera_;
  double supersampling_ = 1.0;
  Response response_;
  gl::GlTexture background_, positions_, camera_positions_;
  Output output_;
  std::vector<Sampled> sampled_;  // One per tile of the camera image.
  gl::GlVertexArray no_attributes_;
  Programs programs_;
  double added_blur_px_ = 0.0;  // Camera pixels; 0: none.
  Grain grain_;
};

}  // namespace pleinair::compositor
