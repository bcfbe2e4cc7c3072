// Meshes of a scene file: numbers in the element, or an OBJ file next to the scene.
#include "pfx/high_level/scene_file/read_mesh.h"

#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/high_level/scene_file/names.h"
#include "pfx/high_level/scene_file/obj_reader.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace pfx {
namespace {

struct MeshSource {
  TriangleList list;
  std::vector<float> thickness;     // by triangle, or empty
  std::vector<uint32_t> user_data;  // likewise
};

void addVertices(const XmlElement& e, std::vector<Vec3>& vertices) {
  const std::vector<float> v = e.numbers();
  if (v.size() % 3 != 0) e.fail(std::to_string(v.size()) + " numbers, must be three a vertex");
  for (size_t i = 0; i < v.size(); i += 3) vertices.push_back(Vec3(v[i], v[i + 1], v[i + 2]));
}

MeshSource readSource(XmlElement& e, const std::filesystem::path& folder) {
  MeshSource source;
  const std::string file = e.text("file", "");
  e.finish();
  if (!file.empty()) {
    const std::filesystem::path path = folder / file;
    source.list = readObj(readTextFile(path), path.string());
  }
  for (const XmlElement& child : e.children({"vertices", "triangles", "thickness", "user-data"})) {
    child.finish();
    if (!file.empty() && (child.tag() == "vertices" || child.tag() == "triangles"))
      child.fail("the mesh has a file already");
    if (child.tag() == "vertices") addVertices(child, source.list.vertices);
    if (child.tag() == "triangles") source.list.indices = child.indices();
    if (child.tag() == "thickness") source.thickness = child.numbers();
    if (child.tag() == "user-data") source.user_data = child.indices();
  }
  if (source.list.vertices.empty()) e.fail("the mesh has no vertices: give <vertices> or the attribute file");
  return source;
}

}  // namespace

ConvexMesh readConvexMesh(XmlElement& e, const std::filesystem::path& folder) {
  const MeshSource source = readSource(e, folder);
  const TriangleList& list = source.list;
  ConvexMesh mesh;
  const Error error = list.indices.empty() ? buildConvexMesh(list.vertices, mesh)
                                           : checkConvexMesh(list.vertices, list.indices, mesh);
  if (error != Error::Ok) e.fail(toString(error));
  return mesh;
}

LargeMesh readLargeMesh(XmlElement& e, const std::filesystem::path& folder) {
  LargeMeshOptions options;
  e.readName("type", options.type, scene_names::kLargeMeshTypes);
  e.read("high-quality", options.high_quality);
  e.read("weld", options.weld);
  e.read("thickness", options.thickness);
  const MeshSource source = readSource(e, folder);
  options.triangle_thickness = source.thickness;
  options.user_data = source.user_data;
  LargeMeshResult built = buildLargeMesh(source.list.vertices, source.list.indices, options);
  if (built.error != Error::Ok) e.fail(std::string(toString(built.error)) + " (number " + std::to_string(built.where) + ")");
  return std::move(built.mesh);
}

}  // namespace pfx
