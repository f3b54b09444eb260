// Compares indirect illumination in a real scene with a path tracer, at points that a recording's
// camera sees.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "compositor/light/light_solver.h"
#include "compositor/light/ray_scene.h"
#include "compositor/models/model.h"
#include "tests/compositor/light/light_scenes.h"
#include "tests/compositor/light/path_tracer.h"
#include "tests/source_tree.h"

namespace pleinair::compositor {
namespace {

using testing::PathTracer;
using testing::Phantom;
using testing::UniformDay;

const std::string kFolder = tests::SourceTree() / "recordings/courtyard_midday/";
constexpr int kStrata = 48;  // Squared: paths per point.

/// Brighter towards the horizon and the sun.
class Day : public UniformDay {
 public:
  Day() : UniformDay({2500, 3500, 6000}, {70e3, 65e3, 55e3}, {-0.2, -0.7, 0.68}) {}
  LinearRgb SkyRadiance(Direction<World> from) const override {
    return UniformDay::SkyRadiance(from) *
           (1.5 - from.xyz.z + std::exp(8 * (Dot(from.xyz, ToSun().xyz) - 1)));
  }
};

struct Ray {
  Vec3 eye, direction;
};

/// Rays through an even grid of pixels of the recording's key frames, 36 and 72.
std::vector<Ray> LinesOfSight() {
  constexpr int kStep_px = 32;
  std::vector<Ray> rays;
  std::ifstream file(kFolder + "truth.tum");
  std::string line;
  for (int frame = -1; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    ++frame;
    if (frame != 36 && frame != 72) continue;
    // x_marker = R(q) x_camera + t.
    std::istringstream numbers(line);
    double t = 0.0, w = 0.0;
    Vec3 eye, q;
    numbers >> t >> eye.x >> eye.y >> eye.z >> q.x >> q.y >> q.z >> w;
    for (int y = kStep_px / 2; y < 480; y += kStep_px) {
      for (int x = kStep_px / 2; x < 640; x += kStep_px) {
        const Vec3 ray{(x - 319.5) / 605, (y - 239.5) / 605, 1.0};
        const Vec3 across = Cross(q, ray) * 2.0;
        rays.push_back({eye, Normalized(ray + across * w + Cross(q, across))});
      }
    }
  }
  return rays;
}

/// A point on a lit mesh.
struct Place {
  std::size_t mesh = 0;
  std::array<std::uint32_t, 3> corners{};
  std::array<double, 3> weights{};
  Point<Marker> point;
  Vec3 normal;

  LinearRgb Mean(const std::vector<std::array<float, 3>>& light) const {
    LinearRgb sum;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& l = light[corners[k]];
      sum = sum + LinearRgb{l[0], l[1], l[2]} * weights[k];
    }
    return sum;
  }
};

/// The first hits of the rays.
std::vector<Place> PlacesSeen(const std::vector<LitMesh>& meshes) {
  std::vector<RayMesh> targets;
  targets.reserve(meshes.size());
  for (const LitMesh& mesh : meshes) targets.push_back({mesh.positions, mesh.indices, true});
  const auto scene = RayScene::Create(targets, "courtyard");
  std::vector<Place> places;
  for (const Ray& ray : LinesOfSight()) {
    RayHit hit;
    if (!(*scene)->Intersect(RayTargets::kPhantoms, ray.eye, ray.direction, &hit)) continue;
    Place place{hit.mesh, {}, {1.0 - hit.u - hit.v, hit.u, hit.v}, {}, {}};
    if (hit.back) {
      // The two sides of an open surface coincide, with opposite winding.
      const bool after = hit.mesh + 1 < meshes.size() &&
                         meshes[hit.mesh + 1].positions == meshes[hit.mesh].positions;
      place.mesh = after ? hit.mesh + 1 : hit.mesh - 1;
      std::swap(place.weights[1], place.weights[2]);
    }
    const LitMesh& mesh = meshes[place.mesh];
    for (std::size_t k = 0; k < 3; ++k) {
      place.corners[k] = mesh.indices[3 * hit.triangle + k];
      const auto& n = mesh.normals[place.corners[k]];
      place.normal = place.normal + Vec3{n[0], n[1], n[2]} * place.weights[k];
    }
    place.normal = Normalized(place.normal);
    place.point = {ray.eye + ray.direction * hit.distance_m};
    places.push_back(place);
  }
  return places;
}

/// Path-traced light at the points.
std::vector<LinearRgb> Truths(const PathTracer& oracle, const std::vector<Place>& places) {
  std::vector<LinearRgb> truths(places.size());
  ParallelFor(places.size(), 0, [&](std::size_t i) {
    truths[i] = oracle.Irradiance(places[i].point, places[i].normal, kStrata,
                                  static_cast<std::uint32_t>(i));
  });
  return truths;
}

class RelativeRms {
 public:
  void Add(LinearRgb value, LinearRgb truth) {
    const LinearRgb error = value + truth * -1.0;
    errors_ += error.r * error.r + error.g * error.g + error.b * error.b;
    truths_ += truth.r * truth.r + truth.g * truth.g + truth.b * truth.b;
  }
  double value() const { return std::sqrt(errors_ / truths_); }

