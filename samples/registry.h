// The samples, one function each: its scenes in the order of the browser.
#pragma once

#include <vector>

#include "samples/scene.h"

namespace samples {

std::vector<SceneEntry> simpleScenes();  // 1_simple
std::vector<SceneEntry> stableScenes();  // 2_stable
std::vector<SceneEntry> sleepScenes();       // 3_sleep
std::vector<SceneEntry> motionTypeScenes();  // 4_motion_type
std::vector<SceneEntry> raycastScenes();     // 5_raycast
std::vector<SceneEntry> jointScenes();       // 6_joint
std::vector<SceneEntry> serializeScenes();   // 7_serialize
std::vector<SceneEntry> deformMeshScenes();       // 8_deform_mesh
std::vector<SceneEntry> particlePhysicsScenes();  // 9_particle_physics
std::vector<SceneEntry> characterScenes();   // 10_character_ctrl
std::vector<SceneEntry> xmlImportScenes();   // 11_xml_import
std::vector<SceneEntry> tutorialScenes();    // tutorial
std::vector<SceneEntry> accuracyScenes();    // accuracy
std::vector<SceneEntry> hardCaseScenes();    // hard_cases
std::vector<SceneEntry> benchmarkScenes();   // benchmarks

}  // namespace samples
