#include "app/project/new_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

#include "app/options/local_time.h"
#include "app/options/place_option.h"
#include "app/project/heading_from_view.h"
#include "files/csv.h"
#include "scene/cloudiness.h"
#include "tracker/tracker.h"

namespace pleinair::app {
namespace {

using devices::FilmTags;

constexpr const char* kAsStated = "as you stated";

std::string PlaceText(const FilmTags::Place& place) {
  std::string text = fmt::format("{:.6f},{:.6f}", place.latitude_deg, place.longitude_deg);
  if (place.height_m) text += fmt::format(",{:.0f}", *place.height_m);
  return text;
}

std::string HeadingText(const StatedHeading& heading) {
  return fmt::format("{:.1f}{}", heading.deg, heading.is_magnetic ? "m" : "");
}

std::string FromTags(const FilmLook& look) {
  return "from the tags of " + look.file.filename().string() + ": check it";
}

/// Film first, then photographs.
template <typename Take>
void ForEachSource(const Footage& footage, const Take& take) {
  take(footage.film);
  for (const FilmLook& photo : footage.photos) take(photo);
}

std::optional<Sourced<std::string>> OfferedTime(const Footage& footage) {
  std::optional<Sourced<std::string>> offered;
  ForEachSource(footage, [&](const FilmLook& look) {
    if (!offered && !look.tags.time.empty()) {
      offered = Sourced<std::string>{look.tags.time, FromTags(look)};
    }
  });
  return offered;
}

std::optional<Sourced<FilmTags::Place>> OfferedPlace(const Footage& footage) {
  std::optional<Sourced<FilmTags::Place>> offered;
  ForEachSource(footage, [&](const FilmLook& look) {
    if (!offered && look.tags.place) {
      offered = Sourced<FilmTags::Place>{*look.tags.place, FromTags(look)};
    }
  });
  return offered;
}

/// From the direction in which a photograph looks at the marker.
std::optional<Sourced<StatedHeading>> OfferedHeading(const Footage& footage, bool upright) {
  std::optional<Sourced<StatedHeading>> offered;
  ForEachSource(footage, [&](const FilmLook& look) {
    if (offered || !look.tags.view_heading_deg || look.looked_at.empty()) return;
    for (const tracker::MarkerObservation& seen : look.looked_at.front().markers) {
      if (session::NameOfDetected(seen.detection) != footage.marker.name) continue;
      const auto heading_deg =
          HeadingFromView(*look.tags.view_heading_deg, seen.pose.best.camera_from_marker, upright);
      if (!heading_deg) continue;
      offered = Sourced<StatedHeading>{{*heading_deg, look.tags.view_heading_is_magnetic},
                                       "from the direction in the tags of " +
                                           look.file.filename().string() +
                                           ": its compass may be off by 10 degrees and more"};
    }
  });
  return offered;
}

/// Takes each value from where it is known, and remembers what is known nowhere.
class Collector {
 public:
  Collector(const StatedScene& stated, Questions* questions)
      : stated_(stated), questions_(questions) {}

  /// `offered`: the value as an answer, empty without one.
  struct Wanted {
    std::string name, option, question, offered;
  };

  /// Returns the answer to a question: nothing where the user accepts `offered`, or where nobody
  /// can be asked.
  Result<std::optional<std::string>> Answer(const Wanted& wanted, const Questions::Check& check) {
    if (questions_ != nullptr) {
      PLEINAIR_ASSIGN_OR_RETURN(const std::string answer,
                                questions_->Ask(wanted.question, wanted.offered, check));
      if (answer == wanted.offered) return std::nullopt;
      return answer;
    }
    if (!wanted.offered.empty() && stated_.accepts_tags) return std::nullopt;
    missing_ += (missing_.empty() ? "" : ", ") + wanted.name;
    options_ += (options_.empty() ? "" : ", ") + wanted.option;
    if (!wanted.offered.empty()) offers_ += (offers_.empty() ? "" : ", ") + wanted.name;
    return std::nullopt;
  }

  Result<void> CheckNothingIsMissing(const std::string& film) const {
    if (missing_.empty()) return {};
    std::string remedy = "give " + options_;
    if (!offers_.empty()) remedy += ", or --yes for what the tags offer (" + offers_ + ")";
    return InputError(film, "a scene needs what nobody has stated: " + missing_,
                      remedy + "; 'pleinair new --help' explains them");
  }

