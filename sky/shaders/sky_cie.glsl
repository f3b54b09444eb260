// The CIE standard general skies, the twin of sky/cie_sky.h (which has the equations and their
// source). Pure functions of numbers.
//
//   CieSky sky = CieSkyCreate(12, to_sun);                                   // type 1 to 15
//   float luminance_cd_m2 = zenith_cd_m2 * CieSkyRelativeLuminance(sky, direction);
//
// Directions are unit vectors, east, north, up. The `f` of the literals is for C++.
#ifndef PLEINAIR_SKY_CIE_GLSL
#define PLEINAIR_SKY_CIE_GLSL

#include "sky/shaders/sky_angles.glsl"

struct CieSky {
  float a, b, c, d, e;
  vec3 to_sun;  // On the horizon when the sun is below it.
  float horizon_term;  // 1 - c e^(d pi/2).
  float scale;         // 1 / (f(Z_sun) g(0)).
};

float CieSkyIndicatrix(CieSky sky, float chi, float cos_chi) {
  return sky.horizon_term + sky.c * exp(sky.d * chi) + sky.e * (cos_chi * cos_chi);
}

// ISO 15469:2004, Table 1: gradation groups (a, b) and indicatrix groups (c, d, e).
CieSky CieSkyCreate(int type, vec3 to_sun) {
  CieSky sky;
  if (type <= 2) {
    sky.a = 4.0f;
    sky.b = -0.70f;
  } else if (type <= 4) {
    sky.a = 1.1f;
    sky.b = -0.80f;
  } else if (type <= 8) {
    sky.a = 0.0f;
    sky.b = -1.0f;
  } else if (type <= 11) {
    sky.a = -1.0f;
    sky.b = -0.55f;
  } else if (type <= 13) {
    sky.a = -1.0f;
    sky.b = -0.32f;
  } else {
    sky.a = -1.0f;
    sky.b = -0.15f;
  }
  if (type == 1 || type == 3 || type == 5) {
    sky.c = 0.0f;
    sky.d = -1.0f;
    sky.e = 0.0f;
  } else if (type == 2 || type == 4 || type == 6 || type == 9) {
    sky.c = 2.0f;
    sky.d = -1.5f;
    sky.e = 0.15f;
  } else if (type == 7 || type == 10) {
    sky.c = 5.0f;
    sky.d = -2.5f;
    sky.e = 0.30f;
  } else if (type == 8 || type == 11 || type == 12) {
    sky.c = 10.0f;
    sky.d = -3.0f;
    sky.e = 0.45f;
  } else if (type == 13 || type == 14) {
    sky.c = 16.0f;
    sky.d = -3.0f;
    sky.e = 0.30f;
  } else {
    sky.c = 24.0f;
    sky.d = -2.8f;
    sky.e = 0.15f;
  }
  sky.to_sun = SkyLiftedToHorizon(to_sun);
  sky.horizon_term = 1.0f - sky.c * exp(sky.d * (0.5f * kSkyPi));
  float zenith_distance = 0.5f * kSkyPi - SkyElevation(sky.to_sun);
  sky.scale = 1.0f / (CieSkyIndicatrix(sky, zenith_distance, min(sky.to_sun.z, 1.0f)) *
                      (1.0f + sky.a * exp(sky.b)));
  return sky;
}

// As a share of the zenith's luminance; 0 below the horizon.
float CieSkyRelativeLuminance(CieSky sky, vec3 direction) {
  if (direction.z < 0.0f) return 0.0f;
  float gradation = 1.0f + sky.a * exp(sky.b / max(direction.z, 1e-3f));
  float cos_chi = clamp(dot(direction, sky.to_sun), -1.0f, 1.0f);
  return sky.scale * gradation *
         CieSkyIndicatrix(sky, SkyAngleBetween(direction, sky.to_sun), cos_chi);
}

#endif
