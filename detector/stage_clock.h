// How long the stages of a method take.
#pragma once

#include <chrono>
#include <string_view>
#include <vector>

namespace fathom {

struct StageTime {
  std::string_view name;
  double seconds;
};

/// Runs from its construction on; the time since the last call belongs to the stage that is named.
class StageClock {
 public:
  explicit StageClock(std::vector<StageTime>& stages) : stages_(stages) {}

  void done(std::string_view name) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    for (StageTime& stage : stages_)
      if (stage.name == name) {
        stage.seconds += seconds;
        return;
      }
    stages_.push_back({name, seconds});
  }

 private:
  std::vector<StageTime>& stages_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace fathom
