// The keys of a configuration object as one table. Its reader, its writer, its schema and its rows in the docs are made
// from the table, so that a key stands in one place.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/json.h"
#include "core/key_table.h"
#include "core/units.h"

namespace fathom {

/// A length that is metres in the program and millimetres in files.
template <class T>
struct Length {
  double T::*metres;
};
template <class T>
Length(double T::*) -> Length<T>;

/// A pair [x, y] of lengths, as Length.
template <class T>
struct Lengths {
  Eigen::Vector2d T::*metres;
};
template <class T>
Lengths(Eigen::Vector2d T::*) -> Lengths<T>;

/// The ends of a range of lengths, as Length: two rising ones, neither below 0.
template <class T>
struct LengthRange {
  double T::*low;
  double T::*high;
};
template <class T>
LengthRange(double T::*, double T::*) -> LengthRange<T>;

/// A coefficient that is per metre in the program and per millimetre in files.
template <class T>
struct PerLength {
  double T::*per_metre;
};
template <class T>
PerLength(double T::*) -> PerLength<T>;

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

/// A member that is an enumeration; the names stand in the order of its values.
template <auto member, class T>
Choice<T> enum_choice(std::vector<std::string> names) {
  return {std::move(names), [](const T& object) { return static_cast<std::size_t>(object.*member); },
          [](T& object, std::size_t choice) {
            object.*member = static_cast<std::remove_reference_t<decltype(object.*member)>>(choice);
          }};
}

/// A value with a reader and a writer of its own. No reader: something else reads the key. No writer, or null from it:
/// the key is left out.
template <class T>
struct Part {
  void (*read)(const JsonReader&, T&);
  Json (*write)(const T&);
  std::string_view schema = {};   ///< as JSON, or the place that it refers to; without one the field's range says all
  std::string_view allowed = {};  ///< for people, beside a schema
};

/// A value that something else reads and nothing writes.
template <class T>
Part<T> unread(std::string_view schema, std::string_view allowed) {
  return {nullptr, nullptr, schema, allowed};
}

/// A field of a part of the object, in the way of Part: see field_of_part().
template <class T>
struct FieldOfPart {
  std::function<void(const JsonReader&, T&)> read;
  std::function<Json(const T&)> write;
  KeyRow row;
};

/// One key of an object T.
template <class T>
struct Field {
  using Value =
      std::variant<double T::*, Length<T>, PerLength<T>, Angle<T>, int T::*, std::uint64_t T::*, Eigen::Vector2d T::*,
                   Lengths<T>, LengthRange<T>, Interval T::*, std::string T::*, Choice<T>, Part<T>, FieldOfPart<T>>;

  std::string_view key;
  Value value;
  Range range;               ///< of a number, in the file's unit, which the key's name ends with
  std::string_view meaning;  ///< one line
  bool is_required;
  std::string_view schema;  ///< as JSON, where the range does not say all

