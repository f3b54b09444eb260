#version 450 core
#extension GL_GOOGLE_include_directive : require
// Nothing but a stage around the pure file, for the validator.
#include "sky/shaders/sky_perez.glsl"

layout(location = 0) uniform vec4 sun_and_turbidity;
layout(location = 0) in vec3 direction;
layout(location = 0) out vec3 radiance;

void main() {
  PerezSky sky = PerezSkyCreate(sun_and_turbidity.w, sun_and_turbidity.xyz);
  radiance = PerezSkyRadiance(sky, normalize(direction));
}
