#include "app/bench/defocus_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>

namespace pleinair::app {
namespace {

using compositor::Mesh;
using compositor::Model;

constexpr std::array<std::string_view, 5> kDefocusNames{"boards", "edges", "fence", "stack", "far"};
constexpr std::array<std::string_view, 5> kMotionNames{"pan", "shake", "walk", "dolly", "both"};
constexpr double kFocus_dioptres = 0.25, kCirclePerDioptre_px = 30.0;

std::vector<BenchBoard> BoardsOf(std::string_view name, double w, double h) {
  if (name == "edges") {
    return {{0.20 * w, 0.20 * h, 0.50 * w, 0.80 * h, -8.0, 0.9F},
            {0.25 * w, 0.30 * h, 0.50 * w + 3.0, 0.70 * h, 5.0, 0.5F}};
  }
  if (name == "fence") {
    std::vector<BenchBoard> boards;
    constexpr double kStep_px = 20.0, kWidth_px = 6.0;
    const int bars = static_cast<int>(0.73 * w / kStep_px);
    boards.reserve(static_cast<std::size_t>(bars) + 1);
    for (int i = 0; i < bars; ++i) {
      const double left = 0.12 * w + kStep_px * i;
      boards.push_back({left, 0.05 * h, left + kWidth_px, 0.95 * h, -12.0, 0.15F});
    }
    boards.push_back({0.2 * w, 0.2 * h, 0.8 * w, 0.8 * h, 0.0, 0.9F});
    return boards;
  }
  if (name == "stack") {
    std::vector<BenchBoard> boards;
    constexpr int kCount = 8;
    boards.reserve(kCount);
    for (int i = 0; i < kCount; ++i) {
      const double share = i / (kCount - 1.0), light = 0.25 + 0.6 * (i * 3 % kCount) / kCount;
      boards.push_back({(0.08 + 0.45 * share) * w, (0.12 + 0.3 * share) * h,
                        (0.45 + 0.45 * share) * w, (0.55 + 0.3 * share) * h, -10.0 + 16.0 * share,
                        static_cast<float>(light)});
    }
    return boards;
  }
  if (name == "far") {
    std::vector<BenchBoard> boards;
    constexpr int kCount = 5;
    boards.reserve(kCount);
    for (int i = 0; i < kCount; ++i) {
      const double share = i / (kCount - 1.0);
      boards.push_back({(0.15 + 0.13 * i) * w, (0.1 + 0.1 * share) * h, (0.24 + 0.13 * i) * w,
                        0.9 * h, 1.0 + 5.0 * share, static_cast<float>(0.9 - 0.15 * i)});
    }
    return boards;
  }
  return {{0.15 * w, 0.40 * h, 0.55 * w, 0.75 * h, -8.0, 0.8F},
          {0.30 * w, 0.15 * h, 0.62 * w, 0.62 * h, -3.5, 0.3F},
          {0.20 * w, 0.10 * h, 0.85 * w, 0.90 * h, 0.0, 0.6F}};
}

/// In the marker's plane: x to the right, y up, looking along −z.
compositor::PlacedModel Placed(const BenchBoard& board, const CameraModel& camera) {
  const double z = board.distance_m;
  // Pixel centres are whole numbers, so that a board from 10 to 12 covers pixels 10 and 11.
  const auto x_m = [&](double x) {
    return static_cast<float>((x - 0.5 - camera.cx) / camera.fx * z);
  };
  const auto y_m = [&](double y) {
    return static_cast<float>(-(y - 0.5 - camera.cy) / camera.fy * z);
  };
  const auto height = static_cast<float>(-z);
  Mesh mesh;
  for (const auto& [x, y] : {std::pair{board.left, board.bottom},
                             {board.right, board.bottom},
                             {board.right, board.top},
                             {board.left, board.top}}) {
    mesh.positions.push_back({x_m(x), y_m(y), height});
    mesh.normals.push_back({0, 0, 1});
    mesh.uvs.push_back({0, 0});
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(i);
  auto model = std::make_shared<Model>();
  compositor::Material material;
  material.base_color = {board.light, board.light, board.light};
  material.detail.unlit = true;
  model->materials.push_back(std::move(material));
  model->meshes.push_back(std::move(mesh));
  return {std::move(model), Mat3{}, {}, false};
}

/// How a camera's coordinates change within an exposure, by its share −½…½.
compositor::CameraMotion MotionOf(std::string_view name, const CameraModel& camera,
                                  const Transform<Camera, Marker>& middle) {
  struct Speeds {
    double yaw_px = 0.0, bend_px = 0.0, roll_rad = 0.0, right_px_m = 0.0, forward_m = 0.0;
  };
  Speeds speeds;
  if (name == "pan") speeds.yaw_px = 12.0;
  if (name == "shake") speeds = {8.0, 12.0, 0.04, 0.0, 0.0};
  if (name == "walk" || name == "both") speeds.right_px_m = 24.0;
  if (name == "dolly") speeds.forward_m = 0.2;
  return [speeds, fx = camera.fx, middle](double share) {
    const double yaw = share * speeds.yaw_px / fx, pitch = share * share * speeds.bend_px / fx;
    const double roll = share * speeds.roll_rad;
    const Mat3 turned_yaw{
        {std::cos(yaw), 0, std::sin(yaw), 0, 1, 0, -std::sin(yaw), 0, std::cos(yaw)}};
    const Mat3 turned_pitch{
        {1, 0, 0, 0, std::cos(pitch), -std::sin(pitch), 0, std::sin(pitch), std::cos(pitch)}};
    const Mat3 turned_roll{
        {std::cos(roll), -std::sin(roll), 0, std::sin(roll), std::cos(roll), 0, 0, 0, 1}};
    const Transform<Camera, Camera> moved{
        turned_roll * turned_pitch * turned_yaw,
        {share * speeds.right_px_m / fx, 0.0, -share * speeds.forward_m}};
    return moved * middle;
  };
}

}  // namespace

std::span<const std::string_view> MotionSceneNames() { return kMotionNames; }

std::span<const std::string_view> DefocusSceneNames() { return kDefocusNames; }

DefocusScene MakeDefocusScene(std::string_view name, const CameraModel& camera) {
  DefocusScene scene;
  scene.name = name;
  scene.boards = BoardsOf(name, camera.width, camera.height);
  scene.lens = {kCirclePerDioptre_px / camera.fx, kFocus_dioptres};
  scene.camera_from_marker = {Mat3{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 0}};
  for (BenchBoard& board : scene.boards) {
    board.distance_m = 1.0 / (kFocus_dioptres - board.circle_px / kCirclePerDioptre_px);
  }
  if (std::ranges::find(kMotionNames, name) != kMotionNames.end()) {
    scene.motion = MotionOf(name, camera, scene.camera_from_marker);
    if (name != "both") {
      scene.lens.aperture_m = 0.0;
      for (BenchBoard& board : scene.boards) board.circle_px = 0.0;
    }
  }
  std::transform(scene.boards.begin(), scene.boards.end(), std::back_inserter(scene.models),
                 [&](const BenchBoard& board) { return Placed(board, camera); });
  return scene;
}

}  // namespace pleinair::app
