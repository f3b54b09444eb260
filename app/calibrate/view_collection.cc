#include "app/calibrate/view_collection.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <utility>

#include "app/terminal/interrupt.h"
#include "app/terminal/progress_bar.h"
#include "tracker/calibration/view_coverage.h"
#include "tracker/calibration/view_picker.h"

namespace pleinair::app {
namespace {

using Clock = std::chrono::steady_clock;

Result<void> CheckSize(const NamedPicture& picture, const std::string& first_name,
                       Collection* collection) {
  const int width = picture.grey.width(), height = picture.grey.height();
  if (collection->looked_at == 0) {
    collection->width = width;
    collection->height = height;
    return {};
  }
  if (width == collection->width && height == collection->height) return {};
  return InputError(picture.name,
                    fmt::format("has {}x{} pixels, and {} has {}x{}", width, height, first_name,
                                collection->width, collection->height),
                    "a calibration is for one size: give images of one camera at one size");
}

/// Reports the missing coverage after each view of a camera.
void ReportProgress(const Collection& collection, const tracker::ViewCoverage& coverage) {
  std::string bare;
  constexpr const char* kHalves[] = {"left", "right", "top", "bottom"};
  const auto halves = coverage.Halves();
  for (std::size_t i = 0; i < halves.size(); ++i) {
    if (halves[i] < 0.6)
      bare += (bare.empty() ? "; not yet covered: " : ", ") + std::string(kHalves[i]);
  }
  std::cerr << fmt::format("view {}: {:.0f} % of the image covered{}\n", collection.views.size(),
                           100.0 * coverage.Share(), bare);
}

tl::unexpected<Error> NothingFound(const Collection& collection, tracker::BoardFinder& finder,
                                   const std::string& first_name, const GreyImage& first) {
  const std::string hint = first.empty() ? "" : finder.Hint(first.view());
  return InputError(first_name,
                    fmt::format("no {} is seen in {}", finder.board().Description(),
                                collection.looked_at == 1
                                    ? "this image"
                                    : fmt::format("any of {} images", collection.looked_at)),
                    hint.empty()
                        ? "check its type and its counts, and that it is wholly visible and sharp"
                        : hint);
}

}  // namespace

Result<Collection> CollectViews(PictureStream& pictures, tracker::BoardFinder& finder,
                                const CollectionOptions& options) {
  Collection collection;
  std::optional<tracker::ViewPicker> picker;
  tracker::ViewCoverage coverage;
  std::string first_name;
  GreyImage first;
  const auto start = Clock::now();
  ProgressBar bar("Finding the board", pictures.Count(), "images");
  const auto maximum = static_cast<std::size_t>(options.max_views);
  while (collection.views.size() < maximum || !pictures.is_film()) {
    if (pictures.is_live() && options.seconds &&
        std::chrono::duration<double>(Clock::now() - start).count() > *options.seconds) {
      break;
    }
    if (InterruptGuard::Interrupted() && !pictures.is_live()) {
      return SystemError("", "interrupted", "");
    }
    PLEINAIR_ASSIGN_OR_RETURN(std::optional<NamedPicture> picture, pictures.Next());
    if (!picture) break;
    PLEINAIR_RETURN_IF_ERROR(CheckSize(*picture, first_name, &collection));
    ++collection.looked_at;
    bar.Advance();
    auto view = finder.Find(picture->grey.view());
    if (collection.looked_at == 1) {
      first_name = picture->name;
      first = picture->grey;
      picker.emplace(BoardPoints(finder.board()), collection.width);
    }
    if (!view) {
      picker->Miss();
      continue;
    }
    if (pictures.is_film() && !picker->Take(*view)) continue;
    view->name = picture->name;
    coverage.Add(view->observed_px, collection.width, collection.height);
    collection.views.push_back({*std::move(view), std::move(picture->grey)});
    if (pictures.is_live() && !options.quiet) ReportProgress(collection, coverage);
  }
  if (collection.looked_at == 0) {
    return InputError("", "no image arrived", "check that the camera sends images");
  }
  if (collection.views.empty()) return NothingFound(collection, finder, first_name, first);
  return collection;
}

}  // namespace pleinair::app
