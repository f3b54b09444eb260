#include <optional>

#include "scene/scene_facts.h"

namespace pleinair::scene {
namespace {

// Uses `fallback` if `fact` is unset.
template <typename T>
void Fill(std::optional<T>& fact, const std::optional<T>& fallback) {
  if (!fact) fact = fallback;
}

}  // namespace

SceneFacts WithFallback(SceneFacts facts, const SceneFacts& fallback) {
  Fill(facts.place_time.latitude_deg, fallback.place_time.latitude_deg);
  Fill(facts.place_time.longitude_deg, fallback.place_time.longitude_deg);
  // A height and what it is measured from belong together.
  if (!facts.place_time.height_m) {
    Fill(facts.place_time.above_ellipsoid, fallback.place_time.above_ellipsoid);
  }
  Fill(facts.place_time.height_m, fallback.place_time.height_m);
  Fill(facts.place_time.start, fallback.place_time.start);
  // The margin's size and the marker's identity describe one sheet of paper, so they are taken over
  // only together with the marker's size.
  if (!facts.marker.size_m && !facts.marker.target) {
    Fill(facts.marker.target, fallback.marker.target);
    Fill(facts.marker.size_m, fallback.marker.size_m);
    Fill(facts.marker.board_size_m, fallback.marker.board_size_m);
    Fill(facts.marker.family, fallback.marker.family);
    Fill(facts.marker.id, fallback.marker.id);
    Fill(facts.marker.version, fallback.marker.version);
    Fill(facts.marker.albedo_black, fallback.marker.albedo_black);
    Fill(facts.marker.albedo_white, fallback.marker.albedo_white);
  }
  if (!facts.marker.heading_magnetic_deg) {
    Fill(facts.marker.heading_deg, fallback.marker.heading_deg);
  }
  Fill(facts.marker.upright, fallback.marker.upright);
  Fill(facts.camera.recorded_lens, fallback.camera.recorded_lens);
  Fill(facts.cloudiness, fallback.cloudiness);
  if (facts.camera.response.empty()) facts.camera.response = fallback.camera.response;
  return facts;
}

}  // namespace pleinair::scene
