#include "pfx/high_level/scene_file/particles_file.h"

#include <charconv>

namespace pfx {
namespace {

// Rows of `width` numbers, the first `indices` of which are indices.
class Rows {
 public:
  Rows(const XmlElement& e, size_t width, size_t indices) : element_(e), width_(width), numbers_(e.numbers()) {
    if (numbers_.size() % width != 0)
      e.fail(std::to_string(numbers_.size()) + " numbers, must be " + std::to_string(width) + " a row");
    for (size_t r = 0; r < size(); ++r)
      for (size_t k = 0; k < indices; ++k) requireIndex((*this)(r, k));
  }
  size_t size() const { return numbers_.size() / width_; }
  float operator()(size_t row, size_t column) const { return numbers_[row * width_ + column]; }
  uint32_t index(size_t row, size_t column) const { return static_cast<uint32_t>((*this)(row, column)); }
  Vec3 vector(size_t row, size_t column) const {
    return {(*this)(row, column), (*this)(row, column + 1), (*this)(row, column + 2)};
  }

 private:
  // Floats hold whole numbers up to 2^24 exactly.
  void requireIndex(float x) const {
    if (!(x >= 0.0f && x <= 16777216.0f) || x != static_cast<float>(static_cast<uint32_t>(x)))
      element_.fail("an index is no whole number from 0 to 16777216");
  }
  const XmlElement& element_;
  size_t width_;
  std::vector<float> numbers_;
};

void readPoints(const XmlElement& e, ParticleDef& def) {
  const Rows rows(e, 7, 0);
  for (size_t r = 0; r < rows.size(); ++r) {
    def.positions.push_back(rows.vector(r, 0));
    def.velocities.push_back(rows.vector(r, 3));
    def.masses.push_back(rows(r, 6));
  }
}

ParticleStrand readStrand(XmlElement& e) {
  ParticleStrand strand;
  e.read("compliance", strand.compliance);
  e.finish();
  for (const XmlElement& child : e.children({"indices", "lengths", "impulses"})) {
    child.finish();
    if (child.tag() == "indices") strand.particles = child.indices();
    if (child.tag() == "lengths") strand.lengths = child.numbers();
    if (child.tag() == "impulses") strand.impulses = child.numbers();
  }
  return strand;
}

void readDistances(const XmlElement& e, ParticleDef& def) {
  const Rows rows(e, 5, 2);
  for (size_t r = 0; r < rows.size(); ++r)
    def.distances.push_back({rows.index(r, 0), rows.index(r, 1), rows(r, 2), rows(r, 3), rows(r, 4)});
}

void readAngles(const XmlElement& e, ParticleDef& def) {
  const Rows rows(e, 8, 3);
  for (size_t r = 0; r < rows.size(); ++r)
    def.angles.push_back({rows.index(r, 0), rows.index(r, 1), rows.index(r, 2), rows(r, 3), rows(r, 4), rows(r, 5),
                          rows(r, 6), rows(r, 7)});
}

void readVolumes(const XmlElement& e, ParticleDef& def) {
  const Rows rows(e, 7, 4);
  for (size_t r = 0; r < rows.size(); ++r)
    def.volumes.push_back({rows.index(r, 0), rows.index(r, 1), rows.index(r, 2), rows.index(r, 3), rows(r, 4),
                           rows(r, 5), rows(r, 6)});
}

// Text of rows of numbers.
class Table {
 public:
  Table& add(float x) {
    char buffer[32];
    text_ += std::string_view(buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr);
    text_ += ' ';
    return *this;
  }
  Table& add(uint32_t i) {
    text_ += std::to_string(i) + ' ';
    return *this;
  }
  Table& add(const Vec3& v) { return add(v.x()).add(v.y()).add(v.z()); }
  template <class T>
  Table& add(const std::vector<T>& values) {
    for (const T& x : values) add(x);
    return *this;
  }
  void endRow() { text_.back() = '\n'; }
  void write(pugi::xml_node& parent, const char* tag) {
    if (!text_.empty()) parent.append_child(tag).text() = ("\n" + text_).c_str();
  }
  std::string number() const { return text_.substr(0, text_.size() - 1); }

