// The groups that are open while a file is read or written, and the first failure with the place where it
// happened.
#pragma once

#include <string>
#include <vector>

#include "pfx/util/serialize/serialize_error.h"

namespace pfx::serial {

inline constexpr uint32_t kNoNumber = 0xffffffffu;  // of a group that is no record of an array

class TagPath {
 public:
  TagPath() = default;
  TagPath(const TagPath&) = delete;
  TagPath& operator=(const TagPath&) = delete;

  void push(const char* tag, uint32_t number = kNoNumber) { groups_.push_back({tag, number}); }
  void pop() { groups_.pop_back(); }
  bool empty() const { return groups_.empty(); }

  bool good() const { return failure_.error == SerializeError::Ok; }
  void fail(SerializeError error, const char* cause, uint32_t line);
  const SerializeFailure& failure() const { return failure_; }

 private:
  struct Group {
    const char* tag;
    uint32_t number;
  };
  std::vector<Group> groups_;
  SerializeFailure failure_;
  std::vector<std::string> failed_tags_;
  std::vector<const char*> failed_pointers_;
};

}  // namespace pfx::serial
