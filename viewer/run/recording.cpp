// Reads and writes recordings.
#include "viewer/run/recording.h"

#include <xxhash.h>

#include <bit>
#include <cstring>
#include <stdexcept>

#include "viewer/file.h"
#include "viewer/input_error.h"

namespace viewer {
namespace {

static_assert(std::endian::native == std::endian::little, "recordings are little endian");

constexpr char kMagic[8] = {'V', 'T', 'R', 'N', 'R', 'E', 'C', '\n'};
constexpr uint32_t kVersion = 1;
constexpr uint32_t kMaxTarget = 4096;  // bytes
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
  return sizeof kMagic + 4 * sizeof(uint32_t) + sizeof(float) + head.target.size();
}

void checkOffsets(std::span<const uint64_t> offsets, size_t first, size_t end) {
  if (offsets.front() != first || offsets.back() != end) throw std::runtime_error("has a damaged index");
  for (size_t i = 1; i < offsets.size(); ++i)
    if (offsets[i] < offsets[i - 1] + kFrameHead) throw std::runtime_error("has a damaged index");
}

}  // namespace

void RecordingWriter::add(const pfx::World& world) {
  const auto states = world.states();
  put(frames_, world.stepCount());
  put(frames_, world.stateHash());
  put(frames_, uint32_t(states.size()));
  for (const pfx::RigidState& s : states) {
    put(frames_, s.position);
    for (int i = 0; i < 4; ++i) put(frames_, s.orientation.coeffs()[i]);  // x, y, z, w
    put(frames_, s.linear_velocity);
    put(frames_, s.angular_velocity);
  }
  for (const pfx::RigidState& s : states) put(frames_, uint8_t(s.asleep));
  ends_.push_back(frames_.size());
}

std::vector<uint8_t> RecordingWriter::bytes() const {
  std::vector<uint8_t> out(std::begin(kMagic), std::end(kMagic));
  put(out, kVersion);
  put(out, head_.dt);
  put(out, head_.substeps);
  put(out, uint32_t(ends_.size()));
  put(out, uint32_t(head_.target.size()));
  out.insert(out.end(), head_.target.begin(), head_.target.end());
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
    if (version != kVersion)
      throw std::runtime_error("is a recording of version " + std::to_string(version) +
                               "; this program reads version " + std::to_string(kVersion));
    head_.dt = reader.get<float>();
    head_.substeps = reader.get<uint32_t>();
    const auto frames = reader.get<uint32_t>();
    const auto length = reader.get<uint32_t>();
    if (length > kMaxTarget) throw std::runtime_error("is damaged");
    const auto target = reader.take(length);
    head_.target.assign(target.begin(), target.end());
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
