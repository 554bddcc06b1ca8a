#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace limbcast::segmenter {

enum class FirstInstance { kAtOnce, kWhenAskedFor };

/// Objects that work for one thread at a time: as many as threads ask at the same time.
template <class T>
class InstancePool {
 public:
  using Make = std::function<std::unique_ptr<T>()>;

  /// Makes the first at once, so that what `make` throws shows at the start of a program and not in
  /// its work; or, where it may never be asked for, when it is.
  explicit InstancePool(Make make, FirstInstance first = FirstInstance::kAtOnce)
      : make_(std::move(make)) {
    if (first == FirstInstance::kAtOnce) idle_.push_back(make_());
  }

  /// What `work` says of an object that is idle, or made for it. One that throws is not used again.
  template <class Work>
  auto with(const Work& work) {
    std::unique_ptr<T> instance = take();
    if (!instance) instance = make_();
    auto result = work(*instance);
    give_back(std::move(instance));
    return result;
  }

 private:
  std::unique_ptr<T> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (idle_.empty()) return nullptr;
    std::unique_ptr<T> instance = std::move(idle_.back());
    idle_.pop_back();
    return instance;
  }

  void give_back(std::unique_ptr<T> instance) {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(instance));
  }

  Make make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace limbcast::segmenter
