#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/scene/surfaces.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

/// Clusters that grow from all heads together over a lattice: each point goes to the head that is
/// nearest along the surface, so that people who touch are parted about half-way between their
/// heads. What hides a part of a body is crossed where the surface goes on behind it. Shortest ways
/// from many starts: E. W. Dijkstra, "A note on two problems in connexion with graphs", 1959.
class JointGrowth {
 public:
  /// Grows at once, over points that `taken`, where it is told, gives no label. The lattice must
  /// outlive the object.
  JointGrowth(const Lattice& lattice, std::vector<HeadCandidate> heads,
              const JointGrowingParams& params, const ReachParams& reach,
              const std::vector<std::int16_t>* taken = nullptr);

  /// Gives the points of one head to the others, as if it had never been there. Returns the heads
  /// whose clusters, or what lies beside them, changed.
  std::vector<std::int16_t> drop(std::int16_t head);
  /// The points that the head dropped last had.
  const std::vector<std::uint32_t>& freed() const { return freed_; }
  /// Takes the last drop back, if nothing was changed since.
  void undo_drop();

  /// How many places are remembered where a surface goes on behind what hides it: each once.
  std::size_t bridge_count() const { return bridges_.size(); }

  /// Grows again without some points: what turned out to be no part of a body.
  void grow_without(const std::vector<std::uint32_t>& points);
  /// Grows again over some of the points that heads have, and over nothing else.
  void grow_within(const std::vector<std::uint32_t>& points);

  const std::vector<HeadCandidate>& heads() const { return heads_; }
  bool dropped(std::int16_t head) const { return dropped_[static_cast<std::size_t>(head)]; }
  /// For each point of the lattice the index of its head, or kNobody.
  const std::vector<std::int16_t>& labels() const { return labels_; }

 private:
  /// A place where the surface may go on behind what hides it.
  struct Bridge {
    std::uint32_t from, to;
  };
  /// What a point was before it changed.
  struct Change {
    std::uint32_t point;
    std::int16_t label;
    float way_m;
  };

  void grow_anew();
  void start(std::int16_t head);
  void grow();
  void visit(std::uint32_t i);
  void step_to_neighbors(std::uint32_t i, int u, int v);
  void step_behind(std::uint32_t i, int u, int v);
  std::optional<std::uint32_t> find_behind(std::uint32_t i, int du, int dv);
  bool may_be_a_limb(std::uint32_t i);
  void relax(std::uint32_t from, std::uint32_t to, float way_m);
  void queue(std::uint32_t i);
  bool reachable(const Eigen::Vector3f& point_m, std::int16_t head) const;
  void set(std::uint32_t i, std::int16_t label, float way_m);
  void free_points(std::int16_t head);
  void queue_around_freed();

  const Lattice* lattice_;
  std::vector<HeadCandidate> heads_;
  std::vector<bool> dropped_, changed_;
  JointGrowingParams params_;
  ReachParams reach_;
  std::vector<std::int16_t> labels_;
  std::vector<std::uint8_t> forbidden_;  ///< empty, or 1 for a point that nobody may have
  std::vector<float> way_m_;             ///< from the head's surface
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::size_t bucket_ = 0;  ///< the one that is being walked
  std::vector<Bridge> bridges_;
  std::vector<std::uint8_t> bridged_;  ///< 1 for a point whose bridges are among them
  // Of the last drop: what it changed, so that it can be taken back.
  bool dropping_ = false;
  std::int16_t last_dropped_ = kNobody;
  std::vector<std::uint32_t> freed_;
  std::vector<Change> changes_;
  std::size_t bridges_before_ = 0;
  std::optional<Surfaces> surfaces_;  ///< made when the first bridge is looked for
};

/// The labels of a JointGrowth that loses no head.
std::vector<std::int16_t> grow_together(const Lattice& lattice,
                                        const std::vector<HeadCandidate>& heads,
                                        const JointGrowingParams& params, const ReachParams& reach);

}  // namespace limbcast::segmenter
