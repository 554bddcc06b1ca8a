#include "modules/calibrate/pdf.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "common/config/options.hpp"
#include "common/formatted.hpp"
#include "common/units.hpp"
#include "common/whole_file.hpp"

namespace limbcast::calibrate {
namespace {

/// PDF's unit of length (ISO 32000-1, 8.3.2.3).
constexpr double kPointsPerMillimetre = 72.0 / 25.4;

/// The filter RunLengthDecode (ISO 32000-1, 7.4.5), here with runs of equal bytes only: n > 128,
/// then the byte that comes 257 - n times; 0, then a single byte.
std::string run_length_coded(const cv::Mat& image) {
  constexpr int kLongestRun = 128, kRunBase = 257;
  constexpr char kSingle = 0, kEnd = static_cast<char>(128);
  std::string coded;
  for (int row = 0; row < image.rows; ++row) {
    const auto* pixels = image.ptr<std::uint8_t>(row);
    for (int column = 0, run = 0; column < image.cols; column += run) {
      run = 1;
      while (run < kLongestRun && column + run < image.cols &&
             pixels[column + run] == pixels[column])
        ++run;
      coded += run == 1 ? kSingle : static_cast<char>(kRunBase - run);
      coded += static_cast<char>(pixels[column]);
    }
  }
  return coded + kEnd;
}

std::string stream_object(const std::string& dictionary, const std::string& bytes) {
  return formatted("<< %s /Length %zu >>\nstream\n", dictionary.c_str(), bytes.size()) + bytes +
         "\nendstream";
}

std::string image_object(const cv::Mat& image) {
  return stream_object(formatted("/Type /XObject /Subtype /Image /Width %d /Height %d /ColorSpace "
                                 "/DeviceGray /BitsPerComponent 8 /Filter /RunLengthDecode",
                                 image.cols, image.rows),
                       run_length_coded(image));
}

/// Header, objects, the table of where they begin, trailer (ISO 32000-1, 7.5). The first object is
/// the catalog.
std::string pdf_file(const std::vector<std::string>& objects) {
  std::string file = "%PDF-1.4\n";
  std::string table = formatted("xref\n0 %zu\n0000000000 65535 f \n", objects.size() + 1);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    table += formatted("%010zu 00000 n \n", file.size());
    file += formatted("%zu 0 obj\n", i + 1) + objects[i] + "\nendobj\n";
  }
  const std::size_t table_at = file.size();
  return file + table +
         formatted("trailer\n<< /Size %zu /Root 1 0 R >>\nstartxref\n%zu\n%%%%EOF\n",
                   objects.size() + 1, table_at);
}

bool fits(double width_mm, double height_mm, const Paper& paper) {
  return width_mm <= paper.width_mm && height_mm <= paper.height_mm;
}

/// The sheet as the picture fits on it.
Paper turned_to_fit(double width_mm, double height_mm, const Paper& paper) {
  const Paper across{paper.height_mm, paper.width_mm};
  if (fits(width_mm, height_mm, paper)) return paper;
  if (fits(width_mm, height_mm, across)) return across;
  throw config::UsageError(formatted(
      "the board with its white margin is %.0f x %.0f mm, larger than the sheet of %.0f x "
      "%.0f mm; give a larger 'paper' or smaller squares",
      width_mm, height_mm, paper.width_mm, paper.height_mm));
}

}  // namespace

Paper paper_of(const std::string& name) {
  static const std::map<std::string, Paper> kPapers = {
      {"a4", {210.0, 297.0}}, {"a3", {297.0, 420.0}}, {"letter", {215.9, 279.4}}};
  return kPapers.at(name);
}

void write_pdf_of_size(const std::string& path, const cv::Mat& image, double pixels_per_m,
                       const Paper& paper, const std::string& caption) {
  constexpr double kCaptionMargin_mm = 4.0;
  const double width_mm = kMillimetersPerMeter<double> * image.cols / pixels_per_m;
  const double height_mm = kMillimetersPerMeter<double> * image.rows / pixels_per_m;
  const Paper sheet = turned_to_fit(width_mm, height_mm, paper);
  const auto points = [](double length_mm) { return kPointsPerMillimetre * length_mm; };
  const std::string contents =
      formatted("q %.4f 0 0 %.4f %.4f %.4f cm /Board Do Q\n", points(width_mm), points(height_mm),
                points(0.5 * (sheet.width_mm - width_mm)),
                points(0.5 * (sheet.height_mm - height_mm))) +
      formatted("BT /Caption 8 Tf %.4f %.4f Td (%s) Tj ET", points(kCaptionMargin_mm),
                points(kCaptionMargin_mm), caption.c_str());
  const std::string page = formatted(
      "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 %.4f %.4f] /Contents 4 0 R /Resources "
      "<< /XObject << /Board 5 0 R >> /Font << /Caption 6 0 R >> >> >>",
      points(sheet.width_mm), points(sheet.height_mm));
  write_whole_file(path, pdf_file({"<< /Type /Catalog /Pages 2 0 R >>",
                                   "<< /Type /Pages /Kids [3 0 R] /Count 1 >>", page,
                                   stream_object("", contents), image_object(image),
                                   "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"}));
}

}  // namespace limbcast::calibrate
