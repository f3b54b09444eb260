#version 450 core
// A lit surface of the scene, in marker coordinates (metres).

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec2 in_uv;
layout(location = 3) in vec3 in_ambient_with;     // Sky and bounced light with the objects, lux.
layout(location = 4) in vec3 in_ambient_without;  // The same with the phantoms alone.

uniform mat4 u_clip_from_marker;
// Where a model was moved to since its light was made. Angles stay, so that normals turn with it.
uniform mat4 u_marker_from_lit = mat4(1.0);

out vec3 v_position_m;
out vec3 v_normal;
out vec2 v_uv;
// At a silhouette a sample may be covered where the pixel's middle is not; light is not extrapolated
// to there, where it could be anything, less than nothing included.
centroid out vec3 v_ambient_with;
centroid out vec3 v_ambient_without;

void main() {
  vec4 position = u_marker_from_lit * vec4(in_position, 1.0);
  v_position_m = position.xyz;
  v_normal = mat3(u_marker_from_lit) * in_normal;
  v_uv = in_uv;
  v_ambient_with = in_ambient_with;
  v_ambient_without = in_ambient_without;
  gl_Position = u_clip_from_marker * position;
}
