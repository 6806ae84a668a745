// The names of JSON, for headers whose readers need not know its library. Who reads or writes a value includes
// core/json.h, who looks into a table of keys core/key_table.h.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>

namespace fathom {

using Json = nlohmann::ordered_json;
class JsonReader;

struct KeyRow;
struct KeyTable;
template <class T>
struct Field;

/// A JSON value that never changes, which copies share: a member of structs that are otherwise plain.
class SharedJson {
 public:
  SharedJson();  ///< null
  SharedJson(Json value);
  static SharedJson array();   ///< []
  static SharedJson object();  ///< {}

  operator const Json&() const { return *value_; }
  bool operator==(const SharedJson& other) const;

 private:
  std::shared_ptr<const Json> value_;
};

}  // namespace fathom
