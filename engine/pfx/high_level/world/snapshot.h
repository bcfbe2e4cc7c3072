// Snapshots: everything that a world needs to continue to the bit, in one buffer of the caller's.
//
// World::snapshotBytes, snapshot and restore (world.h) take and give them back. The bytes are the same on every
// platform: a header with the version, then sections of which each has its length and a hash. Layout and version are
// in snapshot.cpp.
#pragma once

#include <stdexcept>

namespace pfx {

// "snapshot: SECTION (bytes FROM to TO): cause"
struct SnapshotError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pfx
