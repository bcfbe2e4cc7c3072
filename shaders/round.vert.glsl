// Spheres and capsules: a box round each, inside which the fragment shader finds the exact surface.
// i_scale: half length of the core along X, radius, radius.
#include "frame.glsl"
#include "solid_common.glsl"

uniform vec4 u_eye;  // xyz: eye (w 1) or direction of all rays (w 0)

out vec3 v_local;  // m, shape frame, on the far side of the box
out vec3 v_ray;    // shape frame, not unit
flat out vec3 v_center;
flat out vec4 v_orientation;
flat out vec2 v_size;  // half length, radius
flat out vec4 v_color;  // linear
flat out float v_sheen;
flat out float v_haze;
flat out uint v_finish;
flat out uint v_pick;

void main() {
  v_local = a_position * vec3(i_scale.x + i_scale.y, i_scale.yy);
  vec3 world = i_position + rotate(i_orientation, v_local);
  v_ray = rotateBack(i_orientation, u_eye.w > 0.5 ? world - u_eye.xyz : u_eye.xyz);
  v_center = i_position;
  v_orientation = i_orientation;
  v_size = i_scale.xy;
  v_color = vec4(albedo(), i_color.a);
  v_sheen = sheen();
  v_haze = haze(i_position);
  v_finish = i_finish;
  v_pick = i_pick;
  gl_Position = placed(world);
}
