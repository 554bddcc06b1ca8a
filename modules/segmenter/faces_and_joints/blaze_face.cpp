#include "modules/segmenter/faces_and_joints/blaze_face.hpp"

#include "modules/segmenter/faces_and_joints/picture_network.hpp"

// The file in ../networks/network_files.S.
extern "C" const char limbcast_blaze_face[];

namespace limbcast::segmenter {
namespace {

enum FaceOutput { kScores, kMarks };

/// The network tells of a face for each cell of the picture.
constexpr int kFaceCell_px = 4;
constexpr int kFaceCells = BlazeFace::kPictureSide_px / kFaceCell_px;

/// What it marks of each face, as column and row against the cell's middle [px]
/// (../models/README.md). The second is no place: width and height.
enum class Mark { kFace = 0, kNose = 4, kRightEar = 6, kLeftEar = 7 };
constexpr int kMarksOfAFace = 8;

/// The places that are told with one cell.
class Face {
 public:
  Face(const float* marks, int cell) : marks_(marks + 2 * kMarksOfAFace * cell) {
    const Eigen::Vector2i column_and_row(cell % kFaceCells, cell / kFaceCells);
    middle_of_cell_px_ = kFaceCell_px * (column_and_row.cast<float>().array() + 0.5F);
  }

  Eigen::Vector2f px(Mark mark) const {
    const float* from_cell_px = marks_ + 2 * static_cast<int>(mark);
    return middle_of_cell_px_ + Eigen::Vector2f(from_cell_px[0], from_cell_px[1]);
  }

 private:
  const float* marks_;
  Eigen::Vector2f middle_of_cell_px_;
};

}  // namespace

const TfliteFile& BlazeFace::file() {
  static const TfliteFile file = read_tflite(limbcast_blaze_face);
  return file;
}

BlazeFace::BlazeFace(NetworkLibrary library)
    : network_(file(), {"reshaped_classifier_face_4", "reshaped_regressor_face_4"}, library) {}

SeenFace BlazeFace::see(const cv::Mat3b& picture, float reach_px) {
  constexpr double kMiddle = 127.5;
  write_rgb(picture, 1.0 / kMiddle, -1.0, network_.input());
  network_.run();
  const Eigen::Vector2f middle_px = Eigen::Vector2f::Constant(0.5F * kPictureSide_px);
  SeenFace best;
  for (int cell = 0; cell < kFaceCells * kFaceCells; ++cell) {
    const float score = network_.output(kScores)[cell];
    if (score <= best.score) continue;
    const Face face(network_.output(kMarks), cell);
    if ((face.px(Mark::kFace) - middle_px).norm() > reach_px) continue;
    best = {score, face.px(Mark::kNose),
            0.5F * (face.px(Mark::kRightEar) + face.px(Mark::kLeftEar))};
  }
  return best;
}

}  // namespace limbcast::segmenter
