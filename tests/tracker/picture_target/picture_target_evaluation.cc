// Prints the tables of docs/measurements/picture-targets.md. `picture_target_evaluation
// PHOTOGRAPH...` makes a target of each photograph (at most 800 px) and renders it under known
// poses. It then searches for every target in parts of all the other photographs.
// `picture_target_evaluation` alone prints the times on drawn images.
#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/tracker/picture_target/picture_target_scenes.h"
#include "tracker/picture_target/target_making.h"
#include "tracker/picture_target/target_quality.h"
#include "tracker/picture_target/target_search.h"

namespace pleinair::tracker {
namespace {

constexpr int kRendered = 12;  ///< Photographs that are rendered, of those that rate well,
constexpr int kGood = 60;      ///< … which is from this score on.
constexpr int kFramesOfView = 4, kPartsOfPhotograph = 10;
constexpr int kWidth = 640, kHeight = 480;

CameraModel Camera() {
  return {.width = kWidth,
          .height = kHeight,
          .fx = 600,
          .fy = 600,
          .cx = 319.5,
          .cy = 239.5,
          .distortion = {-0.1, 0.03, 0, 0, 0, 0, 0, 0}};
}

double Now_ms() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

GreyImage Grey(const cv::Mat& from) {
  GreyImage grey(from.cols, from.rows);
  for (int y = 0; y < from.rows; ++y) std::copy_n(from.ptr(y), from.cols, &grey(0, y));
  return grey;
}

/// Minimum over several runs, in milliseconds of this thread.
template <typename Run>
double MinTime_ms(int runs, Run run) {
  double least = 1e9;
  for (int i = 0; i < runs; ++i) {
    const double start = Now_ms();
    run();
    least = std::min(least, Now_ms() - start);
  }
  return least;
}

struct Photograph {
  std::string file;
  cv::Mat picture;
  std::shared_ptr<const PictureTarget> target;  ///< Null if the photograph makes no target.
  int score = 0;
};

struct View {
  const char* name;
  double side_px = 220.0, tilt_deg = 20.0, blur_px = 0.5, noise_codes = 1.0, covered = 0.0;
  bool hard_light = false;
};

constexpr View kViews[] = {{.name = "450 px", .side_px = 450},
                           {.name = "220 px"},
                           {.name = "100 px", .side_px = 100},
                           {.name = "60 px", .side_px = 60},
                           {.name = "40 px", .side_px = 40},
                           {.name = "tilted 45°", .tilt_deg = 45},
                           {.name = "tilted 60°", .tilt_deg = 60},
                           {.name = "tilted 70°", .tilt_deg = 70},
                           {.name = "40 % covered", .covered = 0.4},
                           {.name = "60 % covered", .covered = 0.6},
                           {.name = "75 % covered", .covered = 0.75},
                           {.name = "light 12:1, shadow 4:1", .hard_light = true},
                           {.name = "blur 2 px", .blur_px = 2.0},
                           {.name = "noise of 8 codes", .noise_codes = 8.0}};

/// Times of every step that can be separated from outside.
void PrintTimes() {
  constexpr int kRuns = 15, kMakings = 3;
  std::vector<std::shared_ptr<const PictureTarget>> targets;
  const TestPicture picture = DeadLeaves(1, 640, 480);
  std::printf("| step | ms |\n| --- | --- |\n");
  const GreyImage codes = picture.Codes();
  std::printf("| making a target | %.0f |\n", MinTime_ms(kMakings, [&] {
                targets.push_back(std::make_shared<const PictureTarget>(
                    *MakePictureTarget(codes.view(), Metres(0.4), "leaves")));
              }));
  targets.resize(1);
  for (std::uint32_t seed = 2; seed <= 10; ++seed) {
    const GreyImage other = DeadLeaves(seed, 640, 480).Codes();
    targets.push_back(std::make_shared<const PictureTarget>(
        *MakePictureTarget(other.view(), Metres(0.4), "leaves")));
  }
  const GreyImage clutter = DeadLeaves(99, kWidth, kHeight).Codes();
  const LensGrid lens(Camera());
  for (const int count : {1, 10}) {
    TargetSearch search(lens, {targets.begin(), targets.begin() + count});
    const std::vector<bool> wanted(static_cast<std::size_t>(count), true);
    std::vector<TargetGuess> guesses;
    std::printf("| searching a cluttered frame for %d | %.1f |\n", count,
                MinTime_ms(kRuns, [&] { search.Find(clutter.view(), wanted, &guesses); }));
  }
  for (const double side_px : {100.0, 330.0}) {
    const HungPicture hung = HangAt(Camera(), picture, {320, 240}, side_px, 20.0, 30.0, 40.0);
    const GreyImage frame = RenderPictures(Camera(), {hung}, {.blur_px = 0.5, .noise_codes = 1.0});
    for (const bool follows : {false, true}) {
      auto tracker = *Tracker::Create(
          Camera(), {.families = {}, .consecutive_frames = follows, .targets = {targets.front()}});
      (void)tracker->Track(frame.view());
      std::printf("| %s one of %.0f px | %.1f |\n", follows ? "following" : "finding", side_px,
                  MinTime_ms(kRuns, [&] { (void)tracker->Track(frame.view()); }));
    }
  }
}

class Evaluation {
 public:
  void Load(const std::string& file) {
    Photograph photograph{file, cv::imread(file, cv::IMREAD_GRAYSCALE), nullptr, 0};
    if (photograph.picture.empty()) return;
    const double scale =
        std::min(1.0, 800.0 / std::max(photograph.picture.cols, photograph.picture.rows));
    cv::Mat small;
    cv::resize(photograph.picture, small, {}, scale, scale, cv::INTER_AREA);
    auto target = MakePictureTarget(Grey(small).view(), Metres(0.4), "photograph");
    if (target) {
      photograph.score = RateTarget(*target).score;
      photograph.target = std::make_shared<const PictureTarget>(*std::move(target));
      small.copyTo(photograph.picture);
    }
    photographs_.push_back(std::move(photograph));
  }

