#include "base/frames.h"

#include <cmath>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

namespace pleinair {
namespace {

template <typename A, typename B, typename = void>
constexpr bool kComposes = false;
template <typename A, typename B>
constexpr bool kComposes<A, B, std::void_t<decltype(std::declval<A>() * std::declval<B>())>> = true;

// A quarter turn about z, then a step.
template <typename To, typename From>
Transform<To, From> QuarterTurn(Vec3 step_m) {
  return {{{0, -1, 0, 1, 0, 0, 0, 0, 1}}, step_m};
}

TEST(Transform, ComposesOnlyWhereTheInnerFramesMatch) {
  EXPECT_TRUE((kComposes<Transform<Camera, Marker>, Transform<Marker, World>>));
  EXPECT_TRUE((kComposes<Transform<Camera, Marker>, Point<Marker>>));
  EXPECT_TRUE((kComposes<Transform<Camera, Marker>, Direction<Marker>>));
  EXPECT_FALSE((kComposes<Transform<Camera, Marker>, Transform<World, Marker>>));
  EXPECT_FALSE((kComposes<Transform<Camera, Marker>, Transform<Camera, Marker>>));
  EXPECT_FALSE((kComposes<Transform<Camera, Marker>, Point<Camera>>));
  EXPECT_FALSE((kComposes<Transform<Camera, Marker>, Direction<World>>));
}

TEST(Transform, MovesPointsButOnlyTurnsDirections) {
  const auto camera_from_marker = QuarterTurn<Camera, Marker>({10, 20, 30});
  EXPECT_EQ((camera_from_marker * Point<Marker>{{1, 2, 3}}).xyz, (Vec3{8, 21, 33}));
  EXPECT_EQ((camera_from_marker * Direction<Marker>{{1, 2, 3}}).xyz, (Vec3{-2, 1, 3}));
}

TEST(Transform, CompositionActsAsOneAfterTheOther) {
  const auto camera_from_marker = QuarterTurn<Camera, Marker>({1, 2, 3});
  const Transform<Marker, World> marker_from_world{{{1, 0, 0, 0, 0, -1, 0, 1, 0}}, {4, 5, 6}};
  const Point<World> point{{7, 8, 9}};
  EXPECT_EQ(((camera_from_marker * marker_from_world) * point).xyz,
            (camera_from_marker * (marker_from_world * point)).xyz);
}

TEST(Transform, InverseUndoesIt) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Transform<Camera, Marker> camera_from_marker{{{c, 0, s, 0, 1, 0, -s, 0, c}}, {1, -2, 3}};
  const Transform<Marker, Camera> marker_from_camera = camera_from_marker.Inverse();
  const Point<Marker> back = marker_from_camera * (camera_from_marker * Point<Marker>{{5, 6, 7}});
  EXPECT_NEAR(back.xyz.x, 5, 1e-14);
  EXPECT_NEAR(back.xyz.y, 6, 1e-14);
  EXPECT_NEAR(back.xyz.z, 7, 1e-14);
}

}  // namespace
}  // namespace pleinair
