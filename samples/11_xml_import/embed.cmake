# Puts the scene files into the program, so that it runs from any directory: xml_scenes.h with one string a file.
set(XML_SCENES "")
foreach(scene HouseOfCards:house_of_cards.xml Machine:machine.xml Example:example.xml Arm:arm.xml ArmUrdf:arm.urdf)
  string(REPLACE ":" ";" parts ${scene})
  list(GET parts 0 name)
  list(GET parts 1 file)
  set(path ${CMAKE_CURRENT_SOURCE_DIR}/11_xml_import/${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(READ ${path} text)
  string(APPEND XML_SCENES "inline constexpr std::string_view k${name} = R\"xml(${text})xml\";\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/xml_scenes.h CONTENT
"// Scene files of sample 11_xml_import, made by embed.cmake.
#pragma once

#include <string_view>

namespace samples::xml_scenes {

@XML_SCENES@
}  // namespace samples::xml_scenes
" @ONLY)
