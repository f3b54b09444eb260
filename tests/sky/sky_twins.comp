#version 450 core
#ifdef GL_GOOGLE_include_directive  // The validator's; drivers get the files already included.
#extension GL_GOOGLE_include_directive : require
#endif
// The skies' shader twins at a list of directions, for tests/sky/sky_gpu_test.cc. `queries` has a
// direction and a distance (metres) each.
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Queries { vec4 queries[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };
// Two vectors a node.
layout(std430, binding = 2) readonly buffer SkyNodes { vec4 sky_nodes[]; };
layout(std430, binding = 3) readonly buffer AerialNodes { vec4 aerial_nodes[]; };

vec3 AtmosphereScattered(int node) { return sky_nodes[2 * node].xyz; }
vec3 AtmosphereAerosol(int node) { return sky_nodes[2 * node + 1].xyz; }
vec3 AerialMolecules(int node) { return aerial_nodes[2 * node].xyz; }
vec3 AerialAerosol(int node) { return aerial_nodes[2 * node + 1].xyz; }

#include "sky/shaders/sky_atmosphere.glsl"
#include "sky/shaders/sky_cie.glsl"
#include "sky/shaders/sky_clouds.glsl"
#include "sky/shaders/sky_perez.glsl"

uniform int count;
uniform int model;  // 0 perez, 1 to 15 CIE, 16 atmosphere, 17 its aerial perspective, 18 clouds.
uniform vec3 to_sun;
uniform float turbidity;
uniform float cover;
uniform vec2 clear_lux;
uniform vec2 illuminance_over_zenith;
uniform float asymmetry;
uniform vec3 sun_on_aerosol;
uniform vec3 molecule_extinction;
uniform vec3 aerosol_extinction;
uniform float aerosol_scale_height;

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  vec3 direction = queries[i].xyz;
  vec3 answer;
  if (model == 0) {
    answer = PerezSkyRadiance(PerezSkyCreate(turbidity, to_sun), direction);
  } else if (model <= 15) {
    answer = vec3(CieSkyRelativeLuminance(CieSkyCreate(model, to_sun), direction));
  } else if (model == 16) {
    answer = AtmosphereSkyRadiance(to_sun, asymmetry, direction);
  } else if (model == 18) {
    // Behind them ClearBehindClouds() of tests/sky/sky_twin_cases.h.
    SkyClouds clouds = SkyCloudsCreate(cover, to_sun, clear_lux, illuminance_over_zenith);
    vec3 clear = vec3(1500.0, 2000.0, 3000.0 + 4000.0 * direction.z);
    answer = SkyCloudsRadiance(clouds, clear, direction);
  } else {
    AerialConstants air;
    air.sun_on_aerosol = sun_on_aerosol;
    air.molecule_extinction = molecule_extinction;
    air.aerosol_extinction = aerosol_extinction;
    air.aerosol_scale_height = aerosol_scale_height;
    air.asymmetry = asymmetry;
    air.to_sun = to_sun;
    answer = AerialInscattered(air, direction, queries[i].w);
  }
  answers[i] = vec4(answer, 0.0);
}
