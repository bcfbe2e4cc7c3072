// Attributes, numbers and places of an XML element.
#include "pfx/high_level/scene_file/xml_element.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "pfx/high_level/scene_file/nearest_name.h"
#include "pfx/high_level/scene_file/scene_file.h"

namespace pfx {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ','; }

// Text of a number for a message, cut when it is long.
std::string excerpt(std::string_view word) {
  std::string out(1, '"');
  for (char c : word.substr(0, 40)) out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;  // a message is one line
  out += '"';
  return out;
}

// One number of a list that white space separates.
template <class T>
bool parse(std::string_view word, T& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return false;
  if constexpr (std::is_floating_point_v<T>) return !std::isnan(value);
  return true;
}

// Calls fn(word) for each word; stops when it returns false.
template <class Fn>
void forEachWord(std::string_view text, Fn&& fn) {
  size_t i = 0;
  while (true) {
    while (i < text.size() && isSpace(text[i])) ++i;
    const size_t start = i;
    while (i < text.size() && !isSpace(text[i])) ++i;
    if (i == start || !fn(text.substr(start, i - start))) return;
  }
}

}  // namespace

std::string XmlSource::place(size_t offset, std::string_view element) const {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  const auto line = 1 + std::count(text.begin(), end, '\n');
  std::string out = name + ":" + std::to_string(line);
  if (!element.empty()) out += ": <" + std::string(element.substr(0, 40)) + ">";
  return out;
}

void XmlSource::fail(size_t offset, std::string_view element, const std::string& cause) const {
  throw SceneError(place(offset, element) + ": " + cause);
}

std::string XmlElement::place() const { return source_.place(static_cast<size_t>(node_.offset_debug()), tag()); }
void XmlElement::fail(const std::string& cause) const { throw SceneError(place() + ": " + cause); }

bool XmlElement::has(std::string_view name) {
  asked_.push_back(name);
  return !node_.attribute(std::string(name).c_str()).empty();
}

std::string XmlElement::text(std::string_view name, std::string_view fallback) {
  return has(name) ? node_.attribute(std::string(name).c_str()).value() : std::string(fallback);
}

std::string XmlElement::requiredText(std::string_view name) {
  if (!has(name)) fail("the attribute " + std::string(name) + " is missing");
  return node_.attribute(std::string(name).c_str()).value();
}

std::vector<float> XmlElement::floats(std::string_view name, std::initializer_list<size_t> counts) {
  const std::string value = requiredText(name);
  std::vector<float> out;
  forEachWord(value, [&](std::string_view word) {
    float x = 0.0f;
    if (!parse(word, x)) fail(std::string(name) + ": " + excerpt(word) + " is not a number");
    out.push_back(x);
    return true;
  });
  if (std::find(counts.begin(), counts.end(), out.size()) != counts.end()) return out;
  std::string wanted;
  for (size_t n : counts) wanted += (wanted.empty() ? "" : " or ") + std::to_string(n);
  fail(std::string(name) + " has " + std::to_string(out.size()) + " numbers, must have " + wanted);
}

void XmlElement::read(std::string_view name, float& value) {
  if (has(name)) value = floats(name, {1})[0];
}

void XmlElement::read(std::string_view name, uint32_t& value) {
  if (!has(name)) return;
  const std::string got = requiredText(name);
  const bool hex = got.starts_with("0x");
  const char* first = got.data() + (hex ? 2 : 0);
  const char* last = got.data() + got.size();
  const auto [end, error] = std::from_chars(first, last, value, hex ? 16 : 10);
  if (error != std::errc() || end != last) fail(std::string(name) + ": " + excerpt(got) + " is not a whole number >= 0");
}

void XmlElement::read(std::string_view name, int& value) {
  if (!has(name)) return;
  const std::string got = requiredText(name);
  if (!parse(std::string_view(got), value)) fail(std::string(name) + ": " + excerpt(got) + " is not a whole number");
}

void XmlElement::read(std::string_view name, bool& value) {
  readName(name, value, {NamedValue<bool>{"true", true}, NamedValue<bool>{"false", false}});
}

void XmlElement::read(std::string_view name, Vec3& value) {
  if (!has(name)) return;
  const std::vector<float> v = floats(name, {3});
  value = Vec3(v[0], v[1], v[2]);
}

void XmlElement::read(std::string_view name, Quat& value) {
  if (!has(name)) return;
  const std::vector<float> v = floats(name, {4});
  value = Quat(v[3], v[0], v[1], v[2]);
  const float error = std::abs(value.squaredNorm() - 1.0f);
  if (!(error < 0.02f)) fail(std::string(name) + " is not a rotation: its length must be 1");
  // What a world wrote is a unit as far as floats can be, and must keep its bits.
  constexpr float kRounding = 1e-6f;
  if (error > kRounding) value.normalize();
}

void XmlElement::read(std::string_view name, Mat3& value) {
  if (!has(name)) return;
  const std::vector<float> v = floats(name, {3, 9});
  value = Mat3::Zero();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (v.size() == 9) value(i, k) = v[static_cast<size_t>(3 * i + k)];
  if (v.size() == 3) value.diagonal() = Vec3(v[0], v[1], v[2]);
}

template <class T>
std::vector<T> XmlElement::content() const {
  const std::string_view body = node_.text().get();
  const auto offset = static_cast<size_t>(node_.text().data().offset_debug());
  std::vector<T> out;
  forEachWord(body, [&](std::string_view word) {
    T x{};
    if (!parse(word, x))
      source_.fail(offset + static_cast<size_t>(word.data() - body.data()), tag(),
                   excerpt(word) + (std::is_integral_v<T> ? " is not an index" : " is not a number"));
    out.push_back(x);
    return true;
  });
  return out;
}

std::vector<float> XmlElement::numbers() const { return content<float>(); }
std::vector<uint32_t> XmlElement::indices() const { return content<uint32_t>(); }

void XmlElement::requireKnown(const std::string& what, std::string_view got,
                              std::span<const std::string_view> known) const {
  if (std::find(known.begin(), known.end(), got) != known.end()) return;
  const std::string_view nearest = nearestName(got, known);
  fail("unknown " + what + " " + excerpt(got) +
       (nearest.empty() ? "" : "; did you mean \"" + std::string(nearest) + "\"?"));
}

std::vector<XmlElement> XmlElement::children(std::span<const std::string_view> known) const {
  std::vector<XmlElement> out;
  for (pugi::xml_node child : node_.children()) {
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
      source_.fail(static_cast<size_t>(child.offset_debug()), tag(), excerpt(child.value()) + " does not belong here");
    if (child.type() != pugi::node_element) continue;
    const XmlElement& element = out.emplace_back(source_, child);
    element.requireKnown("element", element.tag(), known);
  }
  return out;
}

void XmlElement::finish() const {
  for (pugi::xml_attribute a : node_.attributes()) {
    requireKnown("attribute", a.name(), asked_);
    for (pugi::xml_attribute b = a.next_attribute(); b; b = b.next_attribute())
      if (std::string_view(a.name()) == b.name()) fail("the attribute " + std::string(a.name()) + " is there twice");
  }
}

}  // namespace pfx
