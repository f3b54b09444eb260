#include "compositor/light/light_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "base/parallel_for.h"
#include "compositor/light/edge_splitting.h"
#include "compositor/light/gather_origin.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

using Float3 = std::array<float, 3>;

// Rays per point. All points use the same directions about their normals, so that most of the noise
// cancels in differences. The coarse estimate selects edges.
constexpr std::uint32_t kRays = 48, kCoarseRays = 16;
// Fine edges are this share of the diagonal of an object's bounding box: 5 mm for 30 cm.
constexpr double kFineShare = 1.0 / 64.0;
// Shortest edge that is split, in fine edges.
constexpr double kMinSplit = 0.3;
// Deviation of the middle's openness at which a fine edge is split: about 2.5 in CIEDE2000.
constexpr double kMaxDeviation = 0.08;
// Coarse difference of the ends at which the middle of an edge is estimated: of edges that are
// shorter than fine ones, and of others. Edges that are longer by the last factor may hide a
// feature between their ends and are always estimated.
constexpr double kMaxShortDifference = 0.25, kMaxDifference = 0.12, kLong = 3.0;
// Deviation that counts where only some points lie inside a body: the others fill in their light.
constexpr double kBuriedDeviation = 0.3;
constexpr double kBuriedShare = 0.25;  // As in buried_patches.cc.
// Light that surfaces reflect, relative to a uniform surrounding.
constexpr double kReflected = 0.3;
constexpr int kMaxPasses = 8;
constexpr std::size_t kMaxNewVertices = 20'000;

