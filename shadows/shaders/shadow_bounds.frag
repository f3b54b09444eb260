#version 450 core
// One level of the pyramid of nearest and farthest depth: each texel bounds 2×2 of the level below.
layout(binding = 0) uniform sampler2DArray finer;  // Its base level is the level to read.
uniform int slice;
layout(location = 0) out vec2 bounds;

vec2 Fetch(ivec2 texel) {
  vec2 value = texelFetch(finer, ivec3(texel, slice), 0).rg;
#ifdef FROM_DEPTH
  // Where nothing was drawn the ground is for ever away.
  value = vec2(value.r < 1.0 ? value.r : 1e6);
#endif
  return value;
}

void main() {
  ivec2 corner = ivec2(gl_FragCoord.xy) * 2;
  vec2 a = Fetch(corner), b = Fetch(corner + ivec2(1, 0));
  vec2 c = Fetch(corner + ivec2(0, 1)), d = Fetch(corner + ivec2(1, 1));
  bounds = vec2(min(min(a.x, b.x), min(c.x, d.x)), max(max(a.y, b.y), max(c.y, d.y)));
}
