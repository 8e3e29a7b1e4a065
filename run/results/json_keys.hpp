// JSON objects as tables: one row for each key, from which both the object and docs/scene.md are written.
#pragma once

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

using Json = nlohmann::ordered_json;

// The text about a key in docs/scene.md.
struct KeyText {
  std::string_view name, unit, meaning;
};

// A key of an object that describes a T; it is left out if absent() is true.
template <class T>
struct JsonKey {
  std::string_view name, unit, meaning;
  Json (*value)(const T&);
};

inline Json absent() {
  return Json(Json::value_t::discarded);
}

// JSON has no infinity and no NaN.
inline Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

// The object, with the keys in the order of the table.
template <class T, std::size_t n>
std::string json_object(const JsonKey<T> (&keys)[n], const T& told) {
  Json j;
  for (const JsonKey<T>& key : keys) {
    Json value = key.value(told);
    if (!value.is_discarded()) j[std::string(key.name)] = std::move(value);
  }
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

template <class T, std::size_t n>
std::vector<KeyText> key_texts(const JsonKey<T> (&keys)[n]) {
  std::vector<KeyText> texts;
  for (const JsonKey<T>& key : keys) texts.push_back({key.name, key.unit, key.meaning});
  return texts;
}

}  // namespace carom
