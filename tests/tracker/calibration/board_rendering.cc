#include "tests/tracker/calibration/board_rendering.h"

#include <algorithm>

#include "tracker/calibration/aruco_dictionaries.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {
namespace {

constexpr double kDegree = kRadiansPerDegree;

}  // namespace

CameraModel BoardCamera() {
  CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 585.0;
  camera.fy = 588.5;
  camera.cx = 326.3;
  camera.cy = 235.8;
  camera.distortion = {-0.13, 0.045, 0.0006, -0.0004, 0.01};
  return camera;
}

std::shared_ptr<const MarkerPattern> BoardPattern(const CalibrationBoard& board, bool legacy) {
  const bool charuco = board.kind == BoardKind::kCharuco;
  const int columns = board.columns + (charuco ? 0 : 1), rows = board.rows + (charuco ? 0 : 1);
  const int marker = charuco ? ArucoMarkerPattern(board.dictionary, 0)->modules : 0;
  // Modules are doubled, so that every board's centre lies between two of them.
  const int square = 2 * (marker + 2);
  auto print = std::make_shared<MarkerPattern>();
  print->edge_modules = square;
  print->modules = square * (std::max(columns, rows) + 1);
  print->white.assign(static_cast<std::size_t>(print->modules) * print->modules, 1);
  const int left = (print->modules - columns * square) / 2;
  const int top = (print->modules - rows * square) / 2;
  const auto at = [&](int x, int y) -> std::uint8_t& {
    return print->white[static_cast<std::size_t>(top + y) * print->modules + left + x];
  };
  int id = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const bool black = (row + column) % 2 == (legacy && rows % 2 == 0 ? 1 : 0);
      if (black) {
        for (int i = 0; i < square * square; ++i) {
          at(column * square + i % square, row * square + i / square) = 0;
        }
      } else if (charuco) {
        const MarkerPattern code = *ArucoMarkerPattern(board.dictionary, id++);
        for (int i = 0; i < 4 * marker * marker; ++i) {
          const int x = i % (2 * marker), y = i / (2 * marker);
          at(column * square + 2 + x, row * square + 2 + y) = code.white[(y / 2) * marker + x / 2];
        }
      }
    }
  }
  return print;
}

GreyImage RenderBoard(const CameraModel& camera, const CalibrationBoard& board,
                      const Transform<Camera, Marker>& camera_from_board,
                      const RenderingOptions& options, bool legacy) {
  std::vector<RenderedMarker> prints;
  if (board.kind != BoardKind::kMarkers) {
    prints.push_back({BoardPattern(board, legacy), Metres(board.square_m), camera_from_board});
    return RenderMarkers(camera, prints, options);
  }
  const std::vector<Vec2> points = BoardPoints(board);
  for (std::size_t i = 0; i < points.size(); i += 4) {
    const Vec2 middle = (points[i] + points[i + 2]) * 0.5;
    const Transform<Marker, Marker> board_from_marker{{}, {middle.x, middle.y, 0.0}};
    const int number = board.first + static_cast<int>(i / 4);
    prints.push_back({std::make_shared<const MarkerPattern>(SgMarkerPattern(number)),
                      Metres(board.square_m), camera_from_board * board_from_marker});
  }
  return RenderMarkers(camera, prints, options);
}

std::vector<Transform<Camera, Marker>> BoardPoses(const CameraModel& camera, double width_m,
                                                  double tilt_deg) {
  struct Place {
    double x, y, size, tilt, axis_deg, roll_deg;
  };
  // Fractions of the image and of the tilt; near views in the centre, farther ones at the edges.
  constexpr Place kPlaces[] = {
      {.50, .50, .80, 0.2, 0, 2},    {.50, .50, .70, 1.0, 90, -5},  {.50, .50, .70, 1.0, 0, 4},
      {.28, .30, .50, 0.8, 45, 10},  {.72, .30, .50, 0.8, 135, -9}, {.28, .70, .50, 0.8, -45, 6},
      {.72, .70, .50, 0.8, 225, -4}, {.50, .50, .45, 1.0, 60, 90},  {.26, .50, .45, 1.0, 90, 0},
      {.74, .50, .45, 1.0, -90, 3},  {.50, .27, .45, 0.9, 10, 180}, {.50, .73, .45, 0.9, 170, -3}};
  std::vector<Transform<Camera, Marker>> poses;
  for (const Place& place : kPlaces) {
    poses.push_back(PoseAtPixel(
        camera, {place.x * camera.width, place.y * camera.height}, place.size * camera.width,
        Metres(width_m), Radians(place.tilt * tilt_deg * kDegree),
        Radians(place.axis_deg * kDegree), Radians(place.roll_deg * kDegree)));
  }
  return poses;
}

}  // namespace pleinair::tracker
