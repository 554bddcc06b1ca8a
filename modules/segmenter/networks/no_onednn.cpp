// What stands for onednn_engine.cpp where oneDNN has no kernels.
#include <stdexcept>

#include "modules/segmenter/networks/network_engine.hpp"

namespace limbcast::segmenter {

bool onednn_is_quick() { return false; }

std::unique_ptr<NetworkEngine> make_onednn_engine(const NetworkPart& /*part*/) {
  throw std::runtime_error("oneDNN is not built in");
}

}  // namespace limbcast::segmenter