double Length(const Float3& a, const Float3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

struct Openness {
  float value = 0.0F;
  bool buried = false;
};

/// Openness on both sides of a surface; the back of closed bodies is unused.
using BothSides = std::array<Openness, 2>;

/// Estimates the openness of points.
class Prober {
 public:
  Prober(const RayScene& rays, const std::vector<SurfaceOfRays>& surfaces_of_rays)
      : rays_(rays), surfaces_of_rays_(surfaces_of_rays) {}

  BothSides Probe(const SurfacePoint& point, Vec3 centre, bool closed, std::uint32_t rays) const {
    BothSides sides;
    sides[0] = ProbeSide(point, centre, rays);
    if (!closed) sides[1] = ProbeSide(point.OtherSide(), centre, rays);
    return sides;
  }

 private:
  Openness ProbeSide(const SurfacePoint& point, Vec3 centre, std::uint32_t rays) const {
    const Vec3 origin = GatherOrigin(point, centre);
    const TangentFrame frame(Normalized(point.normal));
    double sum = 0.0;
    std::uint32_t inside = 0;
    for (std::uint32_t i = 0; i < rays; ++i) {
      const Vec3 direction = CosineDirection(frame, ShiftedHammersley(i, rays, 0));
      RayHit hit;
      if (!rays_.Intersect(RayTargets::kEverything, origin, direction, &hit)) {
        sum += 1.0;
      } else if (hit.back && surfaces_of_rays_[hit.mesh].closed) {
        ++inside;
      } else {
        sum += kReflected;
      }
    }
    const std::uint32_t outside = rays - inside;
    return {static_cast<float>(outside > 0 ? sum / outside : 0.0), inside > kBuriedShare * rays};
  }

  const RayScene& rays_;
  const std::vector<SurfaceOfRays>& surfaces_of_rays_;
};

/// Deviation of the middle from the mean of the ends.
double Deviation(const BothSides& a, const BothSides& b, const BothSides& middle) {
  double deviation = 0.0;
  for (const int side : {0, 1}) {
    if (a[side].buried != b[side].buried || a[side].buried != middle[side].buried) {
      deviation = std::max(deviation, kBuriedDeviation);
    } else if (!middle[side].buried) {
      deviation = std::max<double>(
          deviation, std::fabs(middle[side].value - 0.5F * (a[side].value + b[side].value)));
    }
  }
  return deviation;
}

double Difference(const BothSides& a, const BothSides& b) {
  double difference = 0.0;
  for (const int side : {0, 1}) {
    difference = std::max<double>(difference, a[side].buried != b[side].buried
                                                  ? 1.0
                                                  : std::fabs(a[side].value - b[side].value));
  }
  return difference;
}

/// Numbers places, so that edges are the same for all surfaces.
class Places {
 public:
  std::uint32_t Number(Float3 place) {
    for (float& value : place) value += 0.0F;  // −0 becomes 0.
    return numbers_.try_emplace(place, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }

 private:
  struct BytesHash {
    std::size_t operator()(const Float3& place) const {
      return std::hash<std::string_view>{}(
          {reinterpret_cast<const char*>(place.data()), sizeof(Float3)});
    }
  };
  std::unordered_map<Float3, std::uint32_t, BytesHash> numbers_;
};

std::uint64_t EdgeKey(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

/// One surface of an object while it is refined.
class Refined {
 public:
  Refined(SurfaceMesh* mesh, double fine_m, Places* places)
      : mesh_(mesh), fine_m_(fine_m), places_(places) {
    AddPlaces();
  }

  std::size_t size() const { return mesh_->positions.size(); }

  /// Finds edges to split and adds them to `split`, which holds pairs of places.
  void FindSplits(const Prober& prober, int threads, std::unordered_set<std::uint64_t>* split) {
    std::vector<Edge> edges = LongEdges();
    if (edges.empty()) return;
    const std::vector<Vec3> centres = CentresAround(*mesh_);
    ProbeEnds(prober, edges, centres, threads);
    for (const Edge& edge : edges) settled_.insert(PlacesOf(edge));
    std::erase_if(edges, [&](const Edge& edge) { return !IsDoubtful(edge); });
    ProbeEndsFinely(prober, edges, centres, threads);
    std::vector<std::uint8_t> splits(edges.size());
    ForEach(edges.size(), threads, [&](std::size_t i) { splits[i] = IsSplit(prober, edges[i]); });
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (splits[i] != 0) split->insert(PlacesOf(edges[i]));
    }
  }

  void Split(const std::unordered_set<std::uint64_t>& split) {
    SplitEdges(mesh_, [&](std::uint32_t a, std::uint32_t b) {
      return split.contains(EdgeKey(place_of_[a], place_of_[b]));
    });
    AddPlaces();
  }

 private:
  template <typename Visit>
  static void ForEach(std::size_t count, int threads, const Visit& visit) {
    constexpr std::size_t kBlock = 32;
    ParallelFor((count + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
      const std::size_t last = std::min(count, (block + 1) * kBlock);
      for (std::size_t i = block * kBlock; i < last; ++i) visit(i);
    });
  }

  struct Edge {
    std::uint32_t a = 0, b = 0;
    Vec3 centre;  ///< Sum of the centres of its triangles.
    int triangles = 0;
  };

  void AddPlaces() {
    for (std::size_t v = place_of_.size(); v < size(); ++v) {
      place_of_.push_back(places_->Number(mesh_->positions[v]));
    }
  }

  /// The edges that are long enough and new.
  std::vector<Edge> LongEdges() const {
    std::vector<Edge> edges;
    std::unordered_map<std::uint64_t, std::size_t> found;
    const auto& indices = mesh_->indices;
    for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
      Vec3 centre;
      for (int c = 0; c < 3; ++c) {
        centre = centre + SurfacePointAt(*mesh_, indices[t + c]).position * (1.0 / 3.0);
      }
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t a = indices[t + c], b = indices[t + (c + 1) % 3];
        if (Length(mesh_->positions[a], mesh_->positions[b]) < kMinSplit * fine_m_) continue;
        if (settled_.contains(EdgeKey(place_of_[a], place_of_[b]))) continue;
        const auto [at, is_new] = found.try_emplace(EdgeKey(a, b), edges.size());
        if (is_new) edges.push_back({std::min(a, b), std::max(a, b), {}, 0});
        Edge& edge = edges[at->second];
        edge.centre = edge.centre + centre;
        ++edge.triangles;
      }
    }
    return edges;
  }

  /// Corners of flat triangles at one place share an estimate where their normals are alike.
  std::uint64_t AlikeKey(std::uint32_t v) const {
    constexpr float kStep = 0.25F;
    std::uint64_t key = place_of_[v];
    for (const float n : mesh_->normals[v]) {
      key = key << 4 | static_cast<std::uint64_t>(std::lround(n / kStep) + 8);
    }
    return key;
  }

  /// Coarse estimates of the edges' ends.
  void ProbeEnds(const Prober& prober, const std::vector<Edge>& edges,
                 const std::vector<Vec3>& centres, int threads) {
    probe_of_.resize(size(), kNone);
    std::vector<std::uint32_t> wanted;
    const std::size_t first = probes_.size();
    for (const Edge& edge : edges) {
      for (const std::uint32_t v : {edge.a, edge.b}) {
        if (probe_of_[v] != kNone) continue;
        const auto [at, is_new] =
            alike_.try_emplace(AlikeKey(v), static_cast<std::uint32_t>(first + wanted.size()));
        probe_of_[v] = at->second;
        if (is_new) wanted.push_back(v);
      }
    }
    probes_.resize(first + wanted.size());
    ForEach(wanted.size(), threads, [&](std::size_t i) {
      probes_[first + i] = ProbeVertex(prober, wanted[i], centres, kCoarseRays);
    });
  }

  BothSides ProbeVertex(const Prober& prober, std::uint32_t v, const std::vector<Vec3>& centres,
                        std::uint32_t rays) const {
    return prober.Probe(SurfacePointAt(*mesh_, v), centres[v], mesh_->closed, rays);
  }

  std::uint64_t PlacesOf(const Edge& edge) const {
    return EdgeKey(place_of_[edge.a], place_of_[edge.b]);
  }

  /// Length in fine edges.
  double LengthOf(const Edge& edge) const {
    return Length(mesh_->positions[edge.a], mesh_->positions[edge.b]) / fine_m_;
  }

  /// Returns whether the light may change along the edge, by the coarse estimates.
  bool IsDoubtful(const Edge& edge) const {
    const double length = LengthOf(edge);
    return length > kLong || Difference(probes_[probe_of_[edge.a]], probes_[probe_of_[edge.b]]) >
                                 (length < 1.0 ? kMaxShortDifference : kMaxDifference);
  }

  void ProbeEndsFinely(const Prober& prober, const std::vector<Edge>& edges,
                       const std::vector<Vec3>& centres, int threads) {
    fine_probes_.resize(size());
    is_fine_.resize(size());
    std::vector<std::uint32_t> wanted;
    for (const Edge& edge : edges) {
      for (const std::uint32_t v : {edge.a, edge.b}) {
        if (is_fine_[v] != 0) continue;
        is_fine_[v] = 1;
        wanted.push_back(v);
      }
    }
    ForEach(wanted.size(), threads, [&](std::size_t i) {
      fine_probes_[wanted[i]] = ProbeVertex(prober, wanted[i], centres, kRays);
    });
  }

  bool IsSplit(const Prober& prober, const Edge& edge) const {
    const BothSides middle =
        prober.Probe(EdgeMiddle(*mesh_, edge.a, edge.b), edge.centre * (1.0 / edge.triangles),
                     mesh_->closed, kRays);
    return Deviation(fine_probes_[edge.a], fine_probes_[edge.b], middle) >
           kMaxDeviation / std::clamp(LengthOf(edge), 0.25, 2.0);
  }

  static constexpr std::uint32_t kNone = ~0U;

  SurfaceMesh* mesh_;
  double fine_m_;
  Places* places_;
  std::vector<std::uint32_t> place_of_;                     ///< By vertex.
  std::vector<BothSides> probes_;                           ///< Coarse.
  std::vector<std::uint32_t> probe_of_;                     ///< By vertex; kNone: not estimated.
  std::unordered_map<std::uint64_t, std::uint32_t> alike_;  ///< Indices of `probes_`.
  std::vector<BothSides> fine_probes_;                      ///< By vertex.
  std::vector<std::uint8_t> is_fine_;                       ///< Whether it has one.
  std::unordered_set<std::uint64_t> settled_;               ///< Pairs of places, estimated before.
};

