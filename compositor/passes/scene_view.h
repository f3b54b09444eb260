#pragma once

#include <array>
#include <glm/glm.hpp>

#include "base/frames.h"
#include "compositor/passes/render_camera.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// What the render camera sees of a scene that lies within `bounds`: its pyramid of view, with near
/// and far as tight around the scene as its box tells.
shadows::View ViewOf(const RenderCamera& camera,
                     const Transform<Camera, Marker>& camera_from_marker,
                     const shadows::Box& bounds);

/// Directions of sight, marker coordinates, not unit: [0] + x [1] + y [2] is the ray through
/// gl_FragCoord (x, y), one metre deep.
std::array<glm::vec3, 3> RaysThroughPixels(const RenderCamera& camera, const shadows::View& view);

/// Pixels, as glScissor takes them.
struct PixelRect {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The smallest rectangle of the picture outside which nothing of `bounds` is seen.
PixelRect PictureOf(const RenderCamera& camera, const shadows::View& view,
                    const shadows::Box& bounds);

}  // namespace pleinair::compositor
