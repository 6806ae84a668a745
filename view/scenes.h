// Folders of results as the pages' data.
#pragma once

#include <filesystem>

#include "core/json.h"

namespace fathom {

/// Frame number `frame` of the capture in `folder`: sensor, meshes, and every pixel with its rays. Throws Error when
/// the folder holds no complete capture, when it has no such frame, when its depths are damaged or were moved to the
/// colour camera's view.
Json capture_scene(const std::filesystem::path& folder, int frame);

/// What was found in a detection's cloud number `number`, and its points in the desk's frame, each with what it belongs
/// to. Throws Error when the folder holds no detection or not that cloud, and when its files are damaged.
Json detection_scene(const std::filesystem::path& folder, int number);

/// Every condition of a diagnosis with the heights in its cup, measured and as the model has them before and after what
/// was found, and the points of one of its clouds where shots.json has one. Throws Error when the folder holds no
/// diagnosis of heights, and when its files are damaged.
Json diagnosis_scene(const std::filesystem::path& folder);

}  // namespace fathom
