#version 450 core
// A lit surface of the scene, in marker coordinates (metres).

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec2 in_uv;
layout(location = 3) in vec3 in_ambient_with;     // Sky and bounced light with the objects, lux.
layout(location = 4) in vec3 in_ambient_without;  // The same with the phantoms alone.

uniform mat4 u_clip_from_marker;

out vec3 v_position_m;
out vec3 v_normal;
out vec2 v_uv;
// At a silhouette a sample may be covered where the pixel's middle is not; light is not extrapolated
// to there, where it could be anything, less than nothing included.
centroid out vec3 v_ambient_with;
centroid out vec3 v_ambient_without;

void main() {
  v_position_m = in_position;
  v_normal = in_normal;
  v_uv = in_uv;
  v_ambient_with = in_ambient_with;
  v_ambient_without = in_ambient_without;
  gl_Position = u_clip_from_marker * vec4(in_position, 1.0);
}
