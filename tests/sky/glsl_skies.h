#pragma once

// sky/shaders/*.glsl compiled as C++: glm has GLSL's types and functions. The tables of the
// atmosphere are those that these point to.

#include <glm/glm.hpp>

#include "sky/atmosphere/aerial_perspective.h"
#include "sky/atmosphere/atmosphere.h"

namespace pleinair::sky::glsl {

using namespace glm;  // NOLINT(google-build-using-namespace): GLSL has no namespaces.

inline const AtmosphereSky::Node* atmosphere_nodes = nullptr;
inline const AerialPerspective::Node* aerial_nodes = nullptr;

inline vec3 ToVec3(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }
inline vec3 ToVec3(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline vec3 AtmosphereScattered(int node) { return ToVec3(atmosphere_nodes[node].scattered); }
inline vec3 AtmosphereAerosol(int node) { return ToVec3(atmosphere_nodes[node].aerosol); }
inline vec3 AerialMolecules(int node) { return ToVec3(aerial_nodes[node].molecules); }
inline vec3 AerialAerosol(int node) { return ToVec3(aerial_nodes[node].aerosol); }

#include "sky/shaders/sky_atmosphere.glsl"
#include "sky/shaders/sky_cie.glsl"
#include "sky/shaders/sky_clouds.glsl"
#include "sky/shaders/sky_perez.glsl"

inline AerialConstants ToGlsl(const AerialPerspective::Constants& c) {
  return {ToVec3(c.sun_on_aerosol),
          ToVec3(c.molecule_extinction),
          ToVec3(c.aerosol_extinction),
          c.aerosol_scale_height,
          c.asymmetry,
          ToVec3(c.to_sun)};
}

}  // namespace pleinair::sky::glsl
