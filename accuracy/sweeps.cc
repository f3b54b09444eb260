#include "accuracy/sweeps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "accuracy/films.h"
#include "accuracy/occluders.h"
#include "accuracy/sweep_poses.h"

namespace pleinair::accuracy {
namespace {

/// Adds frames to a sweep.
class SweepMaker {
 public:
  SweepMaker(std::string sweep, const CameraModel& camera, const SweepOptions& options)
      : sweep_(std::move(sweep)), camera_(camera), options_(options) {}

  int Count(int at_scale_1) const {
    return std::max(1, static_cast<int>(std::lround(at_scale_1 * options_.scale)));
  }
  const CameraModel& camera() const { return camera_; }

  /// The random number stream of a frame.
  RandomStream Stream(const std::string& what, const std::string& pattern, double level,
                      int repeat) const {
    return RandomStream(options_.seed,
                        fmt::format("{}/{}/{}/{}/{}", what, sweep_, pattern, level, repeat));
  }

  FrameSpec Frame(const std::string& pattern, double level, int repeat) const {
    FrameSpec frame{.sweep = sweep_, .pattern = pattern, .level = level, .repeat = repeat};
    frame.name =
        fmt::format("{}_{}{}_{:03}", sweep_, pattern.empty() ? "" : pattern + "_", level, repeat);
    std::replace(frame.name.begin(), frame.name.end(), '.', 'p');
    frame.background = frame.name;
    frame.photo.light = Stream("light", pattern, level, repeat).Uniform(0.75, 1.1);
    return frame;
  }

  void Add(FrameSpec frame) { runs_.push_back({false, {std::move(frame)}}); }

  /// Adds `repeats` frames of one marker at each level, modified by `change`.
  using Change = std::function<void(RandomStream*, PlaceWanted*, FrameSpec*)>;
  void AddLevels(const std::string& pattern, const std::vector<double>& levels, int repeats,
                 const Change& change) {
    for (const double level : levels) {
      for (int i = 0; i < Count(repeats); ++i) {
        RandomStream random = Stream("pose", pattern, level, i);
        FrameSpec frame = Frame(pattern, level, i);
        PlaceWanted place;
        change(&random, &place, &frame);
        MarkerSpec marker = PlaceMarker(camera_, place, &random);
        if (!frame.markers.empty()) marker.occluder = frame.markers[0].occluder;
        frame.markers = {std::move(marker)};
        Add(std::move(frame));
      }
    }
  }

  std::vector<FrameRun> Take() { return std::move(runs_); }

