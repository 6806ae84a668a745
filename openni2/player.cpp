#include "openni2/player.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/error.h"

namespace fathom {

Player::Player(std::unique_ptr<FrameSource> source, Ended ended)
    : source_(std::move(source)),
      ended_(std::move(ended)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

Player::~Player() = default;

void Player::require_sound() const {
  const std::lock_guard lock(mutex_);
  if (!problem_.empty()) throw Error(problem_);
}

void Player::add(const void* owner, bool wants_infrared, Receiver receiver) {
  require_sound();
  {
    const std::lock_guard lock(mutex_);
    if (!prepared_) source_->prepare();
    prepared_ = true;
  }
  {
    const std::lock_guard lock(receiving_);
    receivers_[owner] = std::move(receiver);
  }
  const std::lock_guard lock(mutex_);
  started_[owner] = wants_infrared;
  wake_.notify_all();
}

void Player::remove(const void* owner) {
  {
    const std::lock_guard lock(receiving_);
    if (receivers_.erase(owner) == 0) return;
  }
  const std::lock_guard lock(mutex_);
  started_.erase(owner);
}

void Player::set_speed(float speed) {
  const std::lock_guard lock(mutex_);
  speed_ = speed;
  wake_.notify_all();
}

void Player::set_repeats(bool repeats) {
  const std::lock_guard lock(mutex_);
  repeats_ = repeats;
  wake_.notify_all();
}

void Player::seek(int frame) {
  const std::lock_guard lock(mutex_);
  next_ = frame;
  ++seeks_;
  wake_.notify_all();
}

void Player::trigger() {
  const std::lock_guard lock(mutex_);
  triggered_ = true;
  wake_.notify_all();
}

bool Player::at_end() const { return source_->frames() && next_ >= *source_->frames(); }

bool Player::wanted() const {
  return !started_.empty() && (speed_ != kManual || triggered_) && (!at_end() || repeats_);
}

bool Player::infrared_wanted() const {
  return std::any_of(started_.begin(), started_.end(), [](const auto& owner) { return owner.second; });
}

Player::Clock::duration Player::pause() const {
  if (speed_ <= 0.0f) return Clock::duration::zero();
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / (kFramesPerSecond * speed_)));
}

std::uint64_t Player::time_us() const {
  if (source_->frames()) return handed_out_ * 1'000'000 / kFramesPerSecond;
  return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - opened_).count();
}

void Player::run(const std::stop_token& stop) {
  try {
    play(stop);
  } catch (const std::exception& problem) {
    {
      const std::lock_guard lock(mutex_);
      problem_ = problem.what();
    }
    ended_(problem.what());
  }
}

void Player::play(std::stop_token stop) {
  Clock::time_point due = Clock::now();
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return wanted(); })) {
    triggered_ = false;
    if (at_end()) next_ = 0;
    const int number = next_++, seeks = seeks_;
    const bool infrared = infrared_wanted();
    lock.unlock();
    Shot shot{source_->shoot(number, infrared), number + 1, 0};
    lock.lock();
    due = std::max(due + pause(), Clock::now());
    wake_.wait_until(lock, stop, due, [&] { return seeks_ != seeks || started_.empty(); });
    if (stop.stop_requested()) return;
    if (seeks_ != seeks) continue;
    if (started_.empty()) {
      next_ = number;
      continue;
    }
    shot.time_us = time_us();
    ++handed_out_;
    const bool last = at_end() && !repeats_;
    lock.unlock();
    {
      const std::lock_guard receiving(receiving_);
      for (const auto& [owner, receiver] : receivers_) receiver(shot);
    }
    if (last) ended_("");
    lock.lock();
  }
}

}  // namespace fathom
