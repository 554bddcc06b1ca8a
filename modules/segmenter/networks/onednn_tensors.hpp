#pragma once

#include <cstdint>
#include <dnnl.hpp>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "modules/segmenter/networks/network_engine.hpp"

namespace limbcast::segmenter {

/// Whether oneDNN uses these instructions on this processor ($ONEDNN_MAX_CPU_ISA may forbid them).
bool onednn_has(dnnl::cpu_isa instructions);
/// Whether this processor computes with brain floats of 16 bits (AVX512_BF16, AMX).
bool computes_brain_floats();

/// What oneDNN computes, call after call, in the caller's thread.
class OneDnnCalls {
 public:
  using Arguments = std::unordered_map<int, dnnl::memory>;

  const dnnl::engine& engine() const { return engine_; }
  void add(dnnl::primitive primitive, Arguments arguments);
  void add_copy(const dnnl::memory& from, const dnnl::memory& to);
  /// The same at once, and never again.
  void copy_now(dnnl::memory from, dnnl::memory to);
  void run();

 private:
  struct Call {
    dnnl::primitive primitive;
    Arguments arguments;
  };

  dnnl::engine engine_{dnnl::engine::kind::cpu, 0};
  dnnl::stream stream_{engine_};
  std::vector<Call> calls_;
};

/// A network's tensors in oneDNN's memory: rows, columns and channels as TensorFlow has them, in
/// 16 bits where the processor computes with them and that is exact enough. What is needed no more
/// gives its memory to others.
class OneDnnTensors {
 public:
  using Type = dnnl::memory::data_type;

  /// `calls` live longer than this object.
  OneDnnTensors(const NetworkPart& part, OneDnnCalls& calls);

  const TfliteTensor& told(std::uint32_t index) const { return file_.tensors.at(index); }
  /// What a tensor is computed in.
  Type computed_type(std::uint32_t index) const;
  /// What it is kept in.
  Type kept_type(std::uint32_t index) const;
  dnnl::memory::desc description(std::uint32_t index) const;

  /// A step's input, computed before or constant.
  const dnnl::memory& input(const TfliteStep& step, std::size_t index);
  /// A step's first input with numbers of this type.
  dnnl::memory input_as(Type type, const TfliteStep& step);
  /// Constants as a primitive wants them.
  dnnl::memory constant(std::uint32_t index, const dnnl::memory::desc& as_told,
                        const dnnl::memory::desc& wanted);
  /// Memory for a tensor that is computed: that of one which is needed no more, or new.
  dnnl::memory output(std::uint32_t index);
  /// Memory of its own, of zeros.
  dnnl::memory output_of_zeros(std::uint32_t index);
  /// Lets a tensor be what another one is.
  void make_same(std::uint32_t index, std::uint32_t other);
  /// To be called when that step, of this number, has been added.
  void release_inputs(const TfliteStep& step, std::size_t number);

  void copy_from(float* numbers, std::uint32_t index);
  void copy_to(float* numbers, std::uint32_t index);

 private:
  void find_exact_tensors(const NetworkPart& part);
  dnnl::memory& own(const dnnl::memory::desc& description);

  const TfliteFile& file_;
  OneDnnCalls& calls_;
  std::set<std::uint32_t> is_exact_;
  std::map<std::uint32_t, std::size_t> last_use_;  ///< number of the step
  std::map<std::uint32_t, dnnl::memory> memories_;
  using Bytes = std::pair<std::size_t, void*>;
  std::multimap<std::size_t, void*> idle_;
  std::map<std::uint32_t, Bytes> busy_;
  std::vector<dnnl::memory> owned_;
};

}  // namespace limbcast::segmenter
