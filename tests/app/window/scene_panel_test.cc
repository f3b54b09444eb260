#include "app/window/scene_panel.h"

#include <gmock/gmock.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <string>
#include <utility>

#include "app/window/window_state.h"

namespace pleinair::app {
namespace {

constexpr float kWidth = 320.0F, kHeight = 1600.0F;

/// Operates the panel without a window: passes ImGui the events that GLFW would send.
class PanelInHands : public testing::Test {
 protected:
  void SetUp() override {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {kWidth, kHeight};
    io.DeltaTime = 0.05F;
    for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    scene::SceneDescription scene;
    scene.place_time = {50.0, 14.4, 200.0, *UtcTime::Parse("2025-09-14T11:05:00Z")};
    scene.marker.size_m = 0.2;
    state_ = WindowState::For(scene, {});
    Frames(3);
  }
  void TearDown() override { ImGui::DestroyContext(); }

  void Frames(int count = 2) {
    for (int i = 0; i < count; ++i) {
      ImGui::NewFrame();
      panel_.Draw({}, {kWidth, kHeight}, now_, &state_);
      ImGui::Render();
    }
  }

  /// Moves the pointer to the control with this ImGui id. Returns false if there is none.
  bool Point(ImGuiID control) {
    ImGuiIO& io = ImGui::GetIO();
    for (int y = 2; y < static_cast<int>(kHeight); y += 6) {
      for (const float x : {20.0F, 110.0F, 160.0F}) {
        io.MousePos = {x, static_cast<float>(y)};
        Frames();
        if (ImGui::GetCurrentContext()->HoveredId == control) return true;
      }
    }
    ADD_FAILURE() << "there is no such control";
    return false;
  }
  static ImGuiID Of(const char* label) { return ImGui::FindWindowByName("Scene")->GetID(label); }
  /// For repeated names: the label within a number, or within a label.
  static ImGuiID Of(ImGuiID outer, const char* label) { return ImHashStr(label, 0, outer); }
  static ImGuiID Of(ImGuiID outer, int number) { return ImHashData(&number, sizeof number, outer); }

  void Click(bool with_control = false) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = with_control;
    io.MouseDown[0] = true;
    Frames();
    io.MouseDown[0] = false;
    io.KeyCtrl = false;
    Frames();
  }
  void Key(ImGuiKey key) {
    ImGui::GetIO().KeysDown[key] = true;
    Frames();
    ImGui::GetIO().KeysDown[key] = false;
    Frames();
  }
  void Push(ImGuiID control) {
    if (Point(control)) Click();
  }
  /// Control-click turns a slider into a text field.
  void Type(ImGuiID control, const char* text) {
    if (!Point(control)) return;
    Click(/*with_control=*/true);
    ImGui::GetIO().AddInputCharactersUTF8(text);
    Frames(4);
    Key(ImGuiKey_Enter);
  }

