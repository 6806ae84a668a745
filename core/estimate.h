// Values from random samples, with what they are worth.
#pragma once

#include <cmath>
#include <cstdint>

namespace fathom {

struct Estimate {
  double value = 0.0;
  double standard_error = 0.0;
};

/// Mean and standard error of samples that come one by one, or in parts that are put together in a fixed order.
class Mean {
 public:
  void add(double sample) {
    ++count_;
    const double off = sample - mean_;
    mean_ += off / static_cast<double>(count_);
    squares_ += off * (sample - mean_);
  }

  /// As if the other's samples had been added here (Chan, Golub & LeVeque 1983).
  void add(const Mean& other) {
    if (other.count_ == 0) return;
    const double n = static_cast<double>(count_), m = static_cast<double>(other.count_), off = other.mean_ - mean_;
    mean_ += off * m / (n + m);
    squares_ += other.squares_ + off * off * n * m / (n + m);
    count_ += other.count_;
  }

  std::uint64_t count() const { return count_; }
  /// At least two samples.
  Estimate estimate() const {
    const double n = static_cast<double>(count_);
    return {mean_, std::sqrt(squares_ / (n * (n - 1.0)))};
  }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;  ///< Σ (sample − mean)²
};

}  // namespace fathom
