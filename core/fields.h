// The keys of a configuration object as one table. Its reader, its writer, its schema and its rows in the docs are made
// from the table, so that a key stands in one place.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/json.h"
#include "core/units.h"

namespace fathom {

/// A length that is metres in the program and millimetres in files.
template <class T>
struct Length {
  double T::*metres;
};
template <class T>
Length(double T::*) -> Length<T>;

/// An angle that is radians in the program and degrees in files.
template <class T>
struct Angle {
  double T::*radians;
};
template <class T>
Angle(double T::*) -> Angle<T>;

/// One of some names.
template <class T>
struct Choice {
  std::vector<std::string> names;
  std::size_t (*get)(const T&);
  void (*set)(T&, std::size_t);
};

/// A value with a reader and a writer of its own. A writer that returns null leaves the key out; a reader that is not
/// given takes nothing, because something else reads the key.
template <class T>
struct Part {
  void (*read)(const JsonReader&, T&);
  Json (*write)(const T&);
  std::string_view schema;  ///< as JSON
  std::string_view allowed;
};

/// One key of an object T. The range of a number is in the file's unit, which the key's name ends with.
template <class T>
struct Field {
  std::string_view key;
  std::variant<double T::*, Length<T>, Angle<T>, int T::*, std::uint64_t T::*, Eigen::Vector2d T::*, Choice<T>, Part<T>>
      value;
  Range range;
  std::string_view meaning;  ///< one line
  bool is_required = false;
  std::string_view schema = {};  ///< as JSON, where the range does not say all
};

/// A key as people and programs read of it.
struct KeyRow {
  std::string key, meaning;
  std::string allowed;  ///< "0 to 4"
  Json standard;        ///< without the key; null: nothing
  Json schema;          ///< JSON schema of the value
  bool is_required = false;
};

/// The keys of an object of a file.
struct KeyTable {
  std::string place;       ///< "sensor.optics"
  std::string definition;  ///< its name in the schema
  std::string title;
  std::vector<KeyRow> rows;
};

/// Throws Error where a key that is required is missing, where the object has a key that is neither in the table nor
/// among `besides`, or a value that is not allowed. Keys that are absent leave their members as they are. Members are
/// read in the table's order.
template <class T>
void read_fields(const JsonReader& json, std::span<const Field<T>> fields, T& object,
                 std::span<const std::string_view> besides = {});

/// All keys, in the table's order, with numbers that read back as they are; angles to the last bit but one.
template <class T>
Json json_from_fields(std::span<const Field<T>> fields, const T& object);

/// What a table says, with the values of `standard` for defaults.
template <class T>
std::vector<KeyRow> key_rows(std::span<const Field<T>> fields, const T& standard);

/// The number of millimetres that reads back as this length, where there is one: of forty-four lengths one lies between
/// those that millimetres of double precision can say.
double mm_that_read_back(double metres);

namespace field_detail {

KeyRow number_row(Range range, bool is_whole);
KeyRow vector_row(Range range);
KeyRow choice_row(std::span<const std::string> names);

template <class... Readers>
struct Overloaded : Readers... {
  using Readers::operator()...;
};
template <class... Readers>
Overloaded(Readers...) -> Overloaded<Readers...>;

template <class T>
void read_value(const JsonReader& json, const Field<T>& field, T& object) {
  const auto integer = [&] {
    return json.integer(static_cast<int>(field.range.low), static_cast<int>(field.range.high));
  };
  std::visit(Overloaded{
                 [&](double T::*member) { object.*member = json.number(field.range); },
                 [&](Length<T> length) { object.*length.metres = metres_from_mm(json.number(field.range)); },
                 [&](Angle<T> angle) { object.*angle.radians = radians_from_deg(json.number(field.range)); },
                 [&](int T::*member) { object.*member = integer(); },
                 [&](std::uint64_t T::*member) { object.*member = static_cast<std::uint64_t>(integer()); },
                 [&](Eigen::Vector2d T::*member) { object.*member = json.vector2(field.range); },
                 [&](const Choice<T>& choice) { choice.set(object, json.choice(choice.names, field.key)); },
                 [&](const Part<T>& part) {
                   if (part.read) part.read(json, object);
                 },
             },
             field.value);
}

template <class T>
Json json_from_value(const Field<T>& field, const T& object) {
  return std::visit(Overloaded{
                        [&](double T::*member) -> Json { return object.*member; },
                        [&](Length<T> length) -> Json { return mm_that_read_back(object.*length.metres); },
                        [&](Angle<T> angle) -> Json { return deg_from_radians(object.*angle.radians); },
                        [&](int T::*member) -> Json { return object.*member; },
                        [&](std::uint64_t T::*member) -> Json { return object.*member; },
                        [&](Eigen::Vector2d T::*member) -> Json {
                          return {(object.*member).x(), (object.*member).y()};
                        },
                        [&](const Choice<T>& choice) -> Json { return choice.names.at(choice.get(object)); },
                        [&](const Part<T>& part) -> Json { return part.write ? part.write(object) : Json(); },
                    },
                    field.value);
}

}  // namespace field_detail

template <class T>
void read_fields(const JsonReader& json, std::span<const Field<T>> fields, T& object,
                 std::span<const std::string_view> besides) {
  std::vector<std::string_view> keys;
  for (const Field<T>& field : fields) keys.push_back(field.key);
  keys.insert(keys.end(), besides.begin(), besides.end());
  json.allow_only(keys);
  for (const Field<T>& field : fields)
    if (field.is_required || json.has(field.key)) field_detail::read_value(json.at(field.key), field, object);
}

template <class T>
Json json_from_fields(std::span<const Field<T>> fields, const T& object) {
  Json json = Json::object();
  for (const Field<T>& field : fields)
    if (Json value = field_detail::json_from_value(field, object); !value.is_null())
      json[std::string(field.key)] = std::move(value);
  return json;
}

template <class T>
std::vector<KeyRow> key_rows(std::span<const Field<T>> fields, const T& standard) {
  std::vector<KeyRow> rows;
  for (const Field<T>& field : fields) {
    KeyRow row = std::visit(field_detail::Overloaded{
                                [&](double T::*) { return field_detail::number_row(field.range, false); },
                                [&](Length<T>) { return field_detail::number_row(field.range, false); },
                                [&](Angle<T>) { return field_detail::number_row(field.range, false); },
                                [&](int T::*) { return field_detail::number_row(field.range, true); },
                                [&](std::uint64_t T::*) { return field_detail::number_row(field.range, true); },
                                [&](Eigen::Vector2d T::*) { return field_detail::vector_row(field.range); },
                                [&](const Choice<T>& choice) { return field_detail::choice_row(choice.names); },
                                [&](const Part<T>& part) {
                                  return KeyRow{.key = {},
                                                .meaning = {},
                                                .allowed = std::string(part.allowed),
                                                .standard = {},
                                                .schema = Json::parse(part.schema)};
                                },
                            },
                            field.value);
    row.key = field.key, row.meaning = field.meaning, row.is_required = field.is_required;
    if (!field.is_required) row.standard = field_detail::json_from_value(field, standard);
    if (!field.schema.empty()) row.schema = Json::parse(field.schema);
    row.schema["description"] = field.meaning;
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace fathom
