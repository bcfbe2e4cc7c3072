// The page of the golden report; @DATA@ stands for its JSON. See report.cpp for the keys.
#pragma once

#include <string_view>

namespace viewer {

extern const std::string_view kReportPage;

}  // namespace viewer
