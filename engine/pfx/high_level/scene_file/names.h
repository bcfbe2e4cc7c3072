// The words that scene files use for the engine's choices; reading and writing share them.
#pragma once

#include "pfx/base_level/rigid_body/motion_type.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/high_level/scene_file/xml_element.h"
#include "pfx/high_level/world/world.h"

namespace pfx::scene_names {

inline constexpr NamedValue<Pipeline> kPipelines[] = {{"simple", Pipeline::Simple}, {"stable", Pipeline::Stable}};

inline constexpr NamedValue<JointSolver> kJointSolvers[] = {
    {"auto", JointSolver::Auto}, {"direct", JointSolver::Direct}, {"soft", JointSolver::Soft}};

inline constexpr NamedValue<ContactSolver> kContactSolvers[] = {
    {"auto", ContactSolver::Auto}, {"soft", ContactSolver::Soft}, {"newton", ContactSolver::Newton}};

inline constexpr NamedValue<Mixing> kMixings[] = {{"geometric-mean", Mixing::GeometricMean},
                                                  {"mean", Mixing::Mean},
                                                  {"smaller", Mixing::Smaller},
                                                  {"larger", Mixing::Larger},
                                                  {"product", Mixing::Product}};

inline constexpr NamedValue<MotionType> kMotionTypes[] = {{"fixed", MotionType::Fixed},
                                                          {"active", MotionType::Active},
                                                          {"keyframe", MotionType::Keyframe},
                                                          {"one-way", MotionType::OneWay},
                                                          {"trigger", MotionType::Trigger}};

inline constexpr NamedValue<LargeMeshType> kLargeMeshTypes[] = {{"expanded-array", LargeMeshType::ExpandedArray},
                                                                {"quantized-array", LargeMeshType::QuantizedArray},
                                                                {"expanded-bvh", LargeMeshType::ExpandedBvh},
                                                                {"quantized-bvh", LargeMeshType::QuantizedBvh}};

inline constexpr NamedValue<JointKind> kJointKinds[] = {
    {"ball", JointKind::Ball},           {"swing-twist", JointKind::SwingTwist}, {"hinge", JointKind::Hinge},
    {"slider", JointKind::Slider},       {"fixed", JointKind::Fixed},            {"universal", JointKind::Universal},
    {"distance", JointKind::Distance},   {"gear", JointKind::Gear}};

inline constexpr NamedValue<JointLock> kLocks[] = {
    {"free", JointLock::Free}, {"limit", JointLock::Limit}, {"fixed", JointLock::Fixed}};

inline constexpr NamedValue<int> kAxes[] = {{"x", 0}, {"y", 1}, {"z", 2}, {"twist", 3}, {"swing1", 4}, {"swing2", 5}};

template <class T, size_t N>
std::string_view nameOf(const NamedValue<T> (&names)[N], T value) {
  for (const auto& n : names)
    if (n.value == value) return n.name;
  return names[0].name;
}

}  // namespace pfx::scene_names
