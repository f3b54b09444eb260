#pragma once

#include <vector>

#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/ray_scene.h"

namespace pleinair::compositor {

/// By triangle of a phantom, whether its own or other phantoms' shadows touch it: from ten places
/// of it, near corners, at the middles of edges, its middle and between that and the corners, rays
/// run to three points of the sun's rim. A shadow that falls between them is missed, as a strip
/// along an edge may that is little more than a fifth of the triangle's height wide: what is drawn
/// from this must differ little by it. kNone where it is turned away from the sun.
///
/// `to_sun`: unit, marker coordinates; zero: without a sun.
std::vector<SunVisibility> ClassifySunVisibility(const RayScene& rays, const LitMesh& phantom,
                                                 Vec3 to_sun, int threads);

}  // namespace pleinair::compositor
