// Ours, behind the interface of all engines.
#include "samples/benchmarks/engines/engine.h"

namespace samples::benchmarks {
namespace {

class PfxEngine final : public Engine {
 public:
  PfxEngine(const pfx::WorldDef& def, std::unique_ptr<Scene> scene) : world_(def), scene_(std::move(scene)) {
    scene_->build(world_);
  }
  void step(float dt) override {
    scene_->beforeStep(world_, dt);
    world_.step(dt);
  }
  BodyMotion motion(uint32_t body) const override { return bodyMotion(world_.states()[body]); }

 private:
  pfx::World world_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace

std::unique_ptr<Engine> makePfxEngine(const pfx::WorldDef& def, std::unique_ptr<Scene> scene) {
  return std::make_unique<PfxEngine>(def, std::move(scene));
}

}  // namespace samples::benchmarks
