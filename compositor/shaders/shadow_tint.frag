#version 450 core
// The partitions' tints in the camera image, to be multiplied into it.
layout(binding = 0) uniform sampler2D u_tints;  // Render image.
layout(binding = 1) uniform sampler2D u_positions;  // RenderPositions(), texels.
layout(location = 0) out vec4 out_tint;

void main() {
  vec2 at = texelFetch(u_positions, ivec2(gl_FragCoord.xy), 0).xy / vec2(textureSize(u_tints, 0));
  out_tint = vec4(texture(u_tints, at).rgb, 1.0);
}