 private:
  const StatedScene& stated_;
  Questions* questions_;
  std::string missing_, options_, offers_;
};

/// A value that is stated, offered or answered. `text` and `parse` convert it.
template <typename T>
Result<Sourced<T>> Collect(Collector& collector, const std::optional<T>& stated,
                           const std::optional<Sourced<T>>& offered, Collector::Wanted wanted,
                           const std::function<std::string(const T&)>& text,
                           const std::function<Result<T>(const std::string&)>& parse) {
  if (stated) return Sourced<T>{*stated, kAsStated};
  if (offered) {
    wanted.offered = text(offered->value);
    wanted.question += " (" + offered->from + ")";
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> answer,
                            collector.Answer(wanted, [&](const std::string& given) -> Result<void> {
                              PLEINAIR_RETURN_IF_ERROR(parse(given));
                              return {};
                            }));
  if (!answer) return offered.value_or(Sourced<T>{});
  PLEINAIR_ASSIGN_OR_RETURN(T value, parse(*answer));
  return Sourced<T>{std::move(value), kAsStated};
}

Result<double> ParseSize(const std::string& text) {
  const std::optional<double> size_mm = files::ParseNumber(text);
  if (size_mm && *size_mm * 1e-3 >= tracker::kMinMarker_m &&
      *size_mm * 1e-3 <= tracker::kMaxMarker_m) {
    return *size_mm;
  }
  return InputError("--size-mm", "\"" + text.substr(0, 40) + "\" is no size of a marker",
                    "give the outer edge of its black square in millimetres");
}

Result<bool> ParseUpright(const std::string& text) {
  if (text == "ground" || text == "wall") return text == "wall";
  return InputError("", "\"" + text.substr(0, 40) + "\" is neither", "answer ground or wall");
}

/// How the marker is mounted; asked only on a terminal.
Result<void> CollectMounting(const StatedScene& stated, Questions* questions, NewScene* scene) {
  scene->upright.value = stated.upright;
  scene->marker_height_m = stated.marker_height_m;
  scene->upright.from = stated.upright ? kAsStated : "assumed: it lies flat";
  if (questions != nullptr && !stated.upright && !stated.marker_height_m) {
    PLEINAIR_ASSIGN_OR_RETURN(
        const std::string answer,
        questions->Ask("Does the marker lie on the ground, or hang on a wall?", "ground",
                       [](const std::string& given) -> Result<void> {
                         PLEINAIR_RETURN_IF_ERROR(ParseUpright(given));
                         return {};
                       }));
    PLEINAIR_ASSIGN_OR_RETURN(scene->upright.value, ParseUpright(answer));
    scene->upright.from = kAsStated;
  }
  return {};
}

}  // namespace

Result<std::string> ParseSceneTime(const std::string& text) {
  PLEINAIR_RETURN_IF_ERROR(ParseTimeOption("--time", text));
  return text;
}

Result<std::string> ParseSky(const std::string& text) {
  if (scene::ParseCloudiness(text)) return text;
  return InputError("--sky", "\"" + text.substr(0, 40) + "\" is not known",
                    std::string("known are ") + scene::kCloudinessWords);
}

Result<StatedHeading> ParseHeading(const std::string& text) {
  constexpr double kTurn_deg = 360.0;
  const bool is_magnetic = text.ends_with('m');
  const std::optional<double> deg =
      files::ParseNumber(std::string_view(text).substr(0, text.size() - (is_magnetic ? 1 : 0)));
  if (deg && std::abs(*deg) <= kTurn_deg) return StatedHeading{*deg, is_magnetic};
  return InputError("--heading", "\"" + text.substr(0, 40) + "\" is no heading",
                    "write degrees clockwise from true north, 342, or as a compass shows it, 337m");
}

Result<void> CheckNothingIsMissing(const std::vector<FilmLook>& sources,
                                   const StatedScene& stated) {
  const auto offer = [&](const auto& is_tagged) -> std::string {
    return std::any_of(sources.begin(), sources.end(), is_tagged) ? "offered" : "";
  };
  Collector collector(stated, nullptr);
  const auto want = [&](bool is_stated, const char* name, const char* option,
                        const std::string& offered) -> Result<void> {
    if (is_stated) return {};
    PLEINAIR_RETURN_IF_ERROR(collector.Answer({name, option, "", offered}, {}));
    return {};
  };
  PLEINAIR_RETURN_IF_ERROR(want(stated.size_mm.has_value(), "the marker's size", "--size-mm", ""));
  PLEINAIR_RETURN_IF_ERROR(
      want(stated.heading.has_value(), "the heading", "--heading",
           offer([](const FilmLook& look) { return look.tags.view_heading_deg.has_value(); })));
  PLEINAIR_RETURN_IF_ERROR(
      want(stated.time.has_value(), "the time", "--time",
           offer([](const FilmLook& look) { return !look.tags.time.empty(); })));
  PLEINAIR_RETURN_IF_ERROR(
      want(stated.place.has_value(), "the place", "--at",
           offer([](const FilmLook& look) { return look.tags.place.has_value(); })));
  return collector.CheckNothingIsMissing(sources.front().file.string());
}

Result<NewScene> CollectScene(const Footage& footage, const StatedScene& stated,
                              Questions* questions) {
  NewScene scene;
  scene.marker = footage.marker;
  scene.lens_from = footage.film.lens.from;
  if (!footage.film.lens.note.empty()) scene.notes.push_back(footage.film.lens.note);
  scene.model = stated.model;
  scene.film = footage.film.file.filename().string();
  ForEachSource(footage, [&](const FilmLook& look) {
    for (const std::string& sentence : look.tags.rejected) {
      scene.notes.push_back(look.file.filename().string() + ": " + sentence);
    }
  });
  Collector collector(stated, questions);
  PLEINAIR_RETURN_IF_ERROR(CollectMounting(stated, questions, &scene));
  PLEINAIR_ASSIGN_OR_RETURN(
      const Sourced<double> size,
      Collect<double>(
          collector, stated.size_mm, std::nullopt,
          {"the marker's size", "--size-mm",
           "Outer edge of the black square of marker " + scene.marker.name.ToString() + ", mm", ""},
          [](double size_mm) { return fmt::format("{:g}", size_mm); }, ParseSize));
  scene.size_mm = size.value;
  const char* heading_question =
      scene.upright.value
          ? "Direction in which you look when you read the marker, degrees clockwise "
            "from true north (as a compass shows it: 337m)"
          : "Direction of the marker's top edge, degrees clockwise from true north (as a "
            "compass shows it: 337m)";
  PLEINAIR_ASSIGN_OR_RETURN(
      scene.heading, Collect<StatedHeading>(collector, stated.heading,
                                            OfferedHeading(footage, scene.upright.value),
                                            {"the heading", "--heading", heading_question, ""},
                                            HeadingText, ParseHeading));
  PLEINAIR_ASSIGN_OR_RETURN(
      scene.time, Collect<std::string>(
                      collector, stated.time, OfferedTime(footage),
                      {"the time", "--time",
                       "Time of the first frame, with its offset (2025-09-14T13:05:00+02:00) "
                       "or zone (…[Europe/Prague])",
                       ""},
                      [](const std::string& time) { return time; }, ParseSceneTime));
  PLEINAIR_ASSIGN_OR_RETURN(
      scene.place, Collect<FilmTags::Place>(collector, stated.place, OfferedPlace(footage),
                                            {"the place", "--at",
                                             "Latitude, longitude and, if known, metres above sea "
                                             "level (50.0875,14.4213,220)",
                                             ""},
                                            PlaceText, ParsePlace));
  PLEINAIR_RETURN_IF_ERROR(collector.CheckNothingIsMissing(footage.film.file.string()));
  scene.sky = {"clear", "assumed: clear, hazy, partly cloudy or overcast"};
  if (stated.sky || questions != nullptr) {
    PLEINAIR_ASSIGN_OR_RETURN(
        scene.sky, Collect<std::string>(
                       collector, stated.sky, scene.sky, {"the sky", "--sky", "The sky", ""},
                       [](const std::string& words) { return words; }, ParseSky));
    scene.sky.from = kAsStated;
  }
  PLEINAIR_RETURN_IF_ERROR(ParseSky(scene.sky.value));
  return scene;
}

}  // namespace pleinair::app
