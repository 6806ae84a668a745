#include "core/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/files.h"
#include "core/modest_json.h"
#include "core/units.h"

namespace fathom {
namespace {

std::string shown(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() > 40 ? text.substr(0, 37) + "..." : text;
}

/// Line and column (from 1) of a byte position.
std::pair<std::size_t, std::size_t> line_and_column(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const std::size_t line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t start = before.rfind('\n');
  return {line, 1 + before.size() - (start == std::string_view::npos ? 0 : start + 1)};
}

/// Of the parser's message what a person needs: "unexpected string literal; expected ',' or '}'".
std::string what_is_wrong(std::string_view message) {
  constexpr std::string_view kBefore = " - ";
  if (const std::size_t at = message.find(kBefore); at != std::string_view::npos)
    message.remove_prefix(at + kBefore.size());
  std::string text(message.substr(0, message.find("; last read: ")));
  for (const std::string_view closing : {"expected '}'", "expected ']'"})
    if (text.ends_with(closing)) text.insert(text.size() - 3, "',' or ");
  return text;
}

}  // namespace

SharedJson::SharedJson() : SharedJson(Json()) {}
SharedJson::SharedJson(Json value) : value_(std::make_shared<const Json>(std::move(value))) {}
SharedJson SharedJson::array() { return Json::array(); }
SharedJson SharedJson::object() { return Json::object(); }
bool SharedJson::operator==(const SharedJson& other) const { return *value_ == *other.value_; }

void JsonReader::fail(std::string_view what) const {
  throw Error(file_, pointer_.empty() ? std::string_view("/") : std::string_view(pointer_), what);
}

void JsonReader::fail_at(std::string_view key, std::string_view what) const {
  throw Error(file_, fmt::format("{}/{}", pointer_, key), what);
}

void JsonReader::allow_only(std::span<const std::string_view> keys) const {
  if (!value_->is_object()) fail(fmt::format("must be an object, got {}", shown(*value_)));
  for (const auto& [key, ignored] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    fail_at(key, unknown_name("key", key, std::vector<std::string>(keys.begin(), keys.end())));
  }
}

JsonReader JsonReader::at(std::string_view key) const {
  if (!value_->is_object()) fail(fmt::format("must be an object, got {}", shown(*value_)));
  const auto found = value_->find(key);
  if (found == value_->end()) fail_at(key, "is missing");
  return {*found, file_, fmt::format("{}/{}", pointer_, key)};
}

std::vector<JsonReader> JsonReader::items() const {
  if (!value_->is_array()) fail(fmt::format("must be a list, got {}", shown(*value_)));
  std::vector<JsonReader> readers;
  for (std::size_t i = 0; i < value_->size(); ++i)
    readers.emplace_back((*value_)[i], file_, fmt::format("{}/{}", pointer_, i));
  return readers;
}

double JsonReader::number(Range range) const {
  if (!value_->is_number()) fail(fmt::format("must be {}, got {}", range.text(), shown(*value_)));
  const double number = value_->get<double>();
  if (!range.contains(number)) fail(fmt::format("must be {}, got {}", range.text(), shown(*value_)));
  return number;
}

std::string JsonReader::text() const {
  if (!value_->is_string()) fail(fmt::format("must be a text, got {}", shown(*value_)));
  return value_->get<std::string>();
}

int JsonReader::integer(int low, int high) const {
  const bool whole =
      value_->is_number_integer() && (!value_->is_number_unsigned() || value_->get<std::uint64_t>() <= 1u << 31);
  if (!whole || value_->get<std::int64_t>() < low || value_->get<std::int64_t>() > high)
    fail(fmt::format("must be a whole number from {} to {}, got {}", low, high, shown(*value_)));
  return value_->get<int>();
}

std::vector<double> JsonReader::numbers(Range range) const {
  std::vector<double> result;
  for (const JsonReader& item : items()) result.push_back(item.number(range));
  return result;
}

Interval JsonReader::interval(Range range) const {
  if (value_->is_number()) return {number(range), number(range)};
  const std::vector<double> ends = numbers(range);
  if (ends.size() != 2) fail("must be a number, or the least and the largest of what is drawn");
  if (ends[1] < ends[0]) fail("must not end below its start");
  return {ends[0], ends[1]};
}

double JsonReader::metres(std::string_view key, Range range_mm) const { return metres_from_mm(number(key, range_mm)); }

Eigen::Vector2d JsonReader::vector2(Range range) const {
  const std::vector<double> values = numbers(range);
  if (values.size() != 2) fail(fmt::format("must be a list of 2 numbers, got {}", shown(*value_)));
  return {values[0], values[1]};
}

Eigen::Vector3d JsonReader::vector3(Range range) const {
  const std::vector<double> values = numbers(range);
  if (values.size() != 3) fail(fmt::format("must be a list of 3 numbers, got {}", shown(*value_)));
  return {values[0], values[1], values[2]};
}

std::size_t JsonReader::choice(std::span<const std::string> choices, std::string_view kind) const {
  const std::string name = text();
  const auto found = std::find(choices.begin(), choices.end(), name);
  if (found == choices.end()) fail(unknown_name(kind, name, choices));
  return static_cast<std::size_t>(found - choices.begin());
}

std::string json_text(const Json& value) { return value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json read_json(const std::filesystem::path& path) {
  // Of objects' members, with the keys that are kept to find doubles; of a string the text, what the parser gathers,
  // which grows by doubling, and the value.
  constexpr JsonMemory kMemory{.per_value = 100, .per_byte = 4};
  const std::string text = read_text(path);
  require_modest_json(text, path.string(), kMemory);
  // The parser takes it for the end, whatever follows.
  if (text.find('\0') != std::string::npos) throw Error(path.string(), "holds a NUL, which is not valid JSON");
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto check_event = [&](int /*depth*/, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw Error(path.string(), fmt::format("has the key '{}' twice in one object", parsed.get<std::string>()));
    return true;
  };
  try {
    return Json::parse(text, check_event);
  } catch (const Json::parse_error& problem) {
    const auto [line, column] = line_and_column(text, problem.byte);
    throw Error(path.string(), fmt::format("line {}, column {}", line, column),
                "is not valid JSON: " + what_is_wrong(problem.what()));
  } catch (const Json::out_of_range&) {
    throw Error(path.string(), "holds a number too large for double precision");
  }
}

void write_json(const std::filesystem::path& path, const Json& value) { write_text(path, json_text(value)); }

}  // namespace fathom
