// Joints of a scene file.
#pragma once

#include "pfx/high_level/scene_file/scene_def.h"
#include "pfx/high_level/scene_file/xml_element.h"

namespace pfx {

// The elements that are joints: the kinds, and "joint" for a record that was put together axis by axis.
std::span<const std::string_view> jointTags();

// The joint without its bodies. Throws SceneError.
SceneJoint readJoint(XmlElement& element);

}  // namespace pfx
