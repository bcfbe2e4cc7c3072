// An element that is being read: attributes by name and type, with errors that say where and why.
//
// Every attribute that is asked for is known; finish() complains about the others.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "pfx/base_level/math/vector.h"

namespace pfx {

// The text of a file, for the lines in messages.
struct XmlSource {
  std::string_view text;
  std::string name;

  // Throws SceneError for the character at `offset`.
  [[noreturn]] void fail(size_t offset, std::string_view element, const std::string& cause) const;
  std::string place(size_t offset, std::string_view element) const;  // "FILE:LINE: <ELEMENT>"
};

template <class T>
struct NamedValue {
  std::string_view name;
  T value;
};

class XmlElement {
 public:
  XmlElement(const XmlSource& source, pugi::xml_node node) : source_(source), node_(node) {}

  std::string_view tag() const { return node_.name(); }
  std::string place() const;
  [[noreturn]] void fail(const std::string& cause) const;

  bool has(std::string_view name);
  std::string text(std::string_view name, std::string_view fallback);
  std::string requiredText(std::string_view name);
  void read(std::string_view name, float& value);  // unchanged when it is missing, like the others
  void read(std::string_view name, uint32_t& value);
  void read(std::string_view name, int& value);
  void read(std::string_view name, bool& value);
  void read(std::string_view name, Vec3& value);
  void read(std::string_view name, Quat& value);  // x y z w; made a unit when it is only nearly one
  void read(std::string_view name, Mat3& value);  // 3 numbers: the diagonal; 9: by rows

  template <class T, size_t N>
  void readName(std::string_view name, T& value, const NamedValue<T> (&names)[N]) {
    if (!has(name)) return;
    const std::string got = requiredText(name);
    std::vector<std::string_view> known;
    for (const auto& n : names) {
      known.push_back(n.name);
      if (n.name == got) value = n.value;
    }
    requireKnown("value of " + std::string(name), got, known);
  }

  // Numbers in the text between the tags.
  std::vector<float> numbers() const;
  std::vector<uint32_t> indices() const;

  // The child elements, whose names must be among these. Text between them is an error.
  std::vector<XmlElement> children(std::span<const std::string_view> known) const;
  std::vector<XmlElement> children(std::initializer_list<std::string_view> known) const {
    return children(std::span(known.begin(), known.size()));
  }

  void finish() const;  // complains about attributes that nobody asked for, or that are there twice

 private:
  std::vector<float> floats(std::string_view name, std::initializer_list<size_t> counts);
  void requireKnown(const std::string& what, std::string_view got, std::span<const std::string_view> known) const;
  template <class T>
  std::vector<T> content() const;

  const XmlSource& source_;
  pugi::xml_node node_;
  std::vector<std::string_view> asked_;
};

}  // namespace pfx
