#include "tracker/calibration/board_finder.h"

#include <gmock/gmock.h>

#include <string>

#include "tests/tracker/calibration/board_rendering.h"
#include "tracker/calibration/calibration_board.h"

namespace pleinair::tracker {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(CalibrationBoard, SaysWhatIsWrongWithIt) {
  const auto message = [](CalibrationBoard board) {
    const Result<void> checked = CheckBoard(board);
    return checked ? std::string() : checked.error().Message();
  };
  EXPECT_THAT(message({BoardKind::kCharuco, 8, 6, 0.03, 0.0, 0, "5x5_17"}),
              AllOf(HasSubstr("5x5_17"), HasSubstr("known are 4x4_50")));
  EXPECT_THAT(message({BoardKind::kCharuco, 20, 20, 0.03, 0.0, 0, "4x4_50"}),
              HasSubstr("4x4_50 has 50 markers, and the board needs 200"));
  EXPECT_THAT(message({BoardKind::kChessboard, 1, 6, 0.03, 0.0, 0, ""}),
              HasSubstr("cannot be used"));
  EXPECT_THAT(message({BoardKind::kChessboard, 9, 6, 0.0, 0.0, 0, ""}),
              HasSubstr("greater than zero"));
  EXPECT_EQ(message({BoardKind::kCharuco, 8, 6, 0.03, 0.0, 0, "DICT_6X6_250"}), "");
}

TEST(BoardFinder, FindsNothingInPicturesWithoutTheBoardAndSaysHowItIsCounted) {
  const CalibrationBoard counted{BoardKind::kChessboard, 10, 7, 0.03, 0.0, 0, ""};
  const auto finder = BoardFinder::Create(counted);
  GreyImage empty(320, 240);
  EXPECT_FALSE((*finder)->Find(empty.view()));
  EXPECT_EQ((*finder)->Hint(empty.view()), "");
  const CalibrationBoard real{BoardKind::kChessboard, 9, 6, 0.03, 0.0, 0, ""};
  const GreyImage image =
      RenderBoard(BoardCamera(), real, BoardPoses(BoardCamera(), 0.3, 40.0)[0], {});
  EXPECT_FALSE((*finder)->Find(image.view()));
  EXPECT_THAT((*finder)->Hint(image.view()), HasSubstr("--chessboard 9x6"));
}

}  // namespace
}  // namespace pleinair::tracker
