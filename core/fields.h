// The keys of a configuration object as one table. Its reader, its writer, its schema and its rows in the docs are made
// from the table, so that a key stands in one place.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/json.h"
#include "core/key_table.h"
#include "core/units.h"

namespace fathom {

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

/// A number, and how it is converted from the file's unit and back.
template <class T>
struct Number {
  double T::*member;
  double (*from_file)(double);
  double (*to_file)(double);

  void read(const JsonReader& json, Range range, T& object) const { object.*member = from_file(json.number(range)); }
  Json write(const T& object) const { return to_file(object.*member); }
  KeyRow row(Range range) const { return field_detail::number_row(range, false); }
};

/// A whole number.
template <class T, std::integral I>
requires(!std::same_as<I, bool>) struct Whole {
  I T::*member;

  void read(const JsonReader& json, Range range, T& object) const {
    object.*member = static_cast<I>(json.integer(static_cast<int>(range.low), static_cast<int>(range.high)));
  }
  Json write(const T& object) const { return object.*member; }
  KeyRow row(Range range) const { return field_detail::number_row(range, true); }
};

/// A pair [x, y].
template <class T>
struct Pair {
  Eigen::Vector2d T::*member;

  void read(const JsonReader& json, Range range, T& object) const { object.*member = json.vector2(range); }
  Json write(const T& object) const { return {(object.*member).x(), (object.*member).y()}; }
  KeyRow row(Range range) const { return field_detail::vector_row(range); }
};

/// A number, or a pair of such.
template <class T>
struct Ends {
  Interval T::*member;

  void read(const JsonReader& json, Range range, T& object) const { object.*member = json.interval(range); }
  Json write(const T& object) const { return {(object.*member).low, (object.*member).high}; }
  KeyRow row(Range range) const { return field_detail::interval_row(range); }
};

/// A text, left out where it is empty.
template <class T>
struct Text {
  std::string T::*member;

  void read(const JsonReader& json, Range, T& object) const { object.*member = json.text(); }
  Json write(const T& object) const { return (object.*member).empty() ? Json() : Json(object.*member); }
  KeyRow row(Range) const { return field_detail::row_of(R"({"type": "string"})", "a text"); }
};

}  // namespace field_detail

/// A length that is metres in the program and millimetres in files.
template <class T>
struct Length : field_detail::Number<T> {
  explicit Length(double T::*metres) : field_detail::Number<T>{metres, metres_from_mm, mm_that_read_back} {}
};

/// A coefficient that is per metre in the program and per millimetre in files.
template <class T>
struct PerLength : field_detail::Number<T> {
  explicit PerLength(double T::*per_metre)
      : field_detail::Number<T>{per_metre, per_metre_from_per_mm, per_mm_from_per_metre} {}
};

/// An angle that is radians in the program and degrees in files.
template <class T>
struct Angle : field_detail::Number<T> {
  explicit Angle(double T::*radians) : field_detail::Number<T>{radians, radians_from_deg, deg_from_radians} {}
};

/// A pair [x, y] of lengths, as Length.
template <class T>
struct Lengths {
  Eigen::Vector2d T::*metres;

  void read(const JsonReader& json, Range range, T& object) const {
    object.*metres = json.vector2(range) * kMetresPerMm;
  }
  Json write(const T& object) const {
    return {mm_that_read_back((object.*metres).x()), mm_that_read_back((object.*metres).y())};
  }
  KeyRow row(Range range) const { return field_detail::vector_row(range); }
};
template <class T>
Lengths(Eigen::Vector2d T::*) -> Lengths<T>;

/// The ends of a range of lengths, as Length: two rising ones, neither below 0.
template <class T>
struct LengthRange {
  double T::*low;
  double T::*high;

  void read(const JsonReader& json, Range, T& object) const {
    const Interval range_mm = field_detail::length_range_from_json(json);
    object.*low = metres_from_mm(range_mm.low), object.*high = metres_from_mm(range_mm.high);
  }
  Json write(const T& object) const { return {mm_that_read_back(object.*low), mm_that_read_back(object.*high)}; }
  KeyRow row(Range) const { return field_detail::length_range_row(); }
};
template <class T>
LengthRange(double T::*, double T::*) -> LengthRange<T>;

/// One of some names.
template <class T>
struct Choice {
  std::vector<std::string> names;
  std::size_t (*get)(const T&);
  void (*set)(T&, std::size_t);

