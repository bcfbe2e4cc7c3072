#include "viewer/inspect/fact_sheet.h"

#include <algorithm>
#include <cstdio>

namespace viewer {
namespace {

std::string textOf(const Json& value, int digits) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, value.get<double>());
    return text;
  }
  if (value.is_array()) {
    std::string all = "(";
    for (const Json& part : value) all += (all.size() > 1 ? ", " : "") + textOf(part, digits);
    return all + ")";
  }
  // What names a body or a joint: "box 12 #13".
  if (value.is_object() && value.contains("name") && value.contains("index")) {
    const auto name = value["name"].get<std::string>();
    return (name.empty() ? "" : name + " ") + "#" + std::to_string(value["index"].get<uint32_t>());
  }
  // What lies across an edge: "convex to 56".
  if (value.is_object() && value.contains("kind") && value.contains("neighbor"))
    return value["kind"].get<std::string>() +
           (value["neighbor"].is_null() ? "" : " to " + std::to_string(value["neighbor"].get<uint32_t>()));
  return value.dump();
}

std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace

Json vectorJson(const pfx::Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json toJson(const FactSheet& sheet) {
  Json json = Json::object();
  for (const Fact& fact : sheet.facts) json[fact.key] = fact.value;
  for (const FactList& list : sheet.lists) {
    Json& items = json[list.key] = Json::array();
    for (const FactSheet& item : list.items) items.push_back(toJson(item));
  }
  return json;
}

std::string labelOf(const Fact& fact) { return spaced(fact.key); }

std::string valueText(const Fact& fact, const NumberFormat& format) {
  const std::string_view all(fact.unit);
  const std::string_view unit = format.remarks ? all : all.substr(0, all.find(','));
  const bool apart = !unit.empty() && unit.front() != ',';
  return textOf(fact.value, format.digits) + (apart ? " " : "") + std::string(unit);
}

std::string toText(const FactSheet& sheet, int indent) {
  const std::string margin(size_t(indent), ' ');
  size_t widest = 0;
  for (const Fact& fact : sheet.facts) widest = std::max(widest, fact.key.size());
  std::string text;
  for (const Fact& fact : sheet.facts)
    text += margin + labelOf(fact) + std::string(widest + 2 - fact.key.size(), ' ') + valueText(fact) + "\n";
  for (const FactList& list : sheet.lists)
    for (size_t i = 0; i < list.items.size(); ++i)
      text += margin + spaced(list.key) + " " + std::to_string(i) + "\n" + toText(list.items[i], indent + 2);
  return text;
}

}  // namespace viewer
