#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/human_model/human_model.hpp"
#include "modules/pose_fitter/paper/cluster.hpp"
#include "modules/pose_fitter/paper/paper_params.hpp"

namespace limbcast::pose_fitter {

/// Where a link starts and what it is restricted by.
struct LinkStart {
  Eigen::Vector3f position_m;
  /// Direction of the link it hangs on; zero for the first.
  Eigen::Vector3f parent_direction;
};

/// What "find best fit" found for one link.
struct LinkFit {
  bool valid = false;
  Eigen::Vector3f end_m;      ///< p_s
  float distance_m = 0.0F;    ///< between reference point p_r and p_s
  float mean_density = 0.0F;  ///< along the link
};

/// findBestFit of Algorithm 2, on one cluster.
class LinkFitter {
 public:
  LinkFitter(const Cluster& cluster, const PaperFitterParams& params);

  /// The best end for `link` among the cluster's points near the reference point, which lies in
  /// `direction` of the start at the link's length. Not valid: no point keeps the restrictions.
  LinkFit find_best_fit(const Link& link, const LinkStart& start,
                        const Eigen::Vector3f& direction) const;

 private:
  const Cluster& cluster_;
  const PaperFitterParams& params_;
  float min_turn_cosine_, min_bend_cosine_;
};

}  // namespace limbcast::pose_fitter
