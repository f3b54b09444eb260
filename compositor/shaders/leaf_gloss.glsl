#ifndef COMPOSITOR_LEAF_GLOSS_GLSL
#define COMPOSITOR_LEAF_GLOSS_GLSL
// Reflection by the surface of a leaf: facets of refractive index 1.45 and roughness γ (Miao et al.
// 2016 after Cook & Torrance 1982, with G and the normalization corrected; docs/method/leaves.md).
// Arithmetic only; also compiled as C++ (gl/glsl_as_cpp.h,
// tests/compositor/shaders/leaf_gloss_test.cc).

const float kLeafIndex = 1.45f;
const float kMinLeafRoughness = 0.05f;

// Fresnel's reflectance of unpolarized light; c: cosine between light and facet.
float LeafFresnel(float c) {
  float g = sqrt(kLeafIndex * kLeafIndex + c * c - 1.0f);
  float across = (g - c) / (g + c);
  float along = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
  return 0.5f * across * across * (1.0f + along * along);
}

// Beckmann's distribution: e^(−tan²θ / γ²) / (π γ² cos⁴θ).
float DistributionLeaf(float cos_h, float gamma) {
  float c2 = max(cos_h * cos_h, 1e-6f), g2 = gamma * gamma;
  return exp((c2 - 1.0f) / (c2 * g2)) / (3.14159265f * g2 * c2 * c2);
}

// F D G / (4 cos_i cos_v), with G of Cook & Torrance 1982; 1/sr.
float LeafLobe(float cos_i, float cos_v, float cos_h, float cos_vh, float gamma) {
  float shadowed = min(1.0f, 2.0f * cos_h * min(cos_v, cos_i) / max(cos_vh, 1e-4f));
  return LeafFresnel(cos_vh) * DistributionLeaf(cos_h, gamma) * shadowed /
         max(4.0f * cos_i * cos_v, 1e-6f);
}

// Reflectance of the lobe under uniform light from all sides: integrals of the function above. Rows:
// square root of γ, from that of 0.05 to 1 in sevenths. Columns: square root of the cosine, 0 to 1 in
// sixteenths.
const int kLeafRoughnesses = 8, kLeafAngles = 17;
const float kLeafReflected[kLeafRoughnesses * kLeafAngles] = {
    0.8544, 0.8289, 0.7587, 0.6675, 0.5814, 0.5049, 0.4238, 0.3358, 0.2522,
    0.1824, 0.1289, 0.0905, 0.0646, 0.0484, 0.0392, 0.0349, 0.0337,
    0.7213, 0.7028, 0.6501, 0.5752, 0.4924, 0.4134, 0.3433, 0.2811, 0.2241,
    0.1721, 0.1272, 0.0916, 0.0660, 0.0494, 0.0398, 0.0351, 0.0337,
    0.5905, 0.5762, 0.5358, 0.4769, 0.4092, 0.3416, 0.2798, 0.2264, 0.1813,
    0.1434, 0.1116, 0.0856, 0.0652, 0.0504, 0.0408, 0.0357, 0.0338,
    0.4796, 0.4684, 0.4371, 0.3908, 0.3368, 0.2817, 0.2305, 0.1857, 0.1483,
    0.1178, 0.0933, 0.0739, 0.0590, 0.0480, 0.0405, 0.0358, 0.0338,
    0.3931, 0.3844, 0.3595, 0.3227, 0.2792, 0.2345, 0.1924, 0.1553, 0.1241,
    0.0989, 0.0790, 0.0636, 0.0519, 0.0434, 0.0375, 0.0339, 0.0321,
    0.3286, 0.3219, 0.3013, 0.2711, 0.2355, 0.1984, 0.1633, 0.1321, 0.1060,
    0.0848, 0.0682, 0.0554, 0.0458, 0.0386, 0.0333, 0.0297, 0.0275,
    0.2814, 0.2761, 0.2584, 0.2327, 0.2024, 0.1707, 0.1407, 0.1140, 0.0916,
    0.0736, 0.0594, 0.0486, 0.0403, 0.0337, 0.0284, 0.0245, 0.0215,
    0.2471, 0.2428, 0.2266, 0.2039, 0.1770, 0.1492, 0.1227, 0.0994, 0.0799,
    0.0642, 0.0520, 0.0426, 0.0350, 0.0287, 0.0235, 0.0193, 0.0160};
// The same for light from all sides: means over the hemisphere, weighted by the cosine.
const float kLeafReflectedMean[kLeafRoughnesses] = {0.0827, 0.0782, 0.0715, 0.0638,
                                                    0.0561, 0.0488, 0.0418, 0.0354};

// Place of γ among the rows.
float LeafRow(float gamma) {
  float least = sqrt(kMinLeafRoughness);
  float root = sqrt(clamp(gamma, kMinLeafRoughness, 1.0f));
  return (root - least) / (1.0f - least) * float(kLeafRoughnesses - 1);
}

float LeafReflectedAt(int roughness, float angle) {
  int below = min(int(angle), kLeafAngles - 2);
  int at = roughness * kLeafAngles + below;
  return mix(kLeafReflected[at], kLeafReflected[at + 1], angle - float(below));
}

float LeafReflectance(float cosine, float gamma) {
  float row = LeafRow(gamma);
  float angle = sqrt(clamp(cosine, 0.0f, 1.0f)) * float(kLeafAngles - 1);
  int below = min(int(row), kLeafRoughnesses - 2);
  return mix(LeafReflectedAt(below, angle), LeafReflectedAt(below + 1, angle), row - float(below));
}

float LeafMeanReflectance(float gamma) {
  float row = LeafRow(gamma);
  int below = min(int(row), kLeafRoughnesses - 2);
  return mix(kLeafReflectedMean[below], kLeafReflectedMean[below + 1], row - float(below));
}

// Share of the light from a direction that the surface admits, and, by reciprocity, emits.
float LeafAdmits(float cosine, float gamma, float gloss) {
  return max(1.0f - gloss * LeafReflectance(cosine, gamma), 0.0f);
}
// The same for light from all sides.
float LeafAdmitsMean(float gamma, float gloss) {
  return max(1.0f - gloss * LeafMeanReflectance(gamma), 0.05f);
}

#endif
