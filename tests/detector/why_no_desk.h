// What a detection says that found no desk.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "detector/detector.h"

namespace fathom {

/// There must be neither a desk nor a cup in it.
inline std::string why_no_desk(const Detection& detection) {
  EXPECT_FALSE(detection.desk);
  EXPECT_TRUE(detection.cups.empty());
  return detection.why;
}

}  // namespace fathom
