#include "pfx/high_level/scene_file/nearest_name.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace pfx {

size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t(0));
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string_view nearestName(std::string_view wanted, std::span<const std::string_view> known) {
  constexpr size_t kLongest = 64;  // of a name worth comparing
  std::string_view best;
  size_t least = std::max<size_t>(2, wanted.size() / 2) + 1;
  if (wanted.size() > kLongest) return best;
  for (std::string_view name : known) {
    const size_t distance = editDistance(wanted, name);
    if (distance < least) least = distance, best = name;
  }
  return best;
}

}  // namespace pfx
