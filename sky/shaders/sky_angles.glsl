// Angles from vectors, for the skies. Drivers' own asin and atan may be wrong by 3e-4 (the GLSL
// specification does not say how good they are), too much for skies that must agree within 1e-4.
#ifndef PLEINAIR_SKY_ANGLES_GLSL
#define PLEINAIR_SKY_ANGLES_GLSL

const float kSkyPi = 3.14159265f;

// Arcus tangent of y / x in [0, pi/2], y and x not negative; Moshier, Cephes 2.2, atanf: within
// 2e-7.
float SkyAtanFirstQuadrant(float y, float x) {
  if (y == 0.0f) return 0.0f;
  float small = min(x, y);
  float big = max(x, y);
  float t = small / big;
  float offset = 0.0f;
  if (t > 0.414213562f) {
    t = (t - 1.0f) / (t + 1.0f);
    offset = 0.25f * kSkyPi;
  }
  float z = t * t;
  float angle = offset + t + t * z * (((8.05374449538e-2f * z - 1.38776856032e-1f) * z +
                                       1.99777106478e-1f) * z - 3.33329491539e-1f);
  return y > x ? 0.5f * kSkyPi - angle : angle;
}

// Between unit vectors, [0, pi]; keeps its digits at both ends.
float SkyAngleBetween(vec3 a, vec3 b) {
  return 2.0f * SkyAtanFirstQuadrant(length(a - b), length(a + b));
}

// Of a unit vector above the horizon, or below it (negative).
float SkyElevation(vec3 direction) {
  float level = sqrt(direction.x * direction.x + direction.y * direction.y);
  float angle = SkyAtanFirstQuadrant(abs(direction.z), level);
  return direction.z < 0.0f ? -angle : angle;
}

// Between the azimuths of two directions, [0, pi].
float SkyAzimuthBetween(vec3 a, vec3 b) {
  float across = abs(a.x * b.y - a.y * b.x);
  float along = a.x * b.x + a.y * b.y;
  float angle = SkyAtanFirstQuadrant(across, abs(along));
  return along < 0.0f ? kSkyPi - angle : angle;
}

// The sun, or the point of the horizon above it; at the nadir north, as good as any.
vec3 SkyLiftedToHorizon(vec3 to_sun) {
  if (to_sun.z >= 0.0f) return to_sun;
  float horizontal = sqrt(to_sun.x * to_sun.x + to_sun.y * to_sun.y);
  if (horizontal == 0.0f) return vec3(0.0f, 1.0f, 0.0f);
  return vec3(to_sun.x / horizontal, to_sun.y / horizontal, 0.0f);
}

#endif
