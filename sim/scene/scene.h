// What stands in front of the sensor, as plain data: desk, cups, liquids, objects. Lengths in metres, angles in
// radians.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/cup_profile.h"
#include "core/json_fwd.h"
#include "core/pose.h"
#include "sim/optics/medium.h"
#include "sim/scene/cavity.h"
#include "sim/scene/gltf.h"

namespace fathom {

struct Desk {
  double albedo = 0.55;
  std::optional<Coat> glaze;
  Eigen::Vector2d size{1.4, 1.0};    ///< along x and y
  Eigen::Vector2d centre{0.0, 0.5};  ///< so that the near edge stands under the sensor

  bool operator==(const Desk&) const = default;
};

/// A handle: a tube of circular section, bent into half an ellipse in the vertical plane at the cup's yaw.
struct Handle {
  double low = 0.020;    ///< height above the desk where it leaves the wall
  double high = 0.070;   ///< height where it joins the wall again
  double reach = 0.030;  ///< how far its centre line stands out of the wall
  double tube_radius = 0.005;

  bool operator==(const Handle&) const = default;
};

/// A body of revolution.
struct CupShape : CupProfile {
  std::string name;
  double albedo = 0.70;
  std::optional<Coat> glaze;       ///< of an opaque wall
  std::optional<Medium> material;  ///< of a wall that light enters; without one the wall is opaque
  std::optional<Handle> handle;
  std::string source;

  /// Volume [m³] of a liquid of a depth [m] above the inner bottom's centre: the integral of π r² over the profile.
  double volume(double depth) const;
  /// Angle by which the inner wall leans outward there, over 1 mm.
  double wall_lean(double height_above_desk) const;

  bool operator==(const CupShape&) const = default;
};

/// A cup from a glTF file, placed in the world.
struct MeshCup {
  std::string name;                      ///< the file's
  std::vector<GltfPart> parts;           ///< in the world
  Pose world_from_mesh;                  ///< after glTF's +Y up became z up
  std::shared_ptr<const Cavity> cavity;  ///< of the parts, where a liquid is asked for

  bool operator==(const MeshCup& other) const;
};

struct Ripple {
  double wavelength;
  double amplitude;
  double azimuth;  ///< of the direction in which the phase grows, from +x towards +y in the world
  double phase;    ///< at the cup's axis; 0: level there, rising

  bool operator==(const Ripple&) const = default;
};

/// How a liquid meets an upright wall.
struct Wetting {
  double contact_angle;  ///< in the liquid; below π/2 it climbs the wall
  double capillary_length;

  bool operator==(const Wetting&) const = default;
};

/// What makes a liquid's surface other than level. The parts are added.
struct LiquidForm {
  double tilt = 0.0;
  double tilt_azimuth = 0.0;  ///< in which it rises, from +x towards +y in the world
  std::vector<Ripple> ripples;
  std::optional<Wetting> wetting;

  bool level() const { return tilt == 0.0 && ripples.empty() && !wetting; }

  bool operator==(const LiquidForm&) const = default;
};

struct Filling {
  Medium medium;
  /// Of the liquid above the cavity's lowest point (of a CupShape the inner bottom's centre); of its level with ripples
  /// and meniscus.
  double depth = 0.0;
  LiquidForm form = {};

  bool operator==(const Filling&) const = default;
};

struct Cup {
  std::variant<CupShape, MeshCup> shape;
  Eigen::Vector2d position{0.0, 0.4};  ///< of the axis, or the glTF file's origin, on the desk
  double yaw = 0.0;                    ///< direction of the handle, from +x towards +y
  std::optional<Filling> filling;

  bool operator==(const Cup&) const = default;
};

struct Box {
  Eigen::Vector3d size;  ///< along x, y, z; the middle of its base is the origin

  bool operator==(const Box&) const = default;
};

/// Bounded by what a profile sweeps: (radius, height) from the axis, round the outside, back to the axis above.
struct Revolved {
  std::vector<Eigen::Vector2d> profile;

  bool operator==(const Revolved&) const = default;
};

/// What stands or lies about, without refraction: goods, crockery, an empty cup turned over.
struct Solid {
  std::string name;
  std::variant<Box, Revolved, CupShape> form;
  double albedo = 0.5;

  bool operator==(const Solid&) const = default;
};

struct Object {
  std::variant<std::filesystem::path, Solid> thing;  ///< a glTF file, or
  Pose world_from_object = Pose::Identity();         ///< after glTF's +Y up became z up

  /// glTF files are the same that have the same name and the same triangles, wherever they lie. Throws Error when one
  /// cannot be read.
  bool operator==(const Object& other) const;
};

struct Scene {
  std::optional<Desk> desk = Desk{};
  std::vector<Cup> cups;
  std::vector<Object> objects;

  bool operator==(const Scene&) const = default;
};

/// Its top's two triangles.
GltfPart desk_part(const Desk& desk);

/// "box.glb", "can"
std::string object_name(const Object& object);

/// Its triangles, in the world. Throws Error when its glTF file cannot be read.
std::vector<GltfPart> object_parts(const Object& object);

/// Readers of the parts of a scene file; they throw Error naming file, path and what is allowed. Named shapes come from
/// scenes/cups, named solids from scenes/solids; relative glTF paths are relative to the scene file.
Scene scene_from_json(const JsonReader& json);
Desk desk_from_json(const JsonReader& json);
Cup cup_from_json(const JsonReader& json);
Object object_from_json(const JsonReader& json);
CupShape cup_shape_from_json(const JsonReader& json);
/// The member glaze of a desk or a cup; nothing without it.
std::optional<Coat> glaze_from_json(const JsonReader& json);
/// The member rotation_deg: angles about the world's fixed axes x, then y, then z; none without it.
Eigen::Quaterniond rotation_from_json(const JsonReader& json);
/// The member position_mm of a thing that is put down, given its lowest point's height [m] before: two numbers place it
/// on the desk, a third is the height of its lowest point.
Eigen::Translation3d put_down(const JsonReader& json, double lowest);
/// The objects of a scene file below its own: all of them, those of a cup, those of an object.
std::vector<KeyTable> scene_key_tables();
std::vector<KeyTable> cup_key_tables();
std::vector<KeyTable> object_key_tables();
/// Whether a file's name ends as a glTF file's.
bool names_gltf(const std::string& file);

}  // namespace fathom
