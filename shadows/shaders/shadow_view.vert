#version 450 core
// Surfaces of a scene, for measuring and inspecting its shadows.
layout(location = 0) in vec3 position;
uniform mat4 clip_from_marker;
out vec3 v_position;
invariant gl_Position;

void main() {
  v_position = position;
  gl_Position = clip_from_marker * vec4(position, 1.0);
}
