// Reads and writes recordings.
#include "viewer/run/recording.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "viewer/file.h"
#include "viewer/input_error.h"

namespace viewer {
namespace {

static_assert(std::endian::native == std::endian::little, "recordings are little endian");

constexpr char kMagic[8] = {'V', 'T', 'R', 'N', 'R', 'E', 'C', '\n'};
constexpr uint32_t kVersion = 3;   // of files that are written
constexpr uint32_t kOldest = 2;    // that is read: it has no input for the solver, and is the same otherwise
constexpr uint32_t kMaxTarget = 4096;  // bytes
constexpr uint32_t kMaxParameters = 4096;
constexpr size_t kInputFloats = 8;
constexpr size_t kInputBytes = sizeof(uint64_t) + 2 * sizeof(uint32_t) + kInputFloats * sizeof(float);
constexpr size_t kFloatsABody = 13;
constexpr size_t kBytesABody = kFloatsABody * sizeof(float) + 1;
constexpr size_t kFrameHead = 2 * sizeof(uint64_t) + sizeof(uint32_t);

template <class T>
void put(std::vector<uint8_t>& out, const T& value) {
  static_assert(std::is_arithmetic_v<T>);
  const size_t at = out.size();
  out.resize(at + sizeof value);
  std::memcpy(&out[at], &value, sizeof value);
}

void put(std::vector<uint8_t>& out, const pfx::Vec3& v) { put(out, v.x()), put(out, v.y()), put(out, v.z()); }

// Reads values one after the other; running past the end throws.
class Reader {
 public:
  explicit Reader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  std::span<const uint8_t> take(size_t count) {
    if (count > bytes_.size()) throw std::runtime_error("is cut off");
    const auto part = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return part;
  }
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  pfx::Vec3 getVec3() {
    const auto x = get<float>(), y = get<float>(), z = get<float>();
    return {x, y, z};
  }
  size_t left() const { return bytes_.size(); }

 private:
  std::span<const uint8_t> bytes_;
};

size_t headSize(const RecordingHead& head) {
  return sizeof kMagic + 6 * sizeof(uint32_t) + sizeof(float) + head.target.size() +
         head.parameters.size() * sizeof(float) + head.inputs.size() * kInputBytes;
}

// An input as numbers: what does not need all of them leaves zeros.
struct InputRecord {
  uint32_t index = 0;
  std::array<float, kInputFloats> values = {};
};

struct Pack {
  static InputRecord vectors(uint32_t index, const pfx::Vec3& a, const pfx::Vec3& b, float last = 0.0f) {
    return {index, {a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), last}};
  }
  InputRecord operator()(const Pull& p) const { return vectors(p.body, p.local, p.target); }
  InputRecord operator()(const ThrowBall& b) const { return vectors(0, b.from, b.velocity, b.radius); }
  InputRecord operator()(const SetParameter& p) const { return {p.index, {p.value}}; }
  InputRecord operator()(const SetTimeStep& t) const { return {0, {t.dt}}; }
  InputRecord operator()(const samples::Controls& c) const {
    return {uint32_t(c.run) | uint32_t(c.jump) << 1 | uint32_t(c.crouch) << 2, {c.right, c.forward, c.heading}};
  }
  InputRecord operator()(const pfx::SolverSettings& s) const {
    return {uint32_t(s.substeps), {float(s.joint_solver), float(s.contact_solver)}};
  }
};

pfx::SolverSettings solverOf(const InputRecord& r) {
  constexpr uint32_t kMostSubsteps = 1000;
  const auto choice = [](float value, auto last) {
    if (!(value >= 0.0f) || value > float(last) || value != std::floor(value))
      throw std::runtime_error("has a solver that is not known");
    return decltype(last)(int(value));
  };
  if (r.index < 1 || r.index > kMostSubsteps) throw std::runtime_error("has sub-steps out of range");
  return {int(r.index), choice(r.values[0], pfx::JointSolver::Soft), choice(r.values[1], pfx::ContactSolver::Newton)};
}

SceneInput unpack(uint32_t kind, const InputRecord& r) {
  const auto& v = r.values;
  for (float value : v)
    if (!std::isfinite(value)) throw std::runtime_error("has an input that is not a number");
  const pfx::Vec3 a(v[0], v[1], v[2]), b(v[3], v[4], v[5]);
  switch (kind) {
    case 0:
      return Pull{r.index, a, b};
    case 1:
      if (!(v[6] > 0.0f)) break;
      return ThrowBall{a, b, v[6]};
    case 2:
      return SetParameter{r.index, v[0]};
    case 3:
      if (!(v[0] > 0.0f)) break;
      return SetTimeStep{v[0]};
    case 4:
      return samples::Controls{v[0], v[1], v[2], (r.index & 1) != 0, (r.index & 2) != 0, (r.index & 4) != 0};
    case 5:
      return solverOf(r);
    default:
      break;
  }
  throw std::runtime_error("has an input that is not known");
}

TimedInput readInput(Reader& reader) {
  TimedInput input;
  input.step = reader.get<uint64_t>();
  const auto kind = reader.get<uint32_t>();
  InputRecord record{reader.get<uint32_t>(), {}};
  for (float& value : record.values) value = reader.get<float>();
  input.what = unpack(kind, record);
  return input;
}

void putInput(std::vector<uint8_t>& out, const TimedInput& input) {
  const InputRecord record = std::visit(Pack(), input.what);
  put(out, input.step);
  put(out, uint32_t(input.what.index()));
  put(out, record.index);
  for (float value : record.values) put(out, value);
}

void checkOffsets(std::span<const uint64_t> offsets, size_t first, size_t end) {
  if (offsets.front() != first || offsets.back() != end) throw std::runtime_error("has a damaged index");
  for (size_t i = 1; i < offsets.size(); ++i)
    if (offsets[i] < offsets[i - 1] + kFrameHead) throw std::runtime_error("has a damaged index");
}

}  // namespace

