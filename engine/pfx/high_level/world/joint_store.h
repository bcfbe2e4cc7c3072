// The joints of a world: parallel arrays by joint index, with handles that notice removal.
#pragma once

#include <span>
#include <string>

#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/high_level/world/joint_def.h"

namespace pfx {

struct JointStore {
  Vector<Joint> joints;
  Vector<JointLink> links;
  Vector<String> names;
  Vector<float> break_force, break_torque;
  Vector<uint32_t> generations;  // odd while the joint exists
  Vector<uint32_t> free_slots;

  // Throws std::invalid_argument naming the joint. The bodies exist.
  JointId add(const JointDef& def, const Joint& joint);
  void remove(uint32_t index);
  bool isValid(JointId id) const {
    return id && id.index < generations.size() && generations[id.index] == id.generation;
  }
  uint32_t count() const { return static_cast<uint32_t>(joints.size() - free_slots.size()); }

  // Keys of the pairs that must not collide, ascending.
  std::span<const uint64_t> keptApart();

 private:
  Vector<uint64_t> kept_apart_;
  bool changed_ = true;
};

}  // namespace pfx
