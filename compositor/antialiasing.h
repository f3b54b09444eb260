#pragma once

#include <array>
#include <string_view>

namespace pleinair::compositor {

/// How a pixel that shows several surfaces gets its color. All methods average linear light.
enum class AntialiasingMethod {
  kSubpixel,     ///< As kMultisample, but pixels with edges have coverage at many places.
  kMultisample,  ///< Four samples of geometry. Each surface of a pixel is shaded once.
  kNone,         ///< The surface at the pixel's center.
  kReference,    ///< Each place of SamplePlaces() is drawn and shaded for itself.
};

inline constexpr std::array<AntialiasingMethod, 4> kAntialiasingMethods{
    AntialiasingMethod::kSubpixel, AntialiasingMethod::kMultisample, AntialiasingMethod::kNone,
    AntialiasingMethod::kReference};

/// As users name it.
constexpr std::string_view NameOf(AntialiasingMethod method) {
  if (method == AntialiasingMethod::kSubpixel) return "subpixel";
  if (method == AntialiasingMethod::kNone) return "none";
  return method == AntialiasingMethod::kReference ? "reference" : "msaa";
}

/// A method of antialiasing and what it needs to be told.
struct Antialiasing {
  AntialiasingMethod method = AntialiasingMethod::kSubpixel;
  int places = 64;  ///< Places of a pixel, for methods that HasPlaces(): 4, 8, 16, 32 or 64.

  /// Whether the number of places can be chosen.
  constexpr bool HasPlaces() const {
    return method == AntialiasingMethod::kReference || method == AntialiasingMethod::kSubpixel;
  }
  /// Whether the renderer draws several samples a pixel.
  constexpr bool HasSamples() const {
    return method == AntialiasingMethod::kMultisample || method == AntialiasingMethod::kSubpixel;
  }
  /// Places that are drawn one after another.
  constexpr int DrawnPlaces() const {
    return method == AntialiasingMethod::kReference ? places : 1;
  }
  /// Places at which the processor computes coverage; 0: it does not.
  constexpr int CoveragePlaces() const {
    return method == AntialiasingMethod::kSubpixel ? places : 0;
  }
  bool operator==(const Antialiasing&) const = default;
};

}  // namespace pleinair::compositor
