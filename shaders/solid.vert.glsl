// Solids made of triangles.
#include "frame.glsl"
#include "solid_common.glsl"

out vec3 v_position;
out vec3 v_normal;
out vec3 v_edge;
out float v_haze;
flat out vec4 v_color;  // linear
flat out float v_sheen;
flat out uint v_finish;

void main() {
  v_position = i_position + rotate(i_orientation, a_position * i_scale);
  v_normal = rotate(i_orientation, a_normal / i_scale);
  v_edge = a_edge;
  v_haze = haze(v_position);
  v_color = vec4(albedo(), i_color.a);
  v_sheen = sheen();
  v_finish = i_finish;
  gl_Position = placed(v_position);
}
