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

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec3 rotateBack(vec4 q, vec3 v) { return rotate(vec4(-q.xyz, q.w), v); }

const uint kSoft = 0u, kDead = 4u;  // pfx::Finish

vec4 placed(vec3 world) { return u_clip * vec4(world, 1.0); }

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
