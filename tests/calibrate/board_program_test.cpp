#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/calibrate/boards.hpp"
#include "tests/common/run_program.hpp"

namespace limbcast::calibrate {
namespace {

using limbcast::test::Outcome;
using limbcast::test::run_program;
using limbcast::test::shell_quoted;
using limbcast::test::TemporaryFolder;
using ::testing::HasSubstr;

TEST(CalibrateProgram, DrawsABoardOfTrueSizeThatIsFound) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"board", "--square-mm", "20", "--output", folder / "board.png"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("220 x 160 mm"));  // 10 x 7 squares and half a one around
  const cv::Mat image = cv::imread(folder / "board.png", cv::IMREAD_GRAYSCALE);
  const std::optional<BoardPoints> points = find_board(image, {});
  ASSERT_TRUE(points);
  const double square_px = cv::norm(points->pixels[1] - points->pixels[0]);
  EXPECT_NEAR(square_px, 0.02 / 0.0254 * 300.0, 0.6);
  std::ifstream file(folder / "board.png", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const std::size_t chunk = bytes.find("pHYs");
  ASSERT_NE(chunk, std::string::npos);
  std::uint32_t pixels_per_m = 0;
  for (int i = 0; i < 4; ++i)
    pixels_per_m = pixels_per_m << 8 | static_cast<unsigned char>(bytes[chunk + 4 + i]);
  EXPECT_NEAR(pixels_per_m * 0.02, square_px, 0.05);
}

TEST(CalibrateProgram, DrawsABoardWhoseNameEndsInCapitals) {
  const TemporaryFolder folder;
  for (const char* name : {"BOARD.PDF", "BOARD.PNG"}) {
    const Outcome outcome = run_program("limbcast-calibrate", {"board", "--output", folder / name});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_GT(std::filesystem::file_size(folder / name), 1000U);
  }
}

TEST(CalibrateProgram, RefusesBoardsThatNobodyCouldPrint) {
  const TemporaryFolder folder;
  const auto error = [&folder](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "board");
    const Outcome outcome = run_program("limbcast-calibrate", arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_EQ(error({"--output", folder / "board.docx"}),
            "limbcast-calibrate: " + folder / "board.docx" +
                ": boards are drawn as .pdf or .png; give --output such an ending\n");
  // 9 + 2 by 6 + 2 squares of 11811 px.
  EXPECT_EQ(error({"--square-mm", "1000", "--output", folder / "board.png"}),
            "limbcast-calibrate: the board has 1.23e+10 pixels, must be at most 1.07e+09; lower "
            "'dpi' or 'square-mm'\n");
}

/// A PDF as poppler shows it.
class BoardOnPaper : public ::testing::Test {
 protected:
  Outcome draw(const std::vector<std::string>& options) const {
    std::vector<std::string> all = {"board", "--output", folder_ / "board.pdf"};
    all.insert(all.end(), options.begin(), options.end());
    return run_program("limbcast-calibrate", all);
  }
  /// What a command of poppler prints of the file.
  std::string poppler(const std::string& command, const std::string& arguments) const {
    const std::string output = folder_ / "poppler.txt";
    const std::string line =
        command + " " + shell_quoted(folder_ / "board.pdf") + " " + arguments + " >" + output;
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    std::ifstream file(output, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  cv::Mat printed(int dots_per_inch) const {
    const std::string page =
        poppler("pdftoppm", "-singlefile -gray -r " + std::to_string(dots_per_inch));
    return cv::imdecode(std::vector<char>(page.begin(), page.end()), cv::IMREAD_GRAYSCALE);
  }
  TemporaryFolder folder_;
};

TEST_F(BoardOnPaper, HasTheSheetsSizeAndTrueSquaresAndIsFound) {
  const Outcome outcome = draw({});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(poppler("pdfinfo", ""), ::testing::ContainsRegex("Page size: +841.89 x 595.2[78]"));
  const int dots_per_inch = 150;
  const std::optional<BoardPoints> points = find_board(printed(dots_per_inch), {});
  ASSERT_TRUE(points);
  // The diagonal of 8 x 5 squares. Poppler puts the edges of a picture on whole pixels of 0.17 mm.
  const double diagonal_mm =
      cv::norm(points->pixels.back() - points->pixels.front()) * 25.4 / dots_per_inch;
  EXPECT_NEAR(diagonal_mm, 25.0 * std::hypot(8.0, 5.0), 0.2);
  EXPECT_THAT(poppler("pdftotext", "-"), HasSubstr("--columns 9 --rows 6, squares of 25 mm"));
}

TEST_F(BoardOnPaper, MayBeOfOtherKindsAndSizes) {
  const Outcome outcome = draw({"--board", "charuco", "--columns", "6", "--rows", "8",
                                "--square-mm", "35", "--paper", "a3"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(poppler("pdfinfo", ""), ::testing::ContainsRegex("Page size: +841.89 x 1190.5[45]"));
  Board board;
  board.kind = BoardKind::kCharuco;
  board.columns = 6;
  board.rows = 8;
  board.square_m = 0.035;
  board.marker_m = 0.7 * board.square_m;
  const std::optional<BoardPoints> points = find_board(printed(75), board);
  ASSERT_TRUE(points);
  EXPECT_EQ(static_cast<int>(points->ids.size()), board.num_points());
}

TEST_F(BoardOnPaper, MustFitOnTheSheet) {
  const Outcome outcome = draw({"--square-mm", "30", "--paper", "letter"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("330 x 240 mm, larger than the sheet of 216 x 279 mm"));
}

TEST(CalibrateProgram, RefusesToDrawABoardIntoAFolderThatIsMissing) {
  const Outcome outcome = run_program("limbcast-calibrate", {"board", "--output", "/none/b.pdf"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("there is no folder /none"));
}

}  // namespace
}  // namespace limbcast::calibrate
