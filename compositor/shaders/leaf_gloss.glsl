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

// Reflectance of the lobe under uniform light from all sides, the integral of the function above. The
// table's interpolation is at most 0.001 below it and 0.004 above it, so that no light is added. Rows:
// square root of γ, from that of 0.05 to 1 in ninths. Columns: square root of the cosine, 0 to 1 in
// 24 steps.
const int kLeafRoughnesses = 10, kLeafAngles = 25;
const float kLeafReflected[kLeafRoughnesses * kLeafAngles] = {
    0.8580, 0.8468, 0.8131, 0.7618, 0.7012, 0.6370, 0.5807, 0.5296, 0.4788,
    0.4247, 0.3684, 0.3094, 0.2545, 0.2056, 0.1624, 0.1282, 0.1011, 0.0801,
    0.0642, 0.0525, 0.0444, 0.0391, 0.0357, 0.0341, 0.0337,
    0.7550, 0.7462, 0.7190, 0.6784, 0.6259, 0.5690, 0.5109, 0.4558, 0.4054,
    0.3592, 0.3174, 0.2776, 0.2367, 0.1961, 0.1606, 0.1293, 0.1025, 0.0814,
    0.0652, 0.0533, 0.0449, 0.0394, 0.0359, 0.0342, 0.0337,
    0.6487, 0.6405, 0.6190, 0.5859, 0.5433, 0.4955, 0.4452, 0.3952, 0.3480,
    0.3049, 0.2657, 0.2304, 0.1985, 0.1700, 0.1437, 0.1203, 0.0993, 0.0812,
    0.0664, 0.0548, 0.0461, 0.0401, 0.0364, 0.0344, 0.0337,
    0.5523, 0.5453, 0.5279, 0.5007, 0.4654, 0.4254, 0.3827, 0.3401, 0.2991,
    0.2611, 0.2264, 0.1955, 0.1684, 0.1441, 0.1232, 0.1048, 0.0889, 0.0752,
    0.0636, 0.0542, 0.0466, 0.0410, 0.0371, 0.0348, 0.0337,
    0.4691, 0.4649, 0.4495, 0.4273, 0.3982, 0.3650, 0.3288, 0.2928, 0.2577,
    0.2250, 0.1949, 0.1681, 0.1445, 0.1240, 0.1062, 0.0910, 0.0781, 0.0671,
    0.0581, 0.0507, 0.0448, 0.0402, 0.0370, 0.0349, 0.0338,
    0.4014, 0.3986, 0.3855, 0.3667, 0.3426, 0.3144, 0.2845, 0.2535, 0.2236,
    0.1954, 0.1696, 0.1463, 0.1260, 0.1082, 0.0930, 0.0800, 0.0691, 0.0600,
    0.0525, 0.0464, 0.0416, 0.0379, 0.0353, 0.0335, 0.0326,
    0.3476, 0.3450, 0.3346, 0.3181, 0.2978, 0.2736, 0.2481, 0.2218, 0.1959,
    0.1716, 0.1491, 0.1289, 0.1111, 0.0957, 0.0824, 0.0712, 0.0618, 0.0540,
    0.0476, 0.0423, 0.0381, 0.0348, 0.0323, 0.0305, 0.0294,
    0.3054, 0.3030, 0.2948, 0.2803, 0.2624, 0.2415, 0.2191, 0.1962, 0.1735,
    0.1521, 0.1324, 0.1146, 0.0989, 0.0853, 0.0737, 0.0639, 0.0557, 0.0488,
    0.0432, 0.0384, 0.0344, 0.0311, 0.0286, 0.0265, 0.0249,
    0.2727, 0.2704, 0.2640, 0.2504, 0.2342, 0.2158, 0.1956, 0.1753, 0.1551,
    0.1360, 0.1183, 0.1025, 0.0885, 0.0765, 0.0662, 0.0575, 0.0503, 0.0442,
    0.0390, 0.0346, 0.0306, 0.0273, 0.0245, 0.0221, 0.0201,
    0.2471, 0.2451, 0.2397, 0.2267, 0.2120, 0.1951, 0.1768, 0.1581, 0.1399,
    0.1225, 0.1065, 0.0922, 0.0797, 0.0689, 0.0597, 0.0519, 0.0453, 0.0398,
    0.0350, 0.0307, 0.0268, 0.0234, 0.0205, 0.0180, 0.0159};
// The same for light from all sides: means over the hemisphere, weighted by the cosine.
const float kLeafReflectedMean[kLeafRoughnesses] = {0.0828, 0.0797, 0.0747, 0.0689, 0.0629,
                                                    0.0570, 0.0512, 0.0456, 0.0403, 0.0354};

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
