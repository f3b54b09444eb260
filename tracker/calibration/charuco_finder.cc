#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

#include "tracker/calibration/aruco_dictionaries.h"
#include "tracker/calibration/board_finders.h"
#include "tracker/calibration/corner_refinement.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

/// A square of the board, from the top-left.
struct Square {
  int column = 0, row = 0;
};

/// Squares with markers, in the order of the markers' numbers. Boards with an even number of rows
/// begin with a black square since OpenCV 4.6, and with a white one in older versions ("legacy").
std::vector<Square> MarkerSquares(const CalibrationBoard& board, bool legacy) {
  const int black = legacy && board.rows % 2 == 0 ? 1 : 0;
  std::vector<Square> squares;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      if ((row + column) % 2 != black) squares.push_back({column, row});
    }
  }
  return squares;
}

struct SeenMarker {
  Mat3 px_from_marker;  ///< Its black square has corners (±1, ±1), y up.
  double min_side_length_px = 0.0;
};
using SeenMarkers = std::map<int, SeenMarker>;

class CharucoFinder final : public BoardFinder {
 public:
  explicit CharucoFinder(const CalibrationBoard& board) : board_(board) {}

  std::optional<BoardView> Find(ImageView<const std::uint8_t> grey) override {
    const cv::Mat image(grey.height(), grey.width(), CV_8UC1,
                        const_cast<std::uint8_t*>(grey.data()),
                        static_cast<std::size_t>(grey.stride()));
    const SeenMarkers markers = DetectMarkers(image);
    if (markers.size() < 2) return std::nullopt;
    // In only one of the two layouts the neighbours are where they should be.
    Layout layout = Judge(markers, false);
    if (board_.rows % 2 == 0) {
      const Layout legacy = Judge(markers, true);
      if (legacy.agreeing > layout.agreeing) layout = legacy;
    }
    if (layout.agreeing == 0) return std::nullopt;
    return Corners(image, markers, layout);
  }

  const CalibrationBoard& board() const override { return board_; }

 private:
  /// Arrangement of the markers on the board.
  struct Layout {
    std::vector<Square> squares;
    int agreeing = 0;                ///< Pairs of neighbours in the expected position.
    double square_per_marker = 0.0;  ///< Side of a square over the side of its marker.
  };

  SeenMarkers DetectMarkers(const cv::Mat& image) {
    if (!board_.dictionary.empty()) return Detect(image, board_.dictionary);
    // The dictionary with the most detected numbers of the board; kept once it is certain.
    SeenMarkers best;
    std::string name;
    const int count = board_.columns * board_.rows / 2;
    for (const std::string& each : DictionariesFor(count)) {
      SeenMarkers markers = Detect(image, each);
      if (markers.size() <= best.size()) continue;
      best = std::move(markers);
      name = each;
    }
    if (best.size() >= std::min<std::size_t>(6, static_cast<std::size_t>(count))) {
      board_.dictionary = name;
    }
    return best;
  }