  Field(std::string_view named, Value of, Range allowed, std::string_view means, bool needed = false,
        std::string_view as = {})
      : key(named), value(std::move(of)), range(allowed), meaning(means), is_required(needed), schema(as) {}
  /// Without a range. A template, so that a meaning after a range {} is not taken for `needed`.
  template <std::same_as<bool> B = bool>
  Field(std::string_view named, Value of, std::string_view means, B needed = false)
      : Field(named, std::move(of), Range{}, means, needed) {}
};

/// A field of a member that is an object itself, whose key stands among those of the object that has the member.
template <class T, class Member>
Field<T> field_of_part(Member T::*part, const Field<Member>& field);

/// A table and the object that it is of. Several in a tuple stand side by side in one object of the file.
template <class T>
struct FieldsOf {
  std::span<const Field<T>> fields;
  T& object;
};

/// Throws Error where a key that is required is missing, where the object has a key that is neither in the table nor
/// among `besides`, or a value that is not allowed. Keys that are absent leave their members as they are. Members are
/// read in the table's order.
template <class T>
void read_fields(const JsonReader& json, std::span<const Field<T>> fields, T& object,
                 std::span<const std::string_view> besides = {});
template <class... T>
void read_fields(const JsonReader& json, const std::tuple<FieldsOf<T>...>& tables);

/// All keys, in the table's order, with numbers that read back as they are; angles to the last bit but one.
template <class T>
Json json_from_fields(std::span<const Field<T>> fields, const T& object);

/// What a table says, with the values of `standard` for defaults.
template <class T>
std::vector<KeyRow> key_rows(std::span<const Field<T>> fields, const T& standard);
template <class... T>
std::vector<KeyRow> key_rows(const std::tuple<FieldsOf<T>...>& tables);

/// The row of a number that no member holds.
KeyRow number_key(std::string key, std::string meaning, Range range, Json standard);

/// The key by which editors find what a file may hold.
template <class T>
Field<T> schema_field() {
  return {"$schema", unread<T>(R"({"type": "string"})", "a text"), "for editors: the file's schema"};
}

/// Millimetres that convert back to exactly this length; the nearest where no double does (one length in 44).
double mm_that_read_back(double metres);

namespace field_detail {

KeyRow number_row(Range range, bool is_whole);
KeyRow vector_row(Range range);
KeyRow interval_row(Range range);
KeyRow length_range_row();
KeyRow choice_row(std::span<const std::string> names);
KeyRow row_of(std::string_view schema, std::string_view allowed);
Interval length_range_from_json(const JsonReader& json);

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
                 [&](PerLength<T> value) { object.*value.per_metre = per_metre_from_per_mm(json.number(field.range)); },
                 [&](Angle<T> angle) { object.*angle.radians = radians_from_deg(json.number(field.range)); },
                 [&](int T::*member) { object.*member = integer(); },
                 [&](std::uint64_t T::*member) { object.*member = static_cast<std::uint64_t>(integer()); },
                 [&](Eigen::Vector2d T::*member) { object.*member = json.vector2(field.range); },
                 [&](Lengths<T> lengths) { object.*lengths.metres = json.vector2(field.range) * kMetresPerMm; },
                 [&](LengthRange<T> ends) {
                   const Interval range_mm = length_range_from_json(json);
                   object.*ends.low = metres_from_mm(range_mm.low), object.*ends.high = metres_from_mm(range_mm.high);
                 },
                 [&](Interval T::*member) { object.*member = json.interval(field.range); },
                 [&](std::string T::*member) { object.*member = json.text(); },
                 [&](const Choice<T>& choice) { choice.set(object, json.choice(choice.names, field.key)); },
                 [&](const Part<T>& part) {
                   if (part.read) part.read(json, object);
                 },
                 [&](const FieldOfPart<T>& part) { part.read(json, object); },
             },
             field.value);
}

template <class T>
Json json_from_value(const Field<T>& field, const T& object) {
  return std::visit(
      Overloaded{
          [&](double T::*member) -> Json { return object.*member; },
          [&](Length<T> length) -> Json { return mm_that_read_back(object.*length.metres); },
          [&](PerLength<T> value) -> Json { return object.*value.per_metre * kMetresPerMm; },
          [&](Angle<T> angle) -> Json { return deg_from_radians(object.*angle.radians); },
          [&](int T::*member) -> Json { return object.*member; },
          [&](std::uint64_t T::*member) -> Json { return object.*member; },
          [&](Eigen::Vector2d T::*member) -> Json {
            return {(object.*member).x(), (object.*member).y()};
          },
          [&](Lengths<T> lengths) -> Json {
            const Eigen::Vector2d& metres = object.*lengths.metres;
            return {mm_that_read_back(metres.x()), mm_that_read_back(metres.y())};
          },
          [&](LengthRange<T> ends) -> Json {
            return {mm_that_read_back(object.*ends.low), mm_that_read_back(object.*ends.high)};
          },
          [&](Interval T::*member) -> Json {
            return {(object.*member).low, (object.*member).high};
          },
          [&](std::string T::*member) -> Json { return (object.*member).empty() ? Json() : Json(object.*member); },
          [&](const Choice<T>& choice) -> Json { return choice.names.at(choice.get(object)); },
          [&](const Part<T>& part) -> Json { return part.write ? part.write(object) : Json(); },
          [&](const FieldOfPart<T>& part) -> Json { return part.write(object); },
      },
      field.value);
}

