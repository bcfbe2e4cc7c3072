// The <particles> element of scene files. Reading and writing lie side by side, since rows of numbers have no names.
//
//   <points>     a row a particle:    x y z  vx vy vz  mass
//   <strand>     <indices>, and unless they are as they stand, <lengths> and <impulses>
//   <distances>  rows of              a b  length compliance impulse
//   <angles>     rows of              a b c  length-ab length-bc chord compliance impulse
//   <volumes>    rows of              a b c d  volume compliance impulse
//   <anchor>     particle, body (an id), local
#pragma once

#include <functional>

#include "pfx/high_level/particles/particle_def.h"
#include "pfx/high_level/scene_file/xml_element.h"

namespace pfx {

// Throws SceneError for what is no such element; whether the values make sense is found when the system is made.
// body_of(element, attribute): index of the body that the attribute names.
using BodyOf = std::function<uint32_t(XmlElement&, std::string_view)>;
ParticleDef readParticles(XmlElement& element, const BodyOf& body_of);

// Appends the element. Bodies have their index as id.
void writeParticles(pugi::xml_node scene, const ParticleDef& def);

}  // namespace pfx
