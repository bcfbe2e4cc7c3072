// Which known name somebody may have meant.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace pfx {

// Letters to insert, delete or replace. Source: R. Wagner, M. Fischer, The String-to-String Correction Problem, 1974.
size_t editDistance(std::string_view a, std::string_view b);

// The one of `known` that is closest to `wanted` by its letters; empty when none is close.
std::string_view nearestName(std::string_view wanted, std::span<const std::string_view> known);

}  // namespace pfx
