#ifndef COMPOSITOR_DIFFERENTIAL_GLSL
#define COMPOSITOR_DIFFERENTIAL_GLSL
// Differential rendering (Debevec 1998, "Rendering Synthetic Objects into Real Scenes", §6), as a
// ratio so that the real surface's texture is kept. The ratio is the light on a real surface with
// the virtual objects over the light without them, per channel.
//
// ambient_*: sky and indirect light. sun: the unshadowed sun's light on the surface, including its
// cosine, same unit. visibility_phantoms: sun visibility past the real surfaces (already in the
// image). visibility_all: sun visibility past real and virtual surfaces. A virtual object cannot
// let more sun through, hence the min(): a real shadow is never darkened twice nor lightened.
vec3 DifferentialRatio(vec3 ambient_with, vec3 ambient_without, vec3 sun, float visibility_all,
                       float visibility_phantoms) {
  float visibility = min(visibility_all, visibility_phantoms);
  vec3 light_with = ambient_with + visibility * sun;
  vec3 light_without = ambient_without + visibility_phantoms * sun;
  return light_with / max(light_without, vec3(1e-6));
}

#endif
