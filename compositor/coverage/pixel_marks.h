#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "compositor/surfaces/image_tiles.h"

namespace pleinair::compositor {

/// A set of pixels of an image, one bit each; 64 pixels of a row a word, the lowest bit leftmost.
class PixelMarks {
 public:
  /// Removes all pixels and sets the image's size.
  void Reset(int width, int height);

  /// Adds the pixels that a line touches, and those within kMargin_px of it. Pixels' centers are at
  /// .5. Ends may lie outside of the image. Adds none if a coordinate is not a number.
  void AddLine(glm::dvec2 from, glm::dvec2 to);
  /// Removes the pixels outside of the tiles with `rectangles`.
  void KeepWithin(std::span<const PixelRect> rectangles);
  /// Numbers the pixels row by row, from 0 on.
  void Number();

  /// Returns whether a pixel of the rectangle belongs to the set. Both ends are included and must
  /// lie in the image.
  bool AnyIn(glm::ivec2 first, glm::ivec2 last) const;
  /// The bits of a word of a row.
  std::uint64_t Word(int word, int y) const { return words_[At(word, y)]; }
  /// After Number(): number of the first pixel of a word, and of all pixels.
  int FirstOf(int word, int y) const { return static_cast<int>(first_[At(word, y)]); }
  int Count() const { return count_; }
  int words_per_row() const { return words_per_row_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// All tiles with pixels of the set.
  ImageTiles Tiles() const;

  /// The renderer rounds corners to 1/256 pixel.
  static constexpr double kMargin_px = 1.0 / 64;

 private:
  std::size_t At(int word, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(words_per_row_) +
           static_cast<std::size_t>(word);
  }
  void AddSpan(int y, int first, int last);

  int width_ = 0, height_ = 0, words_per_row_ = 0, count_ = 0;
  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> first_;   // One a word.
  std::vector<std::uint8_t> has_any_;  // One a row.
};

}  // namespace pleinair::compositor
