// PCL writes its warnings to the terminal; a library should not. What went wrong is said by results and errors.
#pragma once

namespace fathom {

/// Silences PCL while it lives. The verbosity is PCL's own global: what other threads ask of PCL falls silent as well.
class QuietPcl {
 public:
  QuietPcl();
  ~QuietPcl();
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  int verbosity_before_;
};

}  // namespace fathom
