// Command-line values that more than one command reads. Every function throws InputError that names the
// option, what was given and an example of what is right.
#pragma once

#include <string>
#include <vector>

#include "samples/scene.h"

namespace viewer {

struct PixelSize {
  int width = 640, height = 360;  // px
};

struct ShardChoice {
  int index = 1, count = 1;  // 1 <= index <= count
};

std::vector<int> parseFrames(const std::string& text);        // "0,60,120": ascending, without repeats
PixelSize parseSize(const std::string& text);                 // "640x360"
ShardChoice parseShard(const std::string& text);              // "1/3"
std::vector<int> parseThreads(const std::string& text);       // "1,2"
std::vector<std::string> splitList(const std::string& text);  // "a,b": without empty parts
// "yaw=30,pitch=20,distance=12,target=0/1/0": what is not named is as in `base`.
samples::CameraPose parseCamera(const std::string& text, samples::CameraPose base);

}  // namespace viewer
