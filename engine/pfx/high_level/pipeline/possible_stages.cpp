#include "pfx/high_level/pipeline/possible_stages.h"

#include <algorithm>
#include <array>

#include "pfx/high_level/pipeline/stage.h"

namespace pfx {
namespace {

// What a world holds, as far as stages depend on it.
struct Content {
  const WorldDef& def;
  bool several = false, dynamic = false, scripted = false;  // bodies
  bool joints = false, gears = false, particles = false, moving_meshes = false;

  bool mayMeet() const { return several && (dynamic || scripted); }
  bool mayTouch() const { return several && dynamic; }
};

Content contentOf(const World& world) {
  Content c{.def = world.def()};
  int bodies = 0;
  for (uint32_t i = 0; i < world.states().size(); ++i) {
    if (world.collidables()[i].shapes().empty()) continue;  // removed
    const MotionType type = world.states()[i].motion_type;
    ++bodies;
    c.dynamic |= isDynamic(type);
    c.scripted |= !isDynamic(type) && type != MotionType::Fixed;
  }
  c.several = bodies > 1;
  for (uint32_t i = 0; i < world.joints().size(); ++i) {
    if (!world.jointLinks()[i].exists) continue;
    c.joints = true;
    c.gears |= world.joints()[i].kind == JointKind::Gear;
  }
  for (uint32_t i = 0; i < world.numParticleSystems(); ++i) c.particles |= world.particles(i) != nullptr;
  c.moving_meshes = world.deformations() > 0;
  return c;
}

bool always(const Content&) { return true; }
bool severalBodies(const Content& c) { return c.several; }
bool pairs(const Content& c) { return c.mayMeet(); }
bool contacts(const Content& c) { return c.mayTouch(); }
bool constraints(const Content& c) { return c.mayTouch() || c.joints; }
bool joints(const Content& c) { return c.joints; }
bool gears(const Content& c) { return c.gears; }
bool moveableJoints(const Content& c) { return c.joints && c.dynamic; }
bool dynamicBodies(const Content& c) { return c.dynamic; }
bool scriptedBodies(const Content& c) { return c.scripted; }
bool sleepers(const Content& c) { return c.def.sleeping && c.dynamic; }
bool wakeableSleepers(const Content& c) { return c.def.sleeping && c.mayTouch(); }
bool approaches(const Content& c) { return c.def.report_events && c.mayMeet(); }
bool reports(const Content& c) { return c.def.report_events; }
bool particles(const Content& c) { return c.particles; }
bool movingMeshes(const Content& c) { return c.moving_meshes; }
bool never(const Content&) { return false; }

// Newton's method is chosen where contacts are, by worlds that remember or were told to.
bool solverChoice(const Content& c) {
  if (!c.mayTouch() || c.def.contact_solver == ContactSolver::Soft) return false;
  return c.def.contact_solver == ContactSolver::Newton || c.def.pipeline != Pipeline::Simple;
}

struct Condition {
  std::string_view stage;
  bool (*holds)(const Content&);
};
constexpr std::array kConditions = {
    Condition{"broad phase", severalBodies},
    Condition{"collision", pairs},
    Condition{"wake", wakeableSleepers},
    Condition{"approaches", approaches},
    Condition{"constraints", pairs},
    Condition{"joints", joints},
    Condition{"choose solvers", solverChoice},
    Condition{"free flight", dynamicBodies},
    Condition{"joint components", moveableJoints},
    Condition{"island solver", solverChoice},
    Condition{"solver set-up", constraints},
    Condition{"solve", constraints},
    Condition{"write back", constraints},
    Condition{"gears", gears},
    Condition{"break joints", joints},
    Condition{"key frames", scriptedBodies},
    Condition{"continuous", pairs},
    Condition{"store impulses", contacts},
    Condition{"modified impulses", never},
    Condition{"particles", particles},
    Condition{"moving meshes", movingMeshes},
    Condition{"sleep", sleepers},
    Condition{"events", reports},
};

}  // namespace

std::vector<std::string_view> possibleStages(const World& world) {
  const Content content = contentOf(world);
  std::vector<std::string_view> names;
  for (const Stage& s : stages(world.def().pipeline)) {
    const auto* condition = std::ranges::find(kConditions, s.name, &Condition::stage);
    const auto holds = condition == kConditions.end() ? always : condition->holds;  // one that is new here may always run
    if (holds(content)) names.push_back(s.name);
  }
  return names;
}

}  // namespace pfx
