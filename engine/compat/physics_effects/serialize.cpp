#include "compat/physics_effects/serialize.h"

#include <array>

#include "compat/physics_effects/serialize_records.h"

namespace sce::PhysicsEffects {
namespace {

using pfx::serial::RecordArray;
using pfx::serial::TextReader;
using pfx::serial::TextWriter;

constexpr pfx::serial::DocumentFormat kFormat{"physics-effects", 1};

template <class A, class T>
void ioRecord(A& archive, SerializeArrays all, T& record) {
  PfxSerializeAccess::io(archive, all, record);
}
template <class T>
RecordArray arrayOf(const char* tag, const char* record_tag) {
  return pfx::serial::recordArray<T, ioRecord<TextWriter, T>, ioRecord<TextReader, T>>(tag, record_tag);
}

// Meshes own memory, so they are made only where they are kept.
template <class Mesh, auto Write, auto Read>
RecordArray meshArray(const char* tag, const char* record_tag) {
  RecordArray array = {};
  array.tag = tag, array.record_tag = record_tag;
  array.write = [](TextWriter& out, SerializeArrays, const RecordArray& a, uint32_t i) { Write(out, static_cast<Mesh*>(a.data)[i]); };
  array.read = [](TextReader& in, SerializeArrays, const RecordArray& a, uint32_t i) {
    Read(in, a.data == nullptr ? nullptr : &static_cast<Mesh*>(a.data)[i]);
  };
  return array;
}

std::array<RecordArray, kNumParts> allParts() {
  return {meshArray<PfxConvexMesh, writeConvexMesh, readConvexMesh>("convex-meshes", "convex-mesh"),
          meshArray<PfxLargeTriMesh, writeLargeTriMesh, readLargeTriMesh>("large-meshes", "large-mesh"),
          arrayOf<PfxShape>("shapes", "shape"),
          arrayOf<PfxRigidState>("states", "state"),
          arrayOf<PfxRigidBody>("bodies", "body"),
          arrayOf<PfxCollidable>("collidables", "collidable"),
          arrayOf<PfxJoint>("joints", "joint"),
          arrayOf<PfxContactManifold>("contacts", "contact"),
          arrayOf<PfxBroadphasePair>("pairs", "pair")};
}

struct Memory {
  PfxSerializeBuffers buffers;
  PfxSerializeCapacity capacity;
};

void place(const Memory& m, std::span<RecordArray> parts, uint32_t RecordArray::*size) {
  const PfxSerializeBuffers& b = m.buffers;
  const PfxSerializeCapacity& c = m.capacity;
  const auto put = [&](SerializePart part, void* data, PfxUInt32 count) { parts[part].data = data, parts[part].*size = count; };
  put(kConvexMeshes, b.convexMeshes, c.numConvexMeshes), put(kLargeTriMeshes, b.largeTriMeshes, c.numLargeTriMeshes);
  put(kShapes, b.shapes, c.numShapes);
  put(kStates, b.states, c.numRigidBodies), put(kBodies, b.bodies, c.numRigidBodies);
  put(kCollidables, b.collidables, c.numRigidBodies);
  put(kJoints, b.joints, c.numJoints), put(kContacts, b.contacts, c.numContacts), put(kPairs, b.pairs, c.numPairs);
}

PfxSerializeCapacity countsOf(std::span<const RecordArray> parts) {
  PfxSerializeCapacity c;
  c.numRigidBodies = parts[kStates].count;
  c.numShapes = parts[kShapes].count;
  c.numConvexMeshes = parts[kConvexMeshes].count, c.numLargeTriMeshes = parts[kLargeTriMeshes].count;
  c.numJoints = parts[kJoints].count, c.numPairs = parts[kPairs].count, c.numContacts = parts[kContacts].count;
  return c;
}

PfxInt32 codeOf(pfx::SerializeError error) {
  switch (error) {
    case pfx::SerializeError::Ok: return SCE_PFX_OK;
    case pfx::SerializeError::Loading: return SCE_PFX_ERR_SERIALIZE_LOADING_FAILED;
    case pfx::SerializeError::Saving: return SCE_PFX_ERR_SERIALIZE_SAVING_FAILED;
    case pfx::SerializeError::Data: return SCE_PFX_ERR_SERIALIZE_INVALID_DATA;
    case pfx::SerializeError::Parenthesis: return SCE_PFX_ERR_SERIALIZE_INVALID_PARENTHESIS;
    case pfx::SerializeError::File: return SCE_PFX_ERR_SERIALIZE_INVALID_FILE;
    case pfx::SerializeError::Version: return SCE_PFX_ERR_SERIALIZE_INVALID_VERSION;
    case pfx::SerializeError::Tag: return SCE_PFX_ERR_SERIALIZE_INVALID_TAG;
    case pfx::SerializeError::Form: return SCE_PFX_ERR_SERIALIZE_INVALID_FORM;
    case pfx::SerializeError::Count: return SCE_PFX_ERR_SERIALIZE_INVALID_COUNT;
  }
  return SCE_PFX_ERR_SERIALIZE_INVALID_DATA;
}

// Callbacks of the document that go through to those of the application.
pfx::serial::DocumentCallbacks bridge(const PfxSerializeFuncs& funcs, Memory& m, uint32_t RecordArray::*size) {
  pfx::serial::DocumentCallbacks out = {};
  out.init = [&funcs, &m, size](std::span<RecordArray> parts) {
    funcs.initFunc(m.buffers, m.capacity);
    place(m, parts, size);
  };
  if (funcs.resizeFunc != nullptr) {
    out.resize = [&funcs, &m, size](std::span<RecordArray> parts) {
      if (!funcs.resizeFunc(m.buffers, m.capacity, countsOf(parts))) return false;
      place(m, parts, size);
      return true;
    };
  }
  if (funcs.termFunc != nullptr) {
    out.term = [&funcs, &m](std::span<const RecordArray> parts) {
      m.capacity = countsOf(parts);
      funcs.termFunc(m.buffers, m.capacity);
    };
  }
  if (funcs.updateFunc != nullptr) out.update = funcs.updateFunc;
  if (funcs.errorFunc != nullptr) {
    out.error = [&funcs](const pfx::SerializeFailure& f) {
      funcs.errorFunc(codeOf(f.error), f.tags.data(), static_cast<PfxUInt32>(f.tags.size()));
    };
  }
  return out;
}

}  // namespace

PfxInt32 pfxSerializeWrite(std::FILE* file, const PfxSerializeFuncs& funcs) {
  if (file == nullptr || funcs.initFunc == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  Memory memory;
  std::array<RecordArray, kNumParts> parts = allParts();
  return codeOf(pfx::serial::writeDocument(file, kFormat, parts, bridge(funcs, memory, &RecordArray::count)));
}

PfxInt32 pfxSerializeRead(std::FILE* file, const PfxSerializeFuncs& funcs) {
  if (file == nullptr || funcs.initFunc == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  Memory memory;
  std::array<RecordArray, kNumParts> parts = allParts();
  return codeOf(pfx::serial::readDocument(file, kFormat, parts, bridge(funcs, memory, &RecordArray::capacity)));
}

}  // namespace sce::PhysicsEffects
