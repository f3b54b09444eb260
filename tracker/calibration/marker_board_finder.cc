#include <numeric>

#include "tracker/calibration/board_finders.h"
#include "tracker/refinement/marker_alignment.h"
#include "tracker/surf_golay/sg_marker_pattern.h"
#include "tracker/tracker.h"

namespace pleinair::tracker {
namespace {

class MarkerBoardFinder final : public BoardFinder {
 public:
  explicit MarkerBoardFinder(const CalibrationBoard& board) : board_(board) {}

  std::optional<BoardView> Find(ImageView<const std::uint8_t> grey) override {
    if (grey.width() != camera_.width || grey.height() != camera_.height) LookThrough(grey);
    const auto observations = tracker_->Track(grey);
    if (!observations) return std::nullopt;
    BoardView view;
    for (const MarkerObservation& observation : *observations) {
      if (!observation.detection.id) continue;
      const int which = *observation.detection.id - board_.first;
      if (!view.points.empty() && view.points.back() / 4 == which) continue;  // Detected twice.
      for (int i = 0; i < 4; ++i) {
        view.points.push_back(4 * which + i);
        view.observed_px.push_back(observation.detection.corners_px[static_cast<std::size_t>(i)]);
      }
    }
    if (view.points.size() < kMinPoints) return std::nullopt;
    return view;
  }

  // A corner is the intersection of two sides, and the lens bends the sides.
  void Refine(const CameraModel& camera, ImageView<const std::uint8_t> grey,
              BoardView* view) override {
    BoardView refined;
    refined.name = view->name;
    for (std::size_t first = 0; first + 3 < view->points.size(); first += 4) {
      std::array<Vec2, 4> corners;
      std::copy_n(view->observed_px.begin() + static_cast<std::ptrdiff_t>(first), 4,
                  corners.begin());
      const int which = view->points[first] / 4;
      const auto aligned =
          AlignMarker(camera, SgMarkerPattern(board_.first + which), grey, corners);
      if (!aligned) continue;
      for (int i = 0; i < 4; ++i) {
        refined.points.push_back(4 * which + i);
        refined.observed_px.push_back(aligned->corners_px[static_cast<std::size_t>(i)]);
      }
    }
    if (refined.points.size() >= kMinPoints) *view = std::move(refined);
  }
  bool refines() const override { return true; }

  const CalibrationBoard& board() const override { return board_; }

 private:
  /// The tracker needs a lens; any ordinary one suffices to find the markers.
  void LookThrough(ImageView<const std::uint8_t> grey) {
    camera_.width = grey.width();
    camera_.height = grey.height();
    camera_.fx = camera_.fy = 0.9 * grey.width();
    camera_.cx = 0.5 * (grey.width() - 1);
    camera_.cy = 0.5 * (grey.height() - 1);
    TrackerOptions options;
    options.families = {"sg"};
    options.marker_size_m = board_.square_m;
    options.sg.numbers_in_use.resize(static_cast<std::size_t>(board_.columns * board_.rows));
    std::iota(options.sg.numbers_in_use.begin(), options.sg.numbers_in_use.end(), board_.first);
    options.sg.strategy = SgStrategy::kFast;  // A board has many markers: the completely visible
                                              // ones suffice.
    tracker_ = *Tracker::Create(camera_, options);
  }

  const CalibrationBoard board_;
  CameraModel camera_;
  std::unique_ptr<Tracker> tracker_;
};

}  // namespace

std::unique_ptr<BoardFinder> CreateMarkerBoardFinder(const CalibrationBoard& board) {
  return std::make_unique<MarkerBoardFinder>(board);
}

}  // namespace pleinair::tracker
