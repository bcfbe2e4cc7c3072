// Triangles of solids where only depth or the pick id counts.
#include "frame.glsl"
#include "solid_common.glsl"

flat out uint v_pick;

void main() {
  v_pick = i_pick;
  gl_Position = placed(i_position + rotate(i_orientation, a_position * i_scale));
}
