// Progress of long work on stderr: done, rate, time left. Silent when stderr is no terminal or --quiet was given. The
// work's watcher hears of it in any case, and may end it with each step (core/watcher.h).
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace fathom {

class Progress {
 public:
  Progress(std::string what, std::size_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more item is done. Any thread may say so.
  void step();

  /// So many items of so many are done, where the total is found out on the way.
  void reach(std::size_t done, std::size_t total);

 private:
  void tell() const;
  void show() const;

  std::mutex mutex_;
  std::string what_;
  std::size_t total_;
  std::size_t done_ = 0;
  bool shown_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace fathom
