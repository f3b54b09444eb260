#include "app/model/model_facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace pleinair::app {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A slanted triangle 2 wide, 3 deep and 4 high, off its origin.
compositor::Model Triangle() {
  compositor::Model model;
  model.file = "sail.obj";
  model.written_by = "A program";
  model.materials.resize(2);
  model.materials[1].name = "canvas";
  model.materials[1].base_color_texture = 0;
  model.materials[1].alpha = compositor::Material::Alpha::kIgnored;
  model.materials[1].unsupported_features = {"displacement"};
  model.textures.emplace_back(16, 8, 3);
  compositor::Mesh& mesh = model.meshes.emplace_back();
  mesh.material = 1;
  mesh.positions = {{1, 0, 0}, {3, 3, 0}, {1, 0, 4}};
  mesh.indices = {0, 1, 2};
  return model;
}

TEST(ModelFacts, AreListedAsText) {
  const compositor::Model model = Triangle();
  const compositor::ModelFrame frame;
  const ModelFacts facts = FactsOf(model, frame, false);
  EXPECT_THAT(facts.notes, IsEmpty());
  EXPECT_THAT(ModelText(model, frame, facts),
              AllOf(HasSubstr("sail.obj: OBJ, A program\n"), HasSubstr("2 m x 3 m x 4 m"),
                    HasSubstr("[1, 0, 0] to [3, 3, 4] m"), HasSubstr("  unit       m\n"),
                    HasSubstr("those of the marker"), HasSubstr("1, of 3 vertices in 1 meshes"),
                    HasSubstr("  materials  1\n"), HasSubstr("canvas: color 0.800 0.800 0.800"),
                    HasSubstr("color: picture of 16 x 8"), HasSubstr("not drawn  displacement\n")));
}

TEST(ModelFacts, AreOneJsonObjectAFile) {
  const compositor::Model model = Triangle();
  const compositor::ModelFrame frame{UpAxis::kY, UpAxis::kZ, 0.001, false};
  const std::string line = ModelJson(model, frame, FactsOf(model, frame, true), "sheet.png");
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto json = nlohmann::json::parse(line);
  EXPECT_EQ(json["unit"], "mm");
  EXPECT_EQ(json["axes"], "y is up");
  EXPECT_THAT(json["size_m"], ElementsAre(2.0, 3.0, 4.0));
  EXPECT_EQ(json["triangles"], 1);
  EXPECT_EQ(json["materials"][0]["textures"][0]["use"], "color");
  EXPECT_EQ(json["textures"][0]["width_px"], 16);
  EXPECT_THAT(json["not_drawn"], ElementsAre("displacement"));
  EXPECT_EQ(json["sheet"], "sheet.png");
}

TEST(ModelFacts, NoteWhatIsProbablyMeantOtherwise) {
  const auto notes = [](const compositor::Model& model, bool unit_stated) {
    return FactsOf(model, {}, unit_stated).notes;
  };
  compositor::Model large = Triangle();
  for (auto& p : large.meshes[0].positions) {
    for (float& value : p) value *= 200.0F;
  }
  EXPECT_THAT(notes(large, false), ElementsAre(AllOf(HasSubstr("it is 1.077 km large"),
                                                     HasSubstr("1.077 m: unit = \"mm\""))));
  EXPECT_THAT(notes(large, true), IsEmpty());
  compositor::Model surveyed = Triangle();
  surveyed.origin_m = {458000.0, 5548000.0, 0.0};
  EXPECT_THAT(notes(surveyed, false), ElementsAre(HasSubstr("origin = \"bottom centre\"")));
  compositor::Model lying = Triangle();
  lying.meshes[0].positions = {{-1, 0, -2}, {1, 0, 2}, {0, 3, 0}};
  EXPECT_THAT(notes(lying, false), ElementsAre(HasSubstr("up = \"y\"")));
}

}  // namespace
}  // namespace pleinair::app
