#include "compositor/coverage/pixel_pieces.h"

#include <algorithm>
#include <cmath>

#include "compositor/surfaces/mesh_outline.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kMaxPieces = 4;
constexpr std::uint32_t kSamplesShift = 28;  // As shaders/visibility_buffer_layout.glsl.

}  // namespace

bool PieceSorter::Piece::Has(const ScreenTriangle& triangle, float at_m) const {
  if (triangle.is_object != first->is_object || triangle.component != first->component) {
    return false;
  }
  return !triangle.is_object ||
         (glm::dot(triangle.normal, first->normal) > kAlike && std::abs(at_m - depth_m) <= reach_m);
}

PieceSorter::FoundTriangle* PieceSorter::Find(std::uint32_t number) {
  // Neighboring places mostly show the same triangle.
  if (latest_ < count_ && found_[latest_].number == number) return &found_[latest_];
  for (std::size_t i = 0; i < count_; ++i) {
    if (found_[i].number != number) continue;
    latest_ = i;
    return &found_[i];
  }
  return nullptr;
}

std::size_t PieceSorter::PieceOf(const ScreenTriangle& triangle, float nearness) {
  const float depth_m = 1.0F / nearness;
  for (std::size_t i = 0; i < piece_count_; ++i) {
    if (pieces_[i].Has(triangle, depth_m)) return i;
  }
  const auto slope =
      static_cast<float>(std::abs(triangle.nearness.x) + std::abs(triangle.nearness.y));
  pieces_[piece_count_] = {&triangle, depth_m,
                           2.0F * depth_m * (depth_m * slope + 2.0F * pixel_angle_), 0, 0};
  return piece_count_++;
}

void PieceSorter::Add(std::uint32_t number, float nearness) {
  if (number == kNoTriangle) return;
  FoundTriangle* at = Find(number);
  if (at == nullptr) {
    const ScreenTriangle& triangle = triangles_[number];
    has_holes_ = has_holes_ || triangle.has_holes;
    if (triangle.id == 0) return;  // Its light stays as it is.
    latest_ = count_;
    at = &found_[count_++];
    *at = {number, 0, PieceOf(triangle, nearness)};
  }
  ++at->places;
  ++pieces_[at->piece].places;
}

/// The triangle of a piece with the most places, the first of several.
std::uint32_t PieceSorter::RepresentativeOf(std::size_t piece) const {
  const FoundTriangle* best = nullptr;
  for (std::size_t i = 0; i < count_; ++i) {
    if (found_[i].piece != piece) continue;
    const bool is_more = best == nullptr || found_[i].places > best->places ||
                         (found_[i].places == best->places && found_[i].number < best->number);
    if (is_more) best = &found_[i];
  }
  return best == nullptr ? 0 : triangles_[best->number].id;
}

PieceSorter::Written PieceSorter::Write(bool objects, int weight) const {
  std::array<std::size_t, kWeightOfPixel> order{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < piece_count_; ++i) {
    if (pieces_[i].first->is_object != objects) continue;
    // By insertion: there are few. Equal ones stay in order.
    std::size_t at = count++;
    for (; at > 0 && pieces_[order[at - 1]].places < pieces_[i].places; --at) {
      order[at] = order[at - 1];
    }
    order[at] = i;
  }
  Written written;
  std::array<int, kMaxPieces> places{};
  std::array<std::uint32_t, kMaxPieces> samples{};
  for (std::size_t i = 0; i < count; ++i) {
    const Piece& piece = pieces_[order[i]];
    std::size_t slot = i;
    if (i >= kMaxPieces) {
      slot = 0;
      for (std::size_t k = kMaxPieces; k-- > 0;) {
        if (pieces_[order[k]].first->component == piece.first->component) slot = k;
      }
    } else {
      written.ids[i] = RepresentativeOf(order[i]);
    }
    places[slot] += piece.places;
    samples[slot] |= piece.samples;
  }
  for (std::size_t k = 0; k < std::min(count, kMaxPieces); ++k) {
    written.ids[k] |= samples[k] << kSamplesShift;
    written.weights |= static_cast<std::uint32_t>(places[k] * weight) << (8 * k);
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const ScreenTriangle& triangle = triangles_[found_[i].number];
    if (triangle.is_object != objects) continue;
    written.kind = std::min<std::uint32_t>(written.kind, triangle.kind);
  }
  return written;
}

PixelPieces PieceSorter::Sort(const PlacesOfPixel& places, std::size_t count,
                              std::size_t samples_at) {
  has_holes_ = false;
  count_ = piece_count_ = latest_ = 0;
  for (std::size_t i = 0; i < count; ++i) Add(places.triangles[i], places.nearness[i]);
  for (std::size_t i = 0; samples_at > 0 && i < 4; ++i) {
    const FoundTriangle* at = Find(places.triangles[samples_at + i]);
    if (at != nullptr) pieces_[at->piece].samples |= 1U << i;
  }
  const int weight = kWeightOfPixel / std::max(static_cast<int>(count), 1);
  const Written objects = Write(true, weight), real = Write(false, weight);
  return {objects.ids,
          real.ids,
          objects.weights,
          real.weights,
          has_holes_ ? PixelPieces::kKeepSamples : objects.kind,
          real.kind};
}

}  // namespace pleinair::compositor
