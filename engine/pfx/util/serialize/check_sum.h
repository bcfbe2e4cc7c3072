// A sum over the words of a text, whatever blanks and line ends are between them.
#pragma once

#include <span>
#include <string_view>

#include "pfx/util/state_hash/state_hash.h"

namespace pfx::serial {

inline uint64_t addToken(uint64_t sum, std::string_view token) {
  return hashBytes(std::as_bytes(std::span(token)), sum);
}

}  // namespace pfx::serial
