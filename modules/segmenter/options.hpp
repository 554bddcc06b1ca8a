#pragma once

#include <string>

#include "common/config/options.hpp"
#include "modules/segmenter/params.hpp"

namespace limbcast::segmenter {

/// Options of the segmenter: what users turn, with their defaults.
struct SegmenterOptions {
  std::string seeds = "auto";       ///< auto, skin, shape, both
  std::string growing = "refined";  ///< refined, paper
  std::string search = "auto";      ///< auto, kdtree, lattice (only for growing = paper)
  /// Networks compute alike on every processor, in 32 bits: poses as on other computers.
  bool portable_networks = false;
  Params params;
};

/// Binds the keys of section [segmenter].
void declare(config::Section& section, SegmenterOptions& options);

/// The parameters that the options ask for. Throws UsageError where these do not fit together.
Params to_params(const SegmenterOptions& options);

}  // namespace limbcast::segmenter