/// What the value's kind says.
template <class T>
KeyRow row_of(const Field<T>& field) {
  return std::visit(
      Overloaded{
          [&](auto) { return number_row(field.range, false); }, [&](int T::*) { return number_row(field.range, true); },
          [&](std::uint64_t T::*) { return number_row(field.range, true); },
          [&](Eigen::Vector2d T::*) { return vector_row(field.range); },
          [&](Lengths<T>) { return vector_row(field.range); }, [&](LengthRange<T>) { return length_range_row(); },
          [&](Interval T::*) { return interval_row(field.range); },
          [&](std::string T::*) { return row_of(R"({"type": "string"})", "a text"); },
          [&](const Choice<T>& choice) { return choice_row(choice.names); },
          [&](const Part<T>& part) {
            return part.schema.empty() ? number_row(field.range, false) : row_of(part.schema, part.allowed);
          },
          [&](const FieldOfPart<T>& part) { return part.row; }},
      field.value);
}

template <class T>
void add_keys(std::vector<std::string_view>& keys, std::span<const Field<T>> fields) {
  for (const Field<T>& field : fields) keys.push_back(field.key);
}

template <class T>
void read_values(const JsonReader& json, std::span<const Field<T>> fields, T& object) {
  for (const Field<T>& field : fields)
    if (field.is_required || json.has(field.key)) read_value(json.at(field.key), field, object);
}

}  // namespace field_detail

template <class T, class Member>
Field<T> field_of_part(Member T::*part, const Field<Member>& field) {
  return {
      field.key,
      FieldOfPart<T>{[=](const JsonReader& json, T& object) { field_detail::read_value(json, field, object.*part); },
                     [=](const T& object) { return field_detail::json_from_value(field, object.*part); },
                     field_detail::row_of(field)},
      field.range,
      field.meaning,
      field.is_required,
      field.schema};
}

template <class T>
void read_fields(const JsonReader& json, std::span<const Field<T>> fields, T& object,
                 std::span<const std::string_view> besides) {
  std::vector<std::string_view> keys;
  field_detail::add_keys(keys, fields);
  keys.insert(keys.end(), besides.begin(), besides.end());
  json.allow_only(keys);
  field_detail::read_values(json, fields, object);
}

template <class... T>
void read_fields(const JsonReader& json, const std::tuple<FieldsOf<T>...>& tables) {
  std::apply(
      [&](const auto&... table) {
        std::vector<std::string_view> keys;
        (field_detail::add_keys(keys, table.fields), ...);
        json.allow_only(keys);
        (field_detail::read_values(json, table.fields, table.object), ...);
      },
      tables);
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
    KeyRow row = field_detail::row_of(field);
    row.key = field.key, row.meaning = field.meaning, row.is_required = field.is_required;
    if (!field.is_required) row.standard = field_detail::json_from_value(field, standard);
    if (!field.schema.empty()) row.schema = field_detail::row_of(field.schema, {}).schema;
    row.schema["description"] = field.meaning;
    rows.push_back(std::move(row));
  }
  return rows;
}

template <class... T>
std::vector<KeyRow> key_rows(const std::tuple<FieldsOf<T>...>& tables) {
  std::vector<KeyRow> rows;
  const auto add = [&](const auto& table) {
    std::ranges::move(key_rows(table.fields, std::as_const(table.object)), std::back_inserter(rows));
  };
  std::apply([&](const auto&... table) { (add(table), ...); }, tables);
  return rows;
}

}  // namespace fathom
