#include "python/watched.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <mutex>
#include <string>
#include <thread>

#include "core/watcher.h"

namespace fathom {
namespace {

struct News {
  std::string what;
  std::size_t done, total;
};

class Listener : public Watcher {
 public:
  void hear(const std::string& what, std::size_t done, std::size_t total) override {
    const std::lock_guard lock(mutex_);
    news_ = News{what, done, total};
  }
  bool ends() const override { return ends_; }

  void end() { ends_ = true; }
  /// What was heard last, once.
  std::optional<News> news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, std::nullopt);
  }

 private:
  std::atomic<bool> ends_ = false;
  std::mutex mutex_;
  std::optional<News> news_;
};

void tell(const py::object& progress, Listener& listener) {
  if (progress.is_none()) return;
  if (const std::optional<News> news = listener.news()) progress(news->what, news->done, news->total);
}

}  // namespace

void run_watched(const py::object& progress, const std::function<void()>& work) {
  constexpr std::chrono::milliseconds kLook(50);
  Listener listener;
  std::packaged_task<void()> task([&] {
    const WatcherScope scope(&listener);
    work();
  });
  std::future<void> result = task.get_future();
  std::thread thread(std::move(task));
  const auto is_done = [&] {
    const py::gil_scoped_release others_run;
    return result.wait_for(kLook) == std::future_status::ready;
  };
  const auto join = [&] {
    const py::gil_scoped_release others_run;
    thread.join();
  };
  try {
    while (!is_done()) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      tell(progress, listener);
    }
  } catch (...) {
    listener.end();
    join();
    throw;
  }
  join();
  result.get();
  tell(progress, listener);
}

}  // namespace fathom
