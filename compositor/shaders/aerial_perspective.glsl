#ifndef COMPOSITOR_AERIAL_PERSPECTIVE_GLSL
#define COMPOSITOR_AERIAL_PERSPECTIVE_GLSL
// AIRLIGHT: includes the airlight between the eye and the real surfaces. Without it there is no
// airlight.

#include "compositor/shaders/aerial_fog.glsl"
#include "compositor/shaders/picture_light.glsl"

uniform vec3 u_exposure_scale;  // Display-linear value per radiance.

#ifdef AIRLIGHT
layout(location = 1) out vec4 out_color;  // Added to the image, with coverage 0.

uniform float u_fog_split_m[kFogSplits];  // FogSplits of compositor/passes/aerial_fog.h.
uniform vec3 u_fog_optical_depth[kFogSplits];
uniform vec3 u_fog_inscattered[kFogSplits];
#endif

FogAir AirUpTo(float distance_m) {
#ifdef AIRLIGHT
  return FogUpTo(distance_m, u_fog_split_m, u_fog_optical_depth, u_fog_inscattered);
#else
  return FogAir(vec3(1.0), vec3(0.0));
#endif
}

// Display-linear light to add to an image whose surface light changes by `ratio`.
vec3 AirlightOver(vec3 ratio, FogAir air) {
#ifdef AIRLIGHT
  return AirlightOverShadow(ratio, u_exposure_scale * air.light, PictureLight());
#else
  return vec3(0.0);
#endif
}

void WriteAirlight(vec3 airlight) {
#ifdef AIRLIGHT
  out_color = vec4(airlight, 0.0);
#endif
}

#endif