  const UtcTime now_ = *UtcTime::Parse("2026-03-01T09:30:00Z");
  ScenePanel panel_;
  WindowState state_;
};

TEST_F(PanelInHands, TypedNumbersChangePlaceAirAndDrawing) {
  session::SceneEdit& edit = state_.edit;
  Type(Of("latitude °N"), "-33.5");
  EXPECT_EQ(edit.latitude_deg, -33.5);
  Type(Of("longitude °E"), "151.25");
  EXPECT_EQ(edit.longitude_deg, 151.25);
  Type(Of("latitude °N"), "123");
  EXPECT_EQ(edit.latitude_deg, 90.0) << "no farther than the pole";
  Type(Of("turbidity"), "4.5");
  ASSERT_TRUE(edit.sky);
  EXPECT_NEAR(edit.sky->turbidity, 4.5, 1e-9);
  Type(Of("cloud cover"), "0.75");
  EXPECT_NEAR(edit.sky->cloud_cover, 0.75, 1e-9);
  EXPECT_NEAR(edit.sky->turbidity, 4.5, 1e-9) << "the other stays";
  Push(Of("by hand"));
  EXPECT_FALSE(edit.sky) << "as measured again";
  Type(Of("fog ×"), "300");
  EXPECT_EQ(edit.drawing.fog[0], 300.0);
  EXPECT_EQ(edit.drawing.fog[1], 300.0);
  Type(Of("convergence"), "0.05");
  EXPECT_NEAR(edit.convergence, 0.05, 1e-9);
  Type(Of("partitions"), "3");
  EXPECT_EQ(edit.drawing.shadow_partitions, 3);
  const auto texels = Of(ImGui::FindWindowByName("Scene")->GetID(1), "##texels");
  for (const auto& [step, size] : {std::pair{"2", 256}, {"4", 1024}, {"6", 4096}, {"0", 0}}) {
    Type(texels, step);
    EXPECT_EQ(edit.drawing.shadow_sizes[1], size) << "0: left open, as it was";
  }
}

TEST_F(PanelInHands, ACityIsFoundByTypingAndTheTimeIsThatOfTheDayThatIsTyped) {
  session::SceneEdit& edit = state_.edit;
  Push(Of("city"));
  ImGui::GetIO().AddInputCharactersUTF8("reykj");
  Frames(8);
  // The only remaining one lies below the field.
  ImGuiWindow* list = ImGui::GetCurrentContext()->OpenPopupStack[0].Window;
  ASSERT_NE(list, nullptr);
  ImGui::GetIO().MousePos = {list->Pos.x + 30.0F, list->Pos.y + ImGui::GetFontSize() * 2.8F};
  Frames();
  Click();
  EXPECT_NEAR(edit.latitude_deg, 64.1, 0.2);
  EXPECT_NEAR(edit.longitude_deg, -21.9, 0.2);
  const UtcTime before = state_.shown_time();
  Type(Of(Of(Of("date"), 1), ""), "12");
  EXPECT_EQ(state_.shown_time().ToCivil().month, 12);
  EXPECT_EQ(state_.shown_time().ToCivil().hour, before.ToCivil().hour);
  Push(Of("Now"));
  EXPECT_EQ(state_.shown_time(), now_);
  Push(Of("Time of the images"));
  EXPECT_EQ(state_.shown_time(), state_.frame.moment);
  if (Point(Of("##time"))) Click();
  EXPECT_LT(TimeOfDay(state_.shown_time(), 0.0), 12.0 * 3600.0) << "left on the bar is early";
  EXPECT_NE(edit.later_s, 0.0);
}

TEST_F(PanelInHands, ShadowsAreChosenByNameWithWhatTheirMethodCanBeTold) {
  session::SceneEdit& edit = state_.edit;
  edit.drawing.shadow_method = shadows::ShadowMethod::kGaussian;
  Type(Of("λ"), "0.9");
  EXPECT_NEAR(edit.drawing.shadow_split_weight, 0.9, 1e-9);
  Type(Of("blur m"), "5");
  EXPECT_NEAR(edit.drawing.shadow_blur_distance_m, 5.0, 1e-9);
  Push(Of("shadows"));
  ImGuiWindow* list = ImGui::GetCurrentContext()->OpenPopupStack[0].Window;
  ASSERT_NE(list, nullptr);
  ImGui::GetIO().MousePos = {list->Pos.x + 30.0F, list->Pos.y + ImGui::GetFontSize()};
  Frames();
  Click();
  EXPECT_EQ(edit.drawing.shadow_method, shadows::ShadowMethods().front().method);
}

TEST_F(PanelInHands, NorthIsTypedAndButtonsAskTheWindow) {
  Type(Of(Of("heading °"), ""), "77.5");
  ASSERT_TRUE(state_.edit.heading_deg);
  EXPECT_NEAR(*state_.edit.heading_deg, 77.5, 1e-9);
  Push(Of("by hand##north"));
  EXPECT_FALSE(state_.edit.heading_deg);
  Push(Of("Record"));
  EXPECT_TRUE(state_.requests.recording_change);
  Push(Of("Screenshot"));
  EXPECT_TRUE(state_.requests.screenshot);
  Push(Of("Save scene"));
  EXPECT_TRUE(state_.requests.save_scene);
  Push(Of("lock exposure"));
  EXPECT_TRUE(state_.exposure_locked);
  EXPECT_TRUE(state_.requests.exposure_change);
}

}  // namespace
}  // namespace pleinair::app