 private:
  std::string text_;
};

void set(pugi::xml_node& node, const char* name, float x) { node.append_attribute(name) = Table().add(x).number().c_str(); }

void writeSettings(pugi::xml_node& node, const ParticleSettings& s) {
  node.append_attribute("substeps") = s.substeps;
  node.append_attribute("iterations") = s.iterations;
  set(node, "warm-start", s.warm_start);
  set(node, "radius", s.radius);
  set(node, "friction", s.friction);
  set(node, "damping", s.damping);
  set(node, "gravity-scale", s.gravity_scale);
  node.append_attribute("filter-self") = s.filter_self;
  node.append_attribute("filter-target") = s.filter_target;
}

void writeStrand(pugi::xml_node& particles, const ParticleStrand& s) {
  pugi::xml_node node = particles.append_child("strand");
  if (s.compliance != 0.0f) set(node, "compliance", s.compliance);
  Table().add(s.particles).write(node, "indices");
  Table().add(s.lengths).write(node, "lengths");
  Table().add(s.impulses).write(node, "impulses");
}

void writeConstraints(pugi::xml_node& node, const ParticleDef& def) {
  Table distances, angles, volumes;
  for (const DistanceConstraint& c : def.distances)
    distances.add(c.a).add(c.b).add(c.length).add(c.compliance).add(c.impulse).endRow();
  for (const AngleConstraint& c : def.angles) {
    angles.add(c.a).add(c.b).add(c.c).add(c.length_ab).add(c.length_bc);
    angles.add(c.chord).add(c.compliance).add(c.impulse).endRow();
  }
  for (const VolumeConstraint& c : def.volumes)
    volumes.add(c.a).add(c.b).add(c.c).add(c.d).add(c.volume).add(c.compliance).add(c.impulse).endRow();
  distances.write(node, "distances");
  angles.write(node, "angles");
  volumes.write(node, "volumes");
}

}  // namespace

ParticleDef readParticles(XmlElement& e, const BodyOf& body_of) {
  ParticleDef def;
  ParticleSettings& s = def.settings;
  def.name = e.text("name", "");
  e.read("substeps", s.substeps);
  e.read("iterations", s.iterations);
  e.read("warm-start", s.warm_start);
  e.read("radius", s.radius);
  e.read("friction", s.friction);
  e.read("damping", s.damping);
  e.read("gravity-scale", s.gravity_scale);
  e.read("filter-self", s.filter_self);
  e.read("filter-target", s.filter_target);
  e.finish();
  constexpr int kMostRounds = 10000;
  if (s.substeps > kMostRounds || s.iterations > kMostRounds)
    e.fail("substeps and iterations must be at most " + std::to_string(kMostRounds));
  for (XmlElement& child : e.children({"points", "strand", "distances", "angles", "volumes", "anchor"})) {
    if (child.tag() == "strand") {
      def.strands.push_back(readStrand(child));
    } else if (child.tag() == "anchor") {
      ParticleAnchor& anchor = def.anchors.emplace_back();
      child.read("particle", anchor.particle);
      child.read("local", anchor.local);
      anchor.body = body_of(child, "body");
    }
    child.finish();
    if (child.tag() == "points") readPoints(child, def);
    if (child.tag() == "distances") readDistances(child, def);
    if (child.tag() == "angles") readAngles(child, def);
    if (child.tag() == "volumes") readVolumes(child, def);
  }
  return def;
}

void writeParticles(pugi::xml_node scene, const ParticleDef& def) {
  pugi::xml_node node = scene.append_child("particles");
  if (!def.name.empty()) node.append_attribute("name") = def.name.c_str();
  writeSettings(node, def.settings);
  Table points;
  for (size_t i = 0; i < def.positions.size(); ++i)
    points.add(def.positions[i]).add(def.velocities[i]).add(def.masses[i]).endRow();
  points.write(node, "points");
  for (const ParticleStrand& s : def.strands) writeStrand(node, s);
  writeConstraints(node, def);
  for (const ParticleAnchor& a : def.anchors) {
    pugi::xml_node anchor = node.append_child("anchor");
    anchor.append_attribute("particle") = a.particle;
    anchor.append_attribute("body") = a.body;
    anchor.append_attribute("local") = Table().add(a.local).number().c_str();
  }
}

}  // namespace pfx
