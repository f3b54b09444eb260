#ifndef COMPOSITOR_TEXTURE_DONOR_GLSL
#define COMPOSITOR_TEXTURE_DONOR_GLSL
// Pixels whose samples have the textures of a piece of surface. A bar between all samples of its
// pixel has none there. Number 0 is the pixel itself. The others of 5 × 5 pixels follow, from near
// to far.

const int kDonors = 25;

ivec2 DonorPixel(uint donor) {
  const ivec2 kAside[kDonors] = ivec2[kDonors](
      ivec2(0, 0), ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1), ivec2(-1, -1),
      ivec2(1, 1), ivec2(-1, 1), ivec2(1, -1), ivec2(-2, 0), ivec2(2, 0), ivec2(0, -2),
      ivec2(0, 2), ivec2(-2, -1), ivec2(2, 1), ivec2(-2, 1), ivec2(2, -1), ivec2(-1, -2),
      ivec2(1, 2), ivec2(-1, 2), ivec2(1, -2), ivec2(-2, -2), ivec2(2, 2), ivec2(-2, 2),
      ivec2(2, -2));
  return ivec2(gl_FragCoord.xy) + kAside[donor];
}

#endif
