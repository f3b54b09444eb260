#include "app/window/scene_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "app/options/local_time.h"
#include "app/window/cities.h"
#include "app/window/measured_text.h"
#include "app/window/surface_section.h"
#include "scene/sun_over_place.h"
#include "shadows/shadow_method.h"

namespace pleinair::app {
namespace {

constexpr double kDay_s = 86400.0;
const ImVec4 kQuiet{0.62F, 0.66F, 0.70F, 1.0F};
const ImVec4 kWarm{1.0F, 0.82F, 0.42F, 1.0F};

bool Section(const char* name, bool open) {
  return ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void Quiet(const std::string& text) {
  if (text.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, kQuiet);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

/// Adds a tooltip to the previous control.
void Hint(const char* text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 22.0F);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool Slider(const char* label, double* value, double low, double high, const char* format,
            bool logarithmic = false) {
  return ImGui::SliderScalar(
      label, ImGuiDataType_Double, value, &low, &high, format,
      ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
}

bool DragDouble(const char* label, double* value, float speed, const char* format) {
  return ImGui::DragScalar(label, ImGuiDataType_Double, value, speed, nullptr, nullptr, format);
}

bool DragVector(const char* label, Vec3* value, float speed, const char* format) {
  double numbers[3] = {value->x, value->y, value->z};
  if (!ImGui::DragScalarN(label, ImGuiDataType_Double, numbers, 3, speed, nullptr, nullptr,
                          format)) {
    return false;
  }
  *value = {numbers[0], numbers[1], numbers[2]};
  return true;
}

std::string HoursMinutes(double seconds) {
  const int minutes = static_cast<int>(seconds / 60.0);
  return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

// Texels per side, doubled at each step of the slider.
constexpr int kMinMap = 128;

void Fog(compositor::ComposerOptions* drawing) {
  double fog = *std::max_element(drawing->fog.begin(), drawing->fog.end());
  constexpr double kThickest = 5000.0;
  if (Slider("fog ×", &fog, 0.0, kThickest, "%.1f", true)) drawing->fog.fill(fog);
  Hint("Haze relative to the sky model's own: 1 is a clear day, some hundreds are fog.");
  if (drawing->shadow_partitions < 2) return;
  constexpr double kNone = 0.0;
  ImGui::DragScalarN("by partition", ImGuiDataType_Double, drawing->fog.data(),
                     drawing->shadow_partitions, 1.0F, &kNone, &kThickest, "%.0f",
                     ImGuiSliderFlags_AlwaysClamp);
  Hint("The same for each partition of the view, from near to far.");
}

}  // namespace

void ScenePanel::Draw(Vec2 corner, Vec2 size, UtcTime now, WindowState* state) {
  ImGui::SetNextWindowPos({static_cast<float>(corner.x), static_cast<float>(corner.y)});
  ImGui::SetNextWindowSize({static_cast<float>(size.x), static_cast<float>(size.y)});
  if (ImGui::Begin("Scene", nullptr,
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus)) {
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.56F);
    if (Section("Place and time", true)) PlaceAndTime(now, state);
    if (Section("Air", true)) Air(state);
    if (Section("North", true)) North(state);
    if (Section("Objects", true)) Objects(state);
    if (Section("Ground, boxes and walls", true)) DrawSurfaceSection(state);
    if (Section("Shadows and light", true)) {
      Shadows(state);
      Light(state);
    }
    if (Section("Camera", true)) Capture(state);
    if (Section("Statistics", true)) Statistics(*state);
    ImGui::PopItemWidth();
  }
  ImGui::End();
}

void ScenePanel::PlaceAndTime(UtcTime now, WindowState* state) {
  session::SceneEdit& edit = state->edit;
  if (ImGui::BeginCombo("city", "choose…", ImGuiComboFlags_HeightLarge)) {
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::IsWindowAppearing()) {
      city_[0] = '\0';
      ImGui::SetKeyboardFocusHere();
    }
    ImGui::InputTextWithHint("##name", "name", city_, sizeof city_);
    for (const City& city : FindCities(city_)) {
      if (ImGui::Selectable(std::string(city.name).c_str())) {
        edit.latitude_deg = city.latitude_deg;
        edit.longitude_deg = city.longitude_deg;
      }
    }
    ImGui::EndCombo();
  }
  ImGui::InputDouble("latitude °N", &edit.latitude_deg, 0.0, 0.0, "%.4f");
  ImGui::InputDouble("longitude °E", &edit.longitude_deg, 0.0, 0.0, "%.4f");
  edit.latitude_deg = std::clamp(edit.latitude_deg, -90.0, 90.0);
  edit.longitude_deg = std::clamp(edit.longitude_deg, -180.0, 180.0);

  const UtcOffset offset = NauticalOffset(edit.longitude_deg);
  const UtcTime shown = state->shown_time();
  const UtcTime::Civil local = shown.PlusSeconds(offset.seconds()).ToCivil();
  int date[3] = {local.year, local.month, local.day};
  if (ImGui::InputInt3("date", date)) {
    const auto day =
        ParseDay(fmt::format("{:04}-{:02}-{:02}", date[0], date[1], date[2]), offset, "date");
    if (day) {
      SetShownTime(day->PlusSeconds(TimeOfDay(shown, offset.seconds())), state);
    } else {
      state->message = "there is no such day";
    }
  }
  double time_of_day = TimeOfDay(shown, offset.seconds());
  ImGui::Text("%s   (UTC%s)", HoursMinutes(time_of_day).c_str(), ToString(offset).c_str());
  ImGui::SetNextItemWidth(-1.0F);
  if (Slider("##time", &time_of_day, 0.0, kDay_s - 60.0, "")) {
    SetTimeOfDay(time_of_day, offset.seconds(), state);
  }
  Hint("The time of day on the nearest whole hour's clock. [ and ] step by ten minutes.");
  SunOverTheDay(offset.seconds(), *state);
  if (ImGui::Button("Now")) Do(Action::kNow, false, now, state);
  ImGui::SameLine();
  if (ImGui::Button("Time of the images")) Do(Action::kAsRecorded, false, now, state);
}

void ScenePanel::SunOverTheDay(double utc_offset_s, const WindowState& state) {
  const session::SceneEdit& edit = state.edit;
  const UtcTime shown = state.shown_time();
  const UtcTime midnight = shown.PlusSeconds(-TimeOfDay(shown, utc_offset_s));
  const std::int64_t day = midnight.nanoseconds_since_1970() / 60'000'000'000;
  scene::PlaceTime place = state.scene.place_time;
  place.latitude_deg = edit.latitude_deg;
  place.longitude_deg = edit.longitude_deg;
  if (day != elevations_of_day_ || edit.latitude_deg != elevations_of_latitude_ ||
      edit.longitude_deg != elevations_of_longitude_) {
    elevations_of_day_ = day;
    elevations_of_latitude_ = edit.latitude_deg;
    elevations_of_longitude_ = edit.longitude_deg;
    for (std::size_t i = 0; i < elevations_deg_.size(); ++i) {
      const double share = static_cast<double>(i) / (elevations_deg_.size() - 1);
      const Vec3 to_sun = scene::SunOver(place, midnight.PlusSeconds(share * kDay_s)).ToSun().xyz;
      elevations_deg_[i] = static_cast<float>(std::asin(to_sun.z) / kRadiansPerDegree);
    }
  }
  // Elevation of the sun over the day, with the horizon and the current value.
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 3.2F};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const auto at = [&](double share, double elevation_deg) {
    return ImVec2(corner.x + size.x * static_cast<float>(share),
                  corner.y + size.y * (0.5F - 0.5F * static_cast<float>(elevation_deg / 90.0)));
  };
  draw->AddRectFilledMultiColor(corner, at(1.0, 0.0), 0xFF5C4326, 0xFF5C4326, 0xFF7A6A50,
                                0xFF7A6A50);
  draw->AddRectFilled(at(0.0, 0.0), {corner.x + size.x, corner.y + size.y}, 0xFF1E1A17);
  for (std::size_t i = 1; i < elevations_deg_.size(); ++i) {
    const double count = static_cast<double>(elevations_deg_.size() - 1);
    const double from = static_cast<double>(i - 1) / count, to = static_cast<double>(i) / count;
    draw->AddLine(at(from, elevations_deg_[i - 1]), at(to, elevations_deg_[i]), 0xFFB0A890, 1.5F);
  }
  const Vec3 to_sun = scene::SunOver(place, shown).ToSun().xyz;
  const double elevation_deg = std::asin(to_sun.z) / kRadiansPerDegree;
  double azimuth_deg = std::atan2(to_sun.x, to_sun.y) / kRadiansPerDegree;
  if (azimuth_deg < 0.0) azimuth_deg += 360.0;
  const bool up = elevation_deg > -0.8;
  draw->AddCircleFilled(at(TimeOfDay(shown, utc_offset_s) / kDay_s, elevation_deg),
                        ImGui::GetFontSize() * 0.3F, up ? 0xFF6AD0FF : 0xFF8A7A70);
  ImGui::Dummy(size);
  ImGui::TextColored(up ? kWarm : kQuiet, "sun %.1f° high, %.1f° from north", elevation_deg,
                     azimuth_deg);
}

void ScenePanel::Air(WindowState* state) {
  session::SceneEdit& edit = state->edit;
  bool by_hand = edit.sky.has_value();
  session::SceneEdit::Sky sky = edit.sky.value_or(session::DescribedAir(state->scene));
  bool changed = Slider("turbidity", &sky.turbidity, 1.2, 10.0, "%.1f", true);
  Hint("Haze: 1.2 high mountains, 1.8 a clear day, 3 hazy, 6 and more thick haze.");
  changed = Slider("cloud cover", &sky.cloud_cover, 0.0, 1.0, "%.2f") || changed;
  if (changed) edit.sky = sky;
  if (ImGui::Checkbox("by hand", &by_hand)) {
    edit.sky = by_hand ? std::optional(sky) : std::nullopt;
  }
  Hint(
      "Otherwise haze and clouds are estimated from the shadows in the images or come from the "
      "scene.");
  if (state->status.statistics.light.frames_in_estimate > 0) {
    Quiet("estimating from shadows…");
  } else if (!edit.sky) {
    Quiet(MeasuredSunText(state->frame.light.measured, state->status.statistics.light.measured));
  }
}

void ScenePanel::North(WindowState* state) {
  session::SceneEdit& edit = state->edit;
  double heading = ToDegrees(state->marker().heading);
  heading -= 360.0 * std::floor(heading / 360.0);
  if (ImGui::InputDouble("heading °", &heading, 0.1, 1.0, "%.2f")) edit.heading_deg = heading;
  Hint("Azimuth of the marker's upper edge, clockwise from true north.");
  if (!edit.heading_deg) Quiet(MeasuredHeadingText(state->status.statistics.light.measured));
  bool by_hand = edit.heading_deg.has_value();
  if (ImGui::Checkbox("by hand##north", &by_hand)) {
    edit.heading_deg = by_hand ? std::optional(heading) : std::nullopt;
  }
  ImGui::SameLine();
  ImGui::Checkbox("pole", &state->overlays.turning_north);
  Hint(
      "Shows a virtual pole. Drag its foot to a real pole's, and its shadow's tip onto the real "
      "shadow: that turns the scene to north.");
  if (state->overlays.turning_north)
    Slider("pole's height m", &state->overlays.pole.height_m, 0.05, 10.0, "%.2f", true);
}

void ScenePanel::Objects(WindowState* state) {
  if (ImGui::Button("Save scene")) Do(Action::kSaveScene, false, {}, state);
  Hint(
      "Ctrl+S. Writes moved objects, location, and what is set by hand of heading and air into the "
      "scene's file. The hour and the drawing options are no part of a scene.");
  if (state->boxes.empty()) Quiet("the scene has no virtual object");
  const int count = static_cast<int>(std::min(state->boxes.size(), state->edit.objects.size()));
  for (int i = 0; i < count; ++i) {
    ImGui::PushID(i);
    if (ImGui::Selectable(state->boxes[i].name.c_str(), state->selected == i)) state->selected = i;
    ImGui::PopID();
  }
  if (state->selected < 0 || state->selected >= count) return;
  session::ObjectPlace& place = state->edit.objects[state->selected];
  DragVector("position m", &place.translation_m, 0.005F, "%.3f");
  DragVector("turn °", &place.rotation_deg, 0.5F, "%.1f");
  double scale = place.scale;
  if (DragDouble("scale", &scale, static_cast<float>(place.scale) * 0.005F, "%.4g") &&
      scale > 0.0) {
    place = Scaled(state->boxes[state->selected], place, scale / place.scale,
                   UpOf(state->scene.marker));
  }
  if (ImGui::Button("Reset")) Do(Action::kResetObject, false, {}, state);
}

void ScenePanel::Shadows(WindowState* state) {
  compositor::ComposerOptions& drawing = state->edit.drawing;
  const shadows::ShadowMethodTraits& in_use = shadows::TraitsOf(drawing.shadow_method);
  if (ImGui::BeginCombo("shadows", std::string(in_use.title).c_str())) {
    for (const shadows::ShadowMethodTraits& traits : shadows::ShadowMethods()) {
      if (ImGui::Selectable(std::string(traits.title).c_str(), &traits == &in_use)) {
        drawing.shadow_method = traits.method;
      }
    }
    ImGui::EndCombo();
  }
  const auto antialiasing = compositor::NameOf(drawing.antialiasing.method);
  if (ImGui::BeginCombo("antialiasing", std::string(antialiasing).c_str())) {
    for (const compositor::AntialiasingMethod method : compositor::kAntialiasingMethods) {
      if (ImGui::Selectable(std::string(compositor::NameOf(method)).c_str(),
                            method == drawing.antialiasing.method)) {
        drawing.antialiasing.method = method;
      }
    }
    ImGui::EndCombo();
  }
  ImGui::SliderInt("partitions", &drawing.shadow_partitions, 1, 4);
  drawing.shadow_partitions = std::clamp(drawing.shadow_partitions, 1, 4);
  for (int i = 0; i < drawing.shadow_partitions; ++i) {
    ImGui::PushID(i);
    int& size = drawing.shadow_sizes[i];
    constexpr int kMapSizes = 6;  // Slider steps from 1 on; 0: automatic.
    int step = size > 0 ? 1 + std::countr_zero(static_cast<unsigned>(size) / kMinMap) : 0;
    const std::string shown = size > 0 ? std::to_string(size) : "auto";
    if (ImGui::SliderInt("##texels", &step, 0, kMapSizes, shown.c_str())) {
      size = step > 0 ? kMinMap << (std::min(step, kMapSizes) - 1) : 0;
    }
    ImGui::SameLine();
    ImGui::Text("texels of map %d", i + 1);
    ImGui::PopID();
  }
  ImGui::Checkbox("show partitions and maps", &drawing.show_shadow_maps);
  Hint(
      "M. Tints surfaces by shadow-map partition (red the finest, then green, blue, yellow) and "
      "shows the maps in the corner. Without a sun there are none.");
  const bool moments = in_use.content == shadows::MapContent::kMoments ||
                       in_use.content == shadows::MapContent::kWarpedMoments;
  if (!moments) return;
  Slider("λ", &drawing.shadow_split_weight, 0.0, 1.0, "%.2f");
  Hint("How the partitions divide the view's depth: 0 evenly, 1 logarithmically (Eq. 11).");
  Slider("blur m", &drawing.shadow_blur_distance_m, 0.05, 20.0, "%.2f", true);
  Hint("Shadow edges are as soft as those of an object at this distance from the ground.");
}

void ScenePanel::Light(WindowState* state) {
  session::SceneEdit& edit = state->edit;
  Fog(&edit.drawing);
  Slider("convergence", &edit.convergence, 1e-4, 0.2, "%.4f", true);
  Hint("Interreflections are computed until one more bounce adds less than this share.");
  constexpr const char* kDetails[] = {"automatic", "fine", "fast", "coarse"};
  int detail = static_cast<int>(edit.detail);
  if (ImGui::Combo("detail", &detail, kDetails, 4))
    edit.detail = static_cast<session::Detail>(detail);
  Hint("Automatic: the finest detail that keeps up with the camera.");
  const double share = state->status.statistics.light.coefficients;
  if (share < 1.0 && !state->boxes.empty()) {
    ImGui::ProgressBar(static_cast<float>(share), {-1.0F, ImGui::GetFontSize() * 0.5F}, "");
    Hint("Light transport is being computed; afterwards the light follows every change at once.");
  }
}

void ScenePanel::Capture(WindowState* state) {
  if (!state->status.camera.empty()) Quiet(state->status.camera);
  bool locked = state->exposure_locked;
  if (ImGui::Checkbox("lock exposure", &locked)) Do(Action::kLockExposure, false, {}, state);
  Hint(
      "Locks the camera's exposure, gain and white balance, and the exposure last estimated from "
      "the marker: the objects' brightness then follows the time of day and the haze alone.");
  if (ImGui::Button("Screenshot")) state->requests.screenshot = true;
  ImGui::SameLine();
  if (state->status.recording) ImGui::PushStyleColor(ImGuiCol_Button, {0.75F, 0.15F, 0.15F, 1.0F});
  const bool clicked = ImGui::Button(state->status.recording ? "End recording" : "Record");
  if (state->status.recording) ImGui::PopStyleColor();
  if (clicked) state->requests.recording_change = true;
}

void ScenePanel::Statistics(const WindowState& state) {
  const LiveStatistics& s = state.status.statistics;
  ImGui::Text("%.1f images a second shown, %.1f sent", state.status.shown_per_second,
              s.timing.period_ms > 0.0 ? 1000.0 / s.timing.period_ms : 0.0);
  ImGui::Text("exposure to screen %.0f ms (95 %%: %.0f)", s.latency.median_ms, s.latency.p95_ms);
  ImGui::Text("tracking %.1f ms, drawing %.1f ms", s.timing.track_ms, s.timing.draw_ms);
  Quiet(fmt::format(
      "{} captured = {} shown + {} late for tracking + {} for drawing + {} for the "
      "screen + {} on their way; {} lost before",
      s.frames.captured, s.frames.shown, s.late.for_tracking, s.late.for_drawing, s.late.for_screen,
      s.frames.captured - s.late.for_tracking - s.late.for_drawing - s.frames.shown -
          s.late.for_screen,
      s.loss.Total()));
  if (s.recording.recorded > 0) {
    Quiet(fmt::format("{} recorded, {} left out", s.recording.recorded, s.recording.left_out));
  }
}

}  // namespace pleinair::app
