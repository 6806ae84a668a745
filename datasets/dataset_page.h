// What a data set holds, for people: its first frames and what was drawn.
#pragma once

#include <filesystem>

#include "datasets/scene_folder.h"

namespace fathom {

/// index.html beside the frames, of a data set that is complete: thumbnails, and histograms of cups a frame, liquids,
/// fills, shares that are in sight, distances and heights of the sensor.
void write_dataset_page(const std::filesystem::path& folder, const Dataset& dataset);

}  // namespace fathom
