// The files of a capture, and what they mean (docs/files.md).
#pragma once

#include <filesystem>

#include "core/json.h"
#include "sim/sensor/capture.h"

namespace fathom {

/// Writes one frame: ir.exr and ir.png (photometric mode only), disparity.exr, depth.exr, depth.png, cloud.pcd and
/// preview.png, a picture for people.
void write_frame(const std::filesystem::path& folder, const Frame& frame, const Image<TruePixel>& truth);

/// truth.exr: position.X/Y/Z, apparent.Z, object, path.
void write_truth(const std::filesystem::path& folder, const Image<TruePixel>& truth);

/// The part of run.json that follows from setup and camera: scene, effective sensor, media, objects, approximations,
/// timing, rays, threads.
Json run_record(const Setup& setup, const Camera& camera);

}  // namespace fathom