  void read(const JsonReader& json, Range, T& object) const { set(object, json.choice(names, json.key())); }
  Json write(const T& object) const { return names.at(get(object)); }
  KeyRow row(Range) const { return field_detail::choice_row(names); }
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
  void (*reader)(const JsonReader&, T&);
  Json (*writer)(const T&);
  std::string_view schema = {};   ///< as JSON, or the place that it refers to; without one the field's range says all
  std::string_view allowed = {};  ///< for people, beside a schema

  void read(const JsonReader& json, Range, T& object) const {
    if (reader) reader(json, object);
  }
  Json write(const T& object) const { return writer ? writer(object) : Json(); }
  KeyRow row(Range range) const {
    return schema.empty() ? field_detail::number_row(range, false) : field_detail::row_of(schema, allowed);
  }
};

/// A value that something else reads and nothing writes.
template <class T>
Part<T> unread(std::string_view schema, std::string_view allowed) {
  return {nullptr, nullptr, schema, allowed};
}

namespace field_detail {

/// The kind that a member's type stands for.
template <class T>
Number<T> kind_of(double T::*member) {
  return {member, [](double number) { return number; }, [](double number) { return number; }};
}
template <class T, std::integral I>
requires(!std::same_as<I, bool>) Whole<T, I> kind_of(I T::*member) { return {member}; }
template <class T>
Pair<T> kind_of(Eigen::Vector2d T::*member) {
  return {member};
}
template <class T>
Ends<T> kind_of(Interval T::*member) {
  return {member};
}
template <class T>
Text<T> kind_of(std::string T::*member) {
  return {member};
}
template <class Kind>
Kind kind_of(Kind kind) {
  return kind;
}

}  // namespace field_detail

/// One key of an object T.
template <class T>
struct Field {
  std::string_view key;
  std::function<void(const JsonReader&, T&)> read;
  std::function<Json(const T&)> write;
  std::function<KeyRow()> row;  ///< what its kind and its range say of it
  std::string_view meaning;     ///< one line
  bool is_required;
  std::string_view schema;  ///< as JSON, where the range does not say all

  /// `value`: a member, or one of the kinds above. `range`: of a number, in the file's unit, which the key's name ends
  /// with.
  template <class Value>
  Field(std::string_view named, Value value, Range range, std::string_view means, bool needed = false,
        std::string_view as = {})
      : key(named), meaning(means), is_required(needed), schema(as) {
    const auto kind = field_detail::kind_of(std::move(value));
    read = [kind, range](const JsonReader& json, T& object) { kind.read(json, range, object); };
    write = [kind](const T& object) { return kind.write(object); };
    row = [kind, range] { return kind.row(range); };
  }
  /// Without a range. A template, so that a meaning after a range {} is not taken for `needed`.
  template <class Value, std::same_as<bool> B = bool>
  Field(std::string_view named, Value value, std::string_view means, B needed = false)
      : Field(named, std::move(value), Range{}, means, needed) {}

  /// A field of a member that is an object itself: its key stands among those of the object that has the member.
  template <class Member>
  Field(Member T::*part, const Field<Member>& field)
      : key(field.key),
        read([=, read = field.read](const JsonReader& json, T& object) { read(json, object.*part); }),
        write([=, write = field.write](const T& object) { return write(object.*part); }),
        row(field.row),
        meaning(field.meaning),
        is_required(field.is_required),
        schema(field.schema) {}
};

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

namespace field_detail {

template <class T>
void add_keys(std::vector<std::string_view>& keys, std::span<const Field<T>> fields) {
  for (const Field<T>& field : fields) keys.push_back(field.key);
}

template <class T>
void read_values(const JsonReader& json, std::span<const Field<T>> fields, T& object) {
  for (const Field<T>& field : fields)
    if (field.is_required || json.has(field.key)) field.read(json.at(field.key), object);
}

}  // namespace field_detail

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
    if (Json value = field.write(object); !value.is_null()) json[std::string(field.key)] = std::move(value);
  return json;
}

template <class T>
std::vector<KeyRow> key_rows(std::span<const Field<T>> fields, const T& standard) {
  std::vector<KeyRow> rows;
  for (const Field<T>& field : fields) {
    KeyRow row = field.row();
    row.key = field.key, row.meaning = field.meaning, row.is_required = field.is_required;
    if (!field.is_required) row.standard = field.write(standard);
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
