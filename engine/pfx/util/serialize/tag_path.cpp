#include "pfx/util/serialize/tag_path.h"

namespace pfx::serial {

void TagPath::fail(SerializeError error, const char* cause, uint32_t line) {
  if (!good()) return;
  for (const Group& g : groups_) {
    std::string& tag = failed_tags_.emplace_back(g.tag);
    if (g.number != kNoNumber) tag.append(" ").append(std::to_string(g.number));
  }
  for (const std::string& tag : failed_tags_) failed_pointers_.push_back(tag.c_str());
  failure_ = {.error = error, .tags = failed_pointers_, .line = line, .cause = cause};
}

}  // namespace pfx::serial
