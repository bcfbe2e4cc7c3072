// Instance attributes and the placing of a vertex, shared by all passes over solids.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec3 a_edge;
layout(location = 3) in vec3 i_position;
layout(location = 4) in vec4 i_orientation;
layout(location = 5) in vec3 i_scale;
layout(location = 6) in vec4 i_color;  // bytes b, g, r, a
layout(location = 7) in uint i_finish;
layout(location = 8) in uint i_pick;

uniform mat4 u_clip;  // of the pass
uniform int u_layer;  // 0: opaque instances, 1: translucent ones, 2: all

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec3 rotateBack(vec4 q, vec3 v) { return rotate(vec4(-q.xyz, q.w), v); }

const uint kSoft = 0u, kMatte = 1u, kGlossy = 2u, kMetallic = 3u, kDead = 4u, kTranslucent = 5u;

bool inLayer() {
  bool translucent = i_finish == kTranslucent || i_color.a < 0.999;
  return u_layer == 2 || translucent == (u_layer == 1);
}
const vec4 kOutside = vec4(0.0, 0.0, 2.0, 1.0);