RecordedFrame captureFrame(const SceneRun& run) {
  const pfx::World& world = run.world();
  RecordedFrame frame{world.stepCount(), run.stateHash(), {}};
  frame.bodies.reserve(world.states().size());
  for (const pfx::RigidState& s : world.states())
    frame.bodies.push_back({s.position, s.orientation, s.linear_velocity, s.angular_velocity, s.asleep});
  return frame;
}

void RecordingWriter::add(const RecordedFrame& frame) {
  put(frames_, frame.step);
  put(frames_, frame.state_hash);
  put(frames_, uint32_t(frame.bodies.size()));
  for (const RecordedBody& b : frame.bodies) {
    put(frames_, b.position);
    for (int i = 0; i < 4; ++i) put(frames_, b.orientation.coeffs()[i]);  // x, y, z, w
    put(frames_, b.linear_velocity);
    put(frames_, b.angular_velocity);
  }
  for (const RecordedBody& b : frame.bodies) put(frames_, uint8_t(b.asleep));
  ends_.push_back(frames_.size());
}

std::vector<uint8_t> RecordingWriter::bytes() const {
  std::vector<uint8_t> out(std::begin(kMagic), std::end(kMagic));
  put(out, kVersion);
  put(out, head_.dt);
  put(out, head_.substeps);
  put(out, uint32_t(ends_.size()));
  put(out, uint32_t(head_.target.size()));
  put(out, uint32_t(head_.parameters.size()));
  put(out, uint32_t(head_.inputs.size()));
  out.insert(out.end(), head_.target.begin(), head_.target.end());
  for (float value : head_.parameters) put(out, value);
  for (const TimedInput& input : head_.inputs) putInput(out, input);
  const uint64_t first = headSize(head_) + (ends_.size() + 1) * sizeof(uint64_t);
  put(out, first);
  for (uint64_t end : ends_) put(out, first + end);
  out.insert(out.end(), frames_.begin(), frames_.end());
  put(out, uint64_t(XXH3_64bits(out.data(), out.size())));
  return out;
}

