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

/// The last steps of a composed picture: what was drawn is blurred as the camera blurs, bent as its
/// lens bends, put before the camera's own picture, given the camera's grain and written in its
/// codes. Needs a current OpenGL context with the compositor's shaders registered.
class CameraPicture {
 public:
  static Result<CameraPicture> Create(const CameraModel& camera, const RenderCamera& render,
                                      double supersampling, const CameraResponse& response);

  /// As Composer::SetCameraLook().
  Result<void> SetCameraLook(const std::optional<CameraLook>& look);

  /// Takes the camera's picture, `rgb`, of its size and without gaps between rows.
  void SetBackground(ImageView<const std::uint8_t> rgb);
  /// Composes what was drawn into `targets` and resolved; the blur is left in them.
  void Draw(const RenderTargets& targets);
  /// Binds the camera's picture, where render pixels lie in it, and the light of its codes.
  void BindForShading(int background_unit, int positions_unit, int light_unit) const {
    background_.Bind(background_unit);
    camera_positions_.Bind(positions_unit);
    response_.light_of_pixel_value.Bind(light_unit);
  }
  /// The picture, with whatever else was drawn into framebuffer() since.
  RgbImage Read() const;

  const gl::GlTexture& positions() const { return positions_; }
  const gl::GlFramebuffer& framebuffer() const { return output_.framebuffer; }

 private:
  /// The camera's response, and both ways through it as tables.
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
    std::optional<CameraLook> look;  // None: no grain that shows.
    double correlation = -1.0;       // Of the texture.
    std::uint32_t pictures = 0;      // Composed so far: each gets grain of its own.
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
