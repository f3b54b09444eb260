#include "compositor/coverage/pixel_marks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace pleinair::compositor {
namespace {

constexpr int kWordBits = 64;

/// Bits `first` to `last` of a word.
std::uint64_t BitsBetween(int first, int last) {
  return (~std::uint64_t{0} >> (kWordBits - 1 - (last - first))) << first;
}

int Clamped(double value, int low, int high) {
  return static_cast<int>(
      std::clamp(std::floor(value), static_cast<double>(low), static_cast<double>(high)));
}

}  // namespace

void PixelMarks::Reset(int width, int height) {
  width_ = width;
  height_ = height;
  words_per_row_ = (width + kWordBits - 1) / kWordBits;
  const auto words = static_cast<std::size_t>(words_per_row_) * static_cast<std::size_t>(height);
  words_.assign(words, 0);
  first_.assign(words, 0);
  has_any_.assign(static_cast<std::size_t>(height), 0);
  count_ = 0;
}

void PixelMarks::AddSpan(int y, int first, int last) {
  for (int word = first / kWordBits; word <= last / kWordBits; ++word) {
    const int begin = word * kWordBits;
    words_[At(word, y)] |=
        BitsBetween(std::max(first - begin, 0), std::min(last - begin, kWordBits - 1));
  }
  has_any_[static_cast<std::size_t>(y)] = 1;
}

void PixelMarks::AddLine(glm::dvec2 from, glm::dvec2 to) {
  if (!std::isfinite(from.x + from.y + to.x + to.y)) return;
  if (from.y > to.y) std::swap(from, to);
  if (to.y < -kMargin_px || from.y > height_ + kMargin_px) return;
  const double left = std::min(from.x, to.x) - kMargin_px;
  const double right = std::max(from.x, to.x) + kMargin_px;
  if (right < 0.0 || left >= width_) return;
  const double slope = to.y > from.y ? (to.x - from.x) / (to.y - from.y) : 0.0;
  const int first = Clamped(from.y - kMargin_px, 0, height_ - 1);
  const int last = Clamped(to.y + kMargin_px, 0, height_ - 1);
  for (int y = first; y <= last; ++y) {
    // The part of the line that is within this row.
    const double top = std::clamp(y - kMargin_px, from.y, to.y);
    const double bottom = std::clamp(y + 1 + kMargin_px, from.y, to.y);
    double begin = left, end = right;
    if (to.y > from.y) {
      const double at_top = from.x + slope * (top - from.y);
      const double at_bottom = from.x + slope * (bottom - from.y);
      begin = std::max(std::min(at_top, at_bottom) - kMargin_px, left);
      end = std::min(std::max(at_top, at_bottom) + kMargin_px, right);
    }
    if (end < 0.0 || begin >= width_) continue;
    AddSpan(y, Clamped(begin, 0, width_ - 1), Clamped(end, 0, width_ - 1));
  }
}

void PixelMarks::KeepWithin(std::span<const PixelRect> rectangles) {
  std::vector<std::uint64_t> kept(words_.size(), 0);
  for (const auto& [x, y, width, height] : rectangles) {
    const int right = std::min(x + width, width_) - 1;
    for (int row = std::max(y, 0); row < std::min(y + height, height_); ++row) {
      for (int word = std::max(x, 0) / kWordBits; word <= right / kWordBits; ++word) {
        const int begin = word * kWordBits;
        kept[At(word, row)] |=
            words_[At(word, row)] &
            BitsBetween(std::max(x - begin, 0), std::min(right - begin, kWordBits - 1));
      }
    }
  }
  words_ = std::move(kept);
}

void PixelMarks::Number() {
  std::uint32_t next = 0;
  for (int y = 0; y < height_; ++y) {
    const std::uint32_t before = next;
    for (int word = 0; word < words_per_row_; ++word) {
      first_[At(word, y)] = next;
      next += static_cast<std::uint32_t>(std::popcount(words_[At(word, y)]));
    }
    has_any_[static_cast<std::size_t>(y)] = next > before ? 1 : 0;
  }
  count_ = static_cast<int>(next);
}

bool PixelMarks::AnyIn(glm::ivec2 first, glm::ivec2 last) const {
  const int first_word = first.x / kWordBits, last_word = last.x / kWordBits;
  for (int y = first.y; y <= last.y; ++y) {
    if (has_any_[static_cast<std::size_t>(y)] == 0) continue;
    for (int word = first_word; word <= last_word; ++word) {
      const int begin = word * kWordBits;
      const std::uint64_t asked =
          BitsBetween(std::max(first.x - begin, 0), std::min(last.x - begin, kWordBits - 1));
      if ((words_[At(word, y)] & asked) != 0) return true;
    }
  }
  return false;
}

ImageTiles PixelMarks::Tiles() const {
  static_assert(ImageTiles::kSide_px == kWordBits);
  ImageTiles tiles(width_, height_);
  for (int top = 0; top < height_; top += kWordBits) {
    for (int word = 0; word < words_per_row_; ++word) {
      const glm::ivec2 last(std::min((word + 1) * kWordBits, width_) - 1,
                            std::min(top + kWordBits, height_) - 1);
      if (!AnyIn({word * kWordBits, top}, last)) continue;
      const glm::vec2 middle = 0.5F * glm::vec2(word * kWordBits + last.x, top + last.y);
      tiles.Include(middle, middle);
    }
  }
  return tiles;
}

}  // namespace pleinair::compositor
