#include <cstdio>
#include <opencv2/core/mat.hpp>

#include "common/config/log.hpp"
#include "common/config/output_file.hpp"
#include "common/file_extension.hpp"
#include "common/formatted.hpp"
#include "modules/calibrate/board.hpp"
#include "modules/calibrate/commands.hpp"
#include "modules/calibrate/output.hpp"
#include "modules/calibrate/pdf.hpp"

namespace limbcast::calibrate {
namespace {

struct DrawingParams {
  /// Side of a square below which no board is drawn [px]. A ChArUco marker of 6 x 6 with its border
  /// has 8 cells on 0.7 of a square; 16 px leave each more than one pixel.
  int min_square_px = 16;
  /// What OpenCV reads at most; 1 GB.
  double max_pixels = 1 << 30;
};

bool is_pdf(const std::string& path) { return extension_of(path) == ".pdf"; }

void check_ending(const std::string& path) {
  if (!is_pdf(path) && extension_of(path) != ".png")
    throw config::UsageError(path +
                             ": boards are drawn as .pdf or .png; give --output such an ending");
}

/// The side of a square.
int square_pixels(const BoardOptions& options, double dots_per_inch) {
  constexpr double kMillimetresPerInch = 25.4;
  const DrawingParams params;
  const int square_px = cvRound(options.square_mm * dots_per_inch / kMillimetresPerInch);
  if (square_px < params.min_square_px)
    throw config::UsageError(
        formatted("a square has %d pixels, must be at least %d; raise 'dpi' or 'square-mm'",
                  square_px, params.min_square_px));
  // With the squares outside the inner corners and the margin.
  const double pixels =
      static_cast<double>(options.columns + 2) * square_px * (options.rows + 2) * square_px;
  if (pixels > params.max_pixels)
    throw config::UsageError(
        formatted("the board has %.3g pixels, must be at most %.3g; lower 'dpi' or 'square-mm'",
                  pixels, params.max_pixels));
  return square_px;
}

/// What those who find the sheet later need for --board, --columns, --rows and --square-mm.
std::string caption_of(const BoardOptions& options) {
  return formatted("limbcast %s, --columns %d --rows %d, squares of %g mm where printed at 100 %%",
                   options.kind.c_str(), options.columns, options.rows, options.square_mm);
}

}  // namespace

bool run_board(int argc, const char* const* argv) {
  constexpr double kMillimetres = 1e3;
  BoardOptions options;
  std::string output;
  std::string paper = "a4";
  double dots_per_inch = 300.0;
  config::Section section("calibrate");
  declare(section, options);
  section.add("output", output, "file to write, .pdf or .png, of true size when printed at 100 %");
  section.add_choice("paper", paper, {"a4", "a3", "letter"}, "sheet of a PDF");
  section.add("dpi", dots_per_inch, "pixels per inch",
              "resolution, rounded to whole pixels a square", {50.0, 2400.0});
  config::Parser parser("limbcast-calibrate board", "Draws a board to print in true size.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return true;
  config::configure_log("calibrate", parser.common().log_level);
  if (output.empty()) throw config::UsageError("--output is missing; see --help");
  config::check_output_file("--output", output);
  check_ending(output);

  const Board board = to_board(options);
  const int square_px = square_pixels(options, dots_per_inch);
  const double pixels_per_m = square_px / board.square_m;
  const cv::Mat image = draw_board(board, square_px);
  if (is_pdf(output)) {
    write_pdf_of_size(output, image, pixels_per_m, paper_of(paper), caption_of(options));
  } else {
    write_png_of_size(output, image, pixels_per_m);
  }
  std::printf(
      "written: %s, %.0f x %.0f mm; print at 100 %%, measure a square and tell it with "
      "--square-mm\n",
      output.c_str(), kMillimetres * image.cols / pixels_per_m,
      kMillimetres * image.rows / pixels_per_m);
  return true;
}

}  // namespace limbcast::calibrate
