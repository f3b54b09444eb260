#pragma once

#include <array>
#include <glm/glm.hpp>

#include "base/frames.h"
#include "compositor/composer_options.h"
#include "compositor/passes/aerial_fog.h"
#include "compositor/passes/render_camera.h"
#include "compositor/surfaces/image_tiles.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// The transform as a matrix.
glm::dmat4 CameraFromMarkerMatrix(const Transform<Camera, Marker>& camera_from_marker);

/// View frustum of the render camera. Near and far planes fit the `bounds` of the scene as tightly
/// as the box allows.
shadows::View ViewOf(const RenderCamera& camera,
                     const Transform<Camera, Marker>& camera_from_marker,
                     const shadows::Box& bounds);

/// The view of another camera at the same place, with the same near and far planes.
shadows::View SeenBy(const RenderCamera& camera, shadows::View view);

/// Viewing rays in marker coordinates, not unit vectors. [0] + x [1] + y [2] is the ray through
/// gl_FragCoord (x, y), one metre deep.
std::array<glm::vec3, 3> RaysThroughPixels(const RenderCamera& camera, const shadows::View& view);

/// The view's image for ImageTiles, with clip_from_position for marker coordinates. `spread_px`: as
/// SceneProjection.
SceneProjection ProjectionOf(const RenderCamera& camera, const shadows::View& view, int spread_px);

/// The fog between the eye and a box with all objects. `options`: shadow partitions and fog.
FogSplits FogBefore(const shadows::Box& objects, const AerialFog& air, const shadows::View& view,
                    const glm::dvec3& eye_m, const ComposerOptions& options);

}  // namespace pleinair::compositor
