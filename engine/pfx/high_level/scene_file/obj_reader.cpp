// Wavefront OBJ: one statement a line, words separated by blanks.
#include "pfx/high_level/scene_file/obj_reader.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "pfx/high_level/scene_file/scene_file.h"

namespace pfx {
namespace {

class ObjReader {
 public:
  explicit ObjReader(const std::string& name) : name_(name) {}

  void line(std::string_view text) {
    ++line_;
    const std::string_view statement = word(text);
    if (statement == "v") readVertex(text);
    if (statement == "f") readFace(text);
  }

  TriangleList finish() {
    if (list_.indices.empty()) fail("has no face");
    return std::move(list_);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw SceneError(name_ + ":" + std::to_string(line_) + ": " + cause);
  }

  // Takes the next word off the text.
  static std::string_view word(std::string_view& text) {
    constexpr std::string_view kBlank = " \t\r";
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    const std::string_view found = text.substr(0, text.find_first_of(kBlank));
    text.remove_prefix(found.size());
    return found;
  }

  void readVertex(std::string_view text) {
    Vec3 v;
    for (int i = 0; i < 3; ++i) {
      const std::string_view w = word(text);
      const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), v[i]);
      if (w.empty() || error != std::errc() || end != w.data() + w.size() || !std::isfinite(v[i]))
        fail("coordinate " + std::to_string(i + 1) + " of the vertex is not a number");
    }
    list_.vertices.push_back(v);
  }

  // "7", "7/1/2" or "7//2"; a negative number counts from the last vertex.
  uint32_t readCorner(std::string_view w) const {
    const std::string_view digits = w.substr(0, w.find('/'));
    int64_t index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc() || end != digits.data() + digits.size()) fail("a corner of the face is not a number");
    const auto count = static_cast<int64_t>(list_.vertices.size());
    const int64_t found = index < 0 ? count + index : index - 1;
    if (found < 0 || found >= count)
      fail("the face uses vertex " + std::to_string(index) + ", there are " + std::to_string(count) + " so far");
    return static_cast<uint32_t>(found);
  }

  void readFace(std::string_view text) {
    std::vector<uint32_t> corners;
    for (std::string_view w = word(text); !w.empty(); w = word(text)) corners.push_back(readCorner(w));
    if (corners.size() < 3) fail("a face needs three corners, it has " + std::to_string(corners.size()));
    for (size_t i = 1; i + 1 < corners.size(); ++i)
      list_.indices.insert(list_.indices.end(), {corners[0], corners[i], corners[i + 1]});
  }

  std::string name_;
  int line_ = 0;
  TriangleList list_;
};

}  // namespace

TriangleList readObj(std::string_view text, const std::string& name) {
  ObjReader reader(name);
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    reader.line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return reader.finish();
}

std::string readTextFile(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw SceneError(path.string() + ": is a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw SceneError(path.string() + ": cannot be opened");
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw SceneError(path.string() + ": cannot be read");
  return text;
}

}  // namespace pfx
