// The shots behind the heights of a diagnosis, for a reader who wants to look at one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

struct Measurement;

struct ReportShot {
  std::string frame;             ///< its name in frames.csv
  std::string condition;         ///< "water, 20 mm, cup at (80, 200) mm"
  std::string cloud;             ///< a path from the report's folder
  Image<std::uint8_t> infrared;  ///< the cup with some desk around it, the brightest hundredth white; may be empty
};

struct ReportShots {
  std::vector<ReportShot> shots;
  std::vector<int> of;  ///< of each observation that of its first trial; −1: it is no height, or there is no cloud
};

/// `folders` as they were read.
ReportShots shots_of(const std::vector<Observation>& observations, const Measurement& measurement,
                     const std::vector<std::filesystem::path>& folders, const std::filesystem::path& report);

}  // namespace fathom
