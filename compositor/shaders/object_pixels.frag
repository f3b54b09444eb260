#version 450 core
// Classifies a pixel of the virtual objects. Output: one triangle per visible piece of surface,
// with the samples that show this piece. A piece belongs to one component. Its normals differ by no
// more than kAlike, and its points lie within the pixel's reach. A round body's far side, seen past
// the edge of its near side, is another piece. The depth gives the passes that shade the sun
// visibility class (KindOf).

#include "compositor/shaders/piece_weights.glsl"
#include "compositor/shaders/visible_surface.glsl"
#include "compositor/shaders/material_table.glsl"

layout(binding = 0) uniform usampler2DMS u_ids;
uniform int u_samples;  // Per pixel, 4 at most.

layout(location = 0) out uvec4 out_visible;  // First to last: VisibleTriangle.
layout(location = 1) out uvec2 out_weights;  // As piece_weights.glsl; all textures are here.

const float kAlike = 0.9;  // Cosine.

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  // Remaining numbers; 0: no object, or done.
  uvec4 left = uvec4(0u);
  for (int i = 0; i < u_samples; ++i) left[i] = texelFetch(u_ids, pixel, i).r;
  left *= uvec4(greaterThan(left, uvec4(kObjectBit)));
  uvec4 seen = uvec4(0u), components = uvec4(~0u);
  vec3 normals[4] = vec3[4](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  vec3 positions_m[4] = normals;
  uint kind = kNothing;
  int found = 0;
  // Tested at its end, see shadow_visibility.glsl.
  do {
    uint id = left.x != 0u ? left.x : left.y != 0u ? left.y : left.z != 0u ? left.z : left.w;
    uvec4 samples = uvec4(equal(left, uvec4(id)));
    left *= 1u - samples;
    bool shown = id != 0u;
    id &= ~kObjectBit;
    uvec4 triangle = TriangleOf(id);
    uint component = ComponentOf(triangle);
    MaterialRecord record = RecordOf(int(ValueOfComponent(int(component))));
    VisibleSurface here =
        VisibleSurfaceOf(Moved(VertexOf(triangle.x), record), Moved(VertexOf(triangle.y), record),
                    Moved(VertexOf(triangle.z), record), gl_FragCoord.xy);
    float reach_m = 2.0 * (length(here.step_x) + length(here.step_y));
    bool known = false;
    for (int k = 0; k < 4; ++k) {
      bool same = shown && !known && components[k] == component &&
                  dot(normals[k], here.flat_normal) > kAlike &&
                  distance(positions_m[k], here.position_m) < reach_m;
      seen[k] += same ? VisibleTriangle(0u, samples) : 0u;
      known = known || same;
    }
    for (int k = 0; k < 4; ++k) {
      bool first = shown && !known && found == k;
      seen[k] += first ? VisibleTriangle(id, samples) : 0u;
      components[k] = first ? component : components[k];
      normals[k] = first ? here.flat_normal : normals[k];
      positions_m[k] = first ? here.position_m : positions_m[k];
    }
    found += known ? 0 : 1;
    kind = shown ? min(kind, KindOf(triangle)) : kind;
  } while (left != uvec4(0u));
  out_visible = seen;
  out_weights = uvec2(WeightsOfSamples(seen, u_samples), 0u);
  gl_FragDepth = DepthOfKind(kind);
}
