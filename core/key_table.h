// What people and programs read of a configuration object's keys.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"

namespace fathom {

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

}  // namespace fathom
