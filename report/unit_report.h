// What fathom calibrate says and shows of a device.
#pragma once

#include <filesystem>
#include <vector>

#include "core/rows.h"
#include "diagnosis/unit/calibration.h"

namespace fathom {

std::vector<Row> unit_rows(const UnitCalibration& unit);

/// unit_map.csv and its picture, and report.html, last.
void write_unit_report(const std::filesystem::path& folder, const UnitCalibration& unit);

}  // namespace fathom