  void Render() const {
    std::printf("| view | found | corner RMS px | worst | position, share of distance | ms |\n");
    for (const View& view : kViews) {
      int shown = 0, found = 0, pictures = 0;
      double squares = 0.0, worst = 0.0, position = 0.0, ms = 0.0;
      for (const Photograph& photograph : photographs_) {
        if (photograph.score < kGood || ++pictures > kRendered) continue;
        const TestPicture picture = TestPicture::FromCodes(Grey(photograph.picture).view());
        auto tracker = *Tracker::Create(Camera(), {.families = {}, .targets = {photograph.target}});
        for (unsigned seed = 1; seed <= kFramesOfView; ++seed) {
          const auto [hung, frame] = Frame(picture, view, seed);
          const double start = Now_ms();
          const auto observations = tracker->Track(frame.view());
          ms += Now_ms() - start;
          ++shown;
          if (!observations || observations->size() != 1) continue;
          const auto truth = TrueCorners(Camera(), hung);
          double square = 0.0;
          for (int i = 0; i < 4; ++i) {
            const double off_px = Norm((*observations)[0].detection.corners_px[i] - truth[i]);
            square += 0.25 * off_px * off_px;
          }
          ++found;
          squares += square;
          worst = std::max(worst, std::sqrt(square));
          const Vec3 at = hung.camera_from_marker.translation_m;
          position +=
              Norm((*observations)[0].pose.best.camera_from_marker.translation_m - at) / Norm(at);
        }
      }
      std::printf("| %s | %d of %d | %.3f | %.2f | %.5f | %.1f |\n", view.name, found, shown,
                  std::sqrt(squares / std::max(1, found)), worst, position / std::max(1, found),
                  ms / std::max(1, shown));
      std::fflush(stdout);
    }
  }

