// A value that is costly to make and often asked for again.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace fathom {

/// Keeps the value that was made last, for as long as the same key is asked for.
template <class Key, class Value>
class LastMade {
 public:
  /// `make()` is called without a lock: a thread that waits within may take up a task that asks for a value itself.
  template <class Make>
  std::shared_ptr<const Value> get(const Key& key, Make make) {
    {
      const std::lock_guard lock(mutex_);
      if (value_ && key_ == key) return value_;
    }
    auto made = std::make_shared<const Value>(make());
    const std::lock_guard lock(mutex_);
    key_ = key;
    value_ = made;
    return made;
  }

 private:
  std::mutex mutex_;
  Key key_;
  std::shared_ptr<const Value> value_;
};

}  // namespace fathom
