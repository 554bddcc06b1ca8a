#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <vector>

#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/classifiers/network_training.hpp"
#include "tests/segmenter/recorded_frames.hpp"

/// What is alike in the training of networks that decide on single points of a lattice.
namespace limbcast::segmenter {

/// Points on other things, and on bodies.
using SortedPoints = std::array<std::vector<std::uint32_t>, 2>;

/// Tells points on bodies from points on other things. Sensors' silhouettes are wider than the true
/// masks: a band around the bodies is neither.
class PointSorter {
 public:
  explicit PointSorter(const LoadedFrame& frame);

  void add(const Lattice& lattice, std::uint32_t point, SortedPoints& sorted) const;

 private:
  cv::Mat1b body_, body_and_band_;
};

/// What a network sees of a point, as it is or mirrored.
using PointInputOf = std::function<std::vector<float>(std::uint32_t point, bool mirrored)>;

/// Adds points that are drawn at random, at most so many of bodies and of other things.
void add_drawn_points(SortedPoints& sorted, std::size_t max_body_points,
                      std::size_t max_other_points, const PointInputOf& input, std::mt19937& random,
                      std::vector<Example>& examples);

struct PointTraining {
  const char* program;  ///< its name
  const char* network;  ///< name of the network in the file that is written
  int epochs;
  void (*add_examples)(const LoadedFrame& frame, const Params& params, std::mt19937& random,
                       std::vector<Example>& examples);
};

/// The whole program: PROGRAM OUT.inc FOLDER... reads each folder's camera frames that have masks
/// (pairs through the reconstructor), but not those that are for checking, trains the network and
/// prints how it decides. Returns the exit code.
int train_on_points(int argc, char** argv, const PointTraining& training);

}  // namespace limbcast::segmenter