  SeenMarkers Detect(const cv::Mat& image, const std::string& dictionary) const {
    const auto number = FindDictionary(dictionary);
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    const auto parameters = cv::aruco::DetectorParameters::create();
    // Markers on boards are small, and photographs large.
    parameters->minMarkerPerimeterRate = 0.01;
    parameters->adaptiveThreshWinSizeMax = 53;
    cv::aruco::detectMarkers(image, cv::aruco::getPredefinedDictionary(*number), corners, ids,
                             parameters);
    SeenMarkers markers;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (ids[i] < 0 || ids[i] >= board_.columns * board_.rows / 2) continue;
      std::array<Vec2, 4> quad;
      SeenMarker marker;
      marker.min_side_length_px = 1e9;
      for (std::size_t k = 0; k < 4; ++k) quad[k] = {corners[i][k].x, corners[i][k].y};
      for (std::size_t k = 0; k < 4; ++k) {
        marker.min_side_length_px =
            std::min(marker.min_side_length_px, Norm(quad[(k + 1) % 4] - quad[k]));
      }
      marker.px_from_marker = HomographyToQuad(quad);
      markers[ids[i]] = marker;
    }
    return markers;
  }

  /// Each marker searches for its diagonal neighbours. In its own coordinates their centres are
  /// equally far in x and y, by the same number of its sides for all.
  Layout Judge(const SeenMarkers& markers, bool legacy) const {
    Layout layout;
    layout.squares = MarkerSquares(board_, legacy);
    std::vector<double> ratios;
    for (const auto& [id, marker] : markers) {
      const Square here = layout.squares[static_cast<std::size_t>(id)];
      const Mat3 marker_from_px = Adjugate(marker.px_from_marker);
      for (const auto& [other_id, other] : markers) {
        const Square there = layout.squares[static_cast<std::size_t>(other_id)];
        const int right = there.column - here.column, down = there.row - here.row;
        if (std::abs(right) != 1 || std::abs(down) != 1) continue;
        const Vec2 middle = Apply(marker_from_px, Apply(other.px_from_marker, {0.0, 0.0}));
        // Corners are ±1: one side is 2.
        const double x = 0.5 * middle.x * right, y = -0.5 * middle.y * down;
        constexpr double kMin = 1.0, kMax = 2.5;  // Range of that ratio.
        if (x < kMin || x > kMax || y < kMin || y > kMax || std::fabs(x - y) > 0.3) continue;
        ratios.push_back(0.5 * (x + y));
      }
    }
    layout.agreeing = static_cast<int>(ratios.size());
    if (ratios.empty()) return layout;
    std::nth_element(ratios.begin(),
                     ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    layout.square_per_marker = ratios[ratios.size() / 2];
    return layout;
  }

  /// Inner corners next to the detected markers; each touches two markers, or one at the edge.
  std::optional<BoardView> Corners(const cv::Mat& image, const SeenMarkers& markers,
                                   const Layout& layout) const {
    struct Guess {
      Vec2 sum;
      int count = 0;
      double window_px = 1e9;
    };
    std::map<int, Guess> guesses;
    for (const auto& [id, marker] : markers) {
      const Square square = layout.squares[static_cast<std::size_t>(id)];
      for (const Vec2 towards : kSquareCorners) {
        // The corner between this square and the next in that direction, counted from 0.
        const int column = square.column - (towards.x < 0.0 ? 1 : 0);
        const int row = square.row - (towards.y > 0.0 ? 1 : 0);
        if (column < 0 || row < 0 || column >= board_.columns - 1 || row >= board_.rows - 1) {
          continue;
        }
        Guess& guess = guesses[row * (board_.columns - 1) + column];
        guess.sum = guess.sum + Apply(marker.px_from_marker, towards * layout.square_per_marker);
        ++guess.count;
        // Up to the marker's own corner, or a third of a square if that is far.
        const double side = marker.min_side_length_px;
        const double margin = 0.5 * (layout.square_per_marker - 1.0) * side;
        guess.window_px = std::min({guess.window_px, 0.9 * margin, side / 3.0});
      }
    }
    std::vector<int> numbers;
    std::vector<cv::Point2f> corners;
    std::vector<float> windows;
    for (const auto& [number, guess] : guesses) {
      const Vec2 at = guess.sum * (1.0 / guess.count);
      numbers.push_back(number);
      corners.emplace_back(static_cast<float>(at.x), static_cast<float>(at.y));
      windows.push_back(static_cast<float>(guess.window_px));
    }
    RefineCorners(image, windows, &corners);
    BoardView view;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!std::isfinite(corners[i].x)) continue;
      view.points.push_back(numbers[i]);
      view.observed_px.push_back({corners[i].x, corners[i].y});
    }
    if (view.points.size() < kMinPoints) return std::nullopt;
    return view;
  }

  CalibrationBoard board_;
};

}  // namespace

std::unique_ptr<BoardFinder> CreateCharucoFinder(const CalibrationBoard& board) {
  return std::make_unique<CharucoFinder>(board);
}

}  // namespace pleinair::tracker