 private:
  const std::string sweep_;
  const CameraModel& camera_;
  const SweepOptions& options_;
  std::vector<FrameRun> runs_;
};

void Occlude(FrameSpec* frame, const std::string& pattern, double share) {
  if (share <= 0.0) return;
  frame->markers.resize(1);
  frame->markers[0].occluder = OccluderSpec{pattern, share, frame->name};
}

void MakeDistance(SweepMaker* maker) {
  maker->AddLevels(
      "", {200, 160, 120, 96, 80, 64, 56, 48, 42, 36, 32, 28, 24, 22, 20, 18, 17, 16, 14, 12}, 8,
      [](RandomStream* random, PlaceWanted* place, FrameSpec* frame) {
        place->side_px = frame->level;
        place->tilt_deg = random->Uniform(0, 25);
      });
}

void MakeAngle(SweepMaker* maker) {
  maker->AddLevels("", {0, 15, 30, 40, 50, 55, 60, 65, 70, 74, 78, 80, 82, 85}, 8,
                   [](RandomStream*, PlaceWanted* place, FrameSpec* frame) {
                     place->side_px = 130;
                     place->tilt_deg = frame->level;
                   });
}

void MakeCovered(SweepMaker* maker, const std::vector<std::string>& patterns,
                 const std::vector<double>& levels, int repeats) {
  for (const std::string& pattern : patterns) {
    std::vector<double> reached;
    for (const double level : levels) {
      if (level <= 100.0 * MaxShare(pattern)) reached.push_back(level);
    }
    maker->AddLevels(pattern, reached, repeats,
                     [](RandomStream* random, PlaceWanted* place, FrameSpec* frame) {
                       place->side_px = random->Uniform(110, 150);
                       place->tilt_deg = random->Uniform(0, 35);
                       Occlude(frame, frame->pattern, frame->level / 100.0);
                     });
  }
}

void MakeBlur(SweepMaker* maker) {
  maker->AddLevels("defocus", {.5, 1, 1.5, 2, 3, 4, 5, 6, 8}, 6,
                   [](RandomStream* random, PlaceWanted* place, FrameSpec* frame) {
                     place->tilt_deg = random->Uniform(0, 30);
                     frame->photo.lens.defocus_px = frame->level;
                   });
  maker->AddLevels("motion", {2, 4, 6, 8, 10, 12, 16, 20, 24, 30}, 6,
                   [](RandomStream* random, PlaceWanted* place, FrameSpec* frame) {
                     place->tilt_deg = random->Uniform(0, 30);
                     frame->photo.motion.length_px = frame->level;
                     frame->photo.motion.angle = random->Uniform(0, M_PI);
                   });
}

void MakeNoise(SweepMaker* maker) {
  maker->AddLevels("gain", {1, 4, 16, 36, 64, 100, 144, 225, 400}, 6,
                   [](RandomStream* random, PlaceWanted* place, FrameSpec* frame) {
                     place->side_px = 80;
                     place->tilt_deg = random->Uniform(0, 30);
                     frame->photo.noise.shot = 2e-4 * frame->level;
                     frame->photo.noise.read = 0.004 * std::sqrt(frame->level);
                   });
  maker->AddLevels("dark", {.3, .1, .05, .025, .0125}, 6,
                   [](RandomStream* random, PlaceWanted* place, FrameSpec* frame) {
                     place->side_px = 80;
                     place->tilt_deg = random->Uniform(0, 30);
                     frame->photo.exposure = frame->level;
                   });
}

void MakeLight(SweepMaker* maker) {
  const std::vector<std::pair<std::string, std::vector<double>>> kPatterns{
      {"gradient", {2, 5, 10, 20, 40}},
      {"shadow", {2, 4, 8, 16, 32}},
      {"over", {1.5, 2, 3, 4, 6, 8}},
      {"glare", {10, 20, 30, 40}}};
  for (const auto& [pattern, levels] : kPatterns) {
    maker->AddLevels(pattern, levels, 6,
                     [](RandomStream* random, PlaceWanted* place, FrameSpec* frame) {
                       place->side_px = 110;
                       place->tilt_deg = random->Uniform(0, 35);
                       LightPattern light{.angle = random->Uniform(0, 2 * M_PI)};
                       light.offset.x = random->Uniform(-.25, .25);
                       light.offset.y = random->Uniform(-.25, .25);
                       light.value = frame->level;
                       PhotoSpec& photo = frame->photo;
                       if (frame->pattern == "gradient") photo.gradient = light;
                       if (frame->pattern == "shadow") photo.shadow = light;
                       if (frame->pattern == "glare") photo.glare = light;
                       if (frame->pattern == "over") photo.exposure = frame->level;
                     });
  }
}

/// 0…count-1 in random order (Fisher & Yates).
std::vector<int> Shuffled(int count, RandomStream* random) {
  std::vector<int> order(count);
  for (int i = 0; i < count; ++i) order[i] = i;
  for (int i = count - 1; i > 0; --i) std::swap(order[i], order[random->Below(i + 1)]);
  return order;
}

/// Positions of `count` different markers on a grid, in random order.
struct MarkerGrid {
  MarkerGrid(const CameraModel& camera, int count, RandomStream* random) {
    const int columns = std::max(
        1, static_cast<int>(std::lround(std::sqrt(1.0 * count * camera.width / camera.height))));
    const int rows = (count + columns - 1) / columns;
    const double width = 1.0 * camera.width / columns, height = 1.0 * camera.height / rows;
    step_px = std::min(width, height);
    const std::vector<int> numbers = Shuffled(kNumbers, random);
    const std::vector<int> cells = Shuffled(columns * rows, random);
    for (int k = 0; k < count; ++k) {
      const int column = cells[k] % columns, row = cells[k] / columns;
      PlaceWanted place{.number = numbers[k]};
      place.centre_px = Vec2{(column + 0.5) * width, (row + 0.5) * height};
      places.push_back(place);
    }
  }
  double step_px = 0.0;
  std::vector<PlaceWanted> places;
};

void MakeMany(SweepMaker* maker) {
  const CameraModel& camera = maker->camera();
  for (const int count : {1, 2, 5, 10, 20, 30, 50}) {
    for (int i = 0; i < maker->Count(5); ++i) {
      RandomStream random = maker->Stream("pose", "", count, i);
      MarkerGrid grid(camera, count, &random);
      const double side = std::min(grid.step_px, 300.0 * camera.height / 480.0) * 0.56;
      FrameSpec frame = maker->Frame("", count, i);
      for (PlaceWanted& place : grid.places) {
        place.side_px = side * random.Uniform(.85, 1);
        place.tilt_deg = random.Uniform(0, 40);
        frame.markers.push_back(PlaceMarker(camera, place, &random));
      }
      maker->Add(std::move(frame));
    }
  }
}

/// Many markers per image, so small that their two planar poses are nearly ambiguous.
void MakeAmbiguity(SweepMaker* maker) {
  constexpr int kMarkers = 48;
  const CameraModel& camera = maker->camera();
  for (const std::string pattern : {"open", "noise", "blur", "covered", "jpeg", "mixed"}) {
    const bool mixed = pattern == "mixed";
    for (const double level : {12, 16, 20, 28, 40}) {
      for (int i = 0; i < maker->Count(2); ++i) {
        RandomStream random = maker->Stream("pose", pattern, level, i);
        FrameSpec frame = maker->Frame(pattern, level, i);
        for (PlaceWanted& place : MarkerGrid(camera, kMarkers, &random).places) {
          place.side_px = level;
          place.tilt_deg = random.Uniform(0, 60);
          MarkerSpec marker = PlaceMarker(camera, place, &random);
          if (pattern == "covered" || (mixed && random.Uniform() < .5)) {
            const std::vector<std::string>& covers = BorderPatterns();
            const std::string& cover = covers[random.Below(static_cast<int>(covers.size()))];
            marker.occluder =
                OccluderSpec{cover, std::min(random.Uniform(.05, .4), MaxShare(cover)),
                             fmt::format("{}/{}", frame.name, marker.number)};
          }
          frame.markers.push_back(std::move(marker));
        }
        PhotoSpec& photo = frame.photo;
        if (pattern == "noise" || mixed) {
          const double gain = std::exp(random.Uniform(0, std::log(mixed ? 16 : 64)));
          photo.noise.shot = 2e-4 * gain;
          photo.noise.read = 0.004 * std::sqrt(gain);
        }
        // At most about a tenth of the marker.
        if (pattern == "blur" || mixed) {
          photo.lens.defocus_px = level * random.Uniform(0, .08);
          photo.motion.length_px = level * random.Uniform(0, .08);
          photo.motion.angle = random.Uniform(0, M_PI);
        }
        if (pattern == "jpeg" || mixed) photo.jpeg_quality = 60 + random.Below(36);
        maker->Add(std::move(frame));
      }
    }
  }
}

void MakeNegative(SweepMaker* maker) {
  for (int i = 0; i < maker->Count(150); ++i) maker->Add(maker->Frame("", 0, i));
}

/// One scene with many samples of the noise.
void MakeJitter(SweepMaker* maker) {
  for (const double side : {160, 120, 80, 60, 42, 30, 24, 18}) {
    for (const int tilt : {5, 40}) {
      const std::string pattern = fmt::format("a{}", tilt);
      RandomStream random = maker->Stream("pose", pattern, side, 0);
      PlaceWanted place;
      place.side_px = side;
      place.tilt_deg = tilt;
      const MarkerSpec marker = PlaceMarker(maker->camera(), place, &random);
      const FrameSpec first = maker->Frame(pattern, side, 0);
      for (int i = 0; i < maker->Count(24); ++i) {
        FrameSpec frame = maker->Frame(pattern, side, i);
        frame.background = first.name;
        frame.photo = first.photo;
        frame.markers = {marker};
        maker->Add(std::move(frame));
      }
    }
  }
}

void MakeWild(SweepMaker* maker) {
  maker->AddLevels("", {0}, 150, [](RandomStream* random, PlaceWanted* place, FrameSpec* frame) {
    std::vector<std::string> patterns = BorderPatterns();
    patterns.insert(patterns.end(), {"cblobs", "cfinger"});
    const std::string& pattern = patterns[random->Below(static_cast<int>(patterns.size()))];
    double share = std::min(random->Uniform(0, .35), MaxShare(pattern));
    if (pattern.starts_with('c') && !pattern.starts_with("corner")) share = std::min(share, .12);
    Occlude(frame, pattern, share);
    PhotoSpec& photo = frame->photo;
    photo.noise.shot = 2e-4 * random->Uniform(1, 30);
    photo.noise.read = .004 * random->Uniform(1, 3);
    photo.exposure = random->Uniform(.4, 1.8);
    photo.lens.defocus_px = random->Uniform(0, 1.6);
    if (random->Uniform() < .4) {
      photo.motion.length_px = random->Uniform(1, 7);
      photo.motion.angle = random->Uniform(0, M_PI);
    }
    if (random->Uniform() < .4) {
      photo.shadow = LightPattern{.angle = random->Uniform(0, 2 * M_PI)};
      photo.shadow->offset.x = random->Uniform(-.3, .3);
      photo.shadow->offset.y = random->Uniform(-.3, .3);
      photo.shadow->value = random->Uniform(2, 6);
    }
    place->side_px = std::exp(random->Uniform(std::log(36.0), std::log(180.0)));
    place->tilt_deg = random->Uniform(0, 62);
  });
}

using Make = std::function<void(SweepMaker*)>;
const std::map<std::string, Make>& Makers() {
  static const std::map<std::string, Make> kMakers{
      {"distance", MakeDistance},
      {"angle", MakeAngle},
      {"border",
       [](SweepMaker* maker) {
         MakeCovered(maker, BorderPatterns(), {0, 10, 20, 30, 40, 50, 60, 70}, 4);
       }},
      {"content",
       [](SweepMaker* maker) {
         MakeCovered(maker, ContentPatterns(), {0, 5, 10, 15, 20, 25, 30, 40, 50}, 5);
       }},
      {"blur", MakeBlur},
      {"noise", MakeNoise},
      {"light", MakeLight},
      {"many", MakeMany},
      {"ambiguity", MakeAmbiguity},
      {"negative", MakeNegative},
      {"jitter", MakeJitter},
      {"wild", MakeWild}};
  return kMakers;
}

}  // namespace

const std::vector<std::string>& SweepCameraNames() {
  static const std::vector<std::string> kNames{"640x480", "1280x720"};
  return kNames;
}

CameraModel SweepCamera(const std::string& name) {
  if (name == "1280x720") {
    return {.width = 1280,
            .height = 720,
            .fx = 950.0,
            .fy = 950.8,
            .cx = 643.7,
            .cy = 357.2,
            .distortion = {-0.09, 0.04, -0.0005, 0.0007}};
  }
  return {.width = 640,
          .height = 480,
          .fx = 600.0,
          .fy = 600.5,
          .cx = 322.3,
          .cy = 238.1,
          .distortion = {-0.12, 0.05, 0.0008, -0.0006}};
}

const std::vector<std::string>& SweepNames() {
  static const std::vector<std::string> kNames{
      "distance", "angle",     "border",   "content", "blur",     "noise",         "light",
      "many",     "ambiguity", "negative", "jitter",  "sequence", "sequence_occl", "wild"};
  return kNames;
}

std::vector<FrameRun> MakeSweep(const std::string& name, const CameraModel& camera,
                                const SweepOptions& options) {
  if (name == "sequence" || name == "sequence_occl") return {MakeFilm(name, camera, options)};
  SweepMaker maker(name, camera, options);
  Makers().at(name)(&maker);
  return maker.Take();
}

}  // namespace pleinair::accuracy
