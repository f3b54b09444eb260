#pragma once

#include <vector>

#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/ray_scene.h"

namespace pleinair::compositor {

/// Classifies each triangle of a phantom by whether shadows of this or other phantoms touch it.
/// From ten points, rays run to three points of the sun's rim. The points lie near the corners, at
/// edge midpoints, at the centre, and between the centre and the corners. Triangles that face away
/// from the sun are kNone.
///
/// A shadow between the points is missed, such as a strip along an edge a little wider than a fifth
/// of the triangle's height. Results that depend on this must tolerate such errors.
///
/// `to_sun`: unit, marker coordinates; zero: without a sun.
std::vector<SunVisibility> ClassifySunVisibility(const RayScene& rays, const LitMesh& phantom,
                                                 Vec3 to_sun, int threads);

}  // namespace pleinair::compositor
