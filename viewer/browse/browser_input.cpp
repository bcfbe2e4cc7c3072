// What keys and mouse do in the browser.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pfx/base_level/shape/aabb.h"
#include "viewer/browse/browser.h"

namespace viewer {

namespace {

constexpr float kClickRadius = 4.0f;  // px, the mouse may move so far between press and release of a click
constexpr float kFlySpeed = 0.9f;     // distances to the target a second
bool isSteeringKey(int key) {
  return key == 'W' || key == 'A' || key == 'S' || key == 'D' || key == key::kSpace;
}

constexpr int kFramesToFocus = 2;     // until a field that was asked for has the keyboard
constexpr float kThrowSpeed = 25.0f;  // m/s

pfx::Aabb bodyBounds(const pfx::World& world, uint32_t body) {
  const pfx::Collidable& c = world.collidables()[body];
  return pfx::transformedAabb(world.states()[body].pose(), c.center, c.half_extent);
}

// Bounds of everything that can move, or of everything when nothing can.
pfx::Aabb sceneBounds(const pfx::World& world) {
  pfx::Aabb moving, all;
  for (uint32_t i = 0; i < world.states().size(); ++i) {
    if (!world.bodyId(i)) continue;
    all.extend(bodyBounds(world, i));
    if (world.states()[i].motion_type != pfx::MotionType::Fixed) moving.extend(bodyBounds(world, i));
  }
  return moving.min.x() <= moving.max.x() ? moving : all;
}

}  // namespace

void Browser::handleKeys(const UiInput::Frame& input, float dt) {
  // A key that came with Shift or Ctrl is a command and does not fly, even if it is let go later than they are.
  std::erase_if(command_keys_, [&](int key) { return !input.isDown(key); });
  for (const KeyEvent& event : input.keys) {
    if (event.shift || event.control) command_keys_.push_back(event.key);
    const bool steered = steers() && isSteeringKey(event.key);
    const auto command = steered ? std::nullopt : commandOf(event);
    // While text is being entered only keys that cannot be part of it are ours.
    if (command &&
        (!ImGui::GetIO().WantTextInput || event.control || event.key == key::kF1 || event.key == key::kF12))
      execute(*command);
  }
  if (ImGui::GetIO().WantTextInput) return;
  if (steers()) return steer(input);
  if (input.control || input.shift) return;
  pfx::Vec3 way = pfx::Vec3::Zero();
  const auto flies = [&](int key) {
    return float(input.isDown(key) && std::find(command_keys_.begin(), command_keys_.end(), key) == command_keys_.end());
  };
  const auto pushed = [&](int plus, int minus) { return flies(plus) - flies(minus); };
  way << pushed('D', 'A'), pushed('E', 'Q'), pushed('W', 'S');
  if (!way.isZero()) camera_.fly(kFlySpeed * dt * way);
}

void Browser::steer(const UiInput::Frame& input) {
  const auto pushed = [&](int plus, int minus) { return float(input.isDown(plus)) - float(input.isDown(minus)); };
  const samples::Controls now = {.right = pushed('D', 'A'),
                                 .forward = pushed('W', 'S'),
                                 .heading = camera_.pose.yaw_deg * std::numbers::pi_v<float> / 180.0f,
                                 .run = input.shift,
                                 .jump = input.isDown(key::kSpace),
                                 .crouch = input.control};
  const auto same = [](const samples::Controls& a, const samples::Controls& b) {
    return a.right == b.right && a.forward == b.forward && a.heading == b.heading && a.run == b.run &&
           a.jump == b.jump && a.crouch == b.crouch;
  };
  // The scene follows its own script until somebody steers.
  const bool untouched = same(controls_, {}) && now.right == 0.0f && now.forward == 0.0f && !now.jump;
  if (session_.paused || untouched || same(now, controls_)) return;
  session_.give(controls_ = now);
}

void Browser::handleMouse(const UiInput::Frame& input) {
  const float dx = input.mouse_x - mouse_x_, dy = input.mouse_y - mouse_y_;
  mouse_x_ = input.mouse_x;
  mouse_y_ = input.mouse_y;
  const bool over_ui = ImGui::GetIO().WantCaptureMouse;
  if (!over_ui && input.wheel_y != 0.0f) camera_.zoom(input.wheel_y);
  if (drag_ == DragMode::Orbit) camera_.orbit(dx, dy, height_);
  if (drag_ == DragMode::Pan) camera_.pan(dx, dy, height_);
  if (drag_ == DragMode::Pull && session_.grab) {
    const Camera camera = camera_.camera();
    const PickRay ray = pickRay(camera, mouse_x_, mouse_y_, width_, height_);
    session_.grab->target =
        ray.origin + ray.direction * (pull_depth_ / ray.direction.dot(axes(camera).forward));
  }
  for (const ButtonEvent& event : input.buttons) {
    if (event.down && !over_ui && drag_ == DragMode::None) {
      drag_start_x_ = mouse_x_;
      drag_start_y_ = mouse_y_;
      if (event.button == 0)
        beginDrag(input);
      else
        drag_ = DragMode::Pan;
    } else if (!event.down) {
      if (event.button == 0) endDrag(input);
      drag_ = DragMode::None;
      session_.grab.reset();
    }
  }
}

void Browser::beginDrag(const UiInput::Frame& input) {
  drag_ = DragMode::Orbit;
  if (!input.control) return;
  const PickHit hit = pickAt(mouse_x_, mouse_y_);
  if (pickKind(hit.id) != PickKind::Body) return;
  const uint32_t body = pickIndex(hit.id);
  select(selectBody(session_.world(), body));
  if (!pfx::isDynamic(session_.world().states()[body].motion_type)) return;
  drag_ = DragMode::Pull;
  const Camera camera = camera_.camera();
  pull_depth_ = (hit.position - camera.eye).dot(axes(camera).forward);
  session_.grab = Grab{session_.world().bodyId(body),
                       session_.world().states()[body].pose().applyInverse(hit.position), hit.position};
  session_.paused = false;
}

void Browser::endDrag(const UiInput::Frame& input) {
  const bool clicked = std::hypot(mouse_x_ - drag_start_x_, mouse_y_ - drag_start_y_) < kClickRadius;
  if (drag_ == DragMode::Orbit && clicked && !input.control)
    select(selectPicked(session_.world(), pickAt(mouse_x_, mouse_y_).id, mouseRay(mouse_x_, mouse_y_)));
}

Ray Browser::mouseRay(float x, float y) const {
  const Camera camera = camera_.camera();
  const PickRay ray = pickRay(camera, x, y, width_, height_);
  return {ray.origin, camera.far_m * ray.direction};
}

PickHit Browser::pickAt(float x, float y) { return renderer_->pick(frameInput(), list_, int(x), int(y)); }

void Browser::execute(BrowseCommand command) {
  if (executeView(command) || executeOverlay(command)) return;
  const auto stepping = [&](auto step) {
    session_.paused = true;
    step();
  };
  switch (command) {
    case BrowseCommand::Pause:
      session_.paused = !session_.paused;
      break;
    case BrowseCommand::Step:
      stepping([&] { session_.stepForward(1); });
      break;
    case BrowseCommand::StepFive:
      stepping([&] { session_.stepForward(5); });
      break;
    case BrowseCommand::StepBack:
      stepping([&] { session_.stepBack(1); });
      break;
    case BrowseCommand::StepBackFive:
      stepping([&] { session_.stepBack(5); });
      break;
    case BrowseCommand::Restart:
      restart();
      break;
    case BrowseCommand::NextScene:
      changeScene(1);
      break;
    case BrowseCommand::PreviousScene:
      changeScene(-1);
      break;
    case BrowseCommand::Slower:
      session_.speed = std::max(0.05f, 0.5f * session_.speed);
      break;
    case BrowseCommand::Faster:
      session_.speed = std::min(4.0f, 2.0f * session_.speed);
      break;
    case BrowseCommand::Find:
      settings_.show_ui = list_state_.focus_filter = true;
      input_.keepTyping(kFramesToFocus);
      break;
    case BrowseCommand::Throw:
      throwBall();
      break;
    case BrowseCommand::Record:
      toggleRecording();
      break;
    case BrowseCommand::Steer:
      steering_ = !steering_;
      say(steering_ ? "keys steer the scene, where it can be steered" : "keys fly the camera");
      break;
    case BrowseCommand::Screenshot:
      screenshot_ = true;
      break;
    case BrowseCommand::ToggleUi:
      settings_.show_ui = !settings_.show_ui;
      break;
    case BrowseCommand::ToggleCosts:
      settings_.show_costs = !settings_.show_costs;
      break;
    case BrowseCommand::Help:
      help_ = !help_;
      break;
    case BrowseCommand::Quit:
      quit_ = true;
      break;
    default:
      break;
  }
}

bool Browser::executeView(BrowseCommand command) {
  switch (command) {
    case BrowseCommand::Frame:
      frameSelection();
      return true;
    case BrowseCommand::ResetCamera:
      camera_ = {.pose = session_.spec().camera, .orthographic = false};
      return true;
    case BrowseCommand::ViewFront:
      camera_.lookFrom(0.0f, 0.0f);
      return true;
    case BrowseCommand::ViewSide:
      camera_.lookFrom(90.0f, 0.0f);
      return true;
    case BrowseCommand::ViewTop:
      camera_.lookFrom(0.0f, 89.9f);
      return true;
    case BrowseCommand::Orthographic:
      camera_.orthographic = !camera_.orthographic;
      return true;
    case BrowseCommand::Follow:
      follow_ = !follow_;
      say(follow_ ? "the view follows the selection" : "the view stays");
      return true;
    case BrowseCommand::Deselect:
      selected_ = {};
      follow_ = help_ = false;
      return true;
    default:
      return false;
  }
}

bool Browser::executeOverlay(BrowseCommand command) {
  Overlays& o = settings_.overlays;
  const auto toggle = [](bool& flag) {
    flag = !flag;
    return true;
  };
  switch (command) {
    case BrowseCommand::ToggleAabb:
      return toggle(o.aabb);
    case BrowseCommand::ToggleAxes:
      return toggle(o.axes);
    case BrowseCommand::ToggleContacts:
      return toggle(o.contacts);
    case BrowseCommand::ToggleIslands:
      return toggle(o.islands);
    case BrowseCommand::ToggleJoints:
      return toggle(o.joints);
    case BrowseCommand::ToggleVelocity:
      return toggle(o.velocity);
    case BrowseCommand::ToggleWorld:
      return toggle(o.world);
    default:
      return false;
  }
}

// Counted from the scene that was asked for last, be it shown yet or not.
void Browser::changeScene(int by) {
  const std::string from = !pending_.empty()    ? pending_
                           : !building_.empty() ? building_
                                                : session_.spec().target();
  const auto at =
      std::find_if(scenes_.begin(), scenes_.end(), [&](const SceneSpec& s) { return s.target() == from; });
  const int count = int(scenes_.size()), index = int(at - scenes_.begin());
  requestLoad(scenes_[size_t((index + by + count) % count)].target());
}

void Browser::frameSelection() {
  const pfx::World& world = session_.world();
  const pfx::Aabb box = boundsOf(world, selected_);
  camera_.frame(box.min.x() <= box.max.x() ? box : sceneBounds(world));
}

void Browser::throwBall() {
  const PickRay ray = pickRay(camera_.camera(), mouse_x_, mouse_y_, width_, height_);
  const float radius = std::clamp(0.02f * camera_.pose.distance, 0.05f, 0.6f);
  session_.give(ThrowBall{ray.origin + 4.0f * radius * ray.direction, kThrowSpeed * ray.direction, radius});
  session_.paused = false;
}

}  // namespace viewer
