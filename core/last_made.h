// Values that are costly to make and often asked for again.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <mutex>
#include <utility>

namespace fathom {

/// Keeps the values that were made last, `kMost` of them.
template <class Key, class Value, std::size_t kMost = 1>
class LastMade {
 public:
  /// `make()` is called without a lock: a thread that waits within may take up a task that asks for a value itself.
  template <class Make>
  std::shared_ptr<const Value> get(const Key& key, Make make) {
    {
      const std::lock_guard lock(mutex_);
      const auto kept = std::find_if(kept_.begin(), kept_.end(), [&](const auto& entry) { return entry.first == key; });
      if (kept != kept_.end()) return kept->second;
    }
    auto made = std::make_shared<const Value>(make());
    const std::lock_guard lock(mutex_);
    if (kept_.size() == kMost) kept_.pop_front();
    kept_.emplace_back(key, made);
    return made;
  }

 private:
  std::mutex mutex_;
  std::deque<std::pair<Key, std::shared_ptr<const Value>>> kept_;
};

}  // namespace fathom
