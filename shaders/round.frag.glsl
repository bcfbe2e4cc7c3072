// Ray against capsule along X (a sphere when the core has no length). PASS_COLOR draws it lit, PASS_ID its pick id, and
// PASS_DEPTH only its depth.
#include "frame.glsl"
#ifdef PASS_COLOR
#include "shading.glsl"
#endif

uniform mat4 u_clip;

in vec3 v_local;
in vec3 v_ray;
flat in vec3 v_center;
flat in vec4 v_orientation;
flat in vec2 v_size;
flat in vec4 v_color;
flat in float v_sheen;
flat in float v_haze;
flat in uint v_finish;
flat in uint v_pick;
#if defined(PASS_COLOR)
out vec4 o_color;
#elif defined(PASS_ID)
out uint o_id;
#endif

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

// The first point of the surface on the ray o + t d, d unit; w: negative when the ray misses.
vec4 firstHit(vec3 o, vec3 d) {
  // The side is hit first wherever the infinite cylinder is entered between the caps; elsewhere the cap on that side.
  float a = max(dot(d.yz, d.yz), 1e-7), b = dot(o.yz, d.yz), c = dot(o.yz, o.yz) - v_size.y * v_size.y;
  float disc = b * b - a * c;
  float t = (-b - sqrt(max(disc, 0.0))) / a;
  float x = o.x + t * d.x;
  if (abs(x) > v_size.x) {
    vec3 from_cap = o - vec3(x > 0.0 ? v_size.x : -v_size.x, 0.0, 0.0);
    float b2 = dot(from_cap, d);
    disc = b2 * b2 - dot(from_cap, from_cap) + v_size.y * v_size.y;
    t = -b2 - sqrt(max(disc, 0.0));
  }
  return vec4(o + t * d, disc);
}

// Two seams along the body and one round each end: they show how it turns.
float seams(vec3 p) {
  vec3 q = vec3(abs(p.x) - v_size.x, p.yz);
  vec3 slope = max(fwidth(q), 1e-6) * fog.z;
  vec3 line = clamp(1.4 - 1.25 * abs(q) / slope, 0.0, 1.0) * clamp(v_size.y / (slope * 12.0) - 0.3, 0.0, 1.0);
  return max(line.x, max(line.y, line.z));
}

void main() {
  vec4 hit = firstHit(v_local, normalize(v_ray));
  vec3 position = v_center + rotate(v_orientation, hit.xyz);
#ifdef PASS_COLOR
  float seam = seams(hit.xyz);
#endif
  if (hit.w < 0.0) discard;
  vec4 clip = u_clip * vec4(position, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
#if defined(PASS_COLOR)
  vec3 normal = hit.xyz - vec3(clamp(hit.x, -v_size.x, v_size.x), 0.0, 0.0);
  normal = rotate(v_orientation, normal / v_size.y);
  vec3 color = shade(position, normal, v_color.rgb, v_sheen, v_finish) * (1.0 - 0.30 * seam);
  o_color = vec4(encode(tone(mix(color, kSkyHorizon, v_haze))), v_color.a);
#elif defined(PASS_ID)
  o_id = v_pick;
#endif
}
