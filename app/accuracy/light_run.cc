#include "app/accuracy/light_run.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string_view>
#include <utility>

#include "app/compare/ground_truth_images.h"
#include "app/compare/image_comparison.h"
#include "app/output/scratch_folder.h"
#include "app/replay/replay.h"
#include "base/atomic_file.h"
#include "files/base64.h"

namespace pleinair::app {
namespace {

constexpr int kPageWidth_px = 480;

static_assert(kPictureScoreNames.size() == accuracy::kImageMeasures.size() &&
              std::equal(kPictureScoreNames.begin(), kPictureScoreNames.end(),
                         accuracy::kImageMeasures.begin(),
                         [](std::string_view name, const accuracy::ImageMeasure& measure) {
                           return name == measure.name;
                         }));

LightPicture PictureOf(const std::string& recording, const ComparedPicture& compared) {
  LightPicture picture;
  picture.record = {.recording = recording, .picture = compared.name, .scores = {}};
  const auto values = compared.scores.Values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) picture.record.scores[i] = values[i];
  }
  picture.truth = files::Base64(compared.truth_jpeg);
  picture.composed = files::Base64(compared.picture_jpeg);
  picture.difference = files::Base64(compared.difference_jpeg);
  return picture;
}

}  // namespace

Result<std::vector<LightPicture>> MeasureLight(const std::string& recording) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<GroundTruthImage> truths,
                            FindKeyFrames(recording, false));
  std::vector<LightPicture> pictures;
  if (truths.empty()) return pictures;
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  PLEINAIR_ASSIGN_OR_RETURN(const ScratchFolder scratch, ScratchFolder::Create());
  ReplayOptions options;
  options.recording = recording;
  options.output = scratch.path() / "replay";
  options.write.frames = true;
  options.write.video = false;
  PLEINAIR_RETURN_IF_ERROR(Replay(options));
  for (const GroundTruthImage& truth : truths) {
    PLEINAIR_ASSIGN_OR_RETURN(const ComparedPicture compared,
                              ComparePicture(options.output, truth, kPageWidth_px));
    pictures.push_back(PictureOf(recording, compared));
  }
  return pictures;
}

}  // namespace pleinair::app
