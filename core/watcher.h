// Somebody who waits for long work: hears how far it is, and may end it.
#pragma once

#include <cstddef>
#include <exception>
#include <string>

namespace fathom {

class Watcher {
 public:
  virtual ~Watcher() = default;
  /// So many items of `what` are done. Any thread may say so.
  virtual void hear(const std::string& what, std::size_t done, std::size_t total) = 0;
  /// Whether the work shall end. Any thread may ask, often.
  virtual bool ends() const = 0;
};

/// Thrown out of work that its watcher ends.
class Ended : public std::exception {
 public:
  const char* what() const noexcept override { return "ended by its watcher"; }
};

/// Who watches what this thread does; null: nobody.
Watcher* watcher();

/// Makes `watcher` that of this thread while the scope lives. Loops (core/parallel.h) pass it on to their threads.
class WatcherScope {
 public:
  explicit WatcherScope(Watcher* watcher);
  ~WatcherScope();
  WatcherScope(const WatcherScope&) = delete;
  WatcherScope& operator=(const WatcherScope&) = delete;

 private:
  Watcher* before_;
};

/// Throws Ended where the watcher of this thread ends the work.
void go_on();

}  // namespace fathom
