// Instance attributes, the placing of a vertex, and the layers that instances fall into, shared by all passes over solids.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec3 a_edge;
layout(location = 3) in vec3 i_position;
layout(location = 4) in vec4 i_orientation;
layout(location = 5) in vec3 i_scale;
layout(location = 6) in vec4 i_color;  // bytes b, g, r, a
layout(location = 7) in uint i_finish;
layout(location = 8) in uint i_pick;

uniform mat4 u_clip;   // of the pass
uniform uint u_layers;  // bits of the layers that are drawn

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec3 rotateBack(vec4 q, vec3 v) { return rotate(vec4(-q.xyz, q.w), v); }

const uint kSoft = 0u, kMatte = 1u, kGlossy = 2u, kMetallic = 3u, kDead = 4u, kTranslucent = 5u;

// As layerOf() in viewer/draw_list/draw_list.h.
uint layer() {
  if (i_finish == kTranslucent || i_color.a < 0.999) return 8u;
  if (i_finish == kGlossy || i_finish == kMetallic) return 2u;
  return i_finish == kMatte && min(i_scale.x, i_scale.z) >= 8.0 ? 4u : 1u;
}

// The clip position of a point of an instance; outside of everything when its layer is not drawn.
vec4 placed(vec3 world) {
  return (layer() & u_layers) != 0u ? u_clip * vec4(world, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
}

// What the colour passes know of a surface. Dead ones lose most of their colour.
vec3 albedo() {
  vec3 c = linearFromSrgb(i_color.bgr);
  return i_finish == kDead ? mix(vec3(dot(c, vec3(0.25, 0.6, 0.15))), c, 0.35) * 0.82 : c;
}
float sheen() { return i_finish == kSoft ? 0.10 : 0.0; }

// Distance hides in haze.
float haze(vec3 world) {
  float t = max(distance(world, eye.xyz) - fog.x, 0.0) * fog.y * eye.w;
  return t * t / (1.0 + t * t);
}
