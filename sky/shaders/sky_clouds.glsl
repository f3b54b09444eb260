// Clouds before a clear sky, the twin of sky/cloud_cover.h (which has the equations and their
// sources). Pure functions of numbers.
//
//   // Once a moment: the clear sky's light on level ground and the clear sun's on a surface facing
//   // it (lux), and CieSky::IlluminanceOverZenith() of the two patterns, from the CPU.
//   SkyClouds clouds = SkyCloudsCreate(cover, to_sun, clear_lux, illuminance_over_zenith);
//   vec3 radiance_cd_m2 = SkyCloudsRadiance(clouds, clear_radiance, direction);
//
// Directions are unit vectors, east, north, up. The `f` of the literals is for C++.
#ifndef PLEINAIR_SKY_CLOUDS_GLSL
#define PLEINAIR_SKY_CLOUDS_GLSL

#include "sky/shaders/sky_angles.glsl"
#include "sky/shaders/sky_cie.glsl"

// CloudTransmission.
struct SkyCloudTransmission {
  float global;
  float sun;
  float clear_sky;
};

// CloudPatterns.
struct SkyCloudPatterns {
  int lower, upper;
  float upper_share;
};

struct SkyClouds {
  SkyCloudTransmission passed;
  CieSky lower, upper;
  float lower_zenith_cd_m2, upper_zenith_cd_m2;
};

// RelativeAirMass() of sky/air_mass.h.
float SkyAirMass(vec3 to_sun) {
  float elevation_deg = max(SkyElevation(to_sun) * (180.0f / kSkyPi), -0.5f);
  return 1.0f / (sin(elevation_deg * (kSkyPi / 180.0f)) +
                 0.50572f * pow(elevation_deg + 6.07995f, -1.6364f));
}

SkyCloudTransmission SkyTransmissionOfClouds(float cover, vec3 to_sun) {
  SkyCloudTransmission passed;
  float c = clamp(cover, 0.0f, 1.0f);
  passed.global = 1.0f;
  passed.sun = 1.0f;
  if (c > 0.0f) {
    float beam_share = 1.0f - pow(c, 2.5f);
    passed.global = 1.0f - 0.75f * pow(c, 3.4f);
    passed.sun = beam_share > 0.0f ? pow(beam_share, SkyAirMass(to_sun)) : 0.0f;
  }
  passed.clear_sky = 1.0f - c;
  return passed;
}

SkyCloudPatterns SkyPatternsOfClouds(float cover) {
  SkyCloudPatterns patterns;
  float place = 3.0f * clamp(cover, 0.0f, 1.0f);
  int lower = min(int(place), 2);
  patterns.lower = lower == 0 ? 11 : (lower == 1 ? 8 : 4);
  patterns.upper = lower == 0 ? 8 : (lower == 1 ? 4 : 1);
  patterns.upper_share = place - float(lower);
  return patterns;
}

// `clear_lux`: of the clear sky on level ground, of the clear sun on a surface facing it.
SkyClouds SkyCloudsCreate(float cover, vec3 to_sun, vec2 clear_lux, vec2 illuminance_over_zenith) {
  SkyClouds clouds;
  clouds.passed = SkyTransmissionOfClouds(cover, to_sun);
  SkyCloudPatterns patterns = SkyPatternsOfClouds(cover);
  clouds.lower = CieSkyCreate(patterns.lower, to_sun);
  clouds.upper = CieSkyCreate(patterns.upper, to_sun);
  float sun_lux = clear_lux.y * max(to_sun.z, 0.0f);
  float lux = max((clouds.passed.global - clouds.passed.clear_sky) * clear_lux.x +
                      (clouds.passed.global - clouds.passed.sun) * sun_lux,
                  0.0f);
  clouds.lower_zenith_cd_m2 = lux * (1.0f - patterns.upper_share) / illuminance_over_zenith.x;
  clouds.upper_zenith_cd_m2 = lux * patterns.upper_share / illuminance_over_zenith.y;
  return clouds;
}

// Linear Rec.709 in cd/m2, from the clear sky's in that direction; the clouds are white.
vec3 SkyCloudsRadiance(SkyClouds clouds, vec3 clear, vec3 direction) {
  float cloud = clouds.lower_zenith_cd_m2 * CieSkyRelativeLuminance(clouds.lower, direction) +
                clouds.upper_zenith_cd_m2 * CieSkyRelativeLuminance(clouds.upper, direction);
  return clear * clouds.passed.clear_sky + vec3(cloud);
}

#endif
