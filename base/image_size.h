#pragma once

namespace pleinair {

/// Size of an image in pixels.
struct ImageSize {
  int width = 0;
  int height = 0;
  bool operator==(const ImageSize&) const = default;
};

}  // namespace pleinair
