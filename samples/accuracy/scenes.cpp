// The accuracy cases as scenes: the simulated bodies, and over them as ghosts the places where they ought to be.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <string>

#include "samples/accuracy/case.h"
#include "samples/accuracy/error_plot.h"
#include "samples/registry.h"

namespace samples {
namespace {

using namespace pfx;
using accuracy::Case;

constexpr Color kGhost = 0x5a3a86c8u, kTruthTrail = 0xff2a6fb0u, kSimulatedTrail = 0xffd1495bu;

class AccuracyScene final : public Scene {
 public:
  AccuracyScene(const Case& c, const CameraPose& view) : case_(c), run_(c.make()), plot_(view, c.seconds) {}

  void build(World& world) override { run_->build(world); }

  void afterStep(World& world, float dt) override {
    run_->advance(double(dt));
    const std::vector<BodyMotion> bodies = bodyMotions(world);
    error_ = run_->error(bodies);
    if (std::abs(error_) > std::abs(largest_)) largest_ = error_;
    plot_.add(error_);
    const std::vector<accuracy::Truth> truth = run_->truth();
    if (truth.empty()) return;
    const accuracy::Truth& last = truth.back();
    remember(ought_, marker(last.pose, last.body, world));
    remember(is_, marker(bodies[last.body].pose, last.body, world));
  }

  void draw(const World& world, Canvas& canvas) const override {
    for (const accuracy::Truth& t : run_->truth())
      for (const Shape& s : world.collidables()[t.body].shapes()) {
        const Transform pose = {t.pose.position.cast<float>(), t.pose.orientation.cast<float>()};
        canvas.solid(std::visit([](const auto& g) { return swollen(g); }, s.geometry), pose * s.offset,
                     {.color = kGhost, .finish = Finish::Translucent});
      }
    drawTrail(canvas, ought_, {.color = kTruthTrail, .width = 4.0f});
    drawTrail(canvas, is_, {.color = kSimulatedTrail, .width = 1.5f});
    drawArms(world, canvas);
    plot_.draw(case_.unit, case_.floor, canvas);
    const std::vector<accuracy::Truth> truth = run_->truth();
    if (truth.empty()) return;
    // Above the last body, or the middle one of many, where nothing hides it.
    const accuracy::Truth& last = truth.size() > 20 ? truth[truth.size() / 2] : truth.back();
    const Vec3 above(0.0f, 1.25f * world.collidables()[last.body].half_extent.norm(), 0.0f);
    canvas.label(last.pose.position.cast<float>() + above, errorText());
  }

  std::vector<Reading> readings(const World&) const override {
    return {{.name = case_.metric, .unit = case_.unit, .value = error_, .limit = case_.target},
            {.name = "largest so far", .unit = case_.unit, .value = largest_, .limit = case_.target}};
  }

 private:
  // From an anchor to the centre of a body that has no shape of its own there.
  static void drawArms(const World& world, Canvas& canvas) {
    for (size_t i = 0; i < world.joints().size(); ++i) {
      const RigidState& body = world.states()[world.jointLinks()[i].body_b];
      const Vec3 anchor = body.pose().apply(world.joints()[i].anchor_b);
      if (isDynamic(body.motion_type)) canvas.line(anchor, body.position, {.width = 2.0f});
    }
  }

  std::string errorText() const {
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "%+.1e %.*s", error_, static_cast<int>(case_.unit.size()), case_.unit.data());
    return text.data();
  }

  // A shell a little larger than the body, so that a body in its place is seen inside.
  template <class G>
  static Geometry swollen(G g) {
    constexpr float kBy = 1.06f;
    if constexpr (requires { g.half_extent; }) g.half_extent *= kBy;
    if constexpr (requires { g.radius; }) g.radius *= kBy;
    if constexpr (requires { g.half_length; }) g.half_length *= kBy;
    return g;
  }

  // The point of a body whose way is drawn: its corner or rim when it only turns, otherwise its centre.
  static Vec3 marker(const TransformDouble& pose, uint32_t body, const World& world) {
    const Shape& s = world.collidables()[body].shapes().front();
    Vec3d local = Vec3d::Zero();
    if (world.def().gravity.isZero())
      if (const auto* box = std::get_if<Box>(&s.geometry)) local = 1.06 * box->half_extent.cast<double>();
    return (pose.position + pose.orientation * local).cast<float>();
  }

  static void remember(std::deque<Vec3>& trail, const Vec3& point) {
    trail.push_back(point);
    if (trail.size() > 180) trail.pop_front();
  }
  static void drawTrail(Canvas& canvas, const std::deque<Vec3>& trail, const Stroke& stroke) {
    for (size_t i = 1; i < trail.size(); ++i) canvas.line(trail[i - 1], trail[i], stroke);
  }

  const Case& case_;
  std::unique_ptr<accuracy::Run> run_;
  double error_ = 0.0, largest_ = 0.0;
  accuracy::ErrorPlot plot_;
  std::deque<Vec3> ought_, is_;  // the last three seconds
};

struct View {
  std::string_view name;  // of the case
  CameraPose camera;
  std::vector<int> frames;
};

const std::vector<View>& views() {
  static const std::vector<View> table = {
      {"pendulum", {{0, -0.1f, 0}, 2.9f, 22.0f, 8.0f}, {0, 50, 300}},
      {"free_top", {{0, 0, 0}, 7.6f, 30.0f, 22.0f}, {0, 60, 300}},
      {"heavy_top", {{0, 0.2f, 0.1f}, 2.1f, 40.0f, 14.0f}, {0, 60, 200}},
      {"heavy_chain", {{0.7f, -0.95f, 0}, 5.3f, 16.0f, 8.0f}, {0, 30, 60}},
      {"catenary", {{4.0f, -1.3f, 0}, 8.0f, 14.0f, 6.0f}, {0, 60, 300}},
      {"puck", {{0.5f, 0.0f, 0}, 1.5f, 20.0f, 34.0f}, {0, 30, 90}},
      {"masse_shot", {{0.7f, 0.0f, 0.75f}, 3.0f, 35.0f, 35.0f}, {0, 30, 100}},
      {"heavy_on_light", {{0, 2.5f, 0}, 11.0f, 30.0f, 12.0f}, {0, 60, 300}},
  };
  return table;
}

template <size_t Index>
std::unique_ptr<Scene> make() {
  return std::make_unique<AccuracyScene>(*accuracy::findCase(views()[Index].name), views()[Index].camera);
}

template <size_t... Index>
std::vector<SceneEntry> entries(std::index_sequence<Index...>) {
  std::vector<SceneEntry> all;
  const auto add = [&](const View& view, std::unique_ptr<Scene> (*maker)()) {
    const Case& c = *accuracy::findCase(view.name);
    all.push_back({.sample = "accuracy",
                   .name = c.name,
                   .shows = c.shows,
                   .camera = view.camera,
                   .frames = view.frames,
                   .world = worldDef(c),
                   .make = maker});
  };
  (add(views()[Index], make<Index>), ...);
  return all;
}

}  // namespace

std::vector<SceneEntry> accuracyScenes() { return entries(std::make_index_sequence<8>()); }

}  // namespace samples
