#pragma once

#include <cstdint>
#include <optional>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/error.h"
#include "base/image.h"
#include "compositor/passes/render_camera.h"
#include "compositor/passes/render_targets.h"
#include "compositor/picture/camera_look.h"
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

  /// Uploads the camera image `rgb`. It must have the camera's size and no gaps between rows.
  void SetBackground(ImageView<const std::uint8_t> rgb);
  /// Composes the drawn and resolved `targets`. The blur is applied to them in place.
  void Draw(const RenderTargets& targets);
  /// Binds the camera image, the render pixels' positions in it, and the table of linear light per
  /// pixel value.
  void BindForShading(int background_unit, int positions_unit, int light_unit) const {
    background_.Bind(background_unit);
    camera_positions_.Bind(positions_unit);
    response_.light_of_pixel_value.Bind(light_unit);
  }
  /// Returns the image, including anything drawn into framebuffer() since.
  RgbImage Read() const;

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
  };
  struct Programs {
    gl::GlProgram blur, composite, grain;
  };
  /// The sensor's noise.
  struct Grain {
    gl::GlTexture texture;
    std::optional<CameraLook> look;  // Empty: no visible noise.
    double correlation = -1.0;       // Of the texture.
    std::uint32_t pictures = 0;      // Images composed so far. Each receives its own noise.
  };
  Result<void> CreateResponseTables();
  void Blur(const RenderTargets& targets) const;
  void SetGrain() const;

  CameraModel camera_;
  double supersampling_ = 1.0;
  Response response_;
  gl::GlTexture background_, positions_, camera_positions_;
  Output output_;
  gl::GlVertexArray no_attributes_;
  Programs programs_;
  double added_blur_px_ = 0.0;  // Camera pixels; 0: none.
  Grain grain_;
};

}  // namespace pleinair::compositor
