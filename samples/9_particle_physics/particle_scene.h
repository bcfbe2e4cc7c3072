// What the scenes of sample 9 share: live settings, and drawing threads, cloth and strain.
#pragma once

#include <span>
#include <vector>

#include "pfx/high_level/particles/particle_system.h"
#include "samples/scene.h"

namespace samples {

// Strain (a share) at which threads are drawn red; 0 is blue.
inline constexpr float kShownStrain = 0.005f;

// Blue over green and yellow to red for 0 .. 1.
pfx::Color heatColor(float heat);

// A sheet of particles as a lit surface with a check woven into it; threads that are pulled by more than a tenth of what
// is drawn red show the colour of their strain.
struct SheetView {
  int columns, rows;
  uint32_t first = 0;
  Paint paint = {};
  pfx::Color check = 0xff8a8377u;
};
void drawSheet(const pfx::ParticleSystem& particles, const SheetView& sheet, Canvas& canvas);

// Links of a strand as round rods.
struct ThreadView {
  float radius = 0.01f;  // m, of the first link
  float tip = 1.0f;      // radius of the last one, as a share of it
  Paint paint = {};
  bool strain = false;   // in its colour
};
void drawStrand(const pfx::ParticleSystem& particles, const pfx::ParticleStrand& strand, const ThreadView& view,
                Canvas& canvas);
void drawRods(std::span<const pfx::Vec3> path, const ThreadView& view, Canvas& canvas);  // likewise, without strain

// A scene of one particle system whose settings can be changed while it runs.
class ParticleScene : public Scene {
 public:
  void beforeStep(pfx::World& world, float dt) override;
  void afterStep(pfx::World& world, float dt) override;
  std::vector<Parameter> parameters() override;
  std::vector<Reading> readings(const pfx::World& world) const override;

 protected:
  // Adds the system with the parameters' values.
  void add(pfx::World& world, pfx::ParticleDef def);
  const pfx::ParticleSystem& particles(const pfx::World& world) const { return *world.particles(id_.index); }
  // What moves from outside, before the settings are applied.
  virtual void script(pfx::World& world, float dt) { (void)world, (void)dt; }

  float substeps_ = 8.0f, iterations_ = 2.0f, friction_ = 0.5f, damping_ = 0.3f;
  double strain_limit_ = 0.5;  // percent, of the reading; 0: none
  float worst_strain_ = 0.0f;

 private:
  pfx::ParticlesId id_;
};

std::unique_ptr<Scene> makeCurtain();
std::unique_ptr<Scene> makeDrape();
std::unique_ptr<Scene> makeHair();
std::unique_ptr<Scene> makeBridge();
std::unique_ptr<Scene> makeJelly();

}  // namespace samples