/// Returns whether any edge may be split. Most fine meshes have none.
bool HasLongEdge(const SurfaceMesh& mesh, double fine_m) {
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::uint32_t next = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
    if (Length(mesh.positions[mesh.indices[i]], mesh.positions[next]) >= kMinSplit * fine_m) {
      return true;
    }
  }
  return false;
}

/// Diagonals of the bounding boxes of the virtual objects.
std::map<int, double> ObjectDiagonals(const std::vector<SurfaceMesh>& surfaces) {
  std::map<int, std::array<Float3, 2>> boxes;
  for (const SurfaceMesh& surface : surfaces) {
    if (surface.is_phantom) continue;
    for (const Float3& position : surface.positions) {
      auto& [low, high] =
          boxes.try_emplace(surface.placed_model, std::array{position, position}).first->second;
      for (int c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], position[c]);
        high[c] = std::max(high[c], position[c]);
      }
    }
  }
  std::map<int, double> diagonals;
  for (const auto& [model, box] : boxes) diagonals[model] = Length(box[0], box[1]);
  return diagonals;
}

}  // namespace

std::vector<LightPlaces> RefineForLight(const RayScene& rays,
                                        const std::vector<SurfaceOfRays>& surfaces_of_rays,
                                        double max_edge_m, int threads,
                                        std::vector<SurfaceMesh>* surfaces) {
  const std::map<int, double> diagonals = ObjectDiagonals(*surfaces);
  Places places;
  std::vector<LightPlaces> light_places(surfaces->size());
  std::vector<Refined> refined;
  std::size_t before = 0;
  for (std::size_t i = 0; i < surfaces->size(); ++i) {
    SurfaceMesh& surface = (*surfaces)[i];
    if (surface.is_phantom || surface.role != MeshRole::kAll) continue;
    const double fine_m = std::min(max_edge_m, kFineShare * diagonals.at(surface.placed_model));
    light_places[i] = {fine_m, surface.positions.size()};
    if (!HasLongEdge(surface, fine_m)) continue;
    refined.emplace_back(&surface, fine_m, &places);
    before += surface.positions.size();
  }
  const Prober prober(rays, surfaces_of_rays);
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    std::unordered_set<std::uint64_t> split;
    for (Refined& surface : refined) surface.FindSplits(prober, threads, &split);
    if (split.empty()) break;
    std::size_t now = 0;
    for (const Refined& surface : refined) now += surface.size();
    if (now + split.size() > before + kMaxNewVertices) break;
    for (Refined& surface : refined) surface.Split(split);
  }
  return light_places;
}

}  // namespace pleinair::compositor
