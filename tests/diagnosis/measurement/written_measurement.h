// A measurement directory of ideal clouds, as a laboratory writes it.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "core/files.h"
#include "tests/core/temporary_folder.h"
#include "tests/diagnosis/measurement/ideal_cloud.h"

namespace fathom {

inline constexpr const char* kFrameColumns =
    "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,";

/// rig.json of the paper's cup, and clouds/a.pcd of a disc 20 mm high where a cup at (0, 300) mm stands.
struct WrittenMeasurement : testing::Test {
  TemporaryFolder folder;

  void SetUp() override {
    make_directory(folder / "clouds");
    write_pcd(folder / "clouds/a.pcd", ideal_cloud(kHeight, 0.020));
    write_rig();
  }
  /// `more`: further keys, a comma before them.
  void write_rig(const std::string& more = "", double height_mm = 650.0) const {
    write_text(folder / "rig.json", fmt::format(R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": {},
        "pitch_deg": {}}}, "cup": {{}}, "liquids": {{"water": "water"}}{}}})",
                                                height_mm, kPitchDeg, more));
  }
};

}  // namespace fathom