Recording::Recording(std::vector<uint8_t> bytes, const std::string& name) : bytes_(std::move(bytes)) {
  try {
    Reader reader(bytes_);
    if (std::memcmp(reader.take(sizeof kMagic).data(), kMagic, sizeof kMagic) != 0)
      throw std::runtime_error("is not a recording");
    const auto version = reader.get<uint32_t>();
    if (version < kOldest || version > kVersion)
      throw std::runtime_error("is a recording of version " + std::to_string(version) + "; this program reads versions " +
                               std::to_string(kOldest) + " to " + std::to_string(kVersion));
    head_.dt = reader.get<float>();
    head_.substeps = reader.get<uint32_t>();
    const auto frames = reader.get<uint32_t>();
    const auto length = reader.get<uint32_t>();
    const auto parameters = reader.get<uint32_t>(), inputs = reader.get<uint32_t>();
    if (length > kMaxTarget || parameters > kMaxParameters) throw std::runtime_error("is damaged");
    const auto target = reader.take(length);
    head_.target.assign(target.begin(), target.end());
    for (uint32_t i = 0; i < parameters; ++i) head_.parameters.push_back(reader.get<float>());
    if (reader.left() / kInputBytes < inputs) throw std::runtime_error("is cut off");
    for (uint32_t i = 0; i < inputs; ++i) head_.inputs.push_back(readInput(reader));
    if (!std::ranges::is_sorted(head_.inputs, {}, &TimedInput::step)) throw std::runtime_error("is damaged");
    if (reader.left() / sizeof(uint64_t) < size_t(frames) + 2) throw std::runtime_error("is cut off");
    offsets_.resize(size_t(frames) + 1);
    for (uint64_t& offset : offsets_) offset = reader.get<uint64_t>();
    const size_t end = bytes_.size() - sizeof(uint64_t);
    const uint64_t hash = Reader(std::span<const uint8_t>(bytes_).subspan(end)).get<uint64_t>();
    if (XXH3_64bits(bytes_.data(), end) != hash)
      throw std::runtime_error("is cut off or damaged: wrong checksum");
    checkOffsets(offsets_, bytes_.size() - reader.left(), end);
  } catch (const std::runtime_error& error) {
    throw InputError(name + ": " + error.what());
  }
}

Recording Recording::read(const std::filesystem::path& file) {
  return Recording(readFile(file), file.string());
}

RecordedFrame Recording::frame(size_t index) const {
  const uint64_t begin = offsets_.at(index), end = offsets_.at(index + 1);
  Reader reader(std::span<const uint8_t>(bytes_).subspan(begin, end - begin));
  RecordedFrame frame;
  frame.step = reader.get<uint64_t>();
  frame.state_hash = reader.get<uint64_t>();
  const auto bodies = reader.get<uint32_t>();
  if (reader.left() != bodies * kBytesABody)
    throw InputError("frame " + std::to_string(index) + " of the recording has a wrong length");
  frame.bodies.resize(bodies);
  for (RecordedBody& b : frame.bodies) {
    b.position = reader.getVec3();
    for (int i = 0; i < 4; ++i) b.orientation.coeffs()[i] = reader.get<float>();
    b.linear_velocity = reader.getVec3();
    b.angular_velocity = reader.getVec3();
  }
  for (RecordedBody& b : frame.bodies) b.asleep = reader.get<uint8_t>() != 0;
  return frame;
}

SceneRun startRun(const Recording& recording) {
  const RecordingHead& head = recording.head();
  RunSettings settings{.dt = head.dt, .substeps = int(head.substeps), .parameters = head.parameters};
  return SceneRun(findScene(allScenes(), head.target), settings);
}

void applyFrame(pfx::World& world, const RecordedFrame& frame) {
  if (frame.bodies.size() != world.states().size())
    throw InputError("the recording has " + std::to_string(frame.bodies.size()) +
                     " bodies in this frame, the scene has " + std::to_string(world.states().size()));
  for (uint32_t i = 0; i < frame.bodies.size(); ++i) {
    const RecordedBody& recorded = frame.bodies[i];
    const pfx::BodyId id = world.bodyId(i);
    if (!world.isValid(id)) continue;  // a removed body
    pfx::RigidState& state = world.state(id);
    state.position = recorded.position;
    state.orientation = recorded.orientation;
    state.linear_velocity = recorded.linear_velocity;
    state.angular_velocity = recorded.angular_velocity;
    state.asleep = recorded.asleep;
  }
}

}  // namespace viewer
