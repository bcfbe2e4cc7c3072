// Solids made of triangles.
#include "frame.glsl"
#include "solid_common.glsl"

out vec3 v_position;
out vec3 v_normal;
out vec3 v_edge;
flat out vec4 v_color;  // linear
flat out uint v_finish;
flat out float v_grid;  // 1: shows the metre grid on top

void main() {
  v_position = i_position + rotate(i_orientation, a_position * i_scale);
  v_normal = rotate(i_orientation, a_normal / i_scale);
  v_edge = a_edge;
  v_color = vec4(linearFromSrgb(i_color.bgr), i_color.a);
  v_finish = i_finish;
  v_grid = i_finish == kMatte && min(i_scale.x, i_scale.z) >= 4.0 ? 1.0 : 0.0;
  gl_Position = inLayer() ? u_clip * vec4(v_position, 1.0) : kOutside;
}
