// What the scene files of sample 11_xml_import show.
#include <gtest/gtest.h>

#include "tests/files/scene_run.h"

namespace {

using namespace pfx;
using samples::RunningScene;

uint32_t bodyNamed(const World& world, std::string_view name) {
  for (uint32_t i = 0; i < world.states().size(); ++i)
    if (world.name(i) == name) return i;
  throw std::logic_error("no body of this name");
}

TEST(XmlSamples, TheHouseOfCardsStands) {
  RunningScene run(*samples::findScenes("11_xml_import/house_of_cards").front());
  const std::vector<RigidState> start(run.world.states().begin(), run.world.states().end());
  for (int i = 0; i < 600; ++i) run.step();
  // A card that slides by less than its thickness still leans on its neighbour.
  for (uint32_t i = 0; i < start.size(); ++i)
    EXPECT_LT((run.world.states()[i].position - start[i].position).norm(), 0.02f) << run.world.name(i);
}

TEST(XmlSamples, TheMachineMovesItsPistonByTwiceTheCrank) {
  RunningScene run(*samples::findScenes("11_xml_import/machine").front());
  const uint32_t piston = bodyNamed(run.world, "piston");
  float least = 1e9f, most = -1e9f;
  for (int i = 0; i < 600; ++i) {
    run.step();
    const float x = run.world.states()[piston].position.x();
    least = std::min(least, x), most = std::max(most, x);
  }
  // Crank radius 1.5 m; the joints hold to millimetres.
  EXPECT_NEAR(most - least, 3.0f, 0.01f);
}

}  // namespace
