#include "compositor/coverage/scene_coverage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/parallel_for.h"
#include "compositor/surfaces/sample_places.h"

namespace pleinair::compositor {
namespace {

constexpr int kRowsPerBand = 16;
/// Places of the renderer's samples (shaders/triangle_id.frag).
constexpr std::array<glm::vec2, 4> kRendererSamples{
    {{-0.125F, -0.375F}, {0.375F, -0.125F}, {-0.375F, 0.125F}, {0.125F, 0.375F}}};

TriangleAtPixel::Plane PlaneAt(const glm::dvec3& plane, const glm::dvec3& at) {
  return {static_cast<float>(glm::dot(plane, at)), static_cast<float>(plane.x),
          static_cast<float>(plane.y)};
}

/// Bits from `first` to `last`, as far as they are among the 64 of a word.
std::uint64_t BitsBetween(int first, int last) {
  const std::uint64_t from = first > 0 ? ~std::uint64_t{0} << first : ~std::uint64_t{0};
  return last < 63 ? from & ((std::uint64_t{2} << last) - 1) : from;
}

/// Planes of a common edge of two triangles are negatives: one of the two has the edge.
bool HasEdge(const TriangleAtPixel::Plane& edge) {
  return edge[1] > 0.0F || (edge[1] == 0.0F && edge[2] > 0.0F);
}

/// A triangle at the pixel with its center at `at`. Returns whether it may cover a place.
bool SetAtPixel(const ScreenTriangle& triangle, const glm::dvec3& at, TriangleAtPixel* here) {
  for (std::size_t e = 0; e < 3; ++e) {
    const TriangleAtPixel::Plane plane = PlaneAt(triangle.edges[e], at);
    const float reach = 0.5F * (std::abs(plane[1]) + std::abs(plane[2]));
    if (plane[0] < -reach) return false;
    here->is_tested[e] = !(plane[0] > reach);
    here->has_edge[e] = HasEdge(plane);
    here->edges[e] = plane;
  }
  here->nearness = PlaneAt(triangle.nearness, at);
  here->nearest = triangle.nearest;
  here->farthest = triangle.farthest;
  return true;
}

}  // namespace

SceneCoverage::SceneCoverage(int places, bool with_samples)
    : count_(static_cast<std::size_t>(places)) {
  const auto add = [&](std::span<const glm::vec2> added) {
    for (const glm::vec2 place : added) {
      x_.push_back(place.x);
      y_.push_back(place.y);
    }
    const std::size_t filled = (x_.size() + kPlaceBlock - 1) / kPlaceBlock * kPlaceBlock;
    x_.resize(filled, 0.0F);
    y_.resize(filled, 0.0F);
  };
  add(SamplePlaces(places));
  if (!with_samples) return;
  samples_at_ = x_.size();
  add(kRendererSamples);
}

void SceneCoverage::MeasureRows(const PixelView& view, int first_row, int last_row,
                                std::size_t band, std::span<PixelPieces> pieces) {
  const PixelMarks& marks = triangles_.marks();
  const int first = marks.FirstOf(0, first_row);
  const int last = last_row < view.height ? marks.FirstOf(0, last_row) : marks.Count();
  if (first == last) return;
  const std::size_t places = x_.size(), pixels = static_cast<std::size_t>(last - first);
  auto& [touching, nearness, numbers] = bands_[band];
  nearness.assign(places * pixels, 0.0F);
  numbers.assign(places * pixels, kNoTriangle);
  const auto places_of = [&](int pixel) {
    const std::size_t at = places * static_cast<std::size_t>(pixel - first);
    return PlacesOfPixel{x_, y_, std::span(bands_[band].nearness).subspan(at, places),
                         std::span(bands_[band].numbers).subspan(at, places)};
  };
  const DrawAtPlaces draw = FastestDrawAtPlaces();
  TriangleAtPixel here;
  here.limit = static_cast<float>(1.0 / view.NearM());
  for (const std::uint32_t number : touching) {
    const ScreenTriangle& triangle = triangles_.triangles()[number];
    here.number = number;
    const int low = std::max(triangle.first.y, first_row);
    const int high = std::min(triangle.last.y, last_row - 1);
    for (int y = low; y <= high; ++y) {
      for (int word = triangle.first.x / 64; word <= triangle.last.x / 64; ++word) {
        const std::uint64_t bits = marks.Word(word, y);
        std::uint64_t left =
            bits & BitsBetween(triangle.first.x - 64 * word, triangle.last.x - 64 * word);
        for (; left != 0; left &= left - 1) {
          const int bit = std::countr_zero(left), x = 64 * word + bit;
          if (!SetAtPixel(triangle, {x + 0.5, y + 0.5, 1.0}, &here)) continue;
          const std::uint64_t before = bits & ((std::uint64_t{1} << bit) - 1);
          draw(here, places_of(marks.FirstOf(word, y) + std::popcount(before)));
        }
      }
    }
  }
  PieceSorter sorter(triangles_.triangles(), view.PixelAngle());
  for (int pixel = first; pixel < last; ++pixel) {
    pieces[static_cast<std::size_t>(pixel)] = sorter.Sort(places_of(pixel), count_, samples_at_);
  }
}

void SceneCoverage::Measure(std::span<const DrawnMesh> meshes, const PixelView& view,
                            std::vector<PixelPieces>* pieces) {
  triangles_.Project(meshes, view);
  pieces->resize(static_cast<std::size_t>(marks().Count()));
  if (pieces->empty()) return;
  const auto bands = static_cast<std::size_t>((view.height + kRowsPerBand - 1) / kRowsPerBand);
  bands_.resize(bands);
  for (Band& band : bands_) band.touching.clear();
  const std::span<const ScreenTriangle> triangles = triangles_.triangles();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int band = triangles[i].first.y / kRowsPerBand; band <= triangles[i].last.y / kRowsPerBand;
         ++band) {
      bands_[static_cast<std::size_t>(band)].touching.push_back(static_cast<std::uint32_t>(i));
    }
  }
  ParallelFor(bands, 0, [&](std::size_t band) {
    const int first = static_cast<int>(band) * kRowsPerBand;
    MeasureRows(view, first, std::min(first + kRowsPerBand, view.height), band, *pieces);
  });
}

}  // namespace pleinair::compositor
