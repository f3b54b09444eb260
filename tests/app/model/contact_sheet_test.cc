#include "app/model/contact_sheet.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "tests/compositor/light/light_scenes.h"

namespace pleinair::app {
namespace {

/// Red, green and blue of the middle of a view: 0 front, 1 right, 2 back, 3 above.
std::array<int, 3> Middle(const RgbImage& sheet, int view) {
  const int x = sheet.width() / 4 + view % 2 * sheet.width() / 2;
  const int y = sheet.height() / 4 + view / 2 * sheet.height() / 2;
  return {sheet(x, y, 0), sheet(x, y, 1), sheet(x, y, 2)};
}

TEST(ContactSheet, ShowsTheModelFromFourSides) {
  // A red box whose front half, towards −y, is blue; far from its origin.
  constexpr double kScale = 30.0;
  const Vec3 at{50.0 * kScale, 0.0, 7.0 * kScale};
  auto model = compositor::testing::BoxModel(at + Vec3{-1, 0, 0} * kScale,
                                             at + Vec3{1, 1, 2} * kScale, {0.6F, 0.02F, 0.02F});
  const auto front = compositor::testing::BoxModel(
      at + Vec3{-1, -1, 0} * kScale, at + Vec3{1, 0, 2} * kScale, {0.02F, 0.02F, 0.6F});
  model->materials.push_back(front->materials[0]);
  model->meshes.push_back(front->meshes[0]);
  model->meshes.back().material = 1;
  const auto sheet = ContactSheet(model);
  ASSERT_TRUE(sheet) << sheet.error().Message();
  EXPECT_EQ(sheet->width(), 1280);
  EXPECT_EQ(sheet->height(), 960);
  const auto seen_front = Middle(*sheet, 0), seen_back = Middle(*sheet, 2);
  EXPECT_GT(seen_front[2], seen_front[0] + 40);
  EXPECT_GT(seen_back[0], seen_back[2] + 40);
  // Ground beside it is grey, and the sky above it is blue.
  const int ground = (*sheet)(620, 400, 1);
  EXPECT_NEAR((*sheet)(620, 400, 0), ground, 40);
  EXPECT_GT((*sheet)(620, 30, 2), (*sheet)(620, 30, 0) + 20);
}

}  // namespace
}  // namespace pleinair::app
