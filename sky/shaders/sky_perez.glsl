// Preetham's sky, the twin of sky/perez.h (which has the equations and their sources). Pure
// functions of numbers: included by shaders, and compiled as C++ by tests/sky/sky_glsl_test.cc,
// which holds them to the C++ within 1e-4.
//
//   PerezSky sky = PerezSkyCreate(turbidity, to_sun);            // once a moment, or on the CPU
//   vec3 radiance_cd_m2 = PerezSkyRadiance(sky, direction);      // linear Rec.709
//
// Directions are unit vectors, east, north, up. The `f` of the literals is for C++.
#ifndef PLEINAIR_SKY_PEREZ_GLSL
#define PLEINAIR_SKY_PEREZ_GLSL

#include "sky/shaders/sky_angles.glsl"
#include "sky/shaders/sky_color.glsl"

const float kPerezLowestTurbidity = 2.0f;
const float kPerezHighestTurbidity = 10.0f;
const float kPerezMinCosine = 1e-3f;

// Perez' five coefficients for chromaticity x, y and luminance Y at once.
struct PerezSky {
  vec3 a, b, c, d, e;
  vec3 zenith_over_f;  // value_zenith / F(0, theta_sun).
  vec3 to_sun;         // On the horizon when the sun is below it.
};

// F(theta, gamma) of x, y, Y.
vec3 PerezDistribution(PerezSky sky, float cos_theta, float gamma, float cos_gamma) {
  return (vec3(1.0f) + sky.a * exp(sky.b / cos_theta)) *
         (vec3(1.0f) + sky.c * exp(sky.d * gamma) + sky.e * (cos_gamma * cos_gamma));
}

// TwilightShare() of sky/atmosphere/twilight.h: logarithm of the clear sky's illuminance between two nodes.
float PerezTwilightSegment(float elevation_deg, float low_deg, float low_log, float step_deg,
                           float high_log) {
  return low_log + (elevation_deg - low_deg) / step_deg * (high_log - low_log);
}

float PerezTwilightShare(float elevation_deg) {
  float e = max(elevation_deg, -18.0f);
  float log10_lux = 2.88f;
  if (e < -15.0f) {
    log10_lux = PerezTwilightSegment(e, -18.0f, -3.19f, 3.0f, -2.69f);
  } else if (e < -12.0f) {
    log10_lux = PerezTwilightSegment(e, -15.0f, -2.69f, 3.0f, -2.09f);
  } else if (e < -9.0f) {
    log10_lux = PerezTwilightSegment(e, -12.0f, -2.09f, 3.0f, -0.93f);
  } else if (e < -6.0f) {
    log10_lux = PerezTwilightSegment(e, -9.0f, -0.93f, 3.0f, 0.53f);
  } else if (e < -5.0f) {
    log10_lux = PerezTwilightSegment(e, -6.0f, 0.53f, 1.0f, 1.02f);
  } else if (e < -4.0f) {
    log10_lux = PerezTwilightSegment(e, -5.0f, 1.02f, 1.0f, 1.48f);
  } else if (e < -3.0f) {
    log10_lux = PerezTwilightSegment(e, -4.0f, 1.48f, 1.0f, 1.90f);
  } else if (e < -2.0f) {
    log10_lux = PerezTwilightSegment(e, -3.0f, 1.90f, 1.0f, 2.28f);
  } else if (e < -1.0f) {
    log10_lux = PerezTwilightSegment(e, -2.0f, 2.28f, 1.0f, 2.61f);
  } else if (e < 0.0f) {
    log10_lux = PerezTwilightSegment(e, -1.0f, 2.61f, 1.0f, 2.88f);
  }
  return exp((log10_lux - 2.88f) * 2.30258509f);
}

// Turbidity outside 2 to 10 is clamped.
PerezSky PerezSkyCreate(float turbidity, vec3 to_sun) {
  float t = clamp(turbidity, kPerezLowestTurbidity, kPerezHighestTurbidity);
  PerezSky sky;
  sky.a = vec3(-0.0193f, -0.0167f, 0.1787f) * t + vec3(-0.2592f, -0.2608f, -1.4630f);
  sky.b = vec3(-0.0665f, -0.0950f, -0.3554f) * t + vec3(0.0008f, 0.0092f, 0.4275f);
  sky.c = vec3(-0.0004f, -0.0079f, -0.0227f) * t + vec3(0.2125f, 0.2102f, 5.3251f);
  sky.d = vec3(-0.0641f, -0.0441f, 0.1206f) * t + vec3(-0.8989f, -1.6537f, -2.5771f);
  sky.e = vec3(-0.0033f, -0.0109f, -0.0670f) * t + vec3(0.0452f, 0.0529f, 0.3703f);
  sky.to_sun = SkyLiftedToHorizon(to_sun);

  float cos_sun = min(sky.to_sun.z, 1.0f);
  float theta = 0.5f * kSkyPi - SkyElevation(sky.to_sun);
  float theta2 = theta * theta;
  float theta3 = theta2 * theta;
  float zenith_x = (0.00166f * theta3 - 0.00375f * theta2 + 0.00209f * theta) * t * t +
                   (-0.02903f * theta3 + 0.06377f * theta2 - 0.03202f * theta + 0.00394f) * t +
                   (0.11693f * theta3 - 0.21196f * theta2 + 0.06052f * theta + 0.25886f);
  float zenith_y = (0.00275f * theta3 - 0.00610f * theta2 + 0.00317f * theta) * t * t +
                   (-0.04214f * theta3 + 0.08970f * theta2 - 0.04153f * theta + 0.00516f) * t +
                   (0.15346f * theta3 - 0.26756f * theta2 + 0.06670f * theta + 0.26688f);
  float chi = (4.0f / 9.0f - t / 120.0f) * (kSkyPi - 2.0f * theta);
  float zenith_luminance =
      1000.0f * ((4.0453f * t - 4.9710f) * tan(chi) - 0.2155f * t + 2.4192f);
  float elevation_deg = SkyElevation(to_sun) * (180.0f / kSkyPi);
  vec3 zenith =
      vec3(zenith_x, zenith_y, zenith_luminance * PerezTwilightShare(elevation_deg));
  sky.zenith_over_f = zenith / PerezDistribution(sky, 1.0f, theta, cos_sun);
  return sky;
}

// Chromaticity x, y and luminance (cd/m2); black below the horizon.
vec3 PerezSkyXyY(PerezSky sky, vec3 direction) {
  if (direction.z < 0.0f) return vec3(0.0f);
  float cos_theta = max(direction.z, kPerezMinCosine);
  float cos_gamma = clamp(dot(direction, sky.to_sun), -1.0f, 1.0f);
  float gamma = SkyAngleBetween(direction, sky.to_sun);
  return sky.zenith_over_f * PerezDistribution(sky, cos_theta, gamma, cos_gamma);
}

// Linear Rec.709 in cd/m2, no channel negative; its luminance is the sky's.
vec3 PerezSkyRadiance(PerezSky sky, vec3 direction) {
  return SkyRgbFromXyY(PerezSkyXyY(sky, direction));
}

#endif
