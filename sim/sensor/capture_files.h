// The files of a capture, and what they mean (docs/files.md): written, and read back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image_file.h"
#include "core/json_fwd.h"
#include "sim/scene/resolved_scene.h"
#include "sim/sensor/capture.h"

namespace fathom {

/// Of one capture.
inline constexpr int kMostFrames = 100000;

/// Names of a frame's files, in the order in which they are written.
std::vector<std::string> frame_files(bool infrared, bool device_outputs);

/// Names that captures have in a folder, and those of the folders of frames that stand there.
std::vector<std::string> capture_names(const std::filesystem::path& folder);

/// Removes what an earlier capture left in its folder but for the manifest, run.json first: while it is there the
/// folder counts as complete. For the folder's owner.
void remove_capture(const std::filesystem::path& folder);

/// Where the frame of that number lies: in the folder itself when it is the only one, else in frame_0000 …
std::filesystem::path frame_folder(const std::filesystem::path& folder, int frame, int frames);

/// Counts of the detector, as an infrared stream has them.
Image<std::uint16_t> whole_dn(const Image<float>& ir);

/// Writes one frame: ir.exr and ir.png (photometric mode only), disparity.exr, depth.exr, depth.png, cloud.pcd and
/// preview.png, a picture for people. `ir_bits` is the full scale of ir.png; 0 = 10.
void write_frame(const std::filesystem::path& folder, const Frame& frame, const Image<TruePixel>& truth, int ir_bits);

/// What the device itself would send of a frame: depth_100um.png, shift.png and depth_registered.png.
void write_device_outputs(const std::filesystem::path& folder, const SensorModel& sensor, const Frame& frame);

/// The channels of truth.exr: position.X/Y/Z, apparent.Z, first.object, first.Z, object, path.
std::vector<ExrChannel> truth_channels(const Image<TruePixel>& truth);

/// truth.exr
void write_truth(const std::filesystem::path& folder, const Image<TruePixel>& truth);

/// Copies of the files that a scene names.
void write_scene_files(const std::filesystem::path& folder, const ResolvedScene& resolved);

/// The part of run.json that follows from what is shot: scene, effective sensor, media, objects, approximations,
/// timing, rays, threads. `resolved` is the camera's set-up as it can be read again.
Json run_record(const Camera& camera, const ResolvedScene& resolved);

struct RecordedCapture {
  Setup setup;                                ///< what was shot, its effects switched on
  bool infrared;                              ///< photometric mode, so that its frames have infrared images
  std::vector<std::filesystem::path> frames;  ///< the folder of each, at least one

  const SensorModel& sensor() const { return setup.rig.sensor; }
};

/// Reads run.json, which need not lie where it was written. Throws Error when the folder holds no complete capture.
RecordedCapture read_capture(const std::filesystem::path& folder);

/// Throws Error naming the first frame's file that is missing, no image of the sensor's size, or cut short. Reads
/// little of each.
void check_frames(const RecordedCapture& capture);

/// One frame's disparities and, where wanted, infrared image as they were written; the rest is left empty. Throws Error
/// naming the file that is missing, damaged or of another size than the sensor's images.
Frame read_frame(const RecordedCapture& capture, std::size_t index, bool infrared);

}  // namespace fathom
