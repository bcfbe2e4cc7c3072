// Key-framed bodies that follow an animation: the rest of the world reacts to them.
//
// A clip is what an animation tool gives: poses of one body at times. Between them positions run along cubic curves with
// the speed of the neighbours (Catmull-Rom), orientations along great circles. A player moves bodies so that each stands
// at its pose of the clip exactly at the end of every step.
// Source of the curve: E. Catmull, R. Rom, A class of local interpolating splines, 1974, for times of any distance.
#pragma once

#include <vector>

#include "pfx/high_level/world/world.h"

namespace pfx {

struct AnimationKey {
  float time = 0.0f;  // s
  Transform pose = {};
};

struct AnimationClip {
  std::vector<AnimationKey> keys;  // at least one; times ascend
  bool loops = false;              // after the last key comes the first; otherwise the last one stays

  float duration() const { return keys.empty() ? 0.0f : keys.back().time - keys.front().time; }
};

// Pose at `time` s after the first key (before it: the first). The clip has at least one key.
Transform sample(const AnimationClip& clip, float time);

class AnimationPlayer {
 public:
  // Lets a Keyframe body follow the clip, which must outlive the player, from `start` s in it. Throws
  // std::invalid_argument for a clip without keys, with times that do not ascend, or with a pose that is not finite.
  void add(BodyId body, const AnimationClip& clip, float start = 0.0f);

  // Tells the bodies where to be after the next step of dt seconds. Bodies that are gone are forgotten.
  void advance(World& world, float dt);

  float time() const { return static_cast<float>(time_); }  // s, that it has played

 private:
  struct Track {
    BodyId body;
    const AnimationClip* clip;
    float start;
  };
  std::vector<Track> tracks_;
  double time_ = 0.0;
};

}  // namespace pfx
