// The physically based sky and the air before things, the twins of AtmosphereSky::Xyz
// (sky/atmosphere/atmosphere.h) and AerialPerspective (sky/atmosphere/aerial_perspective.h): how their tables are read.
// The tables are made on the CPU and reach the shader as it likes; before it includes this file it
// defines, for the nodes in their order,
//
//   vec3 AtmosphereScattered(int node);  // AtmosphereSky::Node
//   vec3 AtmosphereAerosol(int node);
//   vec3 AerialMolecules(int node);      // AerialPerspective::Node
//   vec3 AerialAerosol(int node);
//
// Directions are unit vectors, east, north, up. The `f` of the literals is for C++.
#ifndef PLEINAIR_SKY_ATMOSPHERE_GLSL
#define PLEINAIR_SKY_ATMOSPHERE_GLSL

#include "sky/shaders/sky_angles.glsl"
#include "sky/shaders/sky_color.glsl"

const int kAtmosphereRings = 64;
const int kAtmosphereSectors = 40;
const int kAerialRows = 37;
const int kAerialSectors = 13;
const float kAtmosphereMoleculeScaleHeight = 8000.0f;

// Henyey & Greenstein 1941, Eq. (2). Its cosine comes from the chord, which keeps its digits.
float AtmosphereAerosolPhase(float asymmetry, vec3 a, vec3 b) {
  vec3 chord = a - b;
  float base = max(1e-9f, (1.0f - asymmetry) * (1.0f - asymmetry) + asymmetry * dot(chord, chord));
  return (1.0f - asymmetry * asymmetry) / (4.0f * kSkyPi * base * sqrt(base));
}

// Place in a table whose azimuths are 180 degrees t^1.5.
float AtmosphereColumn(vec3 direction, vec3 to_sun, int sectors) {
  float turn = SkyAzimuthBetween(direction, to_sun) / kSkyPi;
  return turn > 0.0f ? pow(turn * turn, 1.0f / 3.0f) * float(sectors - 1) : 0.0f;
}

vec3 AtmosphereNodeLight(int node, float phase) {
  return AtmosphereScattered(node) + AtmosphereAerosol(node) * phase;
}

// CIE XYZ in cd/m2; black below the horizon.
vec3 AtmosphereSkyXyz(vec3 to_sun, float asymmetry, vec3 direction) {
  if (direction.z < 0.0f) return vec3(0.0f);
  float row = sqrt(SkyElevation(direction) / (0.5f * kSkyPi)) * float(kAtmosphereRings - 1);
  float column = AtmosphereColumn(direction, to_sun, kAtmosphereSectors);
  int r = min(int(row), kAtmosphereRings - 2);
  int c = min(int(column), kAtmosphereSectors - 2);
  float fr = row - float(r);
  float fc = column - float(c);
  float phase = AtmosphereAerosolPhase(asymmetry, direction, to_sun);
  int node = r * kAtmosphereSectors + c;
  vec3 low = mix(AtmosphereNodeLight(node, phase), AtmosphereNodeLight(node + 1, phase), fc);
  vec3 high = mix(AtmosphereNodeLight(node + kAtmosphereSectors, phase),
                  AtmosphereNodeLight(node + kAtmosphereSectors + 1, phase), fc);
  return mix(low, high, fr);
}

// Linear Rec.709 in cd/m2, no channel negative.
vec3 AtmosphereSkyRadiance(vec3 to_sun, float asymmetry, vec3 direction) {
  return SkyRgbFromXyz(AtmosphereSkyXyz(to_sun, asymmetry, direction));
}

// AerialPerspective::Constants.
struct AerialConstants {
  vec3 sun_on_aerosol;
  vec3 molecule_extinction;
  vec3 aerosol_extinction;
  float aerosol_scale_height;
  float asymmetry;
  vec3 to_sun;
};

// (1 - e^-x) / x.
float AerialMeanThrough(float x) {
  if (x < 1e-2f) return 1.0f - x / 2.0f + x * x / 6.0f;
  return (1.0f - exp(-x)) / x;
}

// Columns of molecules and aerosol, metres of the air at the ground.
vec2 AerialColumns(AerialConstants air, vec3 towards, float distance_m) {
  float rise = max(0.0f, towards.z * distance_m);
  return distance_m * vec2(AerialMeanThrough(rise / kAtmosphereMoleculeScaleHeight),
                           AerialMeanThrough(rise / air.aerosol_scale_height));
}

vec3 AerialOpticalDepth(AerialConstants air, vec2 columns) {
  return air.molecule_extinction * columns.x + air.aerosol_extinction * columns.y;
}

vec3 AerialTransmittance(AerialConstants air, vec3 towards, float distance_m) {
  return exp(-AerialOpticalDepth(air, AerialColumns(air, towards, distance_m)));
}

vec3 AerialNodeLight(int node, vec2 columns) {
  return AerialMolecules(node) * columns.x + AerialAerosol(node) * columns.y;
}

// Light that the air adds, linear Rec.709 in cd/m2.
vec3 AerialInscattered(AerialConstants air, vec3 towards, float distance_m) {
  vec2 columns = AerialColumns(air, towards, distance_m);
  vec3 depth = AerialOpticalDepth(air, columns);
  float row = (SkyElevation(towards) / kSkyPi + 0.5f) * float(kAerialRows - 1);
  float column = AtmosphereColumn(towards, air.to_sun, kAerialSectors);
  int r = clamp(int(row), 0, kAerialRows - 2);
  int c = min(int(column), kAerialSectors - 2);
  int node = r * kAerialSectors + c;
  float fc = column - float(c);
  vec3 low = mix(AerialNodeLight(node, columns), AerialNodeLight(node + 1, columns), fc);
  vec3 high = mix(AerialNodeLight(node + kAerialSectors, columns),
                  AerialNodeLight(node + kAerialSectors + 1, columns), fc);
  vec3 added = mix(low, high, row - float(r)) +
               air.sun_on_aerosol *
                   (AtmosphereAerosolPhase(air.asymmetry, towards, air.to_sun) * columns.y);
  return added * vec3(AerialMeanThrough(depth.x), AerialMeanThrough(depth.y),
                      AerialMeanThrough(depth.z));
}

#endif
