#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "tracker/calibration/board_finders.h"
#include "tracker/calibration/corner_refinement.h"

namespace pleinair::tracker {
namespace {

/// The search needs no more pixels than this along a side; the measurement uses all.
constexpr int kSearchSide_px = 1600;

class ChessboardFinder final : public BoardFinder {
 public:
  explicit ChessboardFinder(const CalibrationBoard& board) : board_(board) {}

  std::optional<BoardView> Find(ImageView<const std::uint8_t> grey) override {
    const cv::Mat image(grey.height(), grey.width(), CV_8UC1,
                        const_cast<std::uint8_t*>(grey.data()),
                        static_cast<std::size_t>(grey.stride()));
    std::vector<cv::Point2f> corners = Search(image, {board_.columns, board_.rows});
    if (corners.empty()) return std::nullopt;
    RefineCorners(image, HalfWindows(corners), &corners);
    BoardView view;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!std::isfinite(corners[i].x)) continue;
      view.points.push_back(static_cast<int>(i));
      view.observed_px.push_back({corners[i].x, corners[i].y});
    }
    if (view.points.size() < kMinPoints) return std::nullopt;
    return view;
  }

  const CalibrationBoard& board() const override { return board_; }

  // Manufacturers count squares, OpenCV inner corners.
  std::string Hint(ImageView<const std::uint8_t> grey) override {
    const cv::Mat image(grey.height(), grey.width(), CV_8UC1,
                        const_cast<std::uint8_t*>(grey.data()),
                        static_cast<std::size_t>(grey.stride()));
    for (const int step : {-1, 1}) {
      const cv::Size other(board_.columns + step, board_.rows + step);
      if (other.width < 3 || other.height < 3 || Search(image, other).empty()) continue;
      const std::string sides = std::to_string(other.width) + "x" + std::to_string(other.height);
      return "a board with " + sides + " inner corners is in the images: --chessboard " + sides;
    }
    return "";
  }

 private:
  /// Corners row by row, accurate to about a pixel; empty if the board is not completely visible.
  static std::vector<cv::Point2f> Search(const cv::Mat& image, cv::Size sides) {
    const double scale =
        std::min(1.0, kSearchSide_px / static_cast<double>(std::max(image.cols, image.rows)));
    cv::Mat small = image;
    if (scale < 1.0) cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
    std::vector<cv::Point2f> corners;
    const bool found =
        cv::findChessboardCornersSB(small, sides, corners, cv::CALIB_CB_NORMALIZE_IMAGE) ||
        cv::findChessboardCorners(
            small, sides, corners,
            cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK);
    if (!found) return {};
    // Pixel centres are integers at both sizes.
    const auto back = static_cast<float>(1.0 / scale);
    for (cv::Point2f& corner : corners) {
      corner.x = (corner.x + 0.5F) * back - 0.5F;
      corner.y = (corner.y + 0.5F) * back - 0.5F;
    }
    return corners;
  }

  /// A third of the distance to the nearest neighbour, so that windows contain no other corner.
  std::vector<float> HalfWindows(const std::vector<cv::Point2f>& corners) const {
    std::vector<float> halves;
    for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
      float nearest = 1e9F;
      const auto look = [&](int neighbour) {
        const cv::Point2f apart = corners[i] - corners[neighbour];
        nearest = std::min(nearest, std::hypot(apart.x, apart.y));
      };
      const int column = i % board_.columns, row = i / board_.columns;
      if (column > 0) look(i - 1);
      if (column + 1 < board_.columns) look(i + 1);
      if (row > 0) look(i - board_.columns);
      if (row + 1 < board_.rows) look(i + board_.columns);
      halves.push_back(nearest / 3.0F);
    }
    return halves;
  }

  const CalibrationBoard board_;
};

}  // namespace

std::unique_ptr<BoardFinder> CreateChessboardFinder(const CalibrationBoard& board) {
  return std::make_unique<ChessboardFinder>(board);
}

}  // namespace pleinair::tracker
