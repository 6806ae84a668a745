#include "core/input_record.h"

#include <mutex>

#include "core/hash.h"

namespace fathom {
namespace {

std::mutex guard;
InputRecord* innermost = nullptr;

}  // namespace

InputRecord::InputRecord() {
  const std::lock_guard lock(guard);
  outer_ = innermost;
  innermost = this;
}

InputRecord::~InputRecord() {
  const std::lock_guard lock(guard);
  innermost = outer_;
}

void InputRecord::add(const std::filesystem::path& path, std::string sha256) {
  files_[path.lexically_normal().string()] = std::move(sha256);
}

void record_input(const std::filesystem::path& path, std::string_view content) {
  const std::lock_guard lock(guard);
  if (innermost) innermost->add(path, sha256(content));
}

void record_input_file(const std::filesystem::path& path) {
  const std::lock_guard lock(guard);
  if (innermost) innermost->add(path, sha256_of_file(path));
}

}  // namespace fathom
