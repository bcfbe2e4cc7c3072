// JUnit XML: one suite, one case a frame.
#include "viewer/golden/junit.h"

#include <algorithm>
#include <cstdio>
#include <pugixml.hpp>
#include <sstream>

namespace viewer {

std::string junitXml(std::span<const FrameResult> results, double seconds) {
  const auto failures =
      std::count_if(results.begin(), results.end(), [](const FrameResult& r) { return !r.pass; });
  char time[32];
  std::snprintf(time, sizeof time, "%.3f", seconds);
  pugi::xml_document document;
  pugi::xml_node suite = document.append_child("testsuites").append_child("testsuite");
  suite.append_attribute("name") = "vitrine verify";
  suite.append_attribute("tests") = static_cast<unsigned>(results.size());
  suite.append_attribute("failures") = static_cast<unsigned>(failures);
  suite.append_attribute("time") = time;
  for (const FrameResult& r : results) {
    pugi::xml_node test = suite.append_child("testcase");
    test.append_attribute("classname") = r.target.c_str();
    test.append_attribute("name") = ("frame " + std::to_string(r.frame)).c_str();
    if (r.pass) continue;
    pugi::xml_node failure = test.append_child("failure");
    failure.append_attribute("type") = std::string(toText(r.triage)).c_str();
    failure.append_attribute("message") = r.why.c_str();
  }
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

}  // namespace viewer
