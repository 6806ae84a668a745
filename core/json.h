// Strict reading of JSON: every key is asked for, anything else is an error that names the file and the path.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_fwd.h"
#include "core/range.h"

namespace fathom {

/// A JSON value that knows where it stands. All readers throw Error: "scene.json: /cups/0/fill_mm: must be …".
class JsonReader {
 public:
  JsonReader(const Json& value, std::string file, std::string pointer = "")
      : value_(&value), file_(std::move(file)), pointer_(std::move(pointer)) {}

  const Json& value() const { return *value_; }
  const std::string& file() const { return file_; }
  const std::string& pointer() const { return pointer_; }
  /// The last part of the pointer: the key, or the index, that leads here.
  std::string_view key() const { return std::string_view(pointer_).substr(pointer_.rfind('/') + 1); }

  [[noreturn]] void fail(std::string_view what) const;
  [[noreturn]] void fail_at(std::string_view key, std::string_view what) const;

  /// This must be an object with no keys but these. Call first.
  void allow_only(std::span<const std::string_view> keys) const;
  void allow_only(std::initializer_list<std::string_view> keys) const {
    allow_only(std::span<const std::string_view>(keys.begin(), keys.size()));
  }
  bool has(std::string_view key) const { return value_->is_object() && value_->contains(key); }

  JsonReader at(std::string_view key) const;  ///< required member
  std::vector<JsonReader> items() const;      ///< elements of an array

  double number(Range range = {}) const;
  std::string text() const;
  int integer(int low, int high) const;
  std::vector<double> numbers(Range range = {}) const;
  Interval interval(Range range = {}) const;  ///< one number, or its ends
  Eigen::Vector2d vector2(Range range = {}) const;
  Eigen::Vector3d vector3(Range range = {}) const;

  // Members of an object; with a default where the key may be absent.
  double number(std::string_view key, Range range = {}) const { return at(key).number(range); }
  double number_or(std::string_view key, double otherwise, Range range = {}) const {
    return has(key) ? at(key).number(range) : otherwise;
  }
  /// A length that stands in the file in mm.
  double metres(std::string_view key, Range range_mm = {}) const;
  std::string text(std::string_view key) const { return at(key).text(); }
  std::string text_or(std::string_view key, std::string otherwise) const {
    return has(key) ? at(key).text() : std::move(otherwise);
  }
  int integer_or(std::string_view key, int otherwise, int low, int high) const {
    return has(key) ? at(key).integer(low, high) : otherwise;
  }
  std::vector<JsonReader> items_or_none(std::string_view key) const {
    return has(key) ? at(key).items() : std::vector<JsonReader>{};
  }
  /// One of `choices`; returns its index.
  std::size_t choice(std::span<const std::string> choices, std::string_view kind) const;

 private:
  const Json* value_;
  std::string file_;
  std::string pointer_;
};

/// JSON as the program writes it, into files and on stdout: indented, with a line feed at the end. Bytes that are no
/// UTF-8, as in the names of some files, are U+FFFD.
std::string json_text(const Json& value);

/// Parses the file; a syntax error names line and column. The value outlives the readers made from it.
Json read_json(const std::filesystem::path& path);
void write_json(const std::filesystem::path& path, const Json& value);

}  // namespace fathom
