#pragma once

// Internal: between the .cc files of this module; not installed.

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

/// Finds pictures used as targets, each of which hangs in one place: in consecutive frames a target
/// is looked for where it should be by now; targets that are missing are searched by their
/// keypoints, at once when they have just gone and then every few frames. A candidate's id is the
/// target's place in the list.
class PictureDetector final : public MarkerDetector {
 public:
  PictureDetector(const CameraModel& camera,
                  std::vector<std::shared_ptr<const PictureTarget>> targets,
                  bool consecutive_frames);

  std::vector<Candidate> Detect(ImageView<const std::uint8_t> grey) override;
  std::vector<LostMarker> Lost() const override;
  std::vector<std::string> Warnings() const override { return warnings_; }

 private:
  /// What is known of a target.
  struct Known {
    bool found = false;  ///< In this frame.
    bool ever_found = false;
    int frames_unseen = 0;
    std::array<Vec2, 4> corners_undistorted;  ///< In the last frame that saw it,
    std::array<Vec2, 4> velocity;             ///< … and their motion, per frame.
    bool has_velocity = false;
    double blur_px = 0.7;
  };

  void Track(std::size_t target, std::vector<Candidate>* candidates);
  void Search(std::vector<Candidate>* candidates);
  void SearchMirrored();
  /// What the tracker wants to know of a reading; nothing where no camera sees the target so.
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