 private:
  double errors_ = 0.0, truths_ = 0.0;
};

TEST(PathTracer, BringsWhatClosedFormsHaveOfAnOpenPlaceAndOneBesideAWall) {
  const UniformDay overcast({1, 2, 3});
  const auto ground = testing::Ground(3.0, {0.4F, 0.4F, 0.4F});
  const LinearRgb open =
      PathTracer({ground.get()}, overcast).Irradiance({{0, 0, 0}}, {0, 0, 1}, 32, 1);
  EXPECT_NEAR(open.g, 2 * std::numbers::pi, 1e-6);
  // The point sees only an infinite wall, which sees half the sky and half the land.
  const auto wall = testing::BoxModel({1.0, -99.0, -99.0}, {1.1, 99.0, 99.0}, {0.5F, 0.5F, 0.5F});
  const LinearRgb beside =
      PathTracer({wall.get()}, overcast).Irradiance({{0, 0, 0}}, {1, 0, 0}, 64, 1);
  const double on_wall = (0.5 + 0.5 * 0.2) * 2 * std::numbers::pi;
  EXPECT_NEAR(beside.g, 0.5 * on_wall, 0.02 * on_wall);
}

TEST(CourtyardLight, AgreesWithPathsFollowedOneByOneToThreePercent) {
  const auto phantom = LoadModel(kFolder + "phantom.obj", {});
  const auto object = LoadModel(kFolder + "object.obj", {});
  ASSERT_TRUE(phantom && object);
  const auto shared_phantom = std::make_shared<const Model>(*phantom);
  const auto shared_object = std::make_shared<const Model>(*object);
  const Day day;
  // The same options as the program.
  const auto solver =
      LightSolver::Create({Phantom(shared_phantom), testing::Object(shared_object)}, {});
  ASSERT_TRUE(solver);
  const std::vector<LitMesh> traced = (*solver)->Solve(day, Mat3{});
  const std::vector<LitMesh> relit =
      (*solver)->Relight((*solver)->Coefficients({0, 0, 1}, {}, {}), day, Mat3{});
  const std::vector<Place> places = PlacesSeen(traced);
  const std::vector<LinearRgb> truths_with = Truths(PathTracer({&*phantom, &*object}, day), places);
  const std::vector<LinearRgb> truths_without = Truths(PathTracer({&*phantom}, day), places);
  RelativeRms traced_with, traced_without, relit_with, relit_without;
  int of_object = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    const LitMesh& a = traced[place.mesh];
    const LitMesh& b = relit[place.mesh];
    traced_with.Add(place.Mean(a.ambient_with), truths_with[i]);
    relit_with.Add(place.Mean(b.ambient_with), truths_with[i]);
    if (!a.is_phantom) {
      ++of_object;
      continue;
    }
    traced_without.Add(place.Mean(a.ambient_without), truths_without[i]);
    relit_without.Add(place.Mean(b.ambient_without), truths_without[i]);
  }
  ASSERT_GT(places.size(), 500U);
  EXPECT_GT(of_object, 10);
  std::printf(
      "%zu places, %d on the object: with it traced %.2f %%, by coefficients %.2f %% RMS; without "
      "it %.2f and %.2f %%\n",
      places.size(), of_object, 100 * traced_with.value(), 100 * relit_with.value(),
      100 * traced_without.value(), 100 * relit_without.value());
  EXPECT_LT(traced_with.value(), 0.03);
  EXPECT_LT(traced_without.value(), 0.03);
  EXPECT_LT(relit_with.value(), 0.03);
  EXPECT_LT(relit_without.value(), 0.03);
}

}  // namespace
}  // namespace pleinair::compositor
