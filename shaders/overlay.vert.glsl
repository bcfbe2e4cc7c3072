// Lines, arrows and points as quads that face the screen. Widths are in pixels whatever the distance.
#include "frame.glsl"

layout(location = 0) in vec3 i_from;
layout(location = 1) in vec3 i_to;
layout(location = 2) in vec4 i_color;  // bytes b, g, r, a
layout(location = 3) in float i_width;
layout(location = 4) in uint i_kind;   // 0 line, 1 arrow shaft, 2 arrow head, 3 point
layout(location = 5) in uint i_pick;

uniform vec2 u_pixels;     // size of the target in samples
uniform float u_side;      // samples along a pixel's side

out vec2 v_across;         // samples from the middle line, and from the middle of a point
flat out float v_half;     // half width at this quad's wide end, samples
out float v_taper;         // part of the half width that is left (arrow heads narrow to their tip)
flat out vec4 v_color;
flat out uint v_kind;
flat out uint v_pick;

// Slightly towards the eye, so that lines on a surface are in front of it.
vec4 place(vec3 p) {
  vec3 nearer = eye.w > 0.5 ? mix(p, eye.xyz, 0.004) : p - ray_forward.xyz * 0.01;
  return clip_from_world * vec4(nearer, 1.0);
}

// Cuts the segment a-b at the near plane, keeping b's side when a is behind it.
vec4 cut(vec4 a, vec4 b) {
  float da = a.z + a.w, db = b.z + b.w;
  return da < 0.0 && db > 0.0 ? mix(a, b, (da - 1e-4) / (da - db)) : a;
}

void main() {
  vec4 a = place(i_from), b = place(i_to);
  vec4 ca = cut(a, b), cb = cut(b, a);
  bool visible = ca.z + ca.w > 0.0 && cb.z + cb.w > 0.0;
  vec2 half_size = 0.5 * u_pixels;
  vec2 sa = ca.xy / ca.w * half_size, sb = cb.xy / cb.w * half_size;
  vec2 along = sb - sa;
  float len = length(along);
  vec2 d = len > 1e-4 ? along / len : vec2(0.0, 1.0);

  float end = float(gl_VertexID >> 1), side = float(gl_VertexID & 1) * 2.0 - 1.0;
  float half_width = 0.5 * i_width * u_side;
  float head = min(4.5 * i_width * u_side, 0.6 * len);
  v_taper = 1.0;
  if (i_kind == 1u) sb -= d * head * 0.8;
  if (i_kind == 2u) {
    sa = sb - d * head;
    half_width = 0.42 * head;
    v_taper = 1.0 - end;
  }
  float margin = half_width + u_side;
  vec2 at = mix(sa, sb, end) + vec2(-d.y, d.x) * side * margin;
  v_across = vec2(side * margin, 0.0);
  if (i_kind == 3u) {
    v_across = vec2(end * 2.0 - 1.0, side) * margin;
    at = sa + v_across;
  } else if (i_kind == 0u) {
    at += d * (end * 2.0 - 1.0) * half_width;
  }
  vec4 base = end > 0.5 ? cb : ca;
  v_half = half_width;
  v_color = vec4(linearFromSrgb(i_color.bgr), i_color.a);
  v_kind = i_kind;
  v_pick = i_pick;
  gl_Position = visible ? vec4(at / half_size * base.w, base.z, base.w) : vec4(0.0, 0.0, 2.0, 1.0);
}
