// Facts about a thing in the world: what the inspector panels show, and vitrine inspect prints as text or JSON.
//
// A fact has a key (of the JSON), a value in SI units, and the unit in words for people. Lists of sheets hang below.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pfx/base_level/math/vector.h"

namespace viewer {

using Json = nlohmann::ordered_json;

struct Fact {
  std::string key;  // "linear_velocity"
  Json value;       // a number, text, flag, or list of those; or an object that names something
  const char* unit = "";  // "m", or with a remark behind a comma: "m, world"; ", world" has no unit
};

struct FactList;

struct FactSheet {
  std::vector<Fact> facts;
  std::vector<FactList> lists;

  void add(const char* key, Json value, const char* unit = "") { facts.push_back({key, std::move(value), unit}); }
};

struct FactList {
  std::string key;  // "points"
  std::vector<FactSheet> items;
};

Json vectorJson(const pfx::Vec3& v);

Json toJson(const FactSheet& sheet);

// "linear velocity"
std::string labelOf(const Fact& fact);
// "(0, -9.8, 0) m/s2, world"; without remarks: "(0, -9.8, 0) m/s2".
struct NumberFormat {
  int digits = 6;  // significant ones
  bool remarks = true;
};
std::string valueText(const Fact& fact, const NumberFormat& format = {});

// One line a fact, lists indented below it.
std::string toText(const FactSheet& sheet, int indent = 0);

}  // namespace viewer