  void LookElsewhere() const {
    std::vector<std::shared_ptr<const PictureTarget>> targets;
    std::vector<std::size_t> source;
    for (std::size_t i = 0; i < photographs_.size(); ++i) {
      if (photographs_[i].target == nullptr) continue;
      targets.push_back(photographs_[i].target);
      source.push_back(i);
    }
    CameraModel camera = Camera();
    camera.distortion = {};
    auto tracker = *Tracker::Create(camera, {.families = {}, .targets = targets});
    int frames = 0, falsely = 0, mirrored = 0;
    for (std::size_t i = 0; i < photographs_.size(); ++i) {
      for (int part = 0; part < kPartsOfPhotograph; ++part, ++frames) {
        const auto observations = tracker->Track(
            Part(photographs_[i].picture, 100 * static_cast<unsigned>(i) + part).view());
        for (const MarkerObservation& observation : *observations) {
          if (source[*observation.detection.id] == i) continue;
          ++falsely;
          std::printf("%s in %s, part %d: %.0f %% visible\n",
                      photographs_[source[*observation.detection.id]].file.c_str(),
                      photographs_[i].file.c_str(), part,
                      100.0 * observation.detection.visible_fraction);
        }
        mirrored += static_cast<int>(tracker->Warnings().size());
      }
    }
    std::printf(
        "%d frames of %zu photographs, %zu targets looked for in each: %d false, %d said to "
        "be mirrored\n",
        frames, photographs_.size(), targets.size(), falsely, mirrored);
  }

 private:
  static std::pair<HungPicture, GreyImage> Frame(const TestPicture& picture, const View& view,
                                                 unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return random() / 4294967296.0; };
    HungPicture hung =
        HangAt(Camera(), picture, {320 + 60 * (uniform() - 0.5), 240 + 40 * (uniform() - 0.5)},
               view.side_px, view.tilt_deg, 360 * uniform(), 360 * uniform());
    const double side = uniform();
    if (view.covered > 0.0) {
      hung.cover = [=](Vec2 at) {
        const double from_side = side < 0.25   ? at.x
                                 : side < 0.5  ? 1.0 - at.x
                                 : side < 0.75 ? at.y
                                               : 1.0 - at.y;
        return from_side < view.covered ? 0.2 + 0.15 * std::sin(31 * at.x) * std::sin(23 * at.y)
                                        : -1.0;
      };
    }
    RenderingOptions options{
        .blur_px = view.blur_px, .noise_codes = view.noise_codes, .seed = seed};
    if (view.hard_light) {
      options.light = [](Vec2 pixel) {
        const double gradient = std::pow(12.0, (pixel.x - 320.0) / 220.0);
        return 0.5 * gradient * (pixel.x + 0.5 * pixel.y < 440.0 ? 1.0 : 0.25);
      };
    }
    return {hung, RenderPictures(Camera(), {hung}, options)};
  }

  /// A part of a photograph: turned, enlarged, relit, with noise.
  static GreyImage Part(const cv::Mat& picture, unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return random() / 4294967296.0; };
    const double fill = std::max(1.0 * kWidth / picture.cols, 1.0 * kHeight / picture.rows);
    const double scale = fill * (1.0 + 2.0 * uniform() * uniform());
    const double turn_deg = seed % 2 == 0 ? 0.0 : 360.0 * uniform();
    const cv::Point2f middle(static_cast<float>(picture.cols * (0.3 + 0.4 * uniform())),
                             static_cast<float>(picture.rows * (0.3 + 0.4 * uniform())));
    cv::Mat map = cv::getRotationMatrix2D(middle, turn_deg, scale);
    map.at<double>(0, 2) += 0.5 * kWidth - middle.x;
    map.at<double>(1, 2) += 0.5 * kHeight - middle.y;
    cv::Mat part, noise(kHeight, kWidth, CV_16S), sum;
    cv::warpAffine(picture, part, map, {kWidth, kHeight}, cv::INTER_LINEAR, cv::BORDER_REFLECT);
    part.convertTo(sum, CV_16S, 0.6 + 0.6 * uniform(), 20.0 * uniform());
    cv::RNG draws(seed);
    draws.fill(noise, cv::RNG::NORMAL, 0.0, 1.0 + 3.0 * uniform());
    sum += noise;
    sum.convertTo(part, CV_8U);
    return Grey(part);
  }

  std::vector<Photograph> photographs_;
};

}  // namespace
}  // namespace pleinair::tracker

int main(int argc, char** argv) {
  if (argc == 1) {
    pleinair::tracker::PrintTimes();
    return 0;
  }
  pleinair::tracker::Evaluation evaluation;
  for (int i = 1; i < argc; ++i) evaluation.Load(argv[i]);
  evaluation.Render();
  evaluation.LookElsewhere();
  return 0;
}
