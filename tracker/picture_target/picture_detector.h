#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/marker_detector.h"
#include "tracker/picture_target/picture_pyramid.h"
#include "tracker/picture_target/picture_target.h"
#include "tracker/picture_target/target_reader.h"
#include "tracker/picture_target/target_search.h"

namespace pleinair::tracker {

/// Detects image targets, each of which exists once in the scene. In consecutive frames it predicts
/// and tracks known targets. Missing targets are searched by their keypoints: at once when they
/// were just lost, then every few frames. A candidate's id is the target's index in the list.
class PictureDetector final : public MarkerDetector {
 public:
  PictureDetector(const CameraModel& camera,
                  std::vector<std::shared_ptr<const PictureTarget>> targets,
                  bool consecutive_frames);

  std::vector<Candidate> Detect(ImageView<const std::uint8_t> grey) override;
  std::vector<LostMarker> Lost() const override;
  std::vector<std::string> Warnings() const override { return warnings_; }

 private:
  /// State of one target.
  struct Known {
    bool found = false;  ///< In the present frame.
    bool ever_found = false;
    int frames_unseen = 0;
    std::array<Vec2, 4> corners_undistorted;  ///< In the last frame with the target,
    std::array<Vec2, 4> velocity;             ///< … and their velocity, per frame.
    bool has_velocity = false;
    double blur_px = 0.7;
  };

  void Track(std::size_t target, std::vector<Candidate>* candidates);
  void Search(std::vector<Candidate>* candidates);
  void SearchMirrored();
  /// Converts a reading to a candidate; nullopt if no pose fits it.
  std::optional<Candidate> CandidateOf(std::size_t target, const TargetReading& reading) const;
  void Remember(std::size_t target, const TargetReading& reading);
  bool SearchIsDue() const;

  const LensGrid lens_;
  const std::vector<std::shared_ptr<const PictureTarget>> targets_;
  const bool consecutive_frames_;
  std::vector<PicturePyramid> pyramids_;
  TargetReader reader_;
  TargetSearch search_;
  std::vector<Known> known_;
  std::vector<bool> wanted_;
  std::vector<TargetGuess> guesses_;
  std::vector<std::string> warnings_;
  int frame_ = 0;
};

}  // namespace pleinair::tracker
