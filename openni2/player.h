// The thread that takes frames from their source, at the pace of the device or at what the source can give, and hands
// each of them to every stream that is started: all streams of a device show the same shot.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "openni2/frame_source.h"

namespace fathom {

inline constexpr int kFramesPerSecond = 30;

struct Shot {
  Frame frame;
  int number;             ///< from 1, rising; of a folder the place in it
  std::uint64_t time_us;  ///< rising: of a live scene since it was opened, of a folder as if shot at kFramesPerSecond
};

class Player {
 public:
  using Receiver = std::function<void(const Shot&)>;
  /// Called on the player's thread when no more frames will come: the last one was played, or the error's line.
  using Ended = std::function<void(const std::string& problem)>;

  Player(std::unique_ptr<FrameSource> source, Ended ended);
  ~Player();  ///< waits for the frame in hand

  const FrameSource& source() const { return *source_; }

  /// The first receiver waits until the source is prepared. Throws Error. Receivers are called on the player's thread,
  /// those that want no infrared image perhaps without.
  void add(const void* owner, bool wants_infrared, Receiver receiver);
  /// Throws Error when no more frames will come because of an error: with its line.
  void require_sound() const;
  /// After it returns that receiver is not called any more.
  void remove(const void* owner);

  // Of a folder, as OpenNI2 defines them.
  static constexpr float kFastest = 0.0f;  ///< without pauses
  static constexpr float kManual = -1.0f;  ///< one frame for each trigger()
  float speed() const { return speed_; }
  void set_speed(float speed);  ///< a factor of kFramesPerSecond, kFastest or kManual
  bool repeats() const { return repeats_; }
  void set_repeats(bool repeats);
  void seek(int frame);  ///< the next frame to be handed out, from 0
  void trigger();

 private:
  using Clock = std::chrono::steady_clock;

  void run(const std::stop_token& stop);
  void play(std::stop_token stop);
  bool wanted() const;           ///< with mutex_ held
  bool infrared_wanted() const;  ///< with mutex_ held
  bool at_end() const;           ///< with mutex_ held
  Clock::duration pause() const;
  std::uint64_t time_us() const;

  std::unique_ptr<FrameSource> source_;
  Ended ended_;
  const Clock::time_point opened_ = Clock::now();

  mutable std::mutex mutex_;  ///< of what follows; never held while receivers run
  std::condition_variable_any wake_;
  bool prepared_ = false;
  std::string problem_;                  ///< why no more frames will come; empty while they do
  std::map<const void*, bool> started_;  ///< the receivers' owners, and whether they want infrared images
  int next_ = 0;
  std::uint64_t handed_out_ = 0;
  int seeks_ = 0;
  std::atomic<float> speed_ = 1.0f;  ///< these two are read without it as well
  std::atomic<bool> repeats_ = true;
  bool triggered_ = false;

  std::mutex receiving_;  ///< held while receivers run
  std::map<const void*, Receiver> receivers_;

  std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace fathom
