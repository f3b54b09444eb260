#version 450 core
// One level of the pyramid of minimum and maximum depth. FROM_DEPTH: each texel bounds 4×4 texels
// of the map (finer levels would cost more than they save); otherwise 2×2 of the level below.
layout(binding = 0) uniform sampler2DArray finer;  // Its base level is the level to read.
uniform int slice;
layout(location = 0) out vec2 bounds;

// `so_far` (minimum, maximum), widened by four texels.
vec2 Widened(vec2 so_far, vec4 low, vec4 high) {
  low.xy = min(low.xy, low.zw);
  high.xy = max(high.xy, high.zw);
  return vec2(min(so_far.x, min(low.x, low.y)), max(so_far.y, max(high.x, high.y)));
}

void main() {
  const vec2 kNone = vec2(1e30, -1e30);
  vec2 texels = vec2(textureSize(finer, 0).xy);
#ifdef FROM_DEPTH
  vec2 widest = kNone;
  vec2 corner = floor(gl_FragCoord.xy) * 4.0 + 1.0;
  for (int i = 0; i < 4; ++i) {
    vec4 depth =
        textureGather(finer, vec3((corner + 2.0 * vec2(i & 1, i >> 1)) / texels, float(slice)), 0);
    // Where nothing was drawn the surface is at infinity.
    depth += 1e6 * vec4(greaterThanEqual(depth, vec4(1.0)));
    widest = Widened(widest, depth, depth);
  }
  bounds = widest;
#else
  vec3 at = vec3((floor(gl_FragCoord.xy) * 2.0 + 1.0) / texels, float(slice));
  bounds = Widened(kNone, textureGather(finer, at, 0), textureGather(finer, at, 1));
#endif
}
