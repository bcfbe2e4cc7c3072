// Smooth edges from the distance to the middle line; points are discs with a dark rim.
// PASS_ID writes the pick id, else colour.
#include "frame.glsl"

uniform float u_strength;  // 1, or less for what is hidden behind a solid
uniform float u_side;

in vec2 v_across;
flat in float v_half;
in float v_taper;
flat in vec4 v_color;
flat in uint v_kind;
flat in uint v_pick;
#ifdef PASS_ID
out uint o_id;
#else
out vec4 o_color;
#endif

void main() {
  float away = v_kind == 3u ? length(v_across) : abs(v_across.x);
  float half_width = v_half * v_taper;
#ifdef PASS_ID
  if (v_pick == 0u || away > half_width + u_side) discard;
  o_id = v_pick;
#else
  float cover = clamp((half_width - away) / u_side + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  vec3 color = v_color.rgb;
  if (v_kind == 3u) color *= 1.0 - 0.75 * smoothstep(-1.6, -0.6, (away - half_width) / u_side);
  o_color = vec4(encode(color), v_color.a * cover * u_strength);
#endif
}
