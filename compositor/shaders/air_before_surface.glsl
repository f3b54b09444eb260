#ifndef COMPOSITOR_AIR_BEFORE_SURFACE_GLSL
#define COMPOSITOR_AIR_BEFORE_SURFACE_GLSL
// HAZE: the air between the eye and the real surfaces. Without it there is none, and nothing is
// drawn of it.

#include "compositor/shaders/aerial_fog.glsl"
#include "compositor/shaders/picture_light.glsl"

uniform vec3 u_gain;  // Display-linear value per radiance.

#ifdef HAZE
layout(location = 1) out vec4 out_color;  // Added to the picture, covering nothing.

uniform float u_fog_split_m[kFogSplits];  // FogSplits of compositor/passes/aerial_fog.h.
uniform vec3 u_fog_optical_depth[kFogSplits];
uniform vec3 u_fog_inscattered[kFogSplits];
#endif

FogAir AirUpTo(float distance_m) {
#ifdef HAZE
  return FogUpTo(distance_m, u_fog_split_m, u_fog_optical_depth, u_fog_inscattered);
#else
  return FogAir(vec3(1.0), vec3(0.0));
#endif
}

// What is added to a picture whose surface's light changes by `ratio`, display-linear.
vec3 HazeOver(vec3 ratio, FogAir air) {
#ifdef HAZE
  return AirBeforeShadow(ratio, u_gain * air.light, PictureLight());
#else
  return vec3(0.0);
#endif
}

void DrawHaze(vec3 haze) {
#ifdef HAZE
  out_color = vec4(haze, 0.0);
#endif
}

#endif
