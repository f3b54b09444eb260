#version 450 core
// A surface of the scene, in marker coordinates (metres).

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec2 in_uv;

uniform mat4 u_clip_from_marker;
// Movement of a model since its light was baked.
uniform mat4 u_marker_from_lit = mat4(1.0);

#ifdef DETAILED
layout(location = 2) in vec2 in_second_uv;
layout(location = 3) in vec4 in_color;
out vec2 v_second_uv;
out vec4 v_color;
#endif

out vec3 v_position_m;
out vec2 v_uv;

void main() {
  vec4 position = u_marker_from_lit * vec4(in_position, 1.0);
  v_position_m = position.xyz;
  v_uv = in_uv;
#ifdef DETAILED
  v_second_uv = in_second_uv;
  v_color = in_color;
#endif
  gl_Position = u_clip_from_marker * position;
}
